// glint's side of a contest: its renderers and their frames of one scene.
#ifndef GLINT_BENCH_STAGE_H
#define GLINT_BENCH_STAGE_H

#include "glint.h"
#include "scenes.h"

// All borrowed.
typedef struct bench_stage {
    bench_scene *scene; // its material is set by job
    const glint_environment *environment;
    glint_device *device;
    int width, height; // pixels
    int rounds;
} bench_stage;

// What the job asks of glint. `depth` is the number of surfaces that a path of GLASS meets; the
// other jobs have theirs.
glint_settings bench_stage_settings(const bench_stage *stage, bench_job job, int depth);

// Gives the scene the job's material and makes a renderer.
glint_status bench_stage_renderer(const bench_stage *stage, bench_job job,
                                  const glint_settings *settings, glint_renderer **renderer,
                                  glint_error *error);

// A frame; *ms is what it took on the device. *image is zero or an earlier frame, whose memory is
// used again, and the caller's to free.
glint_status bench_stage_frame(const bench_stage *stage, glint_renderer *renderer, double *ms,
                               glint_image *image, glint_error *error);

#endif
