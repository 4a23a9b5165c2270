// Lets glint and Embree render the same frame in turns. See contest.h.
#include "embree/contest.h"

#include <math.h>
#include <string.h>

// The sweep drops a mode that is this much slower than the fastest mode of its first round.
#define HOPELESS 2.0

// ---- Embree's modes ----------------------------------------------------------------------------

static void add_entry(bench_contest *contest, embree_mode mode)
{
    contest->entries[contest->entry_count++] = (bench_entry){.mode = mode, .sweep_ms = INFINITY};
}

// Adds a mode for each kind of shading of the job, EMBREE_PLAIN first.
static void add_shadings(bench_contest *contest, embree_mode mode)
{
    bool shaded = contest->job == BENCH_REFLECT || contest->job == BENCH_REFRACT;
    add_entry(contest, mode);
    if (shaded) {
        mode.shading = EMBREE_STAGED;
        add_entry(contest, mode);
    }
}

// Adds the modes with the same query for all rays.
static void add_simple_modes(bench_contest *contest, embree_quality quality)
{
    int calls = contest->job == BENCH_GLASS ? 1 : EMBREE_CALLS;
    for (int i = 0; i < 2 * calls; i++) {
        embree_query query = {(embree_call)(i / 2), i % 2 == 1};
        embree_mode mode = {.primary = query, .secondary = query, .quality = quality};
        add_shadings(contest, mode);
        if (query.call != EMBREE_INTERSECT_1) {
            mode.rows = true;
            add_shadings(contest, mode);
        }
    }
}

// Adds modes with a different query inside glass, where rays are less coherent than primary rays.
static void add_mixed_modes(bench_contest *contest, embree_quality quality)
{
    const embree_query stream = {EMBREE_STREAM_16_16, true}, packet = {EMBREE_INTERSECT_16, true};
    const embree_query loose_stream = {EMBREE_STREAM_16_16, false};
    const embree_query loose_packet = {EMBREE_INTERSECT_16, false};
    const embree_query loose_half = {EMBREE_INTERSECT_8, false};
    const embree_query loose_ray = {EMBREE_INTERSECT_1, false};
    const embree_query pairs[][2] = {{stream, packet},       {packet, stream},
                                     {stream, loose_stream}, {stream, loose_packet},
                                     {stream, loose_half},   {stream, loose_ray}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        add_shadings(contest, (embree_mode){
                                  .primary = pairs[i][0],
                                  .secondary = pairs[i][1],
                                  .quality = quality,
                              });
    }
}

static void list_modes(bench_contest *contest, bool high)
{
    for (int quality = EMBREE_MEDIUM; quality <= (high ? EMBREE_HIGH : EMBREE_MEDIUM); quality++) {
        add_simple_modes(contest, (embree_quality)quality);
        if (contest->job == BENCH_REFRACT) {
            add_mixed_modes(contest, (embree_quality)quality);
        }
    }
}

static void try_mode(const bench_arena *arena, bench_contest *contest, bench_entry *entry)
{
    double ms = embree_program_frame(arena->program, contest->job, BENCH_GLASS_DEPTH, &entry->mode);
    entry->sweep_ms = fmin(entry->sweep_ms, ms);
}

// Times all modes. The first round tries plain shading only. Each staged mode follows its plain
// twin in the list, and is dropped with it.
static void sweep(const bench_arena *arena, bench_contest *contest)
{
    double best = INFINITY;
    for (int i = 0; i < contest->entry_count; i++) {
        if (contest->entries[i].mode.shading == EMBREE_PLAIN) {
            try_mode(arena, contest, &contest->entries[i]);
            best = fmin(best, contest->entries[i].sweep_ms);
        }
    }
    for (int round = 1; round < arena->sweep_rounds; round++) {
        for (int i = 0; i < contest->entry_count; i++) {
            bench_entry *entry = &contest->entries[i];
            bool staged = entry->mode.shading == EMBREE_STAGED;
            if (contest->entries[staged ? i - 1 : i].sweep_ms <= HOPELESS * best) {
                try_mode(arena, contest, entry);
            }
        }
    }
}

// Lists the fastest modes of the sweep with this shading.
static void make_short_list(bench_contest *contest, embree_shading shading)
{
    for (int place = 0; place < BENCH_SHORT_LIST; place++) {
        bench_entry *best = NULL;
        for (int i = 0; i < contest->entry_count; i++) {
            bench_entry *entry = &contest->entries[i];
            bool candidate = entry->mode.shading == shading && !entry->listed;
            if (candidate && isfinite(entry->sweep_ms) &&
                (best == NULL || entry->sweep_ms < best->sweep_ms)) {
                best = entry;
            }
        }
        if (best != NULL) {
            best->listed = true;
        }
    }
}

const bench_entry *bench_contest_best(const bench_contest *contest, embree_shading shading)
{
    const bench_entry *best = NULL;
    double least = INFINITY;
    bool shaded = contest->job == BENCH_REFLECT || contest->job == BENCH_REFRACT;
    for (int i = 0; i < contest->entry_count; i++) {
        const bench_entry *entry = &contest->entries[i];
        if (!entry->listed || (shaded && entry->mode.shading != shading)) {
            continue;
        }
        double median = bench_summarize(&entry->series).median;
        if (median < least) {
            least = median;
            best = entry;
        }
    }
    return best;
}

