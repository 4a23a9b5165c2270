// Pictures of a sparse grid of a frame's pixels. See error_grid.h.
#include "report/error_grid.h"

#include "report/metrics.h"
#include "report/stats.h"

#include <math.h>

#define SHIFT 0.001  // of a pixel
#define MATTERS 0.01 // of the mean

int glint_error_grid_step(int width, int height)
{
    const double pixels = (double)width * height;
    if (pixels < GLINT_ERROR_GRID_WHOLE) {
        return 1;
    }
    const double step = floor(sqrt(pixels / GLINT_ERROR_GRID_PIXELS));
    return (int)fmin(step, fmin(width, height));
}

size_t glint_error_grid_pixel_count(const glint_error_grid *grid)
{
    return (size_t)grid->reference.width * (size_t)grid->reference.height;
}

static bool go_on(void *context, uint64_t done, uint64_t total)
{
    (void)done, (void)total;
    const glint_progress *progress = context;
    return progress->step(progress->context, 0, 1);
}

// Through `camera` into *image.
static glint_status render(glint_error_grid *grid, const glint_settings *settings,
                           const glint_camera *camera, glint_image *image,
                           glint_frame_report *report, glint_error *error)
{
    glint_settings of_grid = *settings;
    of_grid.grid_step = grid->step > 1 ? grid->step : 0;
    of_grid.aovs = 0;
    of_grid.terms = 0;
    of_grid.truncation_squares = true;
    const glint_progress progress = {go_on, (void *)grid->progress};
    const bool asks = grid->progress != NULL;
    glint_status status = glint_renderer_set_settings(grid->renderer, &of_grid, error);
    if (status == GLINT_OK) {
        status = glint_renderer_frame(grid->renderer, camera, asks ? &progress : NULL, image,
                                      report, error);
    }
    if (status == GLINT_OK) {
        grid->rays += glint_stats_rays(&report->rays);
        grid->pictures++;
    }
    return status;
}

glint_status glint_error_grid_set_reference(glint_error_grid *grid, const glint_settings *settings,
                                            glint_frame_report *report, glint_error *error)
{
    glint_status status = render(grid, settings, grid->camera, &grid->reference, report, error);
    if (status == GLINT_OK) {
        grid->mean = glint_metrics_mean(&grid->reference, &grid->reference);
    }
    return status;
}

double glint_error_grid_contrast(const glint_error_grid *grid)
{
    const size_t count = glint_error_grid_pixel_count(grid);
    double sums[3] = {0}, squares = 0, finite = 0;
    for (size_t i = 0; i < count; i++) {
        const glint_pixel_error same =
            glint_metrics_pixel(&grid->reference, &grid->reference, i, 0);
        for (size_t c = 0; same.is_finite && c < 3; c++) {
            const double value = (double)grid->reference.pixels[4 * i + c];
            sums[c] += value;
            squares += value * value / 3;
        }
        finite += same.is_finite;
    }
    double of_means = 0;
    for (int c = 0; c < 3; c++) {
        of_means += sums[c] / finite * sums[c] / finite / 3;
    }
    return finite > 0 ? sqrt(fmax(0, squares / finite - of_means)) : 0;
}

// How much larger a mean may be than what was found of it with a relative standard error of
// `chance`: two of these, and more where it rests on so few pixels that these are rare events. Of
// one, 5.6 times; of ten, 1.9; of a hundred, 1.2, as upper bounds of 97.5% of a Poisson
// distribution's mean are.
static double at_most(double chance)
{
    return 1 + 2 * chance + 2.6 * chance * chance;
}

static glint_grid_error compare(const glint_error_grid *grid)
{
    const size_t count = glint_error_grid_pixel_count(grid);
    double n = 0, sum_of_differences = 0;
    double sum = 0, squares = 0; // of the pixels' square errors
    for (size_t i = 0; i < count; i++) {
        const glint_pixel_error same =
            glint_metrics_pixel(&grid->reference, &grid->reference, i, grid->mean);
        if (!same.is_finite) {
            continue;
        }
        const glint_pixel_error e =
            glint_metrics_pixel(&grid->image, &grid->reference, i, grid->mean);
        if (!e.is_finite) {
            return (glint_grid_error){(double)INFINITY, (double)INFINITY, 0};
        }
        double square = 0;
        for (int c = 0; c < 3; c++) {
            square += e.difference[c] * e.difference[c] / 3;
            sum_of_differences += e.difference[c] / 3;
        }
        sum += square;
        squares += square * square;
        n++;
    }
    if (sum == 0) {
        return (glint_grid_error){0};
    }
    const double mean = sum / n, variance = fmax(0, squares / n - mean * mean);
    const double chance = grid->step > 1 ? sqrt(variance / n) / mean : 0;
    const double measured = sqrt(mean) / fabs(grid->mean);
    return (glint_grid_error){measured, measured * sqrt(at_most(chance)), sum_of_differences / n};
}

