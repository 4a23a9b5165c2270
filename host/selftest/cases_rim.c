// Tests lobes of surfaces that are seen at a slant, where they are narrow. Small plates fill the
// pixels of a picture: each column turns them another way, each row tilts them further. The oracle
// goes over the facets that the viewer sees, so no direction matters more than it should.
#include "oracle/rough.h"
#include "selftest/judged.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>

#define FACETS 4096 // of the oracle: its sums err by about 1e-3
#define PITCH 0.03  // of the plates in the picture

static const double cosines[] = {1, 0.5, 0.25, 0.14, 0.1, 0.07, 0.04, 0.02, 0.01, 0.004};
static const float roughnesses[] = {0.03F, 0.05F, 0.07F, 0.1F, 0.15F, 0.3F, 0.6F, 1};
enum { AZIMUTHS = 12, TILTS = sizeof cosines / sizeof *cosines };
enum { FRAMES = sizeof roughnesses / sizeof *roughnesses };

// The place in the picture, from its middle, of plate (azimuth, tilt).
static void place_of(int azimuth, int tilt, double place[2])
{
    place[0] = PITCH * (azimuth + 0.5 - 0.5 * AZIMUTHS);
    place[1] = PITCH * (0.5 * TILTS - 0.5 - tilt);
}

static glint_vec3 in_world(const glint_camera *camera, double right, double up, double back)
{
    return glint_vec3_add(
        glint_vec3_add(glint_vec3_scale(camera->right, right), glint_vec3_scale(camera->up, up)),
        glint_vec3_scale(camera->back, back));
}

static void add_plate(shape *s, const glint_camera *camera, int azimuth, int tilt,
                      shape_material material)
{
    const double c = cosines[tilt], angle = 2 * GLINT_PI * (azimuth + 0.3) / AZIMUTHS;
    const double wide = fmin(0.4 * PITCH, 0.9 * c), steep = sqrt(1 - c * c) / c;
    double place[2], corners[4][3];
    place_of(azimuth, tilt, place);
    for (int i = 0; i < 4; i++) {
        const double along = i == 0 || i == 3 ? -wide : wide, across = i < 2 ? -wide : wide;
        const glint_vec3 p =
            in_world(camera, place[0] + along * cos(angle) - across * sin(angle),
                     place[1] + along * sin(angle) + across * cos(angle), -steep * along);
        corners[i][0] = p.x, corners[i][1] = p.y, corners[i][2] = p.z;
    }
    shape_add_quad(s, corners, material);
}

static glint_status make_plates(const glint_camera *camera, shape_material material,
                                float roughness, glint_scene *scene, glint_error *error)
{
    shape s = shape_begin();
    for (int tilt = 0; tilt < TILTS; tilt++) {
        for (int azimuth = 0; azimuth < AZIMUTHS; azimuth++) {
            add_plate(&s, camera, azimuth, tilt, material);
        }
    }
    TRY(shape_end(&s, scene, error));
    scene->materials[material].roughness = roughness;
    return GLINT_OK;
}

// What the lobe of a plate shows under E(d) = ½ + ½d, divided into Schlick's two parts.
static lobe_integrals integrate(const surface *s)
{
    lobe_integrals sum = {0};
    for (int i = 0; i < FACETS; i++) {
        const surface facet = oracle_facet(s, i, FACETS, 1);
        vector l = {{0, 0, 0}};
        oracle_reflect(facet.normal.at, s->viewer.at, l.at);
        const double weight = oracle_opening(s, dot(s->normal, l)) / FACETS;
        const double edge = weight * pow(1 - facet.cosine, 5), base = weight - edge;
        sum.white_base += base;
        sum.white_edge += edge;
        for (int k = 0; k < 3; k++) {
            sum.base.at[k] += base * (0.5 + 0.5 * l.at[k]);
            sum.edge.at[k] += edge * (0.5 + 0.5 * l.at[k]);
        }
    }
    return sum;
}

