// Lets glint and llvmpipe draw the same mirror in turns. See contest.h.
#include "llvmpipe/contest.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

// The renderers of all contestants; owned.
typedef struct players {
    glint_renderer *glint, *one_ray;
    llvmpipe_program *llvmpipe;
} players;

static glint_status create_players(const bench_stage *stage, players *p, glint_error *error)
{
    glint_settings settings = bench_stage_settings(stage, BENCH_REFLECT, 1);
    TRY(bench_stage_renderer(stage, BENCH_REFLECT, &settings, &p->glint, error));
    settings.kernel_width = 1;
    TRY(bench_stage_renderer(stage, BENCH_REFLECT, &settings, &p->one_ray, error));
    const llvmpipe_inputs inputs = {
        .scene = stage->scene,
        .environment = &stage->environment->radiance,
        .width = stage->width,
        .height = stage->height,
    };
    return llvmpipe_program_create(&inputs, &p->llvmpipe, error);
}

static void free_players(players *p)
{
    glint_renderer_free(p->glint);
    glint_renderer_free(p->one_ray);
    llvmpipe_program_free(p->llvmpipe);
}

// ---- Agreement ---------------------------------------------------------------------------------

static glint_status compare_one_ray(const bench_stage *stage, const players *p,
                                    const glint_image *image, bench_agreement *found,
                                    glint_error *error)
{
    glint_image other = {0};
    double ms;
    glint_status status;
    TRY_OR(cleanup, status, bench_stage_frame(stage, p->one_ray, &ms, &other, error));
    *found = bench_compare_colors(image, other.pixels);
    TRY_OR(cleanup, status,
           bench_check_agreement(found, stage->scene->name, "reflect, one ray a work-item", error));
cleanup:
    glint_image_free(&other);
    return status;
}

static glint_status compare_llvmpipe(const bench_stage *stage, const players *p,
                                     const glint_image *image, bench_agreement *worst,
                                     glint_error *error)
{
    float *pixels = glint_allocate(4 * (size_t)stage->width * (size_t)stage->height, sizeof(float));
    if (pixels == NULL) {
        return glint_fail_memory(error, "a frame");
    }
    glint_status status = GLINT_OK;
    for (int i = 0; i < LLVMPIPE_TEXELS; i++) {
        (void)llvmpipe_program_frame(p->llvmpipe, (llvmpipe_texels)i);
        TRY_OR(cleanup, status, llvmpipe_program_read(p->llvmpipe, pixels, error));
        *worst = bench_agreement_worse(*worst, bench_compare_colors(image, pixels));
    }
    status = bench_check_agreement(worst, stage->scene->name, "reflect, llvmpipe", error);
cleanup:
    free(pixels);
    return status;
}

// Draws the first frame of each contestant as a warm-up, and compares the frames.
static glint_status check_agreement(const bench_stage *stage, const players *p,
                                    llvmpipe_contest *contest, glint_error *error)
{
    glint_image image = {0};
    double ms;
    glint_status status;
    TRY_OR(cleanup, status, bench_stage_frame(stage, p->glint, &ms, &image, error));
    // Start from full agreement.
    contest->agreement.pixels = (uint64_t)stage->width * (uint64_t)stage->height;
    TRY_OR(cleanup, status, compare_one_ray(stage, p, &image, &contest->one_ray_agreement, error));
    TRY_OR(cleanup, status, compare_llvmpipe(stage, p, &image, &contest->agreement, error));
cleanup:
    glint_image_free(&image);
    return status;
}

// ---- Rounds ------------------------------------------------------------------------------------

static glint_status run_round(const bench_stage *stage, const players *p, glint_image *image,
                              llvmpipe_contest *contest, glint_error *error)
{
    double ms;
    for (int i = 0; i < LLVMPIPE_TEXELS; i++) {
        bench_series_add(&contest->llvmpipe[i],
                         llvmpipe_program_frame(p->llvmpipe, (llvmpipe_texels)i));
    }
    TRY(bench_stage_frame(stage, p->glint, &ms, image, error));
    bench_series_add(&contest->glint, ms);
    TRY(bench_stage_frame(stage, p->one_ray, &ms, image, error));
    bench_series_add(&contest->one_ray, ms);
    return GLINT_OK;
}

glint_status llvmpipe_contest_run(const bench_stage *stage, llvmpipe_contest *contest,
                                  glint_error *error)
{
    memset(contest, 0, sizeof *contest);
    players p = {0};
    glint_image image = {0};
    glint_status status;
    TRY_OR(cleanup, status, create_players(stage, &p, error));
    TRY_OR(cleanup, status, check_agreement(stage, &p, contest, error));
    for (int round = 0; round < stage->rounds; round++) {
        TRY_OR(cleanup, status, run_round(stage, &p, &image, contest, error));
    }
cleanup:
    glint_image_free(&image);
    free_players(&p);
    return status;
}

llvmpipe_texels llvmpipe_contest_best(const llvmpipe_contest *contest)
{
    llvmpipe_texels best = (llvmpipe_texels)0;
    for (int i = 1; i < LLVMPIPE_TEXELS; i++) {
        if (bench_summarize(&contest->llvmpipe[i]).median <
            bench_summarize(&contest->llvmpipe[best]).median) {
            best = (llvmpipe_texels)i;
        }
    }
    return best;
}
