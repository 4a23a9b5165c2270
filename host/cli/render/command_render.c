// Implements glint render: it renders a scene in an environment to frames.
#include "cli/commands.h"
#include "cli/common/json_output.h"
#include "cli/common/options.h"
#include "cli/common/output_folder.h"
#include "cli/common/say.h"
#include "cli/render/each_camera.h"
#include "cli/render/run.h"
#include "cli/render/summary.h"
#include "device/device.h"
#include "scene/shape/digits.h"

#include <stdio.h>
#include <unistd.h>

// ---- Statistics --------------------------------------------------------------------------------

// Collects the statistics: of the run before the first frame, or of a single frame after it.
static glint_stats stats_of(const render_run *run, const glint_subject *subject)
{
    const glint_inputs *inputs = &run->shot.stage.inputs;
    const render_frames *frames = &run->frames;
    return (glint_stats){
        .subject = subject,
        .output = run->request->output,
        .phases = glint_renderer_phases(run->tracer.renderer),
        .frame = &frames->last,
        .frames = frames->count,
        .load_scene_ms = inputs->scene_ms,
        .load_environment_ms = inputs->environment_ms,
        .encode_ms = frames->totals.write.sum,
        .total_ms = glint_progress_elapsed(&run->display),
        .exposure = run->request->exposure,
        .tone = render_write_options(run->request).tone,
        .plate = run->request->plate,
        .choice = run->request->max_error > 0 && frames->totals.rendered > 0 ? &run->choice : NULL,
    };
}

static glint_status open_stats(render_run *run, glint_error *error)
{
    const char *path = run->request->stats;
    if (path == NULL || !run->request->is_sequence) {
        return GLINT_OK;
    }
    const glint_subject subject = render_tracer_subject(&run->tracer, &run->shot);
    const glint_stats stats = stats_of(run, &subject);
    FILE *file;
    TRY(glint_open_lines(path, &file, error));
    return glint_stats_log_open(file, path, &stats, &run->frames.log, error);
}

static glint_status finish_stats(render_run *run, glint_error *error)
{
    const render_frames *frames = &run->frames;
    const render_totals *totals = &frames->totals;
    if (frames->log == NULL) {
        return GLINT_OK;
    }
    const glint_stats_total total = {
        .frames = frames->count,
        .rendered = totals->rendered,
        .skipped = totals->skipped,
        .failed = totals->failed,
        .rays = totals->rays,
        .build_ms = totals->build.sum,
        .trace_ms = totals->trace.sum,
        .write_ms = totals->write.sum,
        .total_ms = glint_progress_elapsed(&run->display),
        .stopped = totals->rendered + totals->skipped + totals->failed < frames->count,
    };
    return glint_stats_log_total(frames->log, &total, error);
}

static glint_status write_stats(const render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    if (request->stats == NULL || request->is_sequence || run->frames.totals.rendered == 0) {
        return GLINT_OK;
    }
    const glint_subject subject = render_tracer_subject(&run->tracer, &run->shot);
    const glint_stats stats = stats_of(run, &subject);
    return glint_write_json(request->stats, glint_stats_json(&stats), error);
}

// ---- The command -------------------------------------------------------------------------------

static glint_status check_strict(const render_request *request, const glint_warnings *warnings,
                                 glint_error *error)
{
    const size_t count = warnings->count + warnings->lost;
    return !request->strict || count == 0
               ? GLINT_OK
               : glint_fail(error, GLINT_BAD_INPUT,
                            "%s: %zu warning%s, and --strict wants none (mend what they name, or "
                            "leave --strict out)",
                            request->inputs.scene, count, count == 1 ? "" : "s");
}

// Loads the scene and decides which frames to render.
static glint_status load(render_run *run, render_request *request, glint_error *error)
{
    glint_warnings *warnings = &run->shot.stage.inputs.warnings;
    glint_status status = render_shot_load(&run->shot, request, &run->display, error);
    glint_progress_clear(&run->display);
    TRY(status);
    // Print the warnings of loading first: they say why nothing moves.
    glint_say_warnings(warnings, 0);
    const size_t said = warnings->count;
    TRY(render_request_settle(request, &run->shot.stage.inputs.motion, warnings, error));
    render_frames_begin(&run->frames, request, &run->display);
    render_request_warn(request, &run->shot.stage.inputs.scene, warnings);
    glint_say_warnings(warnings, said);
    return check_strict(request, warnings, error);
}

