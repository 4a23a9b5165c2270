// How far a picture is from the one that it should be. See metrics.h.
#include "report/metrics.h"

#include "base/memory.h"
#include "report/statistics.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

// R, G and B of one pixel of both pictures.
typedef struct pixel_pair {
    const float *image, *reference;
} pixel_pair;

static pixel_pair pair_at(const glint_image *image, const glint_image *reference, size_t pixel)
{
    return (pixel_pair){image->pixels + pixel * (size_t)image->channels,
                        reference->pixels + pixel * (size_t)reference->channels};
}

static bool is_finite(pixel_pair pair)
{
    bool finite = true;
    for (int k = 0; k < 3; k++) {
        finite = finite && isfinite(pair.image[k]) && isfinite(pair.reference[k]);
    }
    return finite;
}

static size_t pixel_count(const glint_image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

static double mean_of(const glint_image *image, const glint_image *reference)
{
    double sum = 0;
    size_t finite = 0;
    for (size_t i = 0; i < pixel_count(reference); i++) {
        pixel_pair pair = pair_at(image, reference, i);
        if (is_finite(pair)) {
            sum +=
                (double)pair.reference[0] + (double)pair.reference[1] + (double)pair.reference[2];
            finite++;
        }
    }
    return finite > 0 ? sum / (3 * (double)finite) : 0;
}

// The largest of the pixel's differences, as they are and over their scale: the component of the
// reference, or the mean where that is larger.
typedef struct pixel_error {
    double absolute, relative, squares; // squares: the sum of their squares
} pixel_error;

static pixel_error error_of(pixel_pair pair, double mean)
{
    pixel_error error = {0};
    for (int k = 0; k < 3; k++) {
        double reference = (double)pair.reference[k];
        double difference = fabs((double)pair.image[k] - reference);
        double scale = fmax(fabs(reference), fabs(mean));
        error.squares += difference * difference;
        error.absolute = fmax(error.absolute, difference);
        error.relative = fmax(error.relative, difference > 0 ? difference / scale : 0);
    }
    return error;
}

static glint_status check_shapes(const glint_image *image, const glint_image *reference,
                                 glint_error *error)
{
    if (image->width == reference->width && image->height == reference->height &&
        image->channels >= 3 && reference->channels >= 3) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_USAGE,
                      "pictures of %dx%d and %dx%d pixels with %d and %d channels cannot be "
                      "compared",
                      image->width, image->height, reference->width, reference->height,
                      image->channels, reference->channels);
}

static void finish(double *differences, double squares, glint_metrics *metrics)
{
    if (metrics->compared == 0) {
        return;
    }
    glint_sort(differences, metrics->compared);
    metrics->rmse = sqrt(squares / (3 * (double)metrics->compared));
    metrics->relative_rmse = metrics->rmse == 0 ? 0 : metrics->rmse / fabs(metrics->mean);
    metrics->p99 = glint_quantile(differences, metrics->compared, 0.99);
    metrics->largest = differences[metrics->compared - 1];
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
    double *differences = glint_allocate(pixels, sizeof *differences);
    if (differences == NULL) {
        return glint_fail_memory(error, "comparing pictures");
    }
    double squares = 0;
    metrics->mean = mean_of(image, reference);
    for (size_t i = 0; i < pixels; i++) {
        pixel_pair pair = pair_at(image, reference, i);
        if (!is_finite(pair)) {
            metrics->nonfinite++;
        } else if (left_out == NULL || !left_out[i]) {
            pixel_error e = error_of(pair, metrics->mean);
            squares += e.squares;
            differences[metrics->compared++] = e.absolute;
            metrics->differing += e.relative > GLINT_METRICS_VISIBLE;
        }
    }
    finish(differences, squares, metrics);
    free(differences);
    return GLINT_OK;
}

uint64_t glint_metrics_mark(const glint_image *image, const glint_image *reference,
                            double tolerance, bool *marks)
{
    double mean = mean_of(image, reference);
    uint64_t count = 0;
    for (size_t i = 0; i < pixel_count(reference); i++) {
        pixel_pair pair = pair_at(image, reference, i);
        marks[i] = !is_finite(pair) || error_of(pair, mean).relative > tolerance;
        count += marks[i];
    }
    return count;
}
