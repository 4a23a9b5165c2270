// Tests hard cases of punctual lights: in a surface, close above a surface, at the edge of a cone
// and of a range, in mirrors and through glass, and in scenes of any size. The environment is
// black.
#include "selftest/judge.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"
#include "selftest/vectors.h"

#include <math.h>

// The roundings of a point's coordinates: a few dozen, each weighed by up to 1/distance.
#define ROUNDINGS 256

#define FLOOR (-0.5)

// Adds a sheet about the y axis, 12 × 12 quads with y = height + slope·x, that faces up or down.
static void add_sheet(shape *s, double height, double slope, bool faces_down)
{
    enum { PARTS = 12 };
    const double step = 1.5 / PARTS;
    for (int i = 0; i < PARTS * PARTS; i++) {
        const int column = i % PARTS, row = i / PARTS;
        const double x0 = -0.75 + step * column, x1 = x0 + step;
        const double z0 = -0.75 + step * row, z1 = z0 + step;
        const double y0 = height + slope * x0, y1 = height + slope * x1;
        const double up[4][3] = {{x0, y0, z1}, {x1, y1, z1}, {x1, y1, z0}, {x0, y0, z0}};
        const double down[4][3] = {{x0, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x0, y0, z1}};
        shape_add_quad(s, faces_down ? down : up, MATERIAL_PAINT);
    }
}

// A lamp whose irradiance at distance 1 is π.
static glint_punctual_light white_lamp(double x, double y, double z)
{
    return (glint_punctual_light){.kind = GLINT_PUNCTUAL_POINT,
                                  .position = {x, y, z},
                                  .direction = {0, -1, 0},
                                  .color = {GLINT_PI, GLINT_PI, GLINT_PI},
                                  .range = INFINITY};
}

// Ends the shape with lights. The caller frees the scene, even after a failure.
static glint_status end_lit(trial *t, shape *s, const glint_punctual_light *lights, size_t count,
                            glint_scene *scene)
{
    TRY(shape_end(s, scene, t->error));
    return shape_set_lights(lights, count, scene, t->error);
}

static glint_status render_in_dark(trial *t, const glint_scene *scene, const glint_camera *camera,
                                   const glint_settings *settings, trial_picture *picture)
{
    glint_environment environment;
    *picture = (trial_picture){0};
    glint_status status;
    TRY_OR(cleanup, status, trial_uniform_environment(0, &environment, t->error));
    const glint_renderer_inputs inputs = trial_inputs(t, scene, &environment, settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, camera, picture));
cleanup:
    glint_environment_free(&environment);
    return status;
}

// A camera with parallel rays from height y, down or up.
static glint_camera looking(double y, bool up)
{
    const double eye[3] = {0, y, 0}, target[3] = {0, up ? y + 1 : y - 1, 0};
    return shape_camera(eye, target, 0, 0.4);
}

// The point where a pixel's ray of this camera meets a sheet.
static void point_of(const glint_camera *camera, const trial_picture *picture, int pixel,
                     const double sheet[2], double p[3])
{
    const int column = pixel % picture->width, row = pixel / picture->width;
    const double w = picture->width, h = picture->height;
    const double x = (2 * (column + 0.5) / w - 1) * camera->ymag * w / h;
    const double y = (1 - 2 * (row + 0.5) / h) * camera->ymag;
    p[0] = camera->right.x * x + camera->up.x * y;
    p[2] = camera->right.z * x + camera->up.z * y;
    p[1] = sheet[0] + sheet[1] * p[0];
}

// (n·l)/d² of a lamp above a sheet.
static double irradiance(const glint_punctual_light *lamp, const double p[3], double slope)
{
    const double to[3] = {lamp->position.x - p[0], lamp->position.y - p[1],
                          lamp->position.z - p[2]};
    const double height = (to[1] - slope * to[0]) / hypot(1, slope);
    return fmax(height, 0) / pow(dot(to, to), 1.5);
}

