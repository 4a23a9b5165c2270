// Tests features where they meet: rooms whose shapes, materials, lamps and settings are chosen by
// chance, the same in every run. The oracle gives the expected colours. tests/plan_choices.c checks
// which two features are together in some room or other case. Rooms take general kernels where
// these serve: special ones would be compiled for each room.
#include "selftest/dressing.h"
#include "selftest/judged.h"
#include "selftest/shapes.h"

#include <math.h>
#include <stdlib.h>

// What a room is for. Only rough rooms have lobes, and none has rough glass.
typedef enum room_kind {
    ROOM_SMOOTH,
    ROOM_ROUGH,      // lobes of metal, paint, coats and sheen
    ROOM_TERMS,      // what pixels are the sum of
    ROOM_HITS,       // what primary rays meet
    ROOM_COLORS,     // colours at vertices
    ROOM_DIRECTIONS, // directions at vertices
} room_kind;

typedef struct room {
    room_kind kind;
    bool dressed;  // materials may have textures and vertices colours
    bool alone;    // a convex body of glass and nothing else
    bool overlaps; // one solid stands out of another
    bool inside;   // the eye is in the box of glass
    bool bead;     // a bead is near the eye, so small that it has an origin of its own
    bool averaged; // the environment is averaged
} room;

// ---- Chance -------------------------------------------------------------------------------------

static bool one_in(trial *t, int n)
{
    return glint_random_number(&t->random) * n < 1;
}

static float between(trial *t, double low, double high)
{
    return (float)(low + (high - low) * glint_random_number(&t->random));
}

static void fill(trial *t, float color[3])
{
    for (int k = 0; k < 3; k++) {
        color[k] = between(t, 0.2, 1);
    }
}

// What lies above the base of any material, and how much of the surface is there.
static void add_layers(trial *t, bool rough, glint_material *m)
{
    if (one_in(t, 3)) {
        m->clearcoat = between(t, 0.3, 1);
        m->clearcoat_roughness = rough && one_in(t, 2) ? between(t, 0.2, 0.6) : 0;
    }
    if (one_in(t, 4)) {
        m->iridescence = between(t, 0.3, 1);
        m->iridescence_ior = 1.4F;
        m->iridescence_thickness[1] = between(t, 200, 500);
    }
    if (one_in(t, 3)) {
        m->specular = between(t, 0.3, 1);
        fill(t, m->specular_color);
    }
    if (one_in(t, 4)) {
        fill(t, m->emission);
    }
    if (one_in(t, 4)) {
        m->alpha_mode = one_in(t, 3) ? GLINT_ALPHA_MASK : GLINT_ALPHA_BLEND;
        m->alpha_cutoff = 0.5F;
        m->alpha = between(t, 0.2, 0.9);
    }
    if (one_in(t, 8)) {
        m->unlit = true;
    }
}

static void choose_metal(trial *t, bool rough, glint_material *m)
{
    m->metallic = one_in(t, 3) ? between(t, 0.3, 0.8) : 1;
    m->roughness = rough && one_in(t, 2) ? between(t, 0.2, 0.8) : 0;
    if (rough && one_in(t, 3)) {
        fill(t, m->sheen_color);
        m->sheen_roughness = between(t, 0.3, 0.9);
    }
    if (one_in(t, 3)) {
        m->mirror = between(t, 0.2, 0.8);
    }
    add_layers(t, rough, m);
}

static void choose_paint(trial *t, bool rough, glint_material *m)
{
    fill(t, m->base_color);
    m->roughness = one_in(t, 2) ? 0 : rough ? between(t, 0.2, 0.9) : 1;
    if (one_in(t, 3)) {
        m->diffuse_transmission = between(t, 0.3, 0.8);
        fill(t, m->diffuse_transmission_color);
    }
    if (rough && one_in(t, 3)) {
        fill(t, m->sheen_color);
        m->sheen_roughness = between(t, 0.3, 0.9);
    }
    add_layers(t, rough, m);
}

