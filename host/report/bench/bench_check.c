// Checks the measured picture against a reference in double precision. See bench.h.
//
// The reference is the same picture in double precision with float texels. It always uses the
// built-in kernels, even if other kernels are measured.
//
// Some pixels are ill-conditioned. Each bounce between curved surfaces multiplies an error by ten
// or more. After about six bounces no digit of a float is left. Such a pixel differs from the
// reference in any single-precision renderer.
//
// To find these pixels, the reference is rendered a second time with the eye moved by SHIFT of the
// scene. SHIFT is sixteen times the rounding error of a stored coordinate. A pixel that changes by
// STABLE or more is ill-conditioned, and only the others are judged. STABLE is a tenth of a visible
// difference, for sixteen times the rounding error: this leaves a float enough room.
//
// Some ill-conditioned pixels do not change by chance, and are judged. Measured in scenes of glass
// (320 × 180 to 1280 × 720): if 3 to 24% of the pixels were ill-conditioned, 0.3 to 2.6% of these
// were judged. So HIDDEN times the number of ill-conditioned pixels may differ visibly among the
// judged pixels. Rays within rounding of an edge add a share of FLIPPED of all pixels (measured: up
// to 2e-5). The allowed relative RMSE of the judged pixels follows: all these pixels may be wrong
// by the mean.
#include "report/bench/bench.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define SHIFT 0x1p-20 // of the scene's unit
#define STABLE (GLINT_METRICS_VISIBLE / 10)
#define HIDDEN 0.05
#define FLIPPED 5e-4
#define LEAST_JUDGED 0.1 // minimum share of judged pixels; fewer say nothing about the picture

static void decide(glint_bench_check *check)
{
    const glint_metrics *judged = &check->judged;
    double differing = (double)judged->differing / (double)judged->compared;
    double most_rmse = sqrt(check->most_differing);
    check->outcome = GLINT_CHECK_FAILED;
    // These forms also fail NaN.
    if (check->error.nonfinite > 0) {
        snprintf(check->reason, sizeof check->reason, "%llu pixels are not finite",
                 (unsigned long long)check->error.nonfinite);
    } else if (!(check->ill_conditioned <= 1 - LEAST_JUDGED)) {
        snprintf(check->reason, sizeof check->reason,
                 "%.3g%% of the pixels are ill-conditioned, which leaves too few to judge (see "
                 "--no-check)",
                 100 * check->ill_conditioned);
    } else if (!(differing <= check->most_differing)) {
        snprintf(check->reason, sizeof check->reason,
                 "%.3g%% of the well-conditioned pixels differ from double precision by over %g%%, "
                 "and %.2g%% may",
                 100 * differing, 100 * GLINT_METRICS_VISIBLE, 100 * check->most_differing);
    } else if (!(judged->relative_rmse <= most_rmse)) {
        snprintf(
            check->reason, sizeof check->reason,
            "relative RMSE %.3g of the well-conditioned pixels against double precision, where "
            "%.2g is allowed",
            judged->relative_rmse, most_rmse);
    } else {
        check->outcome = GLINT_CHECK_PASSED;
    }
}

// Moves the eye sideways and up. Any direction will do that is not along one of the two axes.
static glint_camera moved(const glint_camera *camera, double unit)
{
    double shift = SHIFT * (unit > 0 ? unit : 1);
    glint_camera result = *camera;
    result.eye = glint_vec3_add(result.eye, glint_vec3_scale(camera->right, 0.8 * shift));
    result.eye = glint_vec3_add(result.eye, glint_vec3_scale(camera->up, 0.6 * shift));
    return result;
}

// Renders the reference, and again from the moved eye.
static glint_status render_references(const glint_bench_judge *judge, glint_image references[2],
                                      glint_error *error)
{
    const glint_bench_inputs *inputs = judge->inputs;
    glint_settings settings = *inputs->settings;
    settings.precision = GLINT_PRECISION_DOUBLE;
    settings.texels = GLINT_TEXELS_FLOAT;
    settings.kernel_width = 0;
    settings.tile_packets = 0;
    // "auto" may rely on proofs; the reference relies on none
    settings.depth = settings.depth == 0 ? GLINT_DEPTH_MAX : settings.depth;
    const glint_renderer_inputs exact = {
        .device = judge->device,
        .scene = inputs->scene,
        .environment = inputs->environment,
        .settings = &settings,
    };
    const glint_camera cameras[2] = {*inputs->camera, moved(inputs->camera, inputs->scene->unit)};
    glint_renderer *renderer;
    glint_status status;
    TRY_OR(cleanup, status, glint_renderer_create(&exact, &renderer, error));
    for (int i = 0; i < 2; i++) {
        TRY_OR(cleanup, status,
               glint_renderer_frame(&(glint_frame_request){renderer, &cameras[i], judge->progress,
                                                           &references[i], NULL},
                                    error));
    }
cleanup:
    glint_renderer_free(renderer);
    return status;
}

static glint_status compare(const glint_image *image, const glint_image references[2],
                            glint_bench_check *check, glint_error *error)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    bool *ill_conditioned = glint_allocate(pixels, sizeof *ill_conditioned);
    if (ill_conditioned == NULL) {
        return glint_fail_memory(error, "comparing pictures");
    }
    check->has_reference = true;
    uint64_t marked = glint_metrics_mark(&references[1], &references[0], STABLE, ill_conditioned);
    check->ill_conditioned = (double)marked / (double)pixels;
    check->most_differing = FLIPPED + HIDDEN * check->ill_conditioned;
    glint_status status;
    TRY_OR(cleanup, status, glint_metrics_find(image, &references[0], NULL, &check->error, error));
    TRY_OR(cleanup, status,
           glint_metrics_find(image, &references[0], ill_conditioned, &check->judged, error));
cleanup:
    free(ill_conditioned);
    return status;
}

glint_status glint_bench_check_picture(const glint_bench_judge *judge, const glint_image *image,
                                       glint_bench_check *check, glint_error *error)
{
    glint_image references[2] = {{0}, {0}};
    glint_error cause = {0};
    glint_status status = render_references(judge, references, &cause);
    if (status != GLINT_OK) {
        glint_fail(error, status, "the reference in double precision: %s (--no-check does without)",
                   cause.message);
        goto cleanup;
    }
    TRY_OR(cleanup, status, compare(image, references, check, error));
    decide(check);
cleanup:
    glint_error_free(&cause);
    glint_image_free(&references[0]);
    glint_image_free(&references[1]);
    return status;
}
