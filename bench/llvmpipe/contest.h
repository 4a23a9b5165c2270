// A contest: glint and llvmpipe draw the same mirror in turns, and glint once more in its simplest
// form.
#ifndef GLINT_BENCH_LLVMPIPE_CONTEST_H
#define GLINT_BENCH_LLVMPIPE_CONTEST_H

#include "agreement.h"
#include "llvmpipe/program.h"
#include "series.h"
#include "stage.h"

typedef struct llvmpipe_contest {
    bench_series glint;                     // as its plan chooses
    bench_series one_ray;                   // one ray a work-item
    bench_series llvmpipe[LLVMPIPE_TEXELS]; // with each kind of texels
    bench_agreement one_ray_agreement;      // with glint's own frame
    bench_agreement agreement;              // llvmpipe's; the worst of all kinds of texels
} llvmpipe_contest;

// Checks that the frames agree, and runs the rounds. GLINT_MISMATCH where they do not agree; other
// errors are glint's and OpenGL's.
glint_status llvmpipe_contest_run(const bench_stage *stage, llvmpipe_contest *contest,
                                  glint_error *error);

// The texels with the least median.
llvmpipe_texels llvmpipe_contest_best(const llvmpipe_contest *contest);

#endif
