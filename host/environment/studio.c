// Computes the built-in studio, an environment for product pictures, from a formula. See studio.h.
//
// Metal and glass show their surroundings, so the studio has:
//   a dark room, for contrast;
//   the key light: a large soft box overhead, in front, on the left;
//   a tall cool strip on the right and a warm strip behind on the left: their long reflections draw
//   an object's outline;
//   a lit backdrop straight ahead, for glass to refract;
//   a floor that darkens towards the viewer and meets the backdrop in a horizon;
//   three small lamps, for the sparkle of cut stones.
// Lights have a radiance of 7 to 20, walls of 0.03 to 0.6. White paint is about 1 on the lit side.
// All edges are soft over several texels, so the map has no steps at any zoom.
#include "environment/studio.h"

#include "base/parallel.h"
#include "kernels/layout.h"

#include <math.h>

#define EDGE 512

typedef struct panel {
    double center[3];   // direction, not normalised
    double half_width;  // sideways, in the plane at distance 1
    double half_height; // upwards, in the same plane
    double softness;    // width of the soft edge, in that plane
    double falloff;     // share of the light lost from centre to edge, [0, 1)
    double color[3];    // radiance at the centre
} panel;

// Positions are for a camera that looks along −Z: −X is on its left, +Z behind it.
static const panel panels[] = {
    // The key: a soft box.
    {{-0.64, 0.78, 0.42}, 0.44, 0.30, 0.08, 0.40, {9.6, 9.1, 8.3}},
    // The fill: a tall strip, cool.
    {{0.95, 0.22, 0.34}, 0.085, 0.72, 0.06, 0.25, {7.0, 7.8, 8.8}},
    // The rim: a strip behind, warm.
    {{-0.86, 0.14, -0.58}, 0.06, 0.60, 0.05, 0.25, {8.8, 7.7, 6.1}},
    // A bank from behind on the right, low and wide.
    {{0.70, 0.52, -0.72}, 0.26, 0.07, 0.05, 0.2, {8.0, 8.1, 8.3}},
    // The lamps.
    {{0.25, 0.92, 0.18}, 0.045, 0.045, 0.045, 0.0, {20.0, 19.6, 18.8}},
    {{0.42, 0.86, 0.40}, 0.045, 0.045, 0.045, 0.0, {20.0, 19.6, 18.8}},
    {{0.14, 0.80, 0.66}, 0.045, 0.045, 0.045, 0.0, {20.0, 19.6, 18.8}},
};
#define PANELS (sizeof panels / sizeof panels[0])

// A panel's plane: unit vectors towards its centre, to its right and upwards. `farthest` is the
// cosine of the angle from the centre to the farthest corner; beyond it the panel has no light.
typedef struct frame {
    glint_vec3 forward, right, up;
    double farthest;
} frame;

typedef struct studio {
    glint_cube *cube;
    frame frames[PANELS];
} studio;

// 0 below a, 1 above b, smooth between.
static double smooth_step(double a, double b, double x)
{
    double t = (x - a) / (b - a);
    t = t > 0.0 ? (t < 1.0 ? t : 1.0) : 0.0;
    return t * t * (3.0 - 2.0 * t);
}

static double mix(double a, double b, double weight)
{
    return a + weight * (b - a);
}

static frame frame_of(const panel *which)
{
    const double *c = which->center;
    frame made;
    made.forward = glint_vec3_normalize((glint_vec3){c[0], c[1], c[2]});
    made.right = glint_vec3_normalize(glint_vec3_cross(made.forward, (glint_vec3){0.0, 1.0, 0.0}));
    made.up = glint_vec3_cross(made.right, made.forward);
    double width = which->half_width + which->softness;
    double height = which->half_height + which->softness;
    made.farthest = 1.0 / sqrt(1.0 + width * width + height * height);
    return made;
}

// The share of the panel's light along d, [0, 1].
static double panel_share(const panel *which, const frame *plane, glint_vec3 d)
{
    double ahead = glint_vec3_dot(d, plane->forward);
    if (ahead <= plane->farthest) {
        return 0.0;
    }
    double x = fabs(glint_vec3_dot(d, plane->right)) / ahead / which->half_width;
    double y = fabs(glint_vec3_dot(d, plane->up)) / ahead / which->half_height;
    double soft_x = which->softness / which->half_width;
    double soft_y = which->softness / which->half_height;
    double inside = (1.0 - smooth_step(1.0 - soft_x, 1.0 + soft_x, x)) *
                    (1.0 - smooth_step(1.0 - soft_y, 1.0 + soft_y, y));
    double far = 0.5 * (x * x + y * y);
    return inside * (1.0 - which->falloff * (far < 1.0 ? far : 1.0));
}

