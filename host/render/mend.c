// Mends frames in single precision. See mend.h.
#include "render/mend.h"

#include "render/pixel_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TILE 16 // the pixels of a tile are consecutive in the list
#define BLOCK 4

static double mean_of(const glint_image *image)
{
    double sum = 0, count = 0;
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) {
        const float *p = image->pixels + 4 * i;
        const double light = ((double)p[0] + (double)p[1] + (double)p[2]) / 3;
        if (isfinite(light)) {
            sum += light;
            count++;
        }
    }
    return count > 0 ? sum / count : 0;
}

// Three times the mean squared difference; infinite or NaN if a pixel is not finite.
static float square_difference(const float *a, const float *b)
{
    const float r = a[0] - b[0], g = a[1] - b[1], blue = a[2] - b[2];
    return r * r + g * g + blue * blue;
}

// Marks both pixels of every pair of neighbours that differ by more than `limit`. Compares each
// pixel with its right and lower neighbour. Returns the number of marked pixels.
static size_t mark(const glint_image *image, double limit, uint8_t *marks)
{
    const ptrdiff_t width = image->width;
    const float square = (float)(3 * limit * limit);
    size_t count = 0;
    for (ptrdiff_t y = 0; y < image->height; y++) {
        for (ptrdiff_t x = 0; x < width; x++) {
            const ptrdiff_t i = y * width + x;
            const bool is_there[] = {x + 1 < width, y + 1 < image->height};
            const ptrdiff_t steps[] = {1, width};
            const float *pixel = image->pixels + 4 * i;
            for (int k = 0; k < 2; k++) {
                if (is_there[k] && !(square_difference(pixel, pixel + 4 * steps[k]) <= square)) {
                    marks[i] = marks[i + steps[k]] = 1;
                }
            }
            count += marks[i]; // no later pixel marks this one
        }
    }
    return count;
}

// Lists the marked pixels of a tile, block by block.
static void list_tile(const glint_image *image, const uint8_t *marks, int left, int top,
                      glint_pixel_list *list)
{
    const int width = image->width;
    for (int k = 0; k < TILE * TILE; k++) {
        const int block = k / (BLOCK * BLOCK), i = k % (BLOCK * BLOCK);
        const int x = left + block % (TILE / BLOCK) * BLOCK + i % BLOCK;
        const int y = top + block / (TILE / BLOCK) * BLOCK + i / BLOCK;
        if (x < width && y < image->height && marks[glint_pixel_number(width, x, y)] != 0) {
            glint_pixel_list_add(list, glint_pixel_number(width, x, y));
        }
    }
}

static void list_marked(const glint_image *image, const uint8_t *marks, glint_pixel_list *list)
{
    for (int top = 0; top < image->height; top += TILE) {
        for (int left = 0; left < image->width; left += TILE) {
            list_tile(image, marks, left, top, list);
        }
    }
    glint_pixel_list_fill(list);
}

static glint_status find_pixels(const glint_image *image, double mend, glint_pixel_list *list,
                                glint_error *error)
{
    const uint64_t pixels = (uint64_t)image->width * (uint64_t)image->height;
    if (pixels > GLINT_PIXEL_NUMBERS) {
        return glint_fail(error, GLINT_USAGE, "--mend: %dx%d is too large", image->width,
                          image->height);
    }
    uint8_t *marks = calloc(pixels, 1);
    if (marks == NULL) {
        return glint_fail_memory(error, "the pixels to be mended");
    }
    const size_t count = mark(image, mend * fabs(mean_of(image)), marks);
    const glint_status status = glint_pixel_list_create(count, list, error);
    if (status == GLINT_OK) {
        list_marked(image, marks, list);
    }
    free(marks);
    return status;
}

// Asks whether to continue. The first pass has already reported the progress.
static bool ask(void *context, uint64_t done, uint64_t total)
{
    (void)done, (void)total;
    const glint_progress *progress = context;
    return progress->step(progress->context, 1, 1);
}

static void put(const glint_image *mended, const glint_pixel_list *list, glint_image *image)
{
    for (size_t k = 0; k < list->count; k++) {
        const size_t place = glint_pixel_list_place(k), pixel = list->numbers[place];
        memcpy(image->pixels + 4 * pixel, mended->pixels + 4 * place, 4 * sizeof *image->pixels);
    }
}

// Renders the listed pixels into *mended.
static glint_status render_listed(const glint_frame_request *request, const glint_pixel_list *list,
                                  glint_image *mended, glint_frame_report *report,
                                  glint_error *error)
{
    glint_settings listed = request->renderer->settings;
    listed.precision = GLINT_PRECISION_DOUBLE;
    listed.mend = 0;
    listed.list = list->numbers;
    listed.list_rows = list->rows;
    listed.aovs = 0;
    listed.terms = 0;
    const glint_progress quiet = {ask, (void *)request->progress};
    const glint_frame_request again = {request->renderer, request->camera,
                                       request->progress != NULL ? &quiet : NULL, mended, report};
    TRY(glint_renderer_set_settings(request->renderer, &listed, error));
    return glint_pass_run(&again, error);
}

static glint_status render_again(const glint_frame_request *request, const glint_pixel_list *list,
                                 glint_error *error)
{
    const glint_settings whole = request->renderer->settings;
    glint_image mended = {0};
    glint_frame_report again = {0};
    const glint_status status = render_listed(request, list, &mended, &again, error);
    if (status == GLINT_OK) {
        put(&mended, list, request->image);
        glint_ray_counts_add(&request->report->rays, &again.rays);
        request->report->kernel_ms += again.kernel_ms;
        request->report->readback_ms += again.readback_ms;
    }
    glint_image_free(&mended);
    // Restore the settings even after a failure, because the caller frees the list.
    const glint_status back =
        glint_renderer_set_settings(request->renderer, &whole, status == GLINT_OK ? error : NULL);
    return status == GLINT_OK ? back : status;
}

glint_status glint_mend(const glint_frame_request *request, glint_error *error)
{
    glint_pixel_list list = {0};
    glint_status status =
        find_pixels(request->image, request->renderer->settings.mend, &list, error);
    if (status == GLINT_OK && list.count > 0) {
        status = render_again(request, &list, error);
    }
    request->report->mended_pixels = list.count;
    glint_pixel_list_free(&list);
    return status;
}