// Renders the frames and writes the statistics, even if a frame fails or the user stops the run.
static glint_status render(render_run *run, glint_error *error)
{
    glint_warnings *warnings = &run->shot.stage.inputs.warnings;
    const size_t said = warnings->count;
    run->rendering_begun_ms = glint_progress_elapsed(&run->display);
    glint_status status = render_run_frames(run, error);
    glint_error later = {0};
    glint_status written = finish_stats(run, &later);
    if (status != GLINT_OK) {
        if (run->request->is_sequence) {
            render_summary_say(run);
        }
        glint_error_free(&later);
        return status;
    }
    render_summary_warn(run, warnings);
    glint_say_warnings(warnings, said);
    if (written == GLINT_OK) {
        written = write_stats(run, &later);
    }
    if (written != GLINT_OK) {
        *error = later;
        return written;
    }
    render_summary_say(run);
    return render_frames_verdict(&run->frames, error);
}

static glint_status prepare_and_render(render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    if (run->frames.count == 0) {
        glint_say("--shard: none of the %llu frames is in part %u of %u",
                  (unsigned long long)request->frames.count, request->shard.index,
                  request->shard.count);
        return GLINT_OK;
    }
    glint_status status = render_run_prepare(run, error);
    glint_progress_clear(&run->display);
    TRY(status);
    glint_warnings *warnings = &run->shot.stage.inputs.warnings;
    const size_t said = warnings->count;
    glint_solids_warn(&run->shot.stage.inputs.scene,
                      &glint_renderer_plan(run->tracer.renderer)->remarks, warnings);
    glint_coarse_places_warn(&run->shot.stage.inputs.scene,
                             &run->shot.stage.inputs.viewpoint.camera,
                             request->inputs.settings.height, warnings);
    glint_say_warnings(warnings, said);
    TRY(check_strict(request, warnings, error));
    bool is_new = false;
    if (request->is_sequence) {
        TRY(glint_folder_make(request->folder, &is_new, error));
    }
    status = open_stats(run, error);
    if (status == GLINT_OK) {
        status = render(run, error);
    }
    if (is_new) {
        rmdir(request->folder); // removes it only if it stayed empty
    }
    return status;
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
    glint_status status = GLINT_OK;
    glint_progress_begin(&run.display, (glint_progress_mode)request->progress);
    if (request->progress_fd > 0) {
        TRY(glint_progress_send_to(&run.display, request->progress_fd, error));
    }
    glint_device_start_drivers(); // while the scene loads
    TRY_OR(cleanup, status, load(&run, request, error));
    status = prepare_and_render(&run, error);

cleanup:
    glint_device_await_drivers();
    glint_progress_end(&run.display);
    render_run_free(&run);
    return status;
}

static glint_status render_one(render_request *request, glint_error *error)
{
    glint_status status = render_request_finish(request, error);
    if (status == GLINT_OK) {
        status = run_request(request, error);
    }
    render_request_free(request);
    return status;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    render_request *request = context;
    request->inputs.scene = arguments->positionals[0];
    return render_each_camera_is_asked(request) ? render_each_camera(request, render_one, error)
                                                : render_one(request, error);
}

const glint_command glint_command_render = {
    .name = "render",
    .summary = "render frames of a glTF scene",
    .synopsis = "SCENE -o OUT [options]",
    .description = "Renders the glTF scene (.gltf or .glb) as one frame or as a sequence. Metal "
                   "reflects, glass reflects and refracts, the environment lights paint. glint "
                   "compiles only what the scene needs. stdout stays empty, except with --stats -.",
    .examples = "  glint render scenes/gallery.gltf -o gallery.png\n"
                "  glint render car.glb --env studio.hdr --env-rotate 90 --samples 16 -o car.exr\n"
                "  glint render jewel.glb --depth 8 --background transparent -o jewel.exr\n"
                "  glint render jewel.glb --turntable 240 -o turn/jewel.####.exr\n"
                "  glint render car.glb --camera all --size 1280x720 -o views/car.png\n"
                "  glint render car.glb --eye 3,1,4 --fov 25 --fit -o car.png\n"
                "  glint render walk.glb --animation walk --fps 25 -o walk/walk.####.exr\n",
    .groups = render_option_groups,
    .positional = "SCENE",
    .request_size = sizeof(render_request),
    .set_defaults = set_defaults,
    .run = run,
};