// The share of light that the lamp's range and its cone, about −y, leave.
static double share_left(const glint_punctual_light *lamp, const double p[3])
{
    const double to[3] = {lamp->position.x - p[0], lamp->position.y - p[1],
                          lamp->position.z - p[2]};
    const double distance = sqrt(dot(to, to));
    const double open = fmax(1 - pow(distance / lamp->range, 4), 0);
    if (lamp->kind != GLINT_PUNCTUAL_SPOT) {
        return open;
    }
    const double outer = cos(lamp->outer_angle);
    const double soft = fmax(0.001, cos(lamp->inner_angle) - outer);
    return open * pow(fmin(fmax((to[1] / distance - outer) / soft, 0), 1), 2);
}

// A sheet of this height and slope, seen from `eye`: from above, where the lamp lights it, or from
// below, where it is dark.
typedef struct lit_sheet {
    double sheet[2];
    double eye;
    bool up;
} lit_sheet;

// Renders a shape with a lamp and compares every pixel with the lamp's light on the sheet. Errors
// are in u of the light of the same lamp without range and cone.
static glint_status compare_sheet(trial *t, shape *s, const glint_punctual_light *lamp,
                                  const lit_sheet *sheet, glint_measure *errors)
{
    glint_scene scene;
    trial_picture picture = {0};
    glint_status status;
    const glint_camera camera = looking(sheet->eye, sheet->up);
    const glint_settings settings = trial_settings(t);
    TRY_OR(cleanup, status, end_lit(t, s, lamp, 1, &scene));
    TRY_OR(cleanup, status, render_in_dark(t, &scene, &camera, &settings, &picture));
    for (int i = 0; i < picture.width * picture.height; i++) {
        double p[3];
        point_of(&camera, &picture, i, sheet->sheet, p);
        const double whole = irradiance(lamp, p, sheet->sheet[1]);
        const double expected = sheet->up ? 0 : whole * share_left(lamp, p);
        measure_value(errors, picture.values[4 * i], expected, t->u * (sheet->up ? 1 : whole),
                      "lamp at height %g, pixel %d", lamp->position.y, i);
    }
cleanup:
    glint_scene_free(&scene);
    trial_picture_free(&picture);
    return status;
}

// ---- In a surface -------------------------------------------------------------------------------

// The lamp lights the floor. It must not light the ceiling that it lies in, even if rounding puts a
// ray's hit of the ceiling before the lamp. Its range ends within the picture, or nowhere.
static glint_status lamp_on_a_ceiling(trial *t)
{
    static const double heights[] = {0.5, 0.7, 0.3333};
    static const double ranges[] = {INFINITY, 1.25, 0.875};
    glint_measure *lit = trial_error(t, "light on the floor", "u", ROUNDINGS);
    glint_measure *dark = trial_error(t, "light on the ceiling", "u", 0);
    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++) {
        const double y = (double)(float)heights[i];
        glint_punctual_light lamp = white_lamp(0.125, y, 0.0625);
        lamp.range = ranges[i];
        for (int up = 0; up < 2; up++) {
            shape s = shape_begin();
            add_sheet(&s, FLOOR, 0, false);
            add_sheet(&s, y, 0, true);
            const lit_sheet sheet = {{up ? y : FLOOR, 0}, 0.25, up};
            TRY(compare_sheet(t, &s, &lamp, &sheet, up ? dark : lit));
        }
    }
    return GLINT_OK;
}

// ---- Close above a surface ---------------------------------------------------------------------

// Slopes are powers of two, so the sheets' corners are floats. On a sheet through the origin of
// coordinates, shadow rays start with an offset of 0.
static glint_status grazing_lamps(trial *t)
{
    static const double sheets[][2] = {{FLOOR, 0.125}, {0, 0.125}, {0, 0}};
    glint_measure *errors =
        trial_error(t, "light of a lamp at height h over a sheet", "u/h", ROUNDINGS);
    for (int i = 0; i < 3 * 6; i++) {
        const double *place = sheets[i / 6], height = ldexp(1, -2 * (1 + i % 6));
        const glint_punctual_light lamp = white_lamp(0, place[0] + height, 0.03125);
        const lit_sheet sheet = {{place[0], place[1]}, 0.9, false};
        shape s = shape_begin();
        add_sheet(&s, place[0], place[1], false);
        const double u = t->u;
        t->u /= height; // the unit of errors
        const glint_status status = compare_sheet(t, &s, &lamp, &sheet, errors);
        t->u = u;
        TRY(status);
    }
    return GLINT_OK;
}

