// Makes cube maps from pictures of faces. See faces.h.
#include "environment/faces.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "kernels/layout.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

void glint_face_on_edges(const glint_image *image, int face, double s, double t, double rgb[3])
{
    const int n = image->width, top = face * n;
    const double x = fmin(fmax(0.5 * (s + 1.0), 0.0), 1.0) * (n - 1);
    const double y = fmin(fmax(0.5 * (t + 1.0), 0.0), 1.0) * (n - 1);
    int left = (int)x, upper = (int)y;
    int right = left + 1 < n ? left + 1 : left, lower = upper + 1 < n ? upper + 1 : upper;
    double corners[4][3], above[3], below[3];
    glint_image_rgb(image, left, top + upper, corners[0]);
    glint_image_rgb(image, right, top + upper, corners[1]);
    glint_image_rgb(image, left, top + lower, corners[2]);
    glint_image_rgb(image, right, top + lower, corners[3]);
    glint_rgb_mix(corners[0], corners[1], x - left, above);
    glint_rgb_mix(corners[2], corners[3], x - left, below);
    glint_rgb_mix(above, below, y - upper, rgb);
}

// The data that all threads share.
typedef struct job {
    const glint_image *image;             // NULL: convert the pixels
    const glint_development *development; // NULL: the image is there
    const glint_chart *chart;
    const glint_face_cell *cells;
    glint_cube *cube;
    int width, channels; // of the picture
    atomic_bool is_cut, has_no_memory;
} job;

static void interpolate_row(const job *shared, int face, int j)
{
    const int edge = shared->cube->edge;
    for (int i = 0; i < edge; i++) {
        double rgb[3];
        glint_face_on_edges(shared->image, face, (2.0 * i + 1.0) / edge - 1.0,
                            (2.0 * j + 1.0) / edge - 1.0, rgb);
        glint_cube_store(shared->cube, face, i, j, rgb);
    }
}

// Copies a row of pixels to a row of texels, in the opposite order if `is_turned`.
static void copy_row(const float *pixels, int channels, bool is_turned, int count, float *texels)
{
    const int step = channels >= 3;
    for (int i = 0; i < count; i++) {
        const float *pixel = pixels + (ptrdiff_t)channels * (is_turned ? count - 1 - i : i);
        for (int c = 0; c < 3; c++) {
            texels[4 * i + c] = pixel[c * step];
        }
        texels[4 * i + 3] = 1.0f;
    }
}

// Fills row j of a face. `converted` has room for a row of a face's pixels, unless there is an
// image.
static void fill_row(job *shared, int face, int j, float *converted)
{
    const glint_face_cell *cell = &shared->cells[face];
    const int edge = shared->cube->edge,
              row = cell->row * edge + (cell->is_turned ? edge - 1 - j : j);
    const size_t first = (size_t)row * (size_t)shared->width + (size_t)(cell->column * edge);
    const float *pixels = converted;
    if (shared->image != NULL) {
        pixels = shared->image->pixels + first * (size_t)shared->channels;
    } else if (!glint_development_read(shared->development, first, (size_t)edge, converted)) {
        atomic_store(&shared->is_cut, true);
        return;
    }
    copy_row(pixels, shared->channels, cell->is_turned, edge,
             glint_cube_texel(shared->cube, face, 0, j));
}

#define BAND 16 // rows that a thread fills at once

static void fill_band(size_t index, void *context)
{
    job *shared = context;
    const int edge = shared->cube->edge, bands = (edge + BAND - 1) / BAND;
    const int face = (int)index / bands, first = (int)index % bands * BAND;
    float *converted = NULL;
    if (shared->image == NULL) {
        converted = glint_allocate_unset((size_t)edge * (size_t)shared->channels, sizeof(float));
        if (converted == NULL) {
            atomic_store(&shared->has_no_memory, true);
            return;
        }
    }
    for (int j = first; j < first + BAND && j < edge; j++) {
        if (shared->image != NULL && shared->chart->on_edges) {
            interpolate_row(shared, face, j);
        } else {
            fill_row(shared, face, j, converted);
        }
    }
    free(converted);
}

static glint_status fill(job *shared, glint_error *error)
{
    int across;
    shared->cells = glint_layout_cells(shared->chart->layout, &across, NULL);
    const int edge = shared->width / across;
    TRY(glint_cube_create_unset(edge, shared->cube, error));
    glint_parallel_for(GLINT_CUBE_FACES * (size_t)((edge + BAND - 1) / BAND), fill_band, shared);
    if (atomic_load(&shared->is_cut) || atomic_load(&shared->has_no_memory)) {
        glint_cube_free(shared->cube);
        return atomic_load(&shared->is_cut)
                   ? glint_stored_fail_of_cut(shared->development->stored, error)
                   : glint_fail_memory(error, "an environment");
    }
    glint_cube_fill_border(shared->cube);
    return GLINT_OK;
}

glint_status glint_cube_from_faces(const glint_image *image, const glint_chart *chart,
                                   glint_cube *cube, glint_error *error)
{
    job shared = {.image = image,
                  .chart = chart,
                  .cube = cube,
                  .width = image->width,
                  .channels = image->channels};
    return fill(&shared, error);
}

glint_status glint_cube_from_stored_faces(const glint_stored *stored, const glint_chart *chart,
                                          glint_cube *cube, glint_error *error)
{
    glint_development development;
    TRY(glint_development_begin(stored, &development, error));
    job shared = {.development = &development,
                  .chart = chart,
                  .cube = cube,
                  .width = stored->facts.width,
                  .channels = stored->facts.channels};
    const glint_status status = fill(&shared, error);
    glint_development_end(&development);
    return status;
}