glint_status glint_error_grid_measure(glint_error_grid *grid, const glint_settings *settings,
                                      glint_grid_error *result, glint_frame_report *report,
                                      glint_error *error)
{
    glint_status status = render(grid, settings, grid->camera, &grid->image, report, error);
    if (status == GLINT_OK) {
        *result = compare(grid);
    }
    return status;
}

void glint_error_grid_keep(glint_error_grid *grid, glint_image *image)
{
    const glint_image measured = grid->image;
    grid->image = *image;
    *image = measured;
}

// ---- Chaos -------------------------------------------------------------------------------------

// The camera turned, or one of parallel rays moved, to the right by a part of a pixel.
static glint_camera shifted(const glint_camera *camera, int height, double pixels)
{
    glint_camera c = *camera;
    if (camera->orthographic) {
        const double step = pixels * 2 * camera->ymag / height;
        c.eye = glint_vec3_add(camera->eye, glint_vec3_scale(camera->right, step));
        return c;
    }
    const double angle = pixels * 2 * tan(camera->yfov / 2) / height;
    const double cosine = cos(angle), sine = sin(angle);
    c.back = glint_vec3_add(glint_vec3_scale(camera->back, cosine),
                            glint_vec3_scale(camera->right, -sine));
    c.right = glint_vec3_add(glint_vec3_scale(camera->right, cosine),
                             glint_vec3_scale(camera->back, sine));
    return c;
}

// The largest of the three differences; 0 where either is not finite.
static double difference(const glint_image *a, const glint_image *b, size_t pixel)
{
    const glint_pixel_error e = glint_metrics_pixel(a, b, pixel, 0);
    return e.is_finite ? e.absolute_most : 0;
}

// How far a pixel is from the mean of what it is with the camera on either side, in the same way.
static double bend(const glint_image *image, const glint_image sides[2], size_t pixel)
{
    double most = 0;
    for (size_t i = 4 * pixel; i < 4 * pixel + 3; i++) {
        const double mean = ((double)sides[0].pixels[i] + (double)sides[1].pixels[i]) / 2;
        const double off = fabs(mean - (double)image->pixels[i]);
        most = off > most && off < (double)INFINITY ? off : most;
    }
    return most;
}

// The next pixel, from `pixel` on, whose light beyond where `cut` ends matters; else their number.
static size_t next_that_matters(const glint_error_grid *grid, const glint_image *image,
                                const glint_image *cut, size_t pixel)
{
    const size_t count = glint_error_grid_pixel_count(grid);
    while (pixel < count && difference(cut, image, pixel) <= MATTERS * fabs(grid->mean)) {
        pixel++;
    }
    return pixel;
}

glint_status glint_error_grid_find_chaos(glint_error_grid *grid, const glint_error_chaos *chaos,
                                         double *share, glint_error *error)
{
    const size_t count = glint_error_grid_pixel_count(grid);
    const glint_image *image = chaos->image;
    glint_settings shallow = *chaos->settings;
    shallow.depth = chaos->depth;
    glint_image cut = {0}, sides[2] = {{0}, {0}};
    glint_frame_report unused;
    *share = 0;
    glint_status status = render(grid, &shallow, grid->camera, &cut, &unused, error);
    const size_t first = status == GLINT_OK ? next_that_matters(grid, image, &cut, 0) : count;
    for (int i = 0; status == GLINT_OK && first < count && i < 2; i++) {
        const glint_camera side = shifted(grid->camera, shallow.height, i == 0 ? SHIFT : -SHIFT);
        status = render(grid, chaos->settings, &side, &sides[i], &unused, error);
    }
    for (size_t i = first; status == GLINT_OK && i < count;
         i = next_that_matters(grid, image, &cut, i + 1)) {
        *share += fmin(1, bend(image, sides, i) / chaos->contrast) / (double)count;
    }
    glint_image_free(&cut);
    glint_image_free(&sides[0]);
    glint_image_free(&sides[1]);
    return status;
}

void glint_error_grid_free(glint_error_grid *grid)
{
    glint_image_free(&grid->reference);
    glint_image_free(&grid->image);
    *grid = (glint_error_grid){0};
}