// The colour of a plate (rule 11). `plate` is its second triangle.
static vector color_of(const oracle_triangle *plate, const glint_camera *camera,
                       const glint_material *material, bool all_scattering)
{
    surface s = {.roughness = (double)material->roughness};
    vector edges[2], color;
    for (int k = 0; k < 3; k++) {
        edges[0].at[k] = plate->position[1][k] - plate->position[0][k];
        edges[1].at[k] = plate->position[2][k] - plate->position[0][k];
    }
    s.normal = unit(cross(edges[0], edges[1]));
    s.viewer = (vector){{camera->back.x, camera->back.y, camera->back.z}};
    s.cosine = dot(s.normal, s.viewer);
    const lobe_integrals lobe = integrate(&s);
    const double white = lobe.white_base + lobe.white_edge;
    const double lost = all_scattering ? 1 / white - 1 : 0;
    const double f0 = (material->ior - 1.0) * (material->ior - 1.0) /
                      ((material->ior + 1.0) * (material->ior + 1.0));
    const double kept = 1 - (1 + f0 * lost) * (f0 * lobe.white_base + lobe.white_edge);
    for (int k = 0; k < 3; k++) {
        const double base = (double)material->base_color[k];
        const double by_metal = (1 + base * lost) * (base * lobe.base.at[k] + lobe.edge.at[k]);
        const double by_coat = (1 + f0 * lost) * (f0 * lobe.base.at[k] + lobe.edge.at[k]);
        const double matte = base * (0.5 + s.normal.at[k] / 3); // E(n)/π
        color.at[k] = material->metallic > 0 ? by_metal : by_coat + kept * matte;
    }
    return color;
}

typedef struct rim {
    shape_material material;
    glint_roughness roughness;
    glint_scattering scattering;
    glint_measure *errors[2]; // [is_flat]
} rim;

// Plates seen flatter than this show lobes that are narrower than the finest cells.
#define FLAT 0.02

static void compare(const rim *of, const judge *j, const glint_scene *scene,
                    const glint_camera *camera, const trial_picture *picture)
{
    const glint_material *material = &scene->materials[of->material];
    for (int p = 0; p < AZIMUTHS * TILTS; p++) {
        const vector wanted = color_of(&j->triangles[2 * p + 1], camera, material,
                                       of->scattering == GLINT_SCATTERING_MULTIPLE);
        for (int k = 0; k < 3; k++) {
            const double off = fabs(picture->values[4 * p + k] - wanted.at[k]);
            measure_error(of->errors[cosines[p / AZIMUTHS] < FLAT], off,
                          "roughness %g, n·v %g, azimuth %d: %g expected, %g found",
                          (double)material->roughness, cosines[p / AZIMUTHS], p % AZIMUTHS,
                          wanted.at[k], picture->values[4 * p + k]);
        }
    }
}

static glint_status render_plates(trial *t, const rim *of, const glint_environment *environment,
                                  float roughness)
{
    static const double eye[3] = {0.9, 1.3, 1.6}, target[3] = {0, 0, 0};
    const glint_camera camera = shape_camera(eye, target, 0, 0.5 * PITCH * TILTS);
    glint_scene scene = {0};
    judge j = {0};
    trial_picture picture = {0};
    glint_settings settings = trial_settings(t);
    settings.width = AZIMUTHS;
    settings.height = TILTS;
    settings.depth = 1;
    settings.roughness = of->roughness;
    settings.scattering = of->scattering;
    glint_status status;
    TRY_OR(cleanup, status, make_plates(&camera, of->material, roughness, &scene, t->error));
    TRY_OR(cleanup, status, judge_begin(&scene, &j, t->error));
    const glint_renderer_inputs inputs = trial_inputs(t, &scene, environment, &settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, &camera, &picture));
    compare(of, &j, &scene, &camera, &picture);
cleanup:
    trial_picture_free(&picture);
    judge_end(&j);
    glint_scene_free(&scene);
    return status;
}

