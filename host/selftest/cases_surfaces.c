// Tests hard cases of attributes of surfaces: textures of all roles and samplers, bent normals,
// vertex colours and vertex alpha, seen directly, in mirrors and through glass. The oracle judges.
#include "base/memory.h"
#include "selftest/dressing.h"
#include "selftest/judge.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The materials of the room. They replace the materials of shapes.h.
enum {
    FLOOR,  // matte paint: base colour, occlusion by the second texture coordinates
    WALL,   // glossy paint: vertex colours, emission
    MIRROR, // tinted metal, in places paint, with bent normals
    BALL,   // tinted metal, textured
    LEAVES, // MASK by a texture's alpha
    EVEN,   // MASK with exactly the cutoff's alpha
    VEIL,   // BLEND by the vertices' alpha, glossy
    PANE,   // thin glass, a little metal, BLEND by a texture's alpha, which transmits in places
    SLAB,   // solid glass, which transmits in places
    SHEEN,  // the lecture's blend, with occlusion
    SIGN,   // unlit, BLEND
    MATERIALS
};

// ---- Materials ----------------------------------------------------------------------------------

// Resets a material to smooth white paint, with the given values.
static void set_material(glint_material *m, const float color[3], float metallic, float alpha)
{
    *m = (glint_material){GLINT_MATERIAL_CLEAR,
                          .metallic = metallic,
                          .mirror = -1,
                          .alpha = alpha,
                          .alpha_cutoff = 0.5F,
                          .normal_scale = 0.4F,
                          .occlusion_strength = 0.75F};
    memcpy(m->base_color, color, sizeof m->base_color);
}

static void add_factors(glint_material *m)
{
    static const float colors[MATERIALS][3] = {
        {0.9F, 0.8F, 0.7F}, {0.7F, 0.6F, 0.9F}, {0.9F, 0.7F, 0.5F},   {0.6F, 0.8F, 0.9F},
        {0.3F, 0.8F, 0.2F}, {0.8F, 0.2F, 0.2F}, {0.9F, 0.9F, 0.4F},   {0.8F, 0.9F, 0.9F},
        {0.9F, 1, 0.9F},    {0.4F, 0.5F, 0.8F}, {0.95F, 0.35F, 0.15F}};
    static const float metallic[MATERIALS] = {[MIRROR] = 0.9F, [BALL] = 1, [PANE] = 0.25F};
    static const float alpha[MATERIALS] = {1, 1, 1, 1, 0.85F, 0.5F, 0.9F, 0.9F, 1, 1, 0.6F};
    for (int i = 0; i < MATERIALS; i++) {
        set_material(&m[i], colors[i], metallic[i], alpha[i]);
        m[i].has_vertex_colors = true;
    }
    m[FLOOR].roughness = m[LEAVES].roughness = 1;
    m[LEAVES].alpha_mode = m[EVEN].alpha_mode = GLINT_ALPHA_MASK;
    m[VEIL].alpha_mode = m[PANE].alpha_mode = m[SIGN].alpha_mode = GLINT_ALPHA_BLEND;
    m[PANE].transmission = m[SLAB].transmission = 0.9F;
    m[SLAB].thickness = 1;
    m[SHEEN].mirror = 0.4F;
    m[SIGN].unlit = true;
    for (int k = 0; k < 3; k++) {
        m[WALL].emission[k] = 0.5F + 0.25F * (float)k;
    }
}

// Sets the textures. Both textures of the mirror have the same look-up.
static void add_textures(glint_material *m, int variant)
{
    static const struct {
        int material;
        glint_texture_slot slot;
        int image, variant;
    } uses[] = {
        {FLOOR, GLINT_TEXTURE_BASE_COLOR, 0, 0},
        {FLOOR, GLINT_TEXTURE_OCCLUSION, 2, 1},
        {WALL, GLINT_TEXTURE_EMISSION, 2, 2},
        {MIRROR, GLINT_TEXTURE_METALLIC_ROUGHNESS, 0, 3},
        {MIRROR, GLINT_TEXTURE_NORMAL, 3, 3},
        {BALL, GLINT_TEXTURE_BASE_COLOR, 2, 5},
        {LEAVES, GLINT_TEXTURE_BASE_COLOR, DRESSING_COVERAGE, 6},
        {PANE, GLINT_TEXTURE_BASE_COLOR, DRESSING_COVERAGE, 7},
        {PANE, GLINT_TEXTURE_TRANSMISSION, 0, 8},
        {SLAB, GLINT_TEXTURE_TRANSMISSION, 2, 9},
        {SHEEN, GLINT_TEXTURE_OCCLUSION, 0, 10},
    };
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        m[uses[i].material].textures[uses[i].slot] =
            dressing_use(uses[i].image, variant + uses[i].variant);
    }
}

