// Renders frames whose error stays within a bound. See error_bound.h.
#include "bound/error_bound.h"

#include "base/clock.h"
#include "bound/error_search.h"
#include "bound/error_unseen.h"

#include <math.h>

// After this number of frames that exceeded the bound, glint renders the reference.
#define FRAMES_BEFORE_REFERENCE 3

void glint_error_bound_begin(glint_error_bound *bound, double max_error,
                             const glint_settings *settings)
{
    *bound = (glint_error_bound){.bound = max_error, .settings = *settings};
}

void glint_error_bound_set_environment(glint_error_bound *bound, const glint_cube *environment)
{
    double sum[3] = {0}, squares = 0, all = 0;
    const int edge = environment->edge;
    for (int i = 0; i < 6 * edge * edge; i++) {
        const int column = i % edge, row = i / edge % edge;
        const double x = (2.0 * column + 1) / edge - 1, y = (2.0 * row + 1) / edge - 1;
        const double distance = 1 + x * x + y * y;                  // squared
        const double solid_angle = 1 / (distance * sqrt(distance)); // up to a constant factor
        const float *texel = glint_cube_texel(environment, i / (edge * edge), column, row);
        if (!isfinite(texel[0]) || !isfinite(texel[1]) || !isfinite(texel[2])) {
            continue;
        }
        all += solid_angle;
        for (int c = 0; c < 3; c++) {
            sum[c] += solid_angle * (double)texel[c];
            squares += solid_angle * (double)texel[c] * (double)texel[c] / 3;
        }
    }
    const double means = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / (3 * all * all);
    bound->contrast = all > 0 ? sqrt(fmax(0, squares / all - means)) : 0;
}

// A frame in progress.
typedef struct judged_frame {
    const glint_frame_request *request;
    glint_error_search search;
    glint_error_trial trial; // the settings that render it
    double estimate;         // of the error
} judged_frame;

static glint_status render(judged_frame *f, glint_error *error)
{
    const glint_frame_request *in = f->request;
    glint_settings settings = f->trial.rung.settings;
    settings.truncation_squares = true;
    TRY(glint_renderer_set_settings(in->renderer, &settings, error));
    TRY(glint_renderer_frame(in, error));
    f->estimate = glint_error_search_estimate(&f->search, &f->trial, in->image, in->report);
    return GLINT_OK;
}

static glint_status choose(judged_frame *f, const glint_error_bound *bound, glint_error *error)
{
    const glint_plan *plan = glint_renderer_first_plan(f->request->renderer);
    TRY(glint_error_search_begin(&f->search, bound, plan, error));
    return glint_error_search_choose(&f->search, &f->trial, error);
}

static glint_status choose_and_render(judged_frame *f, const glint_error_bound *bound,
                                      glint_error_choice *choice, glint_error *error)
{
    double begun = glint_now_ms();
    TRY(choose(f, bound, error));
    for (choice->frames = 1;; choice->frames++) {
        choice->choosing_ms += glint_lap_ms(&begun);
        TRY(render(f, error));
        if (f->estimate <= bound->bound || f->trial.is_reference) {
            return GLINT_OK;
        }
        if (choice->frames == FRAMES_BEFORE_REFERENCE) {
            glint_error_search_give_up(&f->search, &f->trial);
        } else {
            TRY(glint_error_search_refine(&f->search, f->estimate, &f->trial, error));
        }
    }
}

glint_status glint_error_bound_frame(const glint_error_bound *bound,
                                     const glint_frame_request *request, glint_error_choice *choice,
                                     glint_error *error)
{
    const glint_settings *settings = &bound->settings;
    judged_frame f = {
        .request = request,
        .search.grid = {.renderer = request->renderer,
                        .camera = request->camera,
                        .progress = request->progress,
                        .step = glint_error_grid_step(settings->width, settings->height)},
    };
    *choice = (glint_error_choice){.bound = bound->bound};
    glint_status status = choose_and_render(&f, bound, choice, error);
    const glint_error_search *s = &f.search;
    choice->rung = f.trial.rung;
    choice->error = f.estimate;
    choice->grid_error = f.trial.grid.measured;
    choice->unseen_of_float = glint_error_with_unseen(s, &f.trial.rung, 0);
    choice->grid_is_frame = s->grid.step == 1;
    choice->grid_pixels = (int)glint_error_grid_pixel_count(&s->grid);
    choice->grids = s->grid.pictures;
    choice->choosing_rays = s->grid.rays;
    glint_error_search_end(&f.search);
    if (status != GLINT_OK) {
        glint_image_free(request->image);
    }
    return status;
}