// Columns that are computed at once. The compiler puts several into a vector.
#define CHUNK 16
_Static_assert(EDGE % CHUNK == 0, "the last chunk would be cut");

// A row of unit directions, and their radiance.
typedef struct chunk {
    double x[CHUNK], y[CHUNK], z[CHUNK];
    double rgb[3][CHUNK];
} chunk;

// Draws the room without its lights.
static void draw_room(chunk *of)
{
    for (int k = 0; k < CHUNK; k++) {
        const double x = of->x[k], y = of->y[k], z = of->z[k];
        // The backdrop glows around a point a little above the horizon, straight ahead.
        double ahead = -0.985 * z + 0.17 * y;
        double glow = smooth_step(0.15, 1.0, ahead);
        double height = y > 0.0 ? y : 0.0;
        double wall = mix(0.16, 0.03, smooth_step(0.0, 0.85, height)) + 0.44 * glow * glow;
        // The floor takes the backdrop's light far away and darkens towards the feet.
        double depth = y < 0.0 ? -y : 0.0;
        double floor_light = mix(0.13 + 0.24 * glow, 0.035, smooth_step(0.0, 0.7, depth));
        double above = smooth_step(-0.012, 0.012, y);
        double grey = mix(floor_light, wall, above);
        // Warm on the left, cool on the right.
        double side = 0.5 + 0.5 * x;
        of->rgb[0][k] = grey * mix(1.10, 0.88, side);
        of->rgb[1][k] = grey * mix(0.99, 0.98, side);
        of->rgb[2][k] = grey * mix(0.86, 1.16, side);
    }
}

// Adds a panel. Skips it if all directions are beyond it: each is within half a chunk of texels
// from one in the middle, so its cosine is at most that much larger.
static void add_panel(const panel *which, const frame *plane, chunk *of)
{
    const glint_vec3 middle = {of->x[CHUNK / 2], of->y[CHUNK / 2], of->z[CHUNK / 2]};
    const double reach = (double)CHUNK / EDGE;
    if (glint_vec3_dot(middle, plane->forward) + reach <= plane->farthest) {
        return;
    }
    for (int k = 0; k < CHUNK; k++) {
        const glint_vec3 d = {of->x[k], of->y[k], of->z[k]};
        const double share = panel_share(which, plane, d);
        for (int c = 0; c < 3; c++) {
            of->rgb[c][k] = mix(of->rgb[c][k], which->color[c], share);
        }
    }
}

static void store_chunk(const chunk *of, float *texels)
{
    for (int k = 0; k < CHUNK; k++) {
        for (int c = 0; c < 3; c++) {
            texels[4 * k + c] = (float)of->rgb[c][k];
        }
        texels[4 * k + 3] = 1.0f;
    }
}

// Computes row j of all faces, which share the texels' distances from the middle of the cube.
static void fill_row(size_t j, void *context)
{
    const studio *job = context;
    const double t = (2.0 * (double)j + 1.0) / EDGE - 1.0;
    for (int first = 0; first < EDGE; first += CHUNK) {
        double s[CHUNK], scale[CHUNK];
        for (int k = 0; k < CHUNK; k++) {
            s[k] = (2.0 * (first + k) + 1.0) / EDGE - 1.0;
            scale[k] = 1.0 / sqrt(1.0 + s[k] * s[k] + t * t);
        }
        for (int face = 0; face < GLINT_CUBE_FACES; face++) {
            chunk of;
            for (int k = 0; k < CHUNK; k++) {
                const glint_vec3 d =
                    glint_vec3_scale(glint_cube_direction(face, s[k], t), scale[k]);
                of.x[k] = d.x, of.y[k] = d.y, of.z[k] = d.z;
            }
            draw_room(&of);
            for (size_t k = 0; k < PANELS; k++) {
                add_panel(&panels[k], &job->frames[k], &of);
            }
            store_chunk(&of, glint_cube_texel(job->cube, face, first, (int)j));
        }
    }
}

glint_status glint_studio_cube(glint_cube *cube, glint_error *error)
{
    TRY(glint_cube_create_unset(EDGE, cube, error));
    studio job = {.cube = cube};
    for (size_t k = 0; k < PANELS; k++) {
        job.frames[k] = frame_of(&panels[k]);
    }
    glint_parallel_for(EDGE, fill_row, &job);
    glint_cube_fill_border(cube);
    return GLINT_OK;
}
