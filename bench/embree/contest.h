// Lets glint and Embree render the same frame of one scene in turns, and times both.
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

// A mode of Embree and its times.
typedef struct bench_entry {
    embree_mode mode;
    double sweep_ms; // the fastest frame of the sweep; INFINITY: not run
    bool listed;     // on the short list
    bench_series series;
} bench_entry;

typedef struct bench_contest {
    bench_job job;
    bench_series glint;
    int entry_count;
    bench_entry entries[BENCH_MODES_MAX];
    bench_agreement agreement; // the worst on the short list
    bench_agreement judged;    // the same; for glass at depth BENCH_JUDGED_DEPTH
} bench_contest;

// Resources and settings for both programs.
typedef struct bench_arena {
    bench_stage stage;
    embree_program *program; // borrowed
    bench_pool *pool;        // borrowed
    int sweep_rounds;
    bool high;   // also run Embree's trees of quality HIGH
    bool robust; // Embree's scenes carry RTC_SCENE_FLAG_ROBUST
} bench_arena;

// Sweeps over Embree's modes, checks that the frames agree, and runs the rounds. Errors:
// GLINT_MISMATCH if the frames differ; otherwise glint's.
glint_status bench_contest_run(const bench_arena *arena, bench_job job, bench_contest *contest,
                               glint_error *error);

// Returns the listed mode with the least median. BENCH_TRAVERSE and BENCH_GLASS have one kind of
// shading, so `shading` does not matter there.
const bench_entry *bench_contest_best(const bench_contest *contest, embree_shading shading);

// The mode's time over glint's, round by round.
bench_summary bench_contest_ratio(const bench_contest *contest, const bench_entry *entry);

// Times of building the trees, in turns.
typedef struct bench_build {
    bench_series glint, embree; // embree: the commit of the MEDIUM tree
    size_t glint_bytes;         // tree, triangles and normals on the device
    size_t embree_tree_bytes, embree_shading_bytes;
} bench_build;

glint_status bench_build_run(const bench_arena *arena, int rounds, bench_build *build,
                             glint_error *error);

// Embree's time over glint's.
bench_summary bench_build_ratio(const bench_build *build);

#endif
