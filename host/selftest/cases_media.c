// Tests hard cases of solids that touch, overlap and contain the eye. The oracle judges, pixel by
// pixel: it finds media from points on both sides of a surface, without a stack.
#include "selftest/judged.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>

typedef struct media_view {
    const char *what;
    void (*build)(shape *s);
    double eye[3];
    double yfov; // 0: parallel rays
    float priority, attenuation;
} media_view;

static void add_box(shape *s, const double bounds[2][3], shape_material material, bool inward)
{
    shape_add_box(s, &(shape_box){bounds[0], bounds[1], 2, material, inward});
}

// A hollow block of glass on metal. A core fills its hollow to the middle.
static void build_filled(shape *s)
{
    static const double outer[2][3] = {{-0.5, -0.4, -0.5}, {0.5, 0.5, 0.5}};
    static const double hollow[2][3] = {{-0.4, -0.3, -0.4}, {0.4, 0.4, 0.4}};
    static const double core[2][3] = {{-0.4, -0.3, -0.4}, {0.4, 0.1, 0.4}};
    static const double stand[2][3] = {{-0.6, -0.6, -0.6}, {0.6, -0.4, 0.6}};
    add_box(s, outer, MATERIAL_GLASS, false);
    add_box(s, hollow, MATERIAL_GLASS, true);
    add_box(s, core, MATERIAL_CORE, false);
    add_box(s, stand, MATERIAL_TINTED, false);
}

// Blocks that reach into each other, and a smaller block beside, of the first one's glass.
static void build_crossed(shape *s)
{
    static const double one[2][3] = {{-0.6, -0.3, -0.3}, {0.2, 0.3, 0.3}};
    static const double beside[2][3] = {{0.2, -0.2, -0.3}, {0.45, 0.3, 0.2}};
    static const double other[2][3] = {{-0.2, -0.5, -0.2}, {0.1, 0.45, 0.15}};
    add_box(s, one, MATERIAL_GLASS, false);
    add_box(s, beside, MATERIAL_GLASS, false);
    add_box(s, other, MATERIAL_CORE, false);
}

// One box inside another.
static void build_nested(shape *s)
{
    static const double outer[2][3] = {{-0.6, -0.5, -0.5}, {0.6, 0.5, 0.5}};
    static const double inner[2][3] = {{-0.3, -0.4, -0.3}, {0.35, 0.3, 0.4}};
    add_box(s, outer, MATERIAL_GLASS, false);
    add_box(s, inner, MATERIAL_CORE, false);
}

static const media_view views[] = {
    {"a core that touches its glass", build_filled, {1.1, 0.9, 1.6}, 0.7, 0, 0.6F},
    {"blocks that overlap", build_crossed, {1.1, 0.9, 1.6}, 0.7, 0, 0.4F},
    {"blocks of other priorities", build_crossed, {1.1, 0.9, 1.6}, 0.7, -1, 0.4F},
    {"from inside two solids", build_nested, {0.1, 0.05, 0.2}, 1.2, 0, 0.6F},
    {"from inside two that rank", build_nested, {0.1, 0.05, 0.2}, 1.2, 1, 0.6F},
    {"from a solid's face", build_nested, {0.35, 0.05, 0.2}, 1.2, 0, 0.6F},
    {"parallel rays from inside", build_nested, {0.1, 0.05, 0.2}, 0, 0, 0.6F},
};

// The oracle starts rays 2e-6 beside surfaces. Texels err by a ten-thousandth.
#define MEDIA_BOUND 5e-4

// Measures all pixels, except those that see an edge: they may differ.
static void measure_pixels(trial *t, const media_view *of, const judged *frame)
{
    const trial_picture *picture = &frame->picture;
    glint_measure *m = trial_error(t, of->what, "of white", MEDIA_BOUND);
    for (int p = 0; p < picture->width * picture->height; p++) {
        double expected[4];
        oracle_report report;
        judged_pixel(frame, p, expected, &report);
        if (report.surfaces == 0 || report.edge < ORACLE_EDGE_REACH) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            measure_value(m, picture->values[4 * p + k], expected[k], 1, "pixel (%d, %d)",
                          p % picture->width, p / picture->width);
        }
    }
}

static glint_status render_view(trial *t, const media_view *of)
{
    static const double target[3] = {-0.05, -0.02, -0.1};
    glint_scene scene = {0};
    judged frame = {0};
    glint_settings settings = trial_settings(t);
    settings.width = 24;
    settings.height = 18;
    settings.depth = 6;
    const glint_camera camera = shape_camera(of->eye, target, of->yfov, 0.4);
    glint_status status;
    shape s = shape_begin();
    of->build(&s);
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    scene.materials[MATERIAL_GLASS].priority = -of->priority;
    scene.materials[MATERIAL_CORE].base_color[2] = 0.8F; // shows whose surface is met
    scene.materials[MATERIAL_CORE].attenuation_distance = 1;
    scene.materials[MATERIAL_CORE].attenuation_color[1] = of->attenuation;
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    frame.judge.scene.overlaps = true;
    frame.view.edges = true;
    measure_pixels(t, of, &frame);
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

static glint_status solids_together(trial *t)
{
    for (size_t i = 0; i < 3; i++) {
        TRY(render_view(t, &views[i]));
    }
    return GLINT_OK;
}

static glint_status eyes_in_solids(trial *t)
{
    for (size_t i = 3; i < sizeof views / sizeof *views; i++) {
        TRY(render_view(t, &views[i]));
    }
    return GLINT_OK;
}

const trial_case media_cases[] = {
    {"solids_together",
     "solids that touch and overlap, by their volume and priority: the oracle's "
     "colours",
     solids_together},
    {"eyes_in_solids", "an eye in nested solids, and on a face: the oracle's colours",
     eyes_in_solids},
    {0},
};
