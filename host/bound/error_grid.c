// Renders a sparse grid of a frame's pixels, and measures its errors. See error_grid.h.
#include "bound/error_grid.h"

#include "base/memory.h"
#include "image/metrics.h"
#include "render/pixel_list.h"

#include <math.h>
#include <stdlib.h>

#define SHIFT 0.001  // of a pixel
#define MATTERS 0.01 // of the mean
#define SMOOTH 0.01  // of the contrast
// The error of paths in single precision, as an angle: two units in the last place. This is 1e-4 of
// a pixel for a frame of 352 rows and 40 degrees. The cameras stood about two scene sizes away;
// much nearer the error may be larger. It was estimated from how often frames showed the wrong side
// of a jump, given all jumps of this size between their pixels. Frames of glass (7 scenes, 80
// frames each) gave 0.2e-4 to 0.8e-4, the folds of the sea 2e-4. Mirrors gave 0.05e-4 to 0.1e-4,
// dense groups of mirrors 0.1e-4 to 0.7e-4.
#define ULPS 0x1p-22
// The share of samples on the wrong side with no neighbour that differs by as much; mending misses
// them. Of 720 frames of nine scenes, mended at 0.3 of the mean, three had a pixel with an error of
// half of the mean or more. ULPS predicts about 360 such pixels from all jumps of this size.
#define HIDDEN 0.01
// Mending compares a pixel with four neighbours, a whole pixel away. The grid compares it with two
// sides, half a pixel away.
#define NEIGHBOURS 2

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

// Renders the grid through `camera` into *image.
static glint_status render(glint_error_grid *grid, const glint_settings *settings,
                           const glint_camera *camera, glint_image *image, glint_error *error)
{
    glint_settings of_grid = *settings;
    of_grid.grid_step = grid->step > 1 && settings->list == NULL ? grid->step : 0;
    of_grid.aovs = 0;
    of_grid.terms = 0;
    of_grid.truncation_squares = true;
    const glint_progress progress = {go_on, (void *)grid->progress};
    const bool asks = grid->progress != NULL;
    TRY(glint_renderer_set_settings(grid->renderer, &of_grid, error));
    TRY(glint_renderer_frame(&(glint_frame_request){grid->renderer, camera, asks ? &progress : NULL,
                                                    image, &grid->report},
                             error));
    grid->rays += glint_ray_counts_all(&grid->report.rays);
    grid->pictures++;
    return GLINT_OK;
}

