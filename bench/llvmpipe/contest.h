// Lets glint, glint in its simplest form, and llvmpipe draw the same mirror in turns.
#ifndef GLINT_BENCH_LLVMPIPE_CONTEST_H
#define GLINT_BENCH_LLVMPIPE_CONTEST_H

#include "agreement.h"
#include "llvmpipe/program.h"
#include "series.h"
#include "stage.h"

typedef struct llvmpipe_contest {
    bench_series glint;                     // with the plan's choice of kernel
    bench_series one_ray;                   // one ray for each work-item
    bench_series llvmpipe[LLVMPIPE_TEXELS]; // by kind of texels
    bench_agreement one_ray_agreement;      // compared with glint's own frame
    bench_agreement agreement;              // llvmpipe's worst over all kinds of texels
} llvmpipe_contest;

// Checks that the frames agree, and runs the rounds. Errors: GLINT_MISMATCH if the frames differ;
// otherwise glint's and OpenGL's.
glint_status llvmpipe_contest_run(const bench_stage *stage, llvmpipe_contest *contest,
                                  glint_error *error);

// The kind of texels with the least median.
llvmpipe_texels llvmpipe_contest_best(const llvmpipe_contest *contest);

#endif