static void choose_glass(trial *t, bool rough, glint_material *m)
{
    m->ior = between(t, 1.2, 1.8);
    if (one_in(t, 3)) {
        m->thickness = 0;
    }
    if (one_in(t, 2)) {
        m->attenuation_distance = between(t, 0.5, 2);
        fill(t, m->attenuation_color);
    }
    if (one_in(t, 3)) {
        m->dispersion = between(t, 0.5, 2);
    }
    if (one_in(t, 3)) {
        m->transmission = between(t, 0.4, 0.9);
        fill(t, m->base_color);
        if (one_in(t, 2)) {
            m->diffuse_transmission = between(t, 0.3, 0.8);
        }
    }
    if (!rough && one_in(t, 6)) {
        m->metallic = between(t, 0.1, 0.4);
    }
    add_layers(t, false, m);
}

// Gives a material textures at random, and its vertices' colours.
static void dress(trial *t, glint_material *m)
{
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        if (one_in(t, 4)) {
            m->textures[slot] =
                dressing_use((int)between(t, 0, DRESSING_IMAGES - 0.01), (int)between(t, 0, 60));
        }
    }
    m->normal_scale = m->clearcoat_normal_scale = 0.3F;
    m->occlusion_strength = 0.75F;
    m->has_vertex_colors = one_in(t, 2);
    if (m->transmission > 0 || m->alpha_mode != GLINT_ALPHA_OPAQUE) {
        // Where light passes, the coat has no direction of its own: rule 13.
        m->textures[GLINT_TEXTURE_CLEARCOAT_NORMAL] = m->textures[GLINT_TEXTURE_NORMAL];
    }
}

// Leaves out what terms do not hold, or what vertices and hits do not show either.
static void leave_out(bool at_vertices, glint_material *m)
{
    m->dispersion = m->diffuse_transmission = 0;
    if (at_vertices) {
        m->clearcoat = 0;
        m->alpha_mode = GLINT_ALPHA_OPAQUE;
    }
}

// ---- Rooms --------------------------------------------------------------------------------------

// The eyes: outside, in the box of glass, and outside but within what stored coordinates can hold.
static const double eyes[3][3] = {{0.3, 0.2, 2.2}, {0.45, 0.1, 0.35}, {0.3, 0.2, 0.95}};

static const double *eye_of(const room *r)
{
    return eyes[r->inside ? 1 : r->bead ? 2 : 0];
}

static void add_ball(shape *s, const double centre[3], double size, int level,
                     shape_material material)
{
    shape_add_ball(s, &(shape_ball){centre, size, level, material, true, NULL});
}

static void add_bead(trial *t, const room *r, shape *s)
{
    static const double away[3] = {-0.004, 0.002, -0.012};
    double place[3];
    for (int k = 0; k < 3; k++) {
        place[k] = eye_of(r)[k] + away[k];
    }
    add_ball(s, place, 0.003, 2, one_in(t, 2) ? MATERIAL_TINTED : MATERIAL_CORE);
}

