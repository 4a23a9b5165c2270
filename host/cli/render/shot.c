// Brings together what a frame shows. See shot.h.
#include "cli/render/shot.h"

#include "base/clock.h"
#include "cli/render/plate.h"
#include "image/image_io.h"

glint_status render_shot_load(render_shot *shot, const render_request *request,
                              glint_progress_display *display, glint_error *error)
{
    shot->request = request;
    shot->display = display;
    glint_image_write_ahead(request->output); // while the scene loads
    TRY(render_stage_load(&shot->stage, request, display, error));
    return render_light_load(&shot->light, &shot->stage, display, error);
}

glint_status render_shot_set(render_shot *shot, int frame, double *ms, glint_error *error)
{
    *ms = 0;
    TRY(render_stage_set(&shot->stage, frame, error));
    double clock = glint_now_ms();
    TRY(render_light_set(&shot->light, &shot->stage, frame, shot->display, error));
    *ms = shot->stage.loading_ms + glint_lap_ms(&clock);
    return render_plate_fingerprint(shot->request, frame, &shot->plate_is, error);
}

void render_shot_fingerprint(const render_shot *shot, const glint_camera *camera,
                             char text[GLINT_FINGERPRINT_TEXT])
{
    const glint_fingerprint parts[] = {shot->shared, shot->stage.is, shot->light.is,
                                       shot->plate_is};
    glint_fingerprint_frame(parts, sizeof parts / sizeof *parts, camera, text);
}

void render_shot_free(render_shot *shot)
{
    render_light_free(&shot->light);
    render_stage_free(&shot->stage);
    *shot = (render_shot){0};
}