// ---- At the edge of a cone ---------------------------------------------------------------------

static glint_status spot_edges(trial *t)
{
    static const struct {
        const char *name;
        double inner, outer;
    } cones[] = {{"cone 14° to 29°", 0.25, 0.5},
                 {"0° to 43°", 0, 0.75},
                 {"0.6° to 1.1°", 0.01, 0.02},
                 {"28.64° to 28.65°", 0.4999, 0.5},
                 {"0° to 90°", 0, GLINT_PI / 2}};
    for (size_t i = 0; i < sizeof cones / sizeof *cones; i++) {
        glint_punctual_light spot = white_lamp(0.0625, 0.75, -0.03125);
        spot.kind = GLINT_PUNCTUAL_SPOT;
        spot.inner_angle = cones[i].inner;
        spot.outer_angle = cones[i].outer;
        // An error of the cosine is divided by cos inner − cos outer, and doubled by the square.
        const double soft = fmax(0.001, cos(spot.inner_angle) - cos(spot.outer_angle));
        glint_measure *errors = trial_error(t, cones[i].name, "u", ROUNDINGS + 16 / soft);
        const lit_sheet sheet = {{FLOOR, 0}, 0.9, false};
        shape s = shape_begin();
        add_sheet(&s, FLOOR, 0, false);
        TRY(compare_sheet(t, &s, &spot, &sheet, errors));
    }
    return GLINT_OK;
}

// ---- In mirrors and through glass --------------------------------------------------------------

static void no_light(const void *context, const double direction[3], double rgb[3])
{
    (void)context;
    (void)direction;
    rgb[0] = rgb[1] = rgb[2] = 0;
}

// Pixels this near to an edge or to the critical angle may show its other side. Curved surfaces
// multiply the rounding error u.
#define MARGIN 2048
// The same rounding in a colour. Near such an edge the colour changes faster.
#define MIRRORED_ROUNDINGS 16384

static glint_status compare_mirrored(trial *t, const glint_scene *scene, glint_measure *errors,
                                     glint_measure *undecided)
{
    static const double eye[3] = {0.2, 0.6, 2.2}, target[3] = {0, -0.2, 0};
    const glint_camera camera = shape_camera(eye, target, 0.7, 0);
    glint_settings settings = trial_settings(t);
    settings.depth = 4;
    oracle_view view = judge_view(&camera, &settings);
    view.depth = settings.depth;
    view.edges = true;
    trial_picture picture = {0};
    judge j;
    glint_status status;
    TRY_OR(cleanup, status, judge_begin(scene, &j, t->error));
    j.scene.radiance = j.scene.irradiance = no_light;
    TRY_OR(cleanup, status, render_in_dark(t, scene, &camera, &settings, &picture));
    for (int i = 0; i < picture.width * picture.height; i++) {
        const int pixel[2] = {i % picture.width, i / picture.width};
        double rgba[4];
        oracle_report report;
        oracle_pixel(&j.scene, &view, pixel, rgba, &report);
        const bool near = fmin(report.edge, report.critical) < MARGIN * t->u;
        measure_event(undecided, near, "pixel (%d, %d)", pixel[0], pixel[1]);
        if (!near) {
            measure_value(errors, picture.values[4 * i], rgba[0], t->u, "pixel (%d, %d)", pixel[0],
                          pixel[1]);
        }
    }
cleanup:
    judge_end(&j);
    trial_picture_free(&picture);
    return status;
}

