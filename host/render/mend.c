// Mending frames in single precision. See mend.h.
#include "render/mend.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Listed pixels lie in blocks, so that packets of any shape are of neighbours.
#define BLOCK 4
#define BLOCK_PIXELS (BLOCK * BLOCK)
#define TILE 16

// Of each pixel, whether more than `limit` of its light is in doubt or it is not finite.
static glint_status mark(const glint_renderer *r, const glint_image *image, uint8_t *marks,
                         glint_error *error)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    float *doubts = NULL;
    glint_status status = glint_renderer_read(r, "reading the doubts", r->doubts,
                                              pixels * sizeof *doubts, (void **)&doubts, error);
    const float limit = (float)r->settings.mend;
    for (size_t i = 0; status == GLINT_OK && i < pixels; i++) {
        const float *p = image->pixels + 4 * i;
        marks[i] = !(doubts[i] <= limit) || !isfinite(p[0] + p[1] + p[2]);
    }
    free(doubts);
    return status;
}

// Where the list's number `k` stands.
static size_t place_of(size_t k)
{
    const size_t block = k / BLOCK_PIXELS, blocks_across = GLINT_LIST_COLUMNS / BLOCK;
    const size_t column = block % blocks_across * BLOCK + k % BLOCK;
    const size_t row = block / blocks_across * BLOCK + k % BLOCK_PIXELS / BLOCK;
    return row * GLINT_LIST_COLUMNS + column;
}

typedef struct pixel_list {
    int32_t *pixels; // [rows][GLINT_LIST_COLUMNS]
    size_t count;    // of those that are wanted
    int rows;
} pixel_list;

static void list_tile(const glint_image *image, const uint8_t *marks, int left, int top,
                      pixel_list *list)
{
    for (int k = 0; k < TILE * TILE; k++) {
        const int block = k / BLOCK_PIXELS, i = k % BLOCK_PIXELS;
        const int x = left + block % (TILE / BLOCK) * BLOCK + i % BLOCK;
        const int y = top + block / (TILE / BLOCK) * BLOCK + i / BLOCK;
        const bool is_inside = x < image->width && y < image->height;
        if (is_inside && marks[(size_t)y * (size_t)image->width + (size_t)x]) {
            list->pixels[place_of(list->count++)] = y * image->width + x;
        }
    }
}

// Those that are marked, those of a tile after each other. What its last rows have left over names
// the first.
static glint_status list_marked(const glint_image *image, const uint8_t *marks, pixel_list *list,
                                glint_error *error)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        count += marks[i];
    }
    const size_t in_row = GLINT_LIST_COLUMNS * BLOCK;
    list->rows = (int)((count + in_row - 1) / in_row * BLOCK);
    list->pixels = glint_allocate((size_t)list->rows * GLINT_LIST_COLUMNS, sizeof *list->pixels);
    if (list->pixels == NULL) {
        return glint_fail_memory(error, "the pixels to be mended");
    }
    for (int top = 0; top < image->height; top += TILE) {
        for (int left = 0; left < image->width; left += TILE) {
            list_tile(image, marks, left, top, list);
        }
    }
    for (size_t k = count; k < (size_t)list->rows * GLINT_LIST_COLUMNS; k++) {
        list->pixels[place_of(k)] = list->pixels[0];
    }
    return GLINT_OK;
}

static glint_status find_pixels(const glint_renderer *r, const glint_image *image, pixel_list *list,
                                glint_error *error)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    *list = (pixel_list){0};
    uint8_t *marks = calloc(pixels, sizeof *marks);
    if (marks == NULL) {
        return glint_fail_memory(error, "the pixels to be mended");
    }
    glint_status status = mark(r, image, marks, error);
    if (status == GLINT_OK) {
        status = list_marked(image, marks, list, error);
    }
    free(marks);
    return status;
}

// Whether to go on: how far it is has been told.
static bool ask(void *context, uint64_t done, uint64_t total)
{
    (void)done, (void)total;
    const glint_progress *progress = context;
    return progress->step(progress->context, 1, 1);
}

static void put(const glint_image *mended, const pixel_list *list, glint_image *image)
{
    for (size_t k = 0; k < list->count; k++) {
        const size_t place = place_of(k), pixel = (size_t)list->pixels[place];
        memcpy(image->pixels + 4 * pixel, mended->pixels + 4 * place, 4 * sizeof *image->pixels);
    }
}

static glint_status render_again(glint_renderer *r, const glint_camera *camera,
                                 const glint_progress *progress, const pixel_list *list,
                                 glint_image *image, glint_frame_report *report, glint_error *error)
{
    const glint_settings whole = r->settings;
    glint_settings listed = whole;
    listed.precision = GLINT_PRECISION_DOUBLE;
    listed.mend = 0;
    listed.list = list->pixels;
    listed.list_rows = list->rows;
    listed.aovs = 0;
    listed.terms = 0;
    glint_image mended = {0};
    glint_frame_report again = {0};
    const glint_progress quiet = {ask, (void *)progress};
    glint_status status = glint_renderer_set_settings(r, &listed, error);
    if (status == GLINT_OK) {
        status = glint_renderer_frame(r, camera, progress != NULL ? &quiet : NULL, &mended, &again,
                                      error);
    }
    if (status == GLINT_OK) {
        put(&mended, list, image);
        glint_ray_counts_add(&report->rays, &again.rays);
        report->kernel_ms += again.kernel_ms;
        report->readback_ms += again.readback_ms;
    }
    glint_image_free(&mended);
    // Also where it failed: the list goes.
    const glint_status back =
        glint_renderer_set_settings(r, &whole, status == GLINT_OK ? error : NULL);
    return status == GLINT_OK ? back : status;
}

glint_status glint_mend(glint_renderer *renderer, const glint_camera *camera,
                        const glint_progress *progress, glint_image *image,
                        glint_frame_report *report, glint_error *error)
{
    pixel_list list;
    glint_status status = find_pixels(renderer, image, &list, error);
    if (status == GLINT_OK && list.count > 0) {
        status = render_again(renderer, camera, progress, &list, image, report, error);
    }
    report->mended_pixels = list.count;
    free(list.pixels);
    return status;
}
