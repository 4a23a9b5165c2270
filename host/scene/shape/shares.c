// Estimates how much of a picture each material fills. See shares.h.
//
// It tests each triangle against the rays within its bounds in the picture, and keeps the nearest
// hits.
#include "scene/shape/shares.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define ROWS 64
#define MOST_COLUMNS 256
#define MOST_TRIES 1e8 // ray-triangle tests, about a second

typedef struct share_sample {
    double distance; // depth of the nearest hit; INFINITY: no hit
    uint32_t material;
} share_sample;

typedef struct share_grid {
    const glint_camera *camera;
    // Of the picture, in metres; in perspective, at a distance of 1 metre.
    double half_width, half_height;
    int columns;
    double tries;
    share_sample *samples; // [ROWS][columns]
} share_grid;

// Coordinates along right, up and forward, from the eye.
static glint_vec3 seen_from(const glint_camera *camera, glint_vec3 point)
{
    const glint_vec3 from_eye = glint_vec3_subtract(point, camera->eye);
    return (glint_vec3){glint_vec3_dot(camera->right, from_eye),
                        glint_vec3_dot(camera->up, from_eye),
                        -glint_vec3_dot(camera->back, from_eye)};
}

static double middle_of(int i, int count, double half_extent)
{
    return ((i + 0.5) / count * 2 - 1) * half_extent;
}

static void try_ray(share_grid *grid, const glint_vec3 corners[3], int row, int column,
                    uint32_t material)
{
    share_sample *sample = grid->samples + row * grid->columns + column;
    const double x = middle_of(column, grid->columns, grid->half_width);
    const double y = middle_of(row, ROWS, grid->half_height);
    const bool is_parallel = grid->camera->orthographic;
    const glint_vec3 start = is_parallel ? (glint_vec3){x, y, 0} : (glint_vec3){0, 0, 0};
    const glint_vec3 along = is_parallel ? (glint_vec3){0, 0, 1} : (glint_vec3){x, y, 1};
    glint_vec3 to[3];
    for (int i = 0; i < 3; i++) {
        to[i] = glint_vec3_subtract(corners[i], start);
    }
    const double a = glint_vec3_dot(along, glint_vec3_cross(to[1], to[2]));
    const double b = glint_vec3_dot(along, glint_vec3_cross(to[2], to[0]));
    const double c = glint_vec3_dot(along, glint_vec3_cross(to[0], to[1]));
    const bool is_inside = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    const double distance = (a * to[0].z + b * to[1].z + c * to[2].z) / (a + b + c);
    if (is_inside && distance > 0 && distance < sample->distance) {
        *sample = (share_sample){distance, material};
    }
}

// The first sample at or after a place in the picture, −1 to 1; also one past the last sample
// before it.
static int sample_at(double place, int count)
{
    const double i = ceil((place + 1) / 2 * count - 0.5);
    return i <= 0 ? 0 : i >= count ? count : (int)i;
}

static void add_triangle(share_grid *grid, const glint_vec3 corners[3], uint32_t material)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    int behind = 0;
    for (int i = 0; i < 3; i++) {
        const double depth = corners[i].z;
        const double scale = grid->camera->orthographic ? 1 : depth;
        const double place[2] = {corners[i].x / (scale * grid->half_width),
                                 corners[i].y / (scale * grid->half_height)};
        behind += depth > 0 ? 0 : 1;
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], place[k]);
            high[k] = fmax(high[k], place[k]);
        }
    }
    if (behind == 3) {
        return;
    }
    // A triangle that is partly behind the camera may be anywhere in the picture.
    const bool is_cut = behind > 0 && !grid->camera->orthographic;
    const int left = is_cut ? 0 : sample_at(low[0], grid->columns);
    const int right =
        is_cut ? grid->columns : sample_at(nextafter(high[0], INFINITY), grid->columns);
    const int bottom = is_cut ? 0 : sample_at(low[1], ROWS);
    const int top = is_cut ? ROWS : sample_at(nextafter(high[1], INFINITY), ROWS);
    for (int row = bottom; row < top; row++) {
        for (int column = left; column < right; column++) {
            try_ray(grid, corners, row, column, material);
        }
    }
    grid->tries += 1 + (double)(top - bottom) * (right - left);
}

static bool add_scene(share_grid *grid, const glint_scene *scene)
{
    for (size_t t = 0; t < scene->triangle_count; t++) {
        glint_vec3 corners[3];
        for (size_t i = 0; i < 3; i++) {
            const glint_vec3 relative = glint_vec3_from_floats(glint_scene_position(scene, t, i));
            corners[i] =
                seen_from(grid->camera,
                          glint_vec3_add(scene->origin, glint_vec3_scale(relative, scene->unit)));
        }
        add_triangle(grid, corners, scene->material_of[t]);
        if (grid->tries > MOST_TRIES) {
            return false;
        }
    }
    return true;
}

bool glint_material_shares(const glint_scene *scene, const glint_camera *camera, double aspect,
                           double *shares)
{
    const double columns = fmin(fmax(round(ROWS * aspect), 1), MOST_COLUMNS);
    share_grid grid = {.camera = camera, .columns = (int)columns};
    grid.half_height = camera->orthographic ? camera->ymag : tan(camera->yfov / 2);
    grid.half_width = grid.half_height * aspect;
    const int count = ROWS * grid.columns;
    grid.samples = glint_allocate((size_t)count, sizeof *grid.samples);
    if (grid.samples == NULL) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        grid.samples[i].distance = INFINITY;
    }
    const bool is_whole = add_scene(&grid, scene);
    for (size_t i = 0; i < scene->material_count; i++) {
        shares[i] = 0;
    }
    for (int i = 0; i < count; i++) {
        if (isfinite(grid.samples[i].distance)) {
            shares[grid.samples[i].material] += 1.0 / count;
        }
    }
    free(grid.samples);
    return is_whole;
}
