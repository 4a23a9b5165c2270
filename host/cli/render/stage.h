// What a run's frames show: its scene and its camera at a frame's time, and the renderer made of
// them. For render_run alone.
#ifndef GLINT_CLI_RENDER_STAGE_H
#define GLINT_CLI_RENDER_STAGE_H

#include "cli/render/run.h"

// Moves the run's scene and camera to a frame. Errors: as glint_scene_at.
glint_status render_stage_set(render_run *run, int frame, glint_error *error);

// The camera of the frame that the scene stands at.
glint_camera render_stage_camera(const render_run *run, int frame);

// Of the frame that the scene stands at, as `camera` sees it.
void render_stage_fingerprint(const render_run *run, const glint_camera *camera,
                              char text[GLINT_FINGERPRINT_TEXT]);

// Gives the renderer the scene, unless it shows the same already. Errors: as
// glint_renderer_set_scene.
glint_status render_stage_show(render_run *run, glint_error *error);

// Begins on the scene of the frame after this one, if it is another; on its tree too, unless there
// is a file that may be found to be the frame. To be called once the renderer shows this one.
void render_stage_look_ahead(render_run *run);

#endif