// ---- The room -----------------------------------------------------------------------------------

// Adds a sheet from one corner to the opposite corner, across one axis, seen from the axis's upper
// end.
static void add_sheet(shape *s, const double low[3], const double high[3], int material)
{
    const int axis = low[0] == high[0] ? 0 : low[1] == high[1] ? 1 : 2;
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    static const int around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double corners[4][3];
    for (int k = 0; k < 4; k++) {
        corners[k][axis] = low[axis];
        corners[k][first] = around[k][0] ? high[first] : low[first];
        corners[k][second] = around[k][1] ? high[second] : low[second];
    }
    shape_add_quad(s, (const double(*)[3])corners, (shape_material)material);
}

static void add_room(shape *s)
{
    static const struct {
        double low[3], high[3];
        int material;
    } sheets[] = {
        {{-0.9, -0.6, -0.9}, {0.9, -0.6, 0.8}, FLOOR},
        {{-0.9, -0.6, -0.9}, {0.9, 0.7, -0.9}, WALL},
        {{-0.9, -0.6, -0.9}, {-0.9, 0.7, 0.6}, MIRROR},
        {{-0.65, -0.6, -0.35}, {-0.1, 0.2, -0.35}, LEAVES},
        {{-0.05, -0.6, -0.45}, {0.1, 0.3, -0.45}, EVEN},
        {{-0.2, 0.15, -0.25}, {0.55, 0.55, -0.25}, VEIL},
        {{0.2, -0.55, 0.2}, {0.75, 0.3, 0.2}, PANE},
        {{0.3, 0.65, -0.3}, {0.8, 0.95, -0.3}, VEIL}, // in front of the open sky
        {{0.72, -0.6, -0.7}, {0.72, 0.5, -0.1}, SHEEN},
        {{-0.75, 0.3, -0.5}, {-0.3, 0.6, -0.5}, SIGN},
    };
    static const double middle[3] = {0.4, -0.25, -0.5}, lens[3] = {0.4, 0.4, 0.4};
    static const double low[3] = {-0.5, -0.3, 0.25}, high[3] = {-0.05, 0.45, 0.4};
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++) {
        add_sheet(s, sheets[i].low, sheets[i].high, sheets[i].material);
    }
    shape_add_ball(s, &(shape_ball){middle, 0.3, 3, (shape_material)BALL, true, NULL});
    shape_add_ball(s, &(shape_ball){lens, 0.15, 3, (shape_material)SLAB, true, NULL});
    shape_add_box(s, &(shape_box){low, high, 1, (shape_material)SLAB, false});
}

static glint_status make_room(int variant, glint_scene *scene, glint_error *error)
{
    shape s = shape_begin();
    add_room(&s);
    TRY(shape_end(&s, scene, error));
    free(scene->materials);
    scene->material_count = MATERIALS;
    scene->materials = glint_allocate(MATERIALS, sizeof *scene->materials);
    if (scene->materials == NULL) {
        return glint_fail_memory(error, "a self-test");
    }
    add_factors(scene->materials);
    add_textures(scene->materials, variant);
    TRY(dressing_add_images(scene, error));
    return dressing_add_attributes(scene, EVEN, error);
}

// Adds a lamp in front of the leaves and a sun from the upper right. Both shine past and through
// the rest.
static glint_status add_lights(glint_scene *scene, glint_error *error)
{
    static const glint_punctual_light lights[] = {
        {.kind = GLINT_PUNCTUAL_POINT,
         .position = {0.1, 0.4, 0.55},
         .direction = {0, -1, 0},
         .color = {2, 1.5, 1},
         .range = 3},
        {.kind = GLINT_PUNCTUAL_DIRECTIONAL,
         .direction = {-0.48, -0.64, -0.6},
         .color = {0.5, 1, 1.5},
         .range = INFINITY},
    };
    return shape_set_lights(lights, sizeof lights / sizeof *lights, scene, error);
}

// ---- Judging ------------------------------------------------------------------------------------

static void uniform_light(const void *context, const double direction[3], double rgb[3])
{
    (void)direction;
    rgb[0] = rgb[1] = rgb[2] = *(const double *)context;
}

typedef struct surface_measures {
    glint_measure *errors, *undecided;
} surface_measures;

