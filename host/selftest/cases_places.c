// Tests hard cases of small things in a large scene: a bead anywhere on a wide floor. The oracle
// takes corners that were never rounded.
#include "selftest/judged.h"
#include "selftest/shapes.h"

#include <math.h>
#include <stdlib.h>

#define BEAD_RADIUS 5e-4

typedef struct floor_view {
    const char *what;
    double half;  // half of the floor's edge, metres
    double place; // the bead's place on the way from the middle to a corner
    bool is_tilted;
    shape_material material;
} floor_view;

static const floor_view views[] = {
    {"a mirror of 1 mm half-way on 10 m", 5, 0.5, false, MATERIAL_MIRROR},
    {"glass of 1 mm in the middle of 100 m", 50, 0, true, MATERIAL_GLASS},
    {"glass of 1 mm at a corner of 100 m", 50, 0.95, false, MATERIAL_GLASS},
    {"a mirror of 1 mm at a corner of 10 m, tilted", 5, 0.95, true, MATERIAL_MIRROR},
    {"a mirror of 1 mm off the middle of 100 km", 5e4, 0.35, false, MATERIAL_MIRROR},
    {"glass of 1 mm off the middle of 10 km", 5000, 0.35, false, MATERIAL_GLASS},
};

// Turns a direction or a place with the floor: by 0.4 about (0.6, 0, 0.8), if it is tilted.
static void lay(const floor_view *of, const double p[3], double laid[3])
{
    static const double axis[3] = {0.6, 0, 0.8};
    const double angle = of->is_tilted ? 0.4 : 0, along = p[0] * axis[0] + p[2] * axis[2];
    const double crossed[3] = {axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2],
                               axis[0] * p[1] - axis[1] * p[0]};
    for (int k = 0; k < 3; k++) {
        laid[k] = p[k] * cos(angle) + crossed[k] * sin(angle) + axis[k] * along * (1 - cos(angle));
    }
}

// A place `offset` metres from the bead's lowest point.
static void place_at(const floor_view *of, const double offset[3], double place[3])
{
    const double p[3] = {of->place * of->half + offset[0], offset[1],
                         of->place * of->half + offset[2]};
    lay(of, p, place);
}

// Builds the scene in stored units. The unit fits the floor's size.
static glint_status build_floor(trial *t, const floor_view *of, glint_scene *scene, double **exact)
{
    static const double around[4][2] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
    static const double to_centre[3] = {0, 1.001 * BEAD_RADIUS, 0};
    const double unit = ldexp(1, 1 + ilogb(of->half));
    double corners[4][3], centre[3];
    shape s = shape_begin();
    place_at(of, to_centre, centre);
    for (int k = 0; k < 3; k++) {
        centre[k] /= unit;
    }
    shape_add_ball(&s, &(shape_ball){centre, BEAD_RADIUS / unit, 3, of->material, true, NULL});
    for (int i = 0; i < 4; i++) {
        const double corner[3] = {of->half / unit * around[i][0], 0,
                                  of->half / unit * around[i][1]};
        lay(of, corner, corners[i]);
    }
    shape_add_quad(&s, (const double(*)[3])corners, MATERIAL_TINTED);
    return shape_end_with_parts(&s, unit, scene, exact, t->error);
}

// If rounding decides a pixel, an edge of a facet may show its other side. At most one pixel in a
// thousand may be off by more than 0.001.
static glint_status see_bead(trial *t, const floor_view *of)
{
    static const double to_eye[3] = {1.5e-3, 2.2e-3, 4e-3}, to_bead[3] = {0, BEAD_RADIUS, 0};
    glint_measure *m = trial_share(t, of->what, 1e-3);
    glint_scene scene = {0};
    judged frame = {0};
    double *exact = NULL, eye[3], target[3];
    // Set up the frame.
    glint_settings settings = trial_settings(t);
    settings.width = 48;
    settings.height = 36;
    settings.depth = 8;
    settings.min_weight = 0x1p-10;
    place_at(of, to_eye, eye);
    place_at(of, to_bead, target);
    const glint_camera camera = shape_camera(eye, target, 0.3, 0);
    glint_status status;
    // Render it; give the oracle the exact corners.
    TRY_OR(cleanup, status, build_floor(t, of, &scene, &exact));
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    TRY_OR(cleanup, status, judge_move(&frame.judge, &scene, exact, t->error));
    // Compare every pixel.
    for (int p = 0; p < settings.width * settings.height; p++) {
        double expected[4], off = 0;
        oracle_report report;
        judged_pixel(&frame, p, expected, &report);
        for (int k = 0; k < 3; k++) {
            const double by = fabs(frame.picture.values[4 * p + k] - expected[k]);
            off = by <= off ? off : by; // NaN stays
        }
        measure_event(m, !(off <= 1e-3), "pixel (%d, %d): off by %.2g", p % settings.width,
                      p / settings.width, off);
    }
cleanup:
    free(exact);
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

static glint_status beads_on_floors(trial *t)
{
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        TRY(see_bead(t, &views[i]));
    }
    return GLINT_OK;
}

const trial_case place_cases[] = {
    {"beads_on_floors",
     "a bead of 1 mm anywhere on floors of 10 m to 100 km, eight surfaces deep: the oracle's "
     "colours",
     beads_on_floors},
    {0},
};
