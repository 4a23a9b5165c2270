// Mending frames in single precision. See mend.h.
#include "render/mend.h"

#include "render/pixel_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TILE 16 // pixels of a tile are listed after each other
#define BLOCK 4

// A frame whose pixels are marked. Pointers are borrowed.
typedef struct marked_frame {
    const glint_image *image;
    const float *doubts; // of each pixel, how much of its light is in doubt
    float limit;
} marked_frame;

// Whether more than `limit` of a pixel's light is in doubt, or it is not finite.
static bool is_marked(const marked_frame *f, size_t pixel)
{
    const float *p = f->image->pixels + 4 * pixel;
    return !(f->doubts[pixel] <= f->limit) || !isfinite(p[0] + p[1] + p[2]);
}

// Block by block.
static void list_tile(const marked_frame *f, int left, int top, glint_pixel_list *list)
{
    const int width = f->image->width;
    for (int k = 0; k < TILE * TILE; k++) {
        const int block = k / (BLOCK * BLOCK), i = k % (BLOCK * BLOCK);
        const int x = left + block % (TILE / BLOCK) * BLOCK + i % BLOCK;
        const int y = top + block / (TILE / BLOCK) * BLOCK + i / BLOCK;
        if (x < width && y < f->image->height && is_marked(f, glint_pixel_number(width, x, y))) {
            glint_pixel_list_add(list, glint_pixel_number(width, x, y));
        }
    }
}

static glint_status list_marked(const marked_frame *f, glint_pixel_list *list, glint_error *error)
{
    const glint_image *image = f->image;
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        count += is_marked(f, i);
    }
    TRY(glint_pixel_list_create(count, list, error));
    for (int top = 0; top < image->height; top += TILE) {
        for (int left = 0; left < image->width; left += TILE) {
            list_tile(f, left, top, list);
        }
    }
    glint_pixel_list_fill(list);
    return GLINT_OK;
}

static glint_status find_pixels(const glint_renderer *r, const glint_image *image,
                                glint_pixel_list *list, glint_error *error)
{
    if ((uint64_t)image->width * (uint64_t)image->height > GLINT_PIXEL_NUMBERS) {
        return glint_fail(error, GLINT_USAGE, "--mend: %dx%d is too large", image->width,
                          image->height);
    }
    float *doubts;
    TRY(glint_target_doubts(&r->target, &r->settings, &doubts, error));
    const marked_frame f = {image, doubts, (float)r->settings.mend};
    const glint_status status = list_marked(&f, list, error);
    free(doubts);
    return status;
}

// Whether to go on: how far it is has been told.
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

// The listed pixels, into *mended.
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
    // Also where it failed: the list goes.
    const glint_status back =
        glint_renderer_set_settings(request->renderer, &whole, status == GLINT_OK ? error : NULL);
    return status == GLINT_OK ? back : status;
}

glint_status glint_mend(const glint_frame_request *request, glint_error *error)
{
    glint_pixel_list list = {0};
    glint_status status = find_pixels(request->renderer, request->image, &list, error);
    if (status == GLINT_OK && list.count > 0) {
        status = render_again(request, &list, error);
    }
    request->report->mended_pixels = list.count;
    glint_pixel_list_free(&list);
    return status;
}