glint_status glint_error_grid_set_reference(glint_error_grid *grid, const glint_settings *settings,
                                            glint_error *error)
{
    TRY(render(grid, settings, grid->camera, &grid->reference, error));
    grid->mean = glint_metrics_mean(&grid->reference, &grid->reference);
    return GLINT_OK;
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

// Upper bound of a mean, relative to its estimate with a relative standard error of `chance`: two
// standard errors more. It is larger if the mean rests on few pixels, which are rare events. For
// one pixel it is 5.6 times, for ten 1.9 times, for a hundred 1.2 times. These are the upper bounds
// (97.5%) of a Poisson distribution's mean.
static double at_most(double chance)
{
    return 1 + 2 * chance + 2.6 * chance * chance;
}

// True if a frame would mend this pixel.
static bool is_mended(const glint_error_grid *grid, double mend, size_t pixel)
{
    return mend > 0 && grid->jumps != NULL && grid->jumps[pixel] > mend * mend;
}

static glint_grid_error compare(const glint_error_grid *grid, double mend)
{
    const size_t count = glint_error_grid_pixel_count(grid);
    double n = 0, sum_of_differences = 0;
    double sum = 0, squares = 0; // of the squared errors of pixels, and of the squares of these
    for (size_t i = 0; i < count; i++) {
        const glint_pixel_error same =
            glint_metrics_pixel(&grid->reference, &grid->reference, i, grid->mean);
        if (!same.is_finite) {
            continue;
        }
        const glint_image *image = is_mended(grid, mend, i) ? grid->in_double : &grid->image;
        const glint_pixel_error e = glint_metrics_pixel(image, &grid->reference, i, grid->mean);
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
                                      glint_grid_error *result, glint_error *error)
{
    TRY(render(grid, settings, grid->camera, &grid->image, error));
    *result = compare(grid, settings->mend);
    return GLINT_OK;
}

void glint_error_grid_keep(glint_error_grid *grid, glint_image *image)
{
    const glint_image measured = grid->image;
    grid->image = *image;
    *image = measured;
}

// ---- Shifted cameras ---------------------------------------------------------------------------

// The size of a pixel: an angle, or for parallel rays a fraction of half the picture's height.
static double pixel_size(const glint_camera *camera, int height)
{
    return (camera->orthographic ? 2 : 2 * tan(camera->yfov / 2)) / height;
}

// Rotates an axis of a camera and the camera's back, so that the view turns towards the axis.
static void turn(glint_vec3 *axis, glint_vec3 *back, double angle)
{
    const double cosine = cos(angle), sine = sin(angle);
    const glint_vec3 before = *back;
    *back = glint_vec3_add(glint_vec3_scale(before, cosine), glint_vec3_scale(*axis, -sine));
    *axis = glint_vec3_add(glint_vec3_scale(*axis, cosine), glint_vec3_scale(before, sine));
}

// The camera rotated to the right and up by fractions of a pixel. A camera with parallel rays is
// moved instead.
static glint_camera shifted(const glint_camera *camera, int height, double right, double up)
{
    const double size = pixel_size(camera, height);
    glint_camera c = *camera;
    if (camera->orthographic) {
        const glint_vec3 sideways = glint_vec3_scale(c.right, size * right * c.ymag);
        const glint_vec3 upwards = glint_vec3_scale(c.up, size * up * c.ymag);
        c.eye = glint_vec3_add(c.eye, glint_vec3_add(sideways, upwards));
        return c;
    }
    turn(&c.right, &c.back, size * right);
    turn(&c.up, &c.back, size * up);
    return c;
}

// The largest of the three differences; 0 if one of the pixels is not finite.
static double difference(const glint_image *a, const glint_image *b, size_t pixel)
{
    const glint_pixel_error e = glint_metrics_pixel(a, b, pixel, 0);
    return e.is_finite ? e.absolute_most : 0;
}

// The difference between a pixel and the mean of its two values with the camera shifted to either
// side: R, G and B. A difference that is not finite counts as 0.
static void find_bend(const glint_image *image, const glint_image sides[2], size_t pixel,
                      double bend[3])
{
    for (size_t c = 0; c < 3; c++) {
        const size_t i = 4 * pixel + c;
        const double mean = ((double)sides[0].pixels[i] + (double)sides[1].pixels[i]) / 2;
        const double off = fabs(mean - (double)image->pixels[i]);
        bend[c] = off < (double)INFINITY ? off : 0;
    }
}

// Renders the grid twice: with the camera shifted by `shift` pixels to the right and up, and by the
// opposite shift.
static glint_status render_sides(glint_error_grid *grid, const glint_settings *settings,
                                 const double shift[2], glint_image sides[2], glint_error *error)
{
    for (int i = 0; i < 2; i++) {
        const double sign = i == 0 ? 1 : -1;
        const glint_camera side =
            shifted(grid->camera, settings->height, sign * shift[0], sign * shift[1]);
        TRY(render(grid, settings, &side, &sides[i], error));
    }
    return GLINT_OK;
}

// ---- Edges -------------------------------------------------------------------------------------

static int falling(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

// Squared jumps in descending order. Each is expected to show the wrong side `each` times.
typedef struct jumps {
    const double *squares;
    size_t count;
    double each;
} jumps;

// Upper bound of the sum of squared jumps from `first` on that a frame's samples show, if the
// samples are independent. It allows two standard deviations more than expected, or one more of the
// largest jump.
static double sum_at_most(const jumps *j, size_t first)
{
    double mean = 0, variance = 0;
    for (size_t i = first; i < j->count; i++) {
        mean += j->each * j->squares[i];
        variance += j->each * j->squares[i] * j->squares[i];
    }
    return first < j->count ? mean + fmax(2 * sqrt(variance), j->squares[first]) : 0;
}

// Upper bound for all jumps. With a confidence of 97.5%, the largest jumps do not occur; these are
// left out.
static double all_at_most(const jumps *j)
{
    return sum_at_most(j, (size_t)fmin(floor(0.025 / j->each), (double)j->count));
}

// Upper bound if the first `mended` jumps are mended. The share HIDDEN of them remains.
static double mended_at_most(const jumps *j, size_t mended)
{
    const jumps hidden = {j->squares, mended, HIDDEN * j->each};
    return all_at_most(&hidden) + sum_at_most(j, mended);
}

// The smallest number of mended jumps whose remaining error is allowed; all jumps if no number
// suffices.
static size_t fewest_mended(const jumps *j, double allowed)
{
    size_t low = 0, high = j->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (mended_at_most(j, middle) <= allowed) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

// `unit`: the squared error of the frame for a sum of squares of 1.
static glint_edge_errors errors_of(const jumps *j, double unit, double allowed)
{
    const size_t mended = fewest_mended(j, allowed * allowed / unit);
    return (glint_edge_errors){
        .at_most = sqrt(all_at_most(j) * unit),
        .mend = mended < j->count ? sqrt(j->squares[mended]) : 0,
        .mended = sqrt(mended_at_most(j, mended) * unit),
    };
}

// Stores the jumps in the grid, and returns a sorted copy.
static glint_status find_jumps(glint_error_grid *grid, const glint_image *image,
                               const glint_image sides[2], double **sorted, glint_error *error)
{
    const size_t count = glint_error_grid_pixel_count(grid);
    free(grid->jumps);
    grid->jumps = glint_allocate(count, sizeof *grid->jumps);
    *sorted = glint_allocate(count, sizeof **sorted);
    if (grid->jumps == NULL || *sorted == NULL) {
        return glint_fail_memory(error, "the grid's jumps");
    }
    for (size_t i = 0; i < count; i++) {
        double bend[3], square = 0;
        find_bend(image, sides, i, bend);
        for (int c = 0; c < 3; c++) {
            square += bend[c] / grid->mean * (bend[c] / grid->mean) / 3;
        }
        // If an edge lies between a pixel and one side, the difference is half of the jump.
        (*sorted)[i] = grid->jumps[i] = 4 * square;
    }
    qsort(*sorted, count, sizeof **sorted, falling);
    return GLINT_OK;
}

glint_status glint_error_grid_find_edges(glint_error_grid *grid, const glint_error_edges *edges,
                                         glint_edge_errors *result, glint_error *error)
{
    const glint_settings *settings = edges->settings;
    const size_t count = glint_error_grid_pixel_count(grid);
    const double samples = (double)settings->samples_per_axis * settings->samples_per_axis;
    const double all = samples * settings->width * settings->height;
    // A pixel of many samples crosses an edge gradually. A shift by a whole pixel to either side
    // then adds up to the effect of half a pixel on a single sample.
    const double shift = samples > 1 ? 1 : 0.5;
    glint_image sides[2] = {{0}, {0}};
    double *sorted = NULL;
    glint_status status;
    TRY_OR(cleanup, status, render_sides(grid, settings, (double[]){shift, shift}, sides, error));
    TRY_OR(cleanup, status, find_jumps(grid, edges->image, sides, &sorted, error));
    const double off = ULPS / pixel_size(grid->camera, settings->height);
    const jumps found = {sorted, count, off * all / (double)count};
    *result = errors_of(&found, 1 / (samples * all), edges->allowed);
    // A pixel that lies half on one side of an edge differs from its neighbours by half of the
    // jump.
    result->mend *= samples > 1 ? 0.5 : 1;
cleanup:
    free(sorted);
    glint_image_free(&sides[0]);
    glint_image_free(&sides[1]);
    return status;
}

// Lists the grid's pixels that would be mended, as pixel numbers of the frame. Unused entries of
// the last row repeat the first pixel. Returns NULL if there is too little memory.
static uint32_t *list_mended(const glint_error_grid *grid, const glint_settings *settings,
                             double mend, size_t *count, int *rows)
{
    const size_t all = glint_error_grid_pixel_count(grid);
    const size_t width = (size_t)grid->reference.width, step = (size_t)grid->step;
    uint32_t *list = glint_allocate(all + GLINT_LIST_COLUMNS, sizeof *list);
    *count = 0;
    for (size_t i = 0; list != NULL && i < all; i++) {
        if (is_mended(grid, mend, i)) {
            const size_t y = i / width * step + step / 2, x = i % width * step + step / 2;
            list[(*count)++] = glint_pixel_number(settings->width, (int)x, (int)y);
        }
    }
    *rows = (int)((*count + GLINT_LIST_COLUMNS - 1) / GLINT_LIST_COLUMNS);
    for (size_t i = *count; list != NULL && i < (size_t)*rows * GLINT_LIST_COLUMNS; i++) {
        list[i] = list[0];
    }
    return list;
}

glint_status glint_error_grid_count_mended(glint_error_grid *grid, const glint_settings *settings,
                                           double mend, double *rays, glint_error *error)
{
    glint_settings listed = *settings;
    size_t count;
    uint32_t *list = list_mended(grid, settings, mend, &count, &listed.list_rows);
    *rays = 0;
    if (list == NULL) {
        return glint_fail_memory(error, "the grid's jumps");
    }
    listed.list = list;
    glint_image image = {0};
    glint_status status = GLINT_OK;
    if (count > 0) {
        status = render(grid, &listed, grid->camera, &image, error);
    }
    if (count > 0 && status == GLINT_OK) {
        const double padded = (double)listed.list_rows * GLINT_LIST_COLUMNS;
        const double of_list = (double)glint_ray_counts_all(&grid->report.rays);
        *rays = NEIGHBOURS * of_list * (double)count / padded;
    }
    glint_image_free(&image);
    free(list);
    return status;
}

// ---- Chaos -------------------------------------------------------------------------------------

// The next pixel from `pixel` on whose light beyond the depth of `cut` matters. Returns the number
// of pixels if there is none.
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
    *share = 0;
    glint_status status;
    TRY_OR(cleanup, status, render(grid, &shallow, grid->camera, &cut, error));
    size_t i = next_that_matters(grid, image, &cut, 0);
    if (i < count) {
        TRY_OR(cleanup, status,
               render_sides(grid, chaos->settings, (double[]){SHIFT, 0}, sides, error));
    }
    for (; i < count; i = next_that_matters(grid, image, &cut, i + 1)) {
        double bend[3];
        find_bend(image, sides, i, bend);
        const double most = fmax(bend[0], fmax(bend[1], bend[2]));
        const double bent = fmin(1, most / chaos->contrast);
        *share += (bent < SMOOTH ? bent * bent : bent) / (double)count;
    }
cleanup:
    glint_image_free(&cut);
    glint_image_free(&sides[0]);
    glint_image_free(&sides[1]);
    return status;
}

void glint_error_grid_free(glint_error_grid *grid)
{
    glint_image_free(&grid->reference);
    glint_image_free(&grid->image);
    free(grid->jumps);
    *grid = (glint_error_grid){0};
}
