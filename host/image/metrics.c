// Measures the difference between a picture and its reference. See metrics.h.
#include "image/metrics.h"

#include "base/memory.h"
#include "base/statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t pixel_count(const glint_image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

// R, G, B and alpha of a pixel of any image. Grey is repeated; a missing alpha is 1.
typedef struct rgba {
    float rgb[3], alpha;
} rgba;

static rgba pixel_of(const glint_image *image, size_t pixel)
{
    const int channels = image->channels;
    const float *from = image->pixels + pixel * (size_t)channels;
    const bool is_grey = channels < 3;
    return (rgba){.rgb = {from[0], from[is_grey ? 0 : 1], from[is_grey ? 0 : 2]},
                  .alpha = glint_image_has_alpha(image) ? from[channels - 1] : 1.0F};
}

static bool is_finite(const rgba *pixel)
{
    return isfinite(pixel->rgb[0]) && isfinite(pixel->rgb[1]) && isfinite(pixel->rgb[2]);
}

double glint_metrics_mean(const glint_image *image, const glint_image *reference)
{
    double sum = 0;
    size_t finite = 0;
    for (size_t i = 0; i < pixel_count(reference); i++) {
        rgba of_image = pixel_of(image, i), of_reference = pixel_of(reference, i);
        if (is_finite(&of_image) && is_finite(&of_reference)) {
            sum += (double)of_reference.rgb[0] + (double)of_reference.rgb[1] +
                   (double)of_reference.rgb[2];
            finite++;
        }
    }
    return finite > 0 ? sum / (3 * (double)finite) : 0;
}

static glint_pixel_error error_between(const rgba *image, const rgba *reference, double mean)
{
    glint_pixel_error error = {.is_finite = is_finite(image) && is_finite(reference)};
    for (int k = 0; error.is_finite && k < 3; k++) {
        double difference = (double)image->rgb[k] - (double)reference->rgb[k];
        double scale = fmax(fabs((double)reference->rgb[k]), fabs(mean));
        error.difference[k] = difference;
        // Equal values have no error, even if the scale is 0.
        error.relative[k] = difference != 0 ? difference / scale : 0;
        error.absolute_most = fmax(error.absolute_most, fabs(difference));
        error.relative_most = fmax(error.relative_most, fabs(error.relative[k]));
    }
    return error;
}

glint_pixel_error glint_metrics_pixel(const glint_image *image, const glint_image *reference,
                                      size_t pixel, double mean)
{
    rgba of_image = pixel_of(image, pixel), of_reference = pixel_of(reference, pixel);
    return error_between(&of_image, &of_reference, mean);
}

static glint_status check_shapes(const glint_image *image, const glint_image *reference,
                                 glint_error *error)
{
    if (image->width == reference->width && image->height == reference->height) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_USAGE, "pictures of %dx%d and %dx%d pixels cannot be compared",
                      image->width, image->height, reference->width, reference->height);
}

static glint_defects defects_of(const rgba *pixel)
{
    const float values[] = {pixel->rgb[0], pixel->rgb[1], pixel->rgb[2], pixel->alpha};
    glint_defects defects = {0};
    for (int k = 0; k < 4; k++) {
        defects.nan |= isnan(values[k]) != 0;
        defects.infinite |= isinf(values[k]) != 0;
    }
    return defects;
}

static void count_defects(const rgba *image, const rgba *reference, glint_metrics *metrics)
{
    glint_defects a = defects_of(image), b = defects_of(reference);
    metrics->in_image.nan += a.nan;
    metrics->in_image.infinite += a.infinite;
    metrics->in_reference.nan += b.nan;
    metrics->in_reference.infinite += b.infinite;
    metrics->in_either.nan += a.nan | b.nan;
    metrics->in_either.infinite += a.infinite | b.infinite;
}

