// glint render: a scene and an environment become frames.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"

#include "cli/render/request.h"
#include "cli/render/run.h"

#include <stdio.h>

#define TRUNCATION_WORTH_SAYING 5e-3 // share of all weight

// ---- Statistics --------------------------------------------------------------------------------

// What is known before the first frame, and of a single one after it.
static glint_stats stats_of(const render_run *run, const glint_subject *subject)
{
    return (glint_stats){
        .subject = subject,
        .output = run->request->output,
        .phases = glint_renderer_phases(run->renderer),
        .frame = &run->last,
        .load_scene_ms = run->inputs.scene_ms,
        .load_environment_ms = run->inputs.environment_ms,
        .encode_ms = run->totals.write.sum,
        .total_ms = glint_progress_elapsed(&run->display),
        .exposure = run->request->exposure,
        .plate = run->request->plate,
        .choice = run->request->max_error > 0 && run->totals.rendered > 0 ? &run->choice : NULL,
    };
}

static glint_status open_stats(render_run *run, glint_error *error)
{
    const char *path = run->request->stats;
    if (path == NULL || !run->request->is_sequence) {
        return GLINT_OK;
    }
    const glint_subject subject = render_run_subject(run);
    const glint_stats stats = stats_of(run, &subject);
    return glint_stats_log_open(path, &stats, run->frames, &run->stats, error);
}

static glint_status finish_stats(render_run *run, glint_error *error)
{
    const render_totals *totals = &run->totals;
    if (run->stats == NULL || run->stats_failed) {
        return GLINT_OK;
    }
    const glint_stats_total total = {
        .frames = run->frames,
        .rendered = totals->rendered,
        .skipped = totals->skipped,
        .failed = totals->failed,
        .rays = totals->rays,
        .build_ms = totals->build.sum,
        .trace_ms = totals->trace.sum,
        .write_ms = totals->write.sum,
        .total_ms = glint_progress_elapsed(&run->display),
        .stopped = totals->rendered + totals->skipped + totals->failed < run->frames,
    };
    return glint_stats_log_total(run->stats, &total, error);
}

static glint_status write_stats(const render_run *run, glint_error *error)
{
    if (run->request->stats == NULL || run->request->is_sequence || run->totals.rendered == 0) {
        return GLINT_OK;
    }
    const glint_subject subject = render_run_subject(run);
    const glint_stats stats = stats_of(run, &subject);
    return glint_stats_write(run->request->stats, &stats, error);
}

// ---- What is said ------------------------------------------------------------------------------

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

