// Prints the summary of a run. See summary.h.
#include "cli/render/summary.h"

#include "cli/common/say.h"

#define TRUNCATION_WORTH_SAYING 5e-3 // share of the light's total weight

static const char *truncation_advice(const glint_truncation *truncation, glint_shading shading)
{
    if (truncation->by_stack > truncation->by_depth + truncation->by_min_weight) {
        return "a larger --min-weight leaves fewer branches waiting";
    }
    if (truncation->by_depth < truncation->by_min_weight) {
        return "a smaller --min-weight, say 1e-5, follows it further";
    }
    return shading == GLINT_SHADING_PIXEL ? "a greater --depth follows it further"
                                          : "--shading pixel follows it further";
}

void render_summary_warn(const render_run *run, glint_warnings *warnings)
{
    const glint_frame_report *report = &run->frames.totals.worst;
    const glint_truncation *truncation = &report->truncation;
    if (report->nonfinite_pixels > 0) {
        glint_warn(warnings, "%llu pixels are not finite",
                   (unsigned long long)report->nonfinite_pixels);
    }
    if (truncation->media_overflows > 0) {
        glint_warn(warnings, "solids nest too deep: %llu paths forgot one that they were in",
                   (unsigned long long)truncation->media_overflows);
    }
    // With --max-error the error is known and bounded: no warning is needed.
    if (run->request->max_error == 0 &&
        glint_truncation_total(truncation) > TRUNCATION_WORTH_SAYING) {
        glint_warn(warnings,
                   "%.3g%% of the light took the environment before its path had ended (%s)",
                   100 * glint_truncation_total(truncation),
                   truncation_advice(truncation, run->request->inputs.settings.shading));
    }
}

static void say_frame(const render_run *run)
{
    const glint_phases *phases = glint_renderer_phases(run->tracer.renderer);
    const glint_settings *settings = &run->request->inputs.settings;
    const glint_frame_report *frame = &run->frames.last;
    const double rate = 1e-3 * (double)frame->rays.primary / frame->kernel_ms;
    glint_say("%s: %dx%d, %.0f ms (load %.0f, tree %.0f, irradiance %.0f, cells %.0f, kernels "
              "%.0f, trace "
              "%.0f, encode %.0f), %.3g primary Mrays/s",
              run->request->output, settings->width, settings->height,
              glint_progress_elapsed(&run->display),
              run->shot.stage.inputs.scene_ms + run->shot.stage.inputs.environment_ms, phases->bvh,
              phases->irradiance, phases->cells, phases->kernel_build, frame->kernel_ms,
              run->frames.totals.write.sum, rate);
    if (run->request->max_error > 0) {
        const glint_error_choice *choice = &run->choice;
        glint_say("  error %.2g of %g allowed, by %s (chosen on %d of its pixels in %.0f ms)",
                  choice->error, choice->bound, choice->rung.options, choice->grid_pixels,
                  choice->choosing_ms);
    }
}

static void say_spread(const char *name, const render_spread *spread, uint64_t count)
{
    glint_say("  %-6s %10.1f %10.1f %10.1f ms", name, spread->sum / (double)count, spread->least,
              spread->most);
}

static void say_sequence(const render_run *run)
{
    const render_totals *totals = &run->frames.totals;
    const double ms = glint_progress_elapsed(&run->display);
    const double rendering_ms = ms - run->rendering_begun_ms;
    glint_say("%s: %llu frames: %llu rendered, %llu skipped, %zu failed, in %.1f s",
              run->request->output, (unsigned long long)run->frames.count,
              (unsigned long long)totals->rendered, (unsigned long long)totals->skipped,
              totals->failed, 1e-3 * ms);
    if (totals->rendered > 0) {
        const double seconds = 1e-3 * rendering_ms;
        glint_say("  %.3g frames/s, %.3g primary Mrays/s; a frame's milliseconds:",
                  (double)totals->rendered / seconds,
                  1e-6 * (double)totals->rays.primary / seconds);
        glint_say("  %-6s %10s %10s %10s", "", "mean", "least", "most");
        if (glint_motion_moves_scene(&run->shot.stage.inputs.motion) ||
            run->request->env_name.length > 0 || run->request->capture != NULL) {
            say_spread("build", &totals->build, totals->rendered);
        }
        if (run->request->max_error > 0) {
            say_spread("choose", &totals->choosing, totals->rendered);
        }
        say_spread("trace", &totals->trace, totals->rendered);
        say_spread("write", &totals->write, totals->rendered);
        if (run->request->max_error > 0) {
            glint_say("  errors of %.2g to %.2g, of %g allowed", totals->error.least,
                      totals->error.most, run->request->max_error);
        }
    }
}

void render_summary_say(const render_run *run)
{
    const render_totals *totals = &run->frames.totals;
    const glint_progress_display *display = &run->display;
    glint_progress_done(display, totals->rendered, totals->skipped, totals->failed);
    if (display->mode == GLINT_PROGRESS_NONE || display->mode == GLINT_PROGRESS_JSON) {
        return;
    }
    if (run->request->is_sequence) {
        say_sequence(run);
    } else if (totals->rendered > 0) {
        say_frame(run);
    } else {
        glint_say("%s: is there already, and made from this", run->request->output);
    }
}
