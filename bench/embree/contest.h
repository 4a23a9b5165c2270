// A contest: glint and Embree render the same frame of one scene in turns.
#ifndef GLINT_BENCH_EMBREE_CONTEST_H
#define GLINT_BENCH_EMBREE_CONTEST_H

#include "agreement.h"
#include "embree/pool.h"
#include "embree/reference.h"
#include "series.h"
#include "stage.h"

#include <stdbool.h>

#define BENCH_MODES_MAX 200
#define BENCH_SHORT_LIST 3 // modes of each kind of shading that run in every round

// One mode of Embree's.
typedef struct bench_entry {
    embree_mode mode;
    double sweep_ms; // the fastest of the sweep; INFINITY: not run
    bool listed;     // on the short list
    bench_series series;
} bench_entry;

typedef struct bench_contest {
    bench_job job;
    bench_series glint;
    int entry_count;
    bench_entry entries[BENCH_MODES_MAX];
    bench_agreement agreement; // the worst of the short list's
    bench_agreement judged;    // the same but for glass: of depth BENCH_JUDGED_DEPTH
} bench_contest;

// What both sides need.
typedef struct bench_arena {
    bench_stage stage;
    embree_program *program; // borrowed
    bench_pool *pool;        // likewise
    int sweep_rounds;
    bool high;   // Embree's trees of quality HIGH compete too
    bool robust; // Embree's scenes carry RTC_SCENE_FLAG_ROBUST
} bench_arena;

// Sweeps over Embree's modes, checks that the frames agree, and runs the rounds. GLINT_MISMATCH
// where they do not agree; other errors are glint's.
glint_status bench_contest_run(const bench_arena *arena, bench_job job, bench_contest *contest,
                               glint_error *error);

// The listed mode with the least median; of traverse and glass, which have one kind of shading,
// the same for both.
const bench_entry *bench_contest_best(const bench_contest *contest, embree_shading shading);

// Round by round: the mode's time by glint's.
bench_summary bench_contest_ratio(const bench_contest *contest, const bench_entry *entry);

// Building the trees, in turns.
typedef struct bench_build {
    bench_series glint, embree; // MEDIUM's commit
    size_t glint_bytes;         // tree, triangles and normals on the device
    size_t embree_tree_bytes, embree_shading_bytes;
} bench_build;

glint_status bench_build_run(const bench_arena *arena, int rounds, bench_build *build,
                             glint_error *error);

// Embree's time by glint's.
bench_summary bench_build_ratio(const bench_build *build);

#endif