bench_summary bench_contest_ratio(const bench_contest *contest, const bench_entry *entry)
{
    return bench_summarize_ratio(&entry->series, &contest->glint);
}

// ---- Rounds ------------------------------------------------------------------------------------

static glint_status create_renderer(const bench_arena *arena, bench_job job, int depth,
                                    glint_renderer **renderer, glint_error *error)
{
    const glint_settings settings = bench_stage_settings(&arena->stage, job, depth);
    return bench_stage_renderer(&arena->stage, job, &settings, renderer, error);
}

// Compares glint's frame with the frame of each listed mode. Returns the worst agreement.
static bench_agreement compare_frames(const bench_arena *arena, const bench_contest *contest,
                                      int depth, const glint_image *image)
{
    bench_agreement worst = {0};
    for (int i = 0; i < contest->entry_count; i++) {
        const bench_entry *entry = &contest->entries[i];
        if (!entry->listed) {
            continue;
        }
        embree_program_frame(arena->program, contest->job, depth, &entry->mode);
        bench_agreement found =
            contest->job == BENCH_TRAVERSE
                ? bench_compare_hits(arena->stage.scene, image, embree_program_hits(arena->program))
                : bench_compare_colors(image, embree_program_pixels(arena->program));
        worst = bench_agreement_worse(worst, found);
    }
    return worst;
}

// Compares the frames of a new renderer and of Embree.
static glint_status find_agreement(const bench_arena *arena, const bench_contest *contest,
                                   int depth, bench_agreement *found, glint_error *error)
{
    glint_renderer *renderer = NULL;
    glint_image image = {0};
    glint_status status;
    TRY_OR(cleanup, status, create_renderer(arena, contest->job, depth, &renderer, error));
    double ms; // of the first frame; unused
    TRY_OR(cleanup, status, bench_stage_frame(&arena->stage, renderer, &ms, &image, error));
    *found = compare_frames(arena, contest, depth, &image);
cleanup:
    glint_image_free(&image);
    glint_renderer_free(renderer);
    return status;
}

static glint_status check_agreement(const bench_arena *arena, bench_contest *contest,
                                    glint_error *error)
{
    TRY(find_agreement(arena, contest, BENCH_GLASS_DEPTH, &contest->agreement, error));
    contest->judged = contest->agreement;
    if (contest->job == BENCH_GLASS) {
        TRY(find_agreement(arena, contest, BENCH_JUDGED_DEPTH, &contest->judged, error));
    }
    return bench_check_agreement(&contest->judged, arena->stage.scene->name,
                                 bench_job_name(contest->job), error);
}

static glint_status run_round(const bench_arena *arena, glint_renderer *renderer,
                              glint_image *image, bench_contest *contest, glint_error *error)
{
    double ms;
    glint_status status = bench_stage_frame(&arena->stage, renderer, &ms, image, error);
    if (status != GLINT_OK) {
        return status;
    }
    bench_series_add(&contest->glint, ms);
    for (int i = 0; i < contest->entry_count; i++) {
        bench_entry *entry = &contest->entries[i];
        if (entry->listed) {
            bench_series_add(&entry->series, embree_program_frame(arena->program, contest->job,
                                                                  BENCH_GLASS_DEPTH, &entry->mode));
        }
    }
    return GLINT_OK;
}

glint_status bench_contest_run(const bench_arena *arena, bench_job job, bench_contest *contest,
                               glint_error *error)
{
    memset(contest, 0, sizeof *contest);
    contest->job = job;
    glint_renderer *renderer = NULL;
    glint_image image = {0};
    list_modes(contest, arena->high);
    sweep(arena, contest);
    make_short_list(contest, EMBREE_PLAIN);
    make_short_list(contest, EMBREE_STAGED);
    glint_status status;
    TRY_OR(cleanup, status, check_agreement(arena, contest, error));
    TRY_OR(cleanup, status, create_renderer(arena, job, BENCH_GLASS_DEPTH, &renderer, error));
    double warming_up; // Embree's modes warmed up in the sweep
    TRY_OR(cleanup, status, bench_stage_frame(&arena->stage, renderer, &warming_up, &image, error));
    for (int round = 0; round < arena->stage.rounds; round++) {
        TRY_OR(cleanup, status, run_round(arena, renderer, &image, contest, error));
    }
cleanup:
    glint_image_free(&image);
    glint_renderer_free(renderer);
    return status;
}

// ---- Trees -------------------------------------------------------------------------------------

glint_status bench_build_run(const bench_arena *arena, int rounds, bench_build *build,
                             glint_error *error)
{
    memset(build, 0, sizeof *build);
    build->embree_tree_bytes = embree_program_bytes(arena->program, EMBREE_MEDIUM);
    build->embree_shading_bytes = embree_program_shading_bytes(arena->program);
    for (int round = 0; round < rounds; round++) {
        glint_renderer *renderer = NULL;
        glint_status status = create_renderer(arena, BENCH_REFLECT, 1, &renderer, error);
        if (status != GLINT_OK) {
            return status;
        }
        bench_series_add(&build->glint, glint_renderer_phases(renderer)->bvh);
        build->glint_bytes = glint_renderer_bvh(renderer)->bytes;
        glint_renderer_free(renderer);
        bench_series_add(&build->embree, embree_program_build(arena->program, EMBREE_MEDIUM));
    }
    return GLINT_OK;
}

bench_summary bench_build_ratio(const bench_build *build)
{
    return bench_summarize_ratio(&build->embree, &build->glint);
}