// A view of the room.
typedef struct room_view {
    int variant, depth;
    bool transparent, lit;
} room_view;

// Pixels this near to an edge, to the critical angle, or to a jump of a texture or alpha may show
// its other side. Curved surfaces multiply the rounding error u.
#define MARGIN 1024

// The rounding of a colour on its way. The irradiance map holds floats.
#define ROUNDING(u) (4096 * (u) + 0x1p-23)

static void measure_pixels(trial *t, const oracle_scene *scene, const oracle_view *view,
                           const trial_picture *picture, const surface_measures *of)
{
    for (int p = 0; p < picture->width * picture->height; p++) {
        const int pixel[2] = {p % picture->width, p / picture->width};
        double expected[4];
        oracle_report report;
        oracle_pixel(scene, view, pixel, expected, &report);
        const double near = fmin(fmin(report.edge, report.critical), report.jump);
        const bool undecided = near < MARGIN * t->u;
        measure_event(of->undecided, undecided, "pixel (%d, %d)", pixel[0], pixel[1]);
        for (int k = 0; !undecided && k < 4; k++) {
            measure_value(of->errors, picture->values[4 * p + k], expected[k], ROUNDING(t->u),
                          "depth %d, pixel (%d, %d), value %d", view->depth, pixel[0], pixel[1], k);
        }
    }
}

static glint_status measure_room(trial *t, const room_view *room, const surface_measures *of)
{
    static const double eye[3] = {0.25, 0.2, 2.1}, target[3] = {-0.05, -0.05, 0};
    static const double light = 0.75;
    glint_scene scene = {0};
    glint_environment environment = {0};
    trial_picture picture = {0};
    judge j = {0};
    // Set up the frame.
    glint_settings settings = trial_settings(t);
    settings.depth = room->depth;
    settings.transparent = room->transparent;
    const glint_camera camera = shape_camera(eye, target, 0.85, 0);
    glint_status status;
    // Make the room and render it.
    TRY_OR(cleanup, status, make_room(room->variant, &scene, t->error));
    if (room->lit) {
        TRY_OR(cleanup, status, add_lights(&scene, t->error));
    }
    TRY_OR(cleanup, status, trial_uniform_environment((float)light, &environment, t->error));
    const glint_renderer_inputs inputs = trial_inputs(t, &scene, &environment, &settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, &camera, &picture));
    // Ask the oracle.
    TRY_OR(cleanup, status, judge_begin(&scene, &j, t->error));
    j.scene.radiance = j.scene.irradiance = uniform_light;
    j.scene.context = &light;
    oracle_view view = judge_view(&camera, &settings);
    view.depth = room->depth;
    view.transparent = room->transparent;
    view.edges = true;
    measure_pixels(t, &j.scene, &view, &picture, of);
cleanup:
    judge_end(&j);
    trial_picture_free(&picture);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
    return status;
}

// Curved surfaces spread errors: behind them colours may err by four times as much.
static glint_status dressed_room(trial *t)
{
    static const struct {
        int depth;
        const char *what;
        double bound;
    } frames[] = {{1, "depth 1: beside the oracle's colours", 1},
                  {4, "depth 4: beside the oracle's colours", 4}};
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        const surface_measures of = {
            trial_error(t, frames[i].what, "4096 u + 2⁻²³", frames[i].bound),
            trial_share(t, "pixels that rounding decides", 0.05),
        };
        for (int variant = 0; variant < 12; variant++) {
            const room_view room = {variant, frames[i].depth, variant % 2 == 1, false};
            TRY(measure_room(t, &room, &of));
        }
    }
    return GLINT_OK;
}

// Edges of shadows are edges too, so rounding decides more pixels.
static glint_status lit_room(trial *t)
{
    const surface_measures of = {
        trial_error(t, "depth 3: beside the oracle's colours", "4096 u + 2⁻²³", 4),
        trial_share(t, "pixels that rounding decides", 0.1),
    };
    for (int variant = 0; variant < 12; variant += 3) {
        const room_view room = {variant, 3, variant % 2 == 1, true};
        TRY(measure_room(t, &room, &of));
    }
    return GLINT_OK;
}

const trial_case surface_cases[] = {
    {"dressed_room",
     "textures, colours and alpha, seen at once, in mirrors and through glass: the oracle's "
     "colours",
     dressed_room},
    {"lit_room", "the same under a lamp and a sun, which occlusion does not darken: their shadows",
     lit_room},
    {0},
};