// Sums over the compared pixels.
typedef struct tally {
    double squares, magnitudes; // over R, G and B
    double *differences;        // largest difference of each pixel, [compared]
} tally;

static void set_worst(const rgba *image, const rgba *reference, size_t pixel, int width,
                      glint_metrics *metrics)
{
    metrics->worst_x = (int)(pixel % (size_t)width);
    metrics->worst_y = (int)(pixel / (size_t)width);
    memcpy(metrics->worst_image, image->rgb, sizeof image->rgb);
    memcpy(metrics->worst_reference, reference->rgb, sizeof reference->rgb);
}

static void add_pixel(const glint_pixel_error *e, tally *sums, glint_metrics *metrics)
{
    double squares = 0, magnitudes = 0;
    for (int k = 0; k < 3; k++) {
        squares += e->difference[k] * e->difference[k];
        magnitudes += fabs(e->difference[k]);
    }
    sums->squares += squares;
    sums->magnitudes += magnitudes;
    sums->differences[metrics->compared++] = e->absolute_most;
    metrics->differing += e->relative_most > GLINT_METRICS_VISIBLE;
    metrics->largest = fmax(metrics->largest, e->absolute_most);
}

static void add_alpha(float image, float reference, glint_metrics *metrics)
{
    if (isfinite(image) && isfinite(reference)) {
        metrics->alpha = fmax(metrics->alpha, fabs((double)image - (double)reference));
    }
}

static void finish(const tally *sums, glint_metrics *metrics)
{
    if (metrics->compared == 0) {
        return;
    }
    const double values = 3 * (double)metrics->compared;
    glint_sort(sums->differences, metrics->compared);
    metrics->rmse = sqrt(sums->squares / values);
    metrics->relative_rmse = metrics->rmse == 0 ? 0 : metrics->rmse / fabs(metrics->mean);
    metrics->mae = sums->magnitudes / values;
    metrics->psnr = 20 * log10(GLINT_METRICS_PEAK / metrics->rmse);
    metrics->p99 = glint_quantile(sums->differences, metrics->compared, 0.99);
}

glint_status glint_metrics_find(const glint_image *image, const glint_image *reference,
                                const bool *left_out, glint_metrics *metrics, glint_error *error)
{
    *metrics = (glint_metrics){0};
    glint_status status = check_shapes(image, reference, error);
    if (status != GLINT_OK) {
        return status;
    }
    const size_t pixels = pixel_count(reference);
    tally sums = {.differences = glint_allocate(pixels, sizeof *sums.differences)};
    if (sums.differences == NULL) {
        return glint_fail_memory(error, "comparing pictures");
    }
    metrics->mean = glint_metrics_mean(image, reference);
    for (size_t i = 0; i < pixels; i++) {
        rgba of_image = pixel_of(image, i), of_reference = pixel_of(reference, i);
        count_defects(&of_image, &of_reference, metrics);
        glint_pixel_error e = error_between(&of_image, &of_reference, metrics->mean);
        if (!e.is_finite) {
            metrics->nonfinite++;
        } else if (left_out == NULL || !left_out[i]) {
            if (metrics->compared == 0 || e.absolute_most > metrics->largest) {
                set_worst(&of_image, &of_reference, i, reference->width, metrics);
            }
            add_pixel(&e, &sums, metrics);
            add_alpha(of_image.alpha, of_reference.alpha, metrics);
        }
    }
    finish(&sums, metrics);
    free(sums.differences);
    return GLINT_OK;
}

uint64_t glint_metrics_mark(const glint_image *image, const glint_image *reference,
                            double tolerance, bool *marks)
{
    double mean = glint_metrics_mean(image, reference);
    uint64_t count = 0;
    for (size_t i = 0; i < pixel_count(reference); i++) {
        glint_pixel_error e = glint_metrics_pixel(image, reference, i, mean);
        marks[i] = !e.is_finite || e.relative_most > tolerance;
        count += marks[i];
    }
    return count;
}