// Bounds at every roughness: 0.01 (fast) and 0.003 (exact) of white. Of flat plates, 0.01.
static glint_status rim_of_lobes(trial *t)
{
    glint_measure *fast = trial_error(t, "metal, fast", "of white", 0.01);
    glint_measure *metal = trial_error(t, "metal, exact, multiple scattering", "of white", 0.003);
    glint_measure *paint = trial_error(t, "paint, exact", "of white", 0.003);
    glint_measure *flat = trial_error(t, "exact, seen flat", "of white", 0.01);
    const rim rims[] = {
        {MATERIAL_MIRROR, GLINT_ROUGHNESS_FAST, GLINT_SCATTERING_SINGLE, {fast, fast}},
        {MATERIAL_MIRROR, GLINT_ROUGHNESS_EXACT, GLINT_SCATTERING_MULTIPLE, {metal, flat}},
        {MATERIAL_PAINT, GLINT_ROUGHNESS_EXACT, GLINT_SCATTERING_SINGLE, {paint, flat}},
    };
    glint_environment environment;
    TRY(trial_linear_environment(128, &environment, t->error));
    glint_status status = GLINT_OK;
    for (size_t i = 0; i < sizeof rims / sizeof *rims && status == GLINT_OK; i++) {
        for (int k = 0; k < FRAMES && status == GLINT_OK; k++) {
            status = render_plates(t, &rims[i], &environment, roughnesses[k]);
        }
    }
    glint_environment_free(&environment);
    return status;
}

// ---- Layers above rough surfaces ----------------------------------------------------------------

typedef struct pane {
    const char *what;
    shape_material material;
    glint_alpha_mode mode;
    float alpha;
} pane;

// A rough floor, and a pane just above it, which all light of the floor passes.
static glint_status make_floor(const pane *of, glint_scene *scene, glint_error *error)
{
    static const double floor[4][3] = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    static const double above[4][3] = {{-1, 0.05, 1}, {1, 0.05, 1}, {1, 0.05, -1}, {-1, 0.05, -1}};
    shape s = shape_begin();
    shape_add_quad(&s, floor, MATERIAL_TINTED);
    shape_add_quad(&s, above, of->material);
    TRY(shape_end(&s, scene, error));
    scene->materials[MATERIAL_TINTED].roughness = 0.5F;
    glint_material *m = &scene->materials[of->material];
    m->alpha_mode = of->mode;
    m->alpha = of->alpha;
    m->thickness = 0;
    return GLINT_OK;
}

// What is there in part, and glass, do not end a lobe. Bound: that of exact lobes.
static glint_status lobes_through_layers(trial *t)
{
    static const double eye[3] = {0.6, 1.2, 1.4}, target[3] = {0, 0, 0};
    static const pane panes[] = {
        {"below paint that is there by 0.3", MATERIAL_PAINT, GLINT_ALPHA_BLEND, 0.3F},
        {"below what is not there", MATERIAL_PAINT, GLINT_ALPHA_MASK, 0},
        {"below a thin pane of glass", MATERIAL_GLASS, GLINT_ALPHA_OPAQUE, 1},
    };
    const glint_camera camera = shape_camera(eye, target, 0.3, 0);
    for (size_t i = 0; i < sizeof panes / sizeof *panes; i++) {
        glint_scene scene = {0};
        judged frame = {0};
        const glint_settings settings = trial_lobe_settings(t, 4);
        glint_status status;
        TRY_OR(cleanup, status, make_floor(&panes[i], &scene, t->error));
        TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
        frame.view.roughness = 96;
        measure_error(trial_error(t, panes[i].what, "of the mean", 0.003), judged_rmse(&frame),
                      "relative RMSE");
    cleanup:
        judged_end(&frame);
        glint_scene_free(&scene);
        TRY(status);
    }
    return GLINT_OK;
}

const trial_case rim_cases[] = {
    {"rim_of_lobes", "rough plates, tilted to n·v = 0.004: what the viewer sees of their facets",
     rim_of_lobes},
    {"lobes_through_layers",
     "rough metal below glass and what is there in part: the oracle's colours",
     lobes_through_layers},
    {0},
};
