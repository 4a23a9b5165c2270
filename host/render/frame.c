// Renders one frame. See frame.h.
#include "render/frame.h"

#include "base/memory.h"
#include "render/mend.h"
#include "render/pass.h"
#include "render/renderer.h"

#include <stdlib.h>

static void put_behind(const double backdrop[4], glint_image *image)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) {
        float *pixel = image->pixels + 4 * i;
        const double nothing = 1 - (double)pixel[3]; // the share of the pixel that shows nothing
        for (int c = 0; c < 4; c++) {
            pixel[c] = (float)((double)pixel[c] + nothing * backdrop[c]);
        }
    }
}

static glint_status render(const glint_frame_request *request, glint_error *error)
{
    glint_renderer *r = request->renderer;
    if (r->state != GLINT_RENDERER_IS_READY) {
        return glint_fail(error, GLINT_USAGE, "the renderer was made without frames, or failed");
    }
    TRY(glint_pass_run(request, error));
    const bool is_whole = r->settings.list == NULL && r->settings.grid_step == 0;
    if (r->settings.mend > 0 && is_whole) {
        TRY(glint_mend(request, error));
    }
    if (r->settings.backdrop[3] > 0) {
        put_behind(r->settings.backdrop, request->image);
    }
    request->report->nonfinite_pixels = glint_image_count_nonfinite(request->image);
    r->phases.kernel = request->report->kernel_ms;
    r->phases.readback = request->report->readback_ms;
    return GLINT_OK;
}

glint_status glint_renderer_frame(const glint_frame_request *request, glint_error *error)
{
    glint_frame_report unused = {0};
    glint_frame_request full = *request;
    if (full.report == NULL) {
        full.report = &unused;
    }
    *full.report = (glint_frame_report){0};
    const glint_status status = render(&full, error);
    if (status != GLINT_OK) {
        glint_image_free(request->image);
    }
    return status;
}

glint_status glint_renderer_exact_pixels(glint_renderer *renderer, double **pixels,
                                         glint_error *error)
{
    *pixels = NULL;
    if (renderer->plan.precision != GLINT_PRECISION_DOUBLE) {
        return glint_fail(error, GLINT_USAGE, "only frames in double precision have exact pixels");
    }
    const glint_pixels *of_frame = &renderer->target.pixels;
    const size_t count = (size_t)of_frame->width * (size_t)of_frame->height;
    double *exact = glint_allocate_unset(count * 4, sizeof *exact);
    if (exact == NULL) {
        return glint_fail_memory(error, "the frame");
    }
    const glint_status status = glint_pixels_exact(of_frame, exact, error);
    if (status != GLINT_OK) {
        free(exact);
        return status;
    }
    *pixels = exact;
    return GLINT_OK;
}

glint_status glint_renderer_layers(glint_renderer *renderer, glint_layers *layers,
                                   glint_error *error)
{
    const glint_settings *settings = &renderer->settings;
    *layers = (glint_layers){0};
    if (settings->aovs == 0 && settings->terms == 0) {
        return glint_fail(error, GLINT_USAGE, "no layers were asked for");
    }
    return glint_target_layers(&renderer->target, settings, &renderer->scene.owners, layers, error);
}