// What the frame's figures give cause to say.
static void warn_of_report(const render_run *run, glint_warnings *warnings)
{
    const glint_frame_report *report = &run->totals.worst;
    const glint_truncation *truncation = &report->truncation;
    if (report->nonfinite_pixels > 0) {
        glint_warn(warnings, "%llu pixels are not finite",
                   (unsigned long long)report->nonfinite_pixels);
    }
    if (truncation->media_overflows > 0) {
        glint_warn(warnings, "solids nest too deep: %llu paths forgot one that they were in",
                   (unsigned long long)truncation->media_overflows);
    }
    // Where an error is kept that has been weighed.
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
    const glint_phases *phases = glint_renderer_phases(run->renderer);
    const glint_settings *settings = &run->request->inputs.settings;
    const double rate = (double)glint_ray_counts_all(&run->last.rays) / run->last.kernel_ms * 1e-3;
    glint_say("%s: %dx%d, %.0f ms (load %.0f, tree %.0f, kernels %.0f, trace %.0f, encode %.0f), "
              "%.3g Mrays/s",
              run->request->output, settings->width, settings->height,
              glint_progress_elapsed(&run->display),
              run->inputs.scene_ms + run->inputs.environment_ms, phases->bvh, phases->kernel_build,
              run->last.kernel_ms, run->totals.write.sum, rate);
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
    const render_totals *totals = &run->totals;
    const double ms = glint_progress_elapsed(&run->display);
    const double rendering_ms = ms - run->rendering_begun_ms;
    glint_say("%s: %llu frames: %llu rendered, %llu skipped, %zu failed, in %.1f s",
              run->request->output, (unsigned long long)run->frames,
              (unsigned long long)totals->rendered, (unsigned long long)totals->skipped,
              totals->failed, 1e-3 * ms);
    if (totals->rendered > 0) {
        const double seconds = 1e-3 * rendering_ms;
        glint_say("  %.3g frames/s, %.3g Mrays/s; a frame's milliseconds:",
                  (double)totals->rendered / seconds,
                  1e-6 * (double)glint_ray_counts_all(&totals->rays) / seconds);
        glint_say("  %-6s %10s %10s %10s", "", "mean", "least", "most");
        if (run->inputs.motion.moves_triangles || run->request->env_name.length > 0 ||
            run->request->capture != NULL) {
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

static void say_summary(const render_run *run)
{
    const render_totals *totals = &run->totals;
    const glint_progress_display *display = &run->display;
    if (display->mode == GLINT_PROGRESS_NONE) {
        return;
    }
    if (display->mode == GLINT_PROGRESS_JSON && run->request->is_sequence) {
        fprintf(stderr,
                "{\"event\": \"done\", \"ms\": %.1f, \"rendered\": %llu, \"skipped\": %llu, "
                "\"failed\": %zu}\n",
                glint_progress_elapsed(display), (unsigned long long)totals->rendered,
                (unsigned long long)totals->skipped, totals->failed);
    } else if (display->mode == GLINT_PROGRESS_JSON) {
        fprintf(stderr, "{\"event\": \"done\", \"ms\": %.1f}\n", glint_progress_elapsed(display));
    } else if (run->request->is_sequence) {
        say_sequence(run);
    } else if (totals->rendered > 0) {
        say_frame(run);
    } else {
        glint_say("%s: is there already, and made from this", run->request->output);
    }
}

// ---- The command -------------------------------------------------------------------------------

static glint_status prepare(render_run *run, render_request *request, glint_error *error)
{
    glint_warnings *warnings = &run->inputs.warnings;
    glint_status status = render_run_load(run, error);
    glint_progress_clear(&run->display);
    if (status != GLINT_OK) {
        return status;
    }
    // Those of loading first: they say why nothing moves, where nothing does.
    glint_say_warnings(warnings, 0);
    const size_t said = warnings->count;
    status = render_request_settle(request, &run->inputs.motion, warnings, error);
    if (status != GLINT_OK) {
        return status;
    }
    run->frames = glint_shard_size(request->shard, request->frames.count);
    render_request_warn(request, &run->inputs.scene, warnings);
    glint_say_warnings(warnings, said);
    run->warnings_said = warnings->count;
    if (run->frames == 0) {
        glint_say("--shard: none of the %llu frames is in part %u of %u",
                  (unsigned long long)request->frames.count, request->shard.index,
                  request->shard.count);
        return GLINT_OK;
    }
    status = render_run_prepare(run, error);
    glint_progress_clear(&run->display);
    return status == GLINT_OK ? open_stats(run, error) : status;
}

// A frame failing does not take the statistics of the others away, nor does a stop.
static glint_status render(render_run *run, glint_error *error)
{
    run->rendering_begun_ms = glint_progress_elapsed(&run->display);
    glint_status status = render_run_frames(run, error);
    glint_error later = {0};
    glint_status written = finish_stats(run, &later);
    if (status != GLINT_OK) {
        if (run->request->is_sequence) {
            say_summary(run);
        }
        glint_error_free(&later);
        return status;
    }
    warn_of_report(run, &run->inputs.warnings);
    glint_say_warnings(&run->inputs.warnings, run->warnings_said);
    if (written == GLINT_OK) {
        written = write_stats(run, &later);
    }
    if (written != GLINT_OK) {
        *error = later;
        return written;
    }
    say_summary(run);
    return render_run_verdict(run, error);
}

static void set_defaults(void *context)
{
    render_request *request = context;
    glint_input_request_default(&request->inputs);
    request->shard = (glint_shard){1, 1};
    request->fps = 24;
}

static glint_status run_request(render_request *request, glint_error *error)
{
    render_run run = {.request = request};
    glint_progress_begin(&run.display, (glint_progress_mode)request->progress);
    glint_status status = prepare(&run, request, error);
    if (status == GLINT_OK && run.frames > 0) {
        status = render(&run, error);
    }
    glint_progress_clear(&run.display);
    render_run_free(&run);
    return status;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    render_request *request = context;
    request->inputs.scene = arguments->positionals[0];
    glint_status status = render_request_finish(request, error);
    if (status == GLINT_OK) {
        status = run_request(request, error);
    }
    render_request_free(request);
    return status;
}

const glint_command glint_command_render = {
    .name = "render",
    .summary = "render frames of a glTF scene",
    .synopsis = "SCENE -o OUT [options]",
    .description = "Renders the glTF scene (.gltf or .glb) as one frame or as a sequence. Metal "
                   "reflects, glass reflects and refracts, paint is lit by the environment; what "
                   "the scene does not need is not compiled. stdout stays empty.",
    .examples = "  glint render scenes/gallery.gltf -o gallery.png\n"
                "  glint render car.glb --env studio.hdr --env-rotate 90 --samples 16 -o car.exr\n"
                "  glint render jewel.glb --depth 8 --background transparent -o jewel.exr\n"
                "  glint render jewel.glb --turntable 240 -o turn/jewel.####.exr\n"
                "  glint render walk.glb --animation walk --fps 25 -o walk/walk.####.exr\n",
    .groups = render_option_groups,
    .positional = "SCENE",
    .request_size = sizeof(render_request),
    .set_defaults = set_defaults,
    .run = run,
};