// Lights paint past a mirror and glass; both show the paint. The lamp hangs below a ceiling, which
// takes none of its light. The sun shines from the side.
static glint_status lights_in_mirrors(trial *t)
{
    static const double left[3] = {-0.35, -0.19, 0}, right[3] = {0.35, -0.19, 0.1};
    static const double low[3] = {-0.15, -0.45, 0.35}, high[3] = {0.1, -0.2, 0.45};
    glint_punctual_light lights[] = {white_lamp(0.3, 0.6, 0.6), white_lamp(0, 0, 0)};
    lights[1].kind = GLINT_PUNCTUAL_DIRECTIONAL;
    lights[1].direction = (glint_vec3){-0.48, -0.64, -0.6};
    glint_measure *errors = trial_error(t, "error of the colour", "u", MIRRORED_ROUNDINGS);
    glint_measure *undecided = trial_share(t, "pixels at edges, left out", 0.1);
    glint_scene scene;
    shape s = shape_begin();
    add_sheet(&s, FLOOR, 0, false);
    add_sheet(&s, 1, 0, true);
    shape_add_ball(&s, &(shape_ball){left, 0.3, 3, MATERIAL_MIRROR, true, NULL});
    shape_add_ball(&s, &(shape_ball){right, 0.3, 3, MATERIAL_GLASS, true, NULL});
    shape_add_box(&s, &(shape_box){low, high, 1, MATERIAL_PAINT, false});
    glint_status status;
    TRY_OR(cleanup, status, end_lit(t, &s, lights, 2, &scene));
    TRY_OR(cleanup, status, compare_mirrored(t, &scene, errors, undecided));
cleanup:
    glint_scene_free(&scene);
    return status;
}

// ---- Of any size -------------------------------------------------------------------------------

// Renders a scene of this unit; the light is brighter by the unit's square.
static glint_status render_sized(trial *t, double unit, trial_picture *picture)
{
    static const double middle[3] = {0, 0, 0};
    const double eye[3] = {0, 2 * unit, 0};
    const glint_camera camera = shape_camera(eye, middle, 0.5, 0);
    glint_punctual_light lamp = white_lamp(0.3 * unit, 0.7 * unit, 0.1 * unit);
    lamp.range = 1.75 * unit;
    for (int k = 0; k < 3; k++) {
        lamp.color[k] *= unit * unit;
    }
    glint_settings settings = trial_settings(t);
    settings.depth = 3;
    glint_scene scene;
    shape s = shape_begin();
    add_sheet(&s, FLOOR, 0, false);
    shape_add_ball(&s, &(shape_ball){middle, 0.2, 2, MATERIAL_GLASS, true, NULL});
    glint_status status;
    TRY_OR(cleanup, status, end_lit(t, &s, &lamp, 1, &scene));
    scene.unit = unit;
    glint_scene_find_bounds(&scene);
    TRY_OR(cleanup, status, render_in_dark(t, &scene, &camera, &settings, picture));
cleanup:
    glint_scene_free(&scene);
    return status;
}

static glint_status lights_of_any_size(trial *t)
{
    static const int powers[] = {40, -40};
    glint_measure *errors = trial_error(t, "colours beside those of unit 1", "ulp", 0);
    trial_picture plain = {0}, sized = {0};
    glint_status status;
    TRY_OR(cleanup, status, render_sized(t, 1, &plain));
    for (int i = 0; i < 2; i++) {
        TRY_OR(cleanup, status, render_sized(t, ldexp(1, powers[i]), &sized));
        for (int p = 0; p < 4 * plain.width * plain.height; p++) {
            measure_error(errors, fabs(trial_ulps(t, sized.values[p], plain.values[p])),
                          "2^%d, value %d: %.9g with unit 1, %.9g", powers[i], p, plain.values[p],
                          sized.values[p]);
        }
        trial_picture_free(&sized);
    }
cleanup:
    trial_picture_free(&plain);
    trial_picture_free(&sized);
    return status;
}

const trial_case light_cases[] = {
    {"lamp_on_a_ceiling", "a lamp in a ceiling's plane lights the floor, and not the ceiling",
     lamp_on_a_ceiling},
    {"grazing_lamps",
     "down to 2^−12 above flat and slanted sheets: light everywhere, no shadow of its own",
     grazing_lamps},
    {"spot_edges", "wide and narrow cones, hard and soft edges", spot_edges},
    {"lights_in_mirrors", "lit paint in a mirror and through glass, and their shadows",
     lights_in_mirrors},
    {"lights_of_any_size", "scenes times 2^±40: the same bits", lights_of_any_size},
    {0},
};