// A ball of metal, a box of glass with a ball of another solid in it or half in it, a wall of
// paint, a bead. Where colours or directions are found at vertices: three balls, finely divided.
static void add_shapes(trial *t, const room *r, shape *s)
{
    static const double left[3] = {-0.5, 0, 0.1}, right[3] = {0.4, 0.05, 0};
    static const double across[3] = {0.13, 0.05, 0.1}, above[3] = {0.3, 0.5, -0.2};
    static const double low[3] = {0, -0.4, -0.4}, high[3] = {0.8, 0.45, 0.4};
    static const double wall[4][3] = {
        {-0.95, -0.9, -0.6}, {0.95, -0.9, -0.8}, {0.95, 0.9, -0.8}, {-0.95, 0.9, -0.6}};
    static const double pane[4][3] = {
        {-0.4, -0.5, 0.6}, {0.2, -0.5, 0.55}, {0.2, 0.1, 0.55}, {-0.4, 0.1, 0.6}};
    if (r->alone) {
        shape_add_box(s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
        return;
    }
    if (r->kind == ROOM_COLORS || r->kind == ROOM_DIRECTIONS) {
        add_ball(s, left, 0.4, 4, MATERIAL_TINTED);
        add_ball(s, right, 0.4, 4, MATERIAL_GLASS);
        add_ball(s, right, 0.2, 4, MATERIAL_CORE);
        add_ball(s, above, 0.4, 4, MATERIAL_PAINT);
        return;
    }
    add_ball(s, left, 0.35, 2, MATERIAL_TINTED);
    shape_add_box(s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
    if (r->overlaps) {
        add_ball(s, across, 0.25, 2, MATERIAL_CORE);
    } else if (one_in(t, 2)) {
        add_ball(s, right, 0.25, 2, MATERIAL_CORE);
    }
    shape_add_quad(s, wall, MATERIAL_PAINT);
    if (one_in(t, 3)) {
        shape_add_quad(s, pane, MATERIAL_MIRROR);
    }
    if (r->bead) {
        add_bead(t, r, s);
    }
}

static glint_status build(trial *t, const room *r, glint_scene *scene, double **exact)
{
    static const glint_punctual_light lamp = {.kind = GLINT_PUNCTUAL_POINT,
                                              .position = {0.2, 1.3, 1.5},
                                              .direction = {0, -1, 0},
                                              .color = {3, 2, 1},
                                              .range = INFINITY};
    shape s = shape_begin();
    add_shapes(t, r, &s);
    TRY(shape_end_with_parts(&s, 1, scene, exact, t->error));
    glint_material *m = scene->materials;
    const bool rough = r->kind == ROOM_ROUGH;
    choose_metal(t, rough, &m[MATERIAL_TINTED]);
    choose_paint(t, rough, &m[MATERIAL_PAINT]);
    choose_glass(t, rough, &m[MATERIAL_GLASS]);
    choose_glass(t, rough, &m[MATERIAL_CORE]);
    choose_glass(t, rough, &m[MATERIAL_MIRROR]);
    m[MATERIAL_MIRROR].metallic = 0;
    m[MATERIAL_MIRROR].transmission = 1;
    if (r->dressed) {
        for (int i = 0; i < MATERIAL_COUNT; i++) {
            dress(t, &m[i]);
        }
        TRY(dressing_add_images(scene, t->error));
        TRY(dressing_add_attributes(scene, -1, t->error));
    }
    for (int i = 0; r->kind >= ROOM_TERMS && i < MATERIAL_COUNT; i++) {
        leave_out(r->kind != ROOM_TERMS, &m[i]);
    }
    return r->kind <= ROOM_TERMS && one_in(t, 2) ? shape_set_lights(&lamp, 1, scene, t->error)
                                                 : GLINT_OK;
}

// ---- Settings -----------------------------------------------------------------------------------

enum { WIDTH = GLINT_LIST_COLUMNS, HEIGHT = 12, TERMS = 32 };

static glint_settings settings_of_kind(trial *t, const room *r)
{
    glint_settings settings = r->kind == ROOM_ROUGH ? trial_lobe_settings(t, 3) : trial_settings(t);
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.depth = 3;
    settings.kernels = GLINT_KERNELS_GENERAL;
    settings.terms = r->kind == ROOM_TERMS ? TERMS : 0;
    settings.output = r->kind == ROOM_HITS ? GLINT_OUTPUT_HITS : GLINT_OUTPUT_COLOR;
    if (r->kind == ROOM_COLORS || r->kind == ROOM_DIRECTIONS) {
        settings.shading =
            r->kind == ROOM_COLORS ? GLINT_SHADING_VERTEX_COLOR : GLINT_SHADING_VERTEX_DIRECTION;
        settings.depth = 1;
    }
    return settings;
}

// `list` gets the numbers of all pixels.
static glint_settings choose_settings(trial *t, const room *r, uint32_t *list)
{
    glint_settings settings = settings_of_kind(t, r);
    const bool by_pixel = settings.shading == GLINT_SHADING_PIXEL;
    settings.wavelengths = 3;
    if (r->alone) { // to any depth, as proofs about paths need
        settings.depth = 0;
        settings.min_weight = 1e-4;
    }
    settings.env_rotate = one_in(t, 3) ? (double)between(t, -180, 180) : 0;
    settings.transparent = one_in(t, 3);
    settings.irradiance = one_in(t, 3) ? GLINT_IRRADIANCE_SH : GLINT_IRRADIANCE_EXACT;
    settings.fresnel = one_in(t, 6) ? GLINT_FRESNEL_NONE : GLINT_FRESNEL_EXACT;
    settings.anisotropy = one_in(t, 2) ? 8 : 1;
    settings.filter = r->averaged ? GLINT_FILTER_MIP : GLINT_FILTER_BILINEAR;
    settings.truncation_squares = one_in(t, 3);
    if (r->kind != ROOM_HITS && by_pixel && one_in(t, 3)) {
        settings.aovs = GLINT_AOV_ALL;
    }
    if (r->kind != ROOM_HITS && one_in(t, by_pixel ? 3 : 2)) {
        settings.samples_per_axis = 2;
    }
    if (by_pixel && one_in(t, 3)) {
        settings.list = list;
        settings.list_rows = HEIGHT;
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            list[i] = i;
        }
    }
    return settings;
}

// ---- Judging ------------------------------------------------------------------------------------

// The look-up in the environment errs as in cases_materials.c.
#define SMOOTH_BOUND 4e-4

// More values are off where solids overlap or hold the eye, up to this share. The oracle takes
// surfaces within 2·10⁻⁶ of the coordinates as in one place, and at a slant farther ones, so that
// rays pass edges on another side. In dense media films are seen near the critical angle, where the
// kernels' sum of eight passes errs by up to 0.033 (film.cl).
#define PLACES_SHARE 0.002

// What a case measures; NULL: nothing of the kind.
typedef struct room_measures {
    glint_measure *errors;   // pixel by pixel
    glint_measure *averages; // the same, of averaged environments
    glint_measure *places;   // values that are off, where the oracle finds media at points
} room_measures;

static void measure_room(const room *r, const judged *frame, const room_measures *of)
{
    if (r->kind == ROOM_HITS) {
        judged_compare_hits(frame, of->errors);
    } else if (r->kind == ROOM_COLORS || r->kind == ROOM_DIRECTIONS || r->averaged ||
               r->kind == ROOM_ROUGH) {
        measure_error(r->averaged ? of->averages : of->errors, judged_rmse(frame), "relative RMSE");
    } else if (r->inside || r->overlaps) {
        judged_count(frame, SMOOTH_BOUND, of->places);
    } else {
        judged_compare(frame, of->errors);
    }
    if (r->kind == ROOM_TERMS) {
        judged_compare_terms(frame, of->errors);
    }
}

static room choose_room(trial *t, room_kind kind)
{
    room r = {.kind = kind};
    const int few = kind == ROOM_TERMS ? 2 : 4; // there are few rooms of terms
    if (kind == ROOM_COLORS || kind == ROOM_DIRECTIONS) {
        return r;
    }
    if (kind == ROOM_ROUGH) {
        r.inside = one_in(t, few);
        return r;
    }
    r.dressed = one_in(t, 2);
    r.alone = one_in(t, 3);
    r.overlaps = !r.alone && one_in(t, 4);
    r.inside = one_in(t, few);
    // For a bead the oracle's places, where media are found at points, are too large.
    r.bead = !r.alone && !r.overlaps && !r.inside && one_in(t, 2);
    r.averaged = kind == ROOM_SMOOTH && one_in(t, 5);
    return r;
}

static glint_status judge_room(trial *t, room_kind kind, const room_measures *of)
{
    static const double target[3] = {0, 0, 0};
    static const glint_proxy proxies[2] = {
        {GLINT_PROXY_BOX, {-0.3, 0.5, 1}, {0.2, 0, 0.1}, {3, 2, 4}},
        {GLINT_PROXY_SPHERE, {0.2, -0.4, 0.3}, {0.1, 0.2, 0}, {4, 4, 4}}};
    static uint32_t list[WIDTH * HEIGHT];
    glint_scene scene = {0};
    double *exact = NULL;
    judged frame = {0};
    const room r = choose_room(t, kind);
    glint_status status;
    TRY_OR(cleanup, status, build(t, &r, &scene, &exact));
    glint_settings settings = choose_settings(t, &r, list);
    if (kind == ROOM_SMOOTH && !r.averaged && one_in(t, 3)) {
        frame.proxy = &proxies[one_in(t, 2)];
        settings.proxy = true;
    }
    const double yfov = r.averaged ? 0.3 : r.bead ? 1.4 : 0.8;
    const glint_camera camera = shape_camera(eye_of(&r), target, yfov, 0);
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    if (r.bead) {
        TRY_OR(cleanup, status, judge_move(&frame.judge, &scene, exact, t->error));
    }
    frame.judge.scene.overlaps = r.inside || r.overlaps;
    frame.view.no_fresnel = settings.fresnel == GLINT_FRESNEL_NONE;
    frame.view.anisotropy = settings.anisotropy;
    frame.view.roughness = kind == ROOM_ROUGH ? 32 : 0;
    frame.view.edges = kind != ROOM_ROUGH;
    measure_room(&r, &frame, of);
cleanup:
    free(exact);
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

static glint_status judge_rooms(trial *t, room_kind kind, int count, const room_measures *of)
{
    for (int i = 0; i < count; i++) {
        TRY(judge_room(t, kind, of));
    }
    return GLINT_OK;
}

static glint_status smooth_rooms(trial *t)
{
    const room_measures of = {
        trial_error(t, "smooth rooms", "of white", SMOOTH_BOUND),
        trial_error(t, "in averaged environments", "of the mean", 0.01),
        trial_share(t, "where solids overlap, or hold the eye: off by more", PLACES_SHARE)};
    return judge_rooms(t, ROOM_SMOOTH, 72, &of);
}

// Lobes err as in cases_rough.c.
static glint_status rough_rooms(trial *t)
{
    const room_measures of = {.errors = trial_error(t, "rough rooms", "of the mean", 0.003)};
    return judge_rooms(t, ROOM_ROUGH, 12, &of);
}

static glint_status rooms_of_terms(trial *t)
{
    const room_measures of = {
        .errors = trial_error(t, "pictures and sums of terms", "of white", SMOOTH_BOUND),
        .places =
            trial_share(t, "where solids overlap, or hold the eye: off by more", PLACES_SHARE)};
    return judge_rooms(t, ROOM_TERMS, 10, &of);
}

static glint_status rooms_of_hits(trial *t)
{
    const room_measures of = {.errors =
                                  trial_error(t, "triangles and barycentric weights", "", 1e-4)};
    return judge_rooms(t, ROOM_HITS, 8, &of);
}

// Colours and directions are interpolated between corners, see shaded_vertices.
static glint_status rooms_at_vertices(trial *t)
{
    const room_measures directions = {
        .errors = trial_error(t, "directions at vertices", "of the mean", 0.002)};
    const room_measures colors = {.errors =
                                      trial_error(t, "colours at vertices", "of the mean", 0.002)};
    TRY(judge_rooms(t, ROOM_DIRECTIONS, 6, &directions));
    return judge_rooms(t, ROOM_COLORS, 10, &colors);
}

const trial_case chance_cases[] = {
    {"smooth_rooms", "smooth materials, lamps and settings by chance: where features meet",
     smooth_rooms},
    {"rough_rooms", "the same with rough surfaces and sheen", rough_rooms},
    {"rooms_of_terms", "the same: what pixels are the sum of", rooms_of_terms},
    {"rooms_of_hits", "the same: what primary rays meet", rooms_of_hits},
    {"rooms_at_vertices", "balls by chance that are shaded at their vertices", rooms_at_vertices},
    {0},
};
