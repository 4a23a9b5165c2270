// Runs glint's side of a contest: its renderers and their frames of one scene.
#ifndef GLINT_BENCH_STAGE_H
#define GLINT_BENCH_STAGE_H

#include "glint.h"
#include "scenes.h"

// A scene and the settings of its frames. All pointers are borrowed.
typedef struct bench_stage {
    bench_scene *scene; // its material is set by job
    const glint_environment *environment;
    glint_device *device;
    int width, height; // pixels
    int rounds;
} bench_stage;

// glint's settings for the job. `depth` limits the surfaces of a path of BENCH_GLASS; the other
// jobs ignore it.
glint_settings bench_stage_settings(const bench_stage *stage, bench_job job, int depth);

// Gives the scene the job's material and makes a renderer.
glint_status bench_stage_renderer(const bench_stage *stage, bench_job job,
                                  const glint_settings *settings, glint_renderer **renderer,
                                  glint_error *error);

// Renders a frame; *ms is its time on the device. *image is zero or an earlier frame, whose memory
// the function uses again. The caller frees it.
glint_status bench_stage_frame(const bench_stage *stage, glint_renderer *renderer, double *ms,
                               glint_image *image, glint_error *error);

#endif
