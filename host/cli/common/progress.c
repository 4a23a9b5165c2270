// Shows progress as a bar, as plain lines or as JSON lines. See progress.h.
#include "cli/common/progress.h"

#include "base/clock.h"
#include "base/plain_text.h"
#include "cli/common/say.h"
#include "report/json.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define BAR_INTERVAL 100.0   // milliseconds: nobody sees more than ten redraws a second
#define LINE_INTERVAL 5000.0 // keeps the logs of a farm short
#define JSON_INTERVAL 250.0
#define LINE_CAPACITY 256

static int terminal_columns(void)
{
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        return size.ws_col < LINE_CAPACITY ? size.ws_col : LINE_CAPACITY - 1;
    }
    return 80;
}

void glint_progress_begin(glint_progress_display *display, glint_progress_mode mode)
{
    *display = (glint_progress_display){.mode = mode, .begun = glint_now_ms()};
    if (mode == GLINT_PROGRESS_AUTO) {
        const char *terminal = getenv("TERM");
        bool can_erase = terminal != NULL && strcmp(terminal, "dumb") != 0;
        display->mode =
            isatty(STDERR_FILENO) && can_erase ? GLINT_PROGRESS_BAR : GLINT_PROGRESS_PLAIN;
    }
}

glint_status glint_progress_send_to(glint_progress_display *display, int descriptor,
                                    glint_error *error)
{
    if (display->mode != GLINT_PROGRESS_JSON) {
        return glint_fail(error, GLINT_USAGE, "--progress-fd: it is for --progress json");
    }
    const int copy = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    display->events = copy >= 0 ? fdopen(copy, "w") : NULL;
    if (display->events == NULL) {
        return glint_fail(error, GLINT_USAGE, "--progress-fd %d: %s (open it: %d>events)",
                          descriptor, strerror(errno), descriptor);
    }
    setvbuf(display->events, NULL, _IOLBF, BUFSIZ);
    return GLINT_OK;
}

void glint_progress_end(glint_progress_display *display)
{
    glint_progress_clear(display);
    if (display->events != NULL) {
        fclose(display->events);
        display->events = NULL;
    }
}

double glint_progress_elapsed(const glint_progress_display *display)
{
    return glint_now_ms() - display->begun;
}

void glint_progress_clear(glint_progress_display *display)
{
    if (display->line_is_drawn) {
        fputs("\r\033[K", stderr);
        display->line_is_drawn = false;
    }
}

// Writes the line with one call: output of another process may come between lines, not inside one.
static void draw_line(glint_progress_display *display, const char *text)
{
    char plain[512];
    snprintf(plain, sizeof plain, "%s", text);
    glint_make_plain(plain);
    // Leave the last column free: some terminals wrap as soon as it is written.
    fprintf(stderr, "\r%.*s\033[K", terminal_columns() - 1, plain);
    fflush(stderr);
    display->line_is_drawn = true;
}

// Writes the event as one line with one call. Takes over the reference.
static void print_event(const glint_progress_display *display, json_t *event)
{
    char *text = event != NULL ? glint_json_dump(event, JSON_REAL_PRECISION(9)) : NULL;
    if (text != NULL) {
        fprintf(display->events != NULL ? display->events : stderr, "%s\n", text);
    }
    free(text);
    json_decref(event);
}

static json_t *make_event(const char *name)
{
    json_t *event = json_object();
    glint_json_put_text(event, "event", name);
    return event;
}

void glint_progress_phase(glint_progress_display *display, const char *name, const char *text)
{
    if (display->mode == GLINT_PROGRESS_BAR) {
        draw_line(display, text);
    } else if (display->mode == GLINT_PROGRESS_JSON) {
        json_t *event = make_event("phase");
        glint_json_put_text(event, "name", name);
        glint_json_put_real(event, "ms", glint_progress_elapsed(display));
        print_event(display, event);
    }
    // Plain mode is silent before the frame: an early error is then the only line.
}

void glint_progress_render(glint_progress_display *display, uint64_t frames, double rays,
                           const char *text)
{
    display->render_begun = glint_now_ms();
    display->last_shown = display->render_begun;
    display->frames = frames;
    display->rays = rays;
    if (display->mode == GLINT_PROGRESS_PLAIN) {
        glint_say("%s", text);
    } else {
        glint_progress_phase(display, "render", text);
    }
}

static void format_seconds(double seconds, char *text, size_t capacity)
{
    if (!(seconds < 359999)) { // also NaN and infinity
        snprintf(text, capacity, "--:--");
        return;
    }
    long whole = (long)(seconds + 0.5);
    if (whole >= 3600) {
        snprintf(text, capacity, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
    } else {
        snprintf(text, capacity, "%ld:%02ld", whole / 60, whole % 60);
    }
}

static void draw_bar(glint_progress_display *display, double share, const char *figures)
{
    char line[LINE_CAPACITY];
    int width = terminal_columns() - 1 - (int)strlen(figures) - 3;
    if (width < 10) {
        draw_line(display, figures);
        return;
    }
    if (width > 60) {
        width = 60;
    }
    int filled = (int)(share * width);
    line[0] = '[';
    memset(line + 1, '#', (size_t)filled);
    memset(line + 1 + filled, '.', (size_t)(width - filled));
    snprintf(line + 1 + width, sizeof line - 1 - (size_t)width, "] %s", figures);
    draw_line(display, line);
}

// Progress and rate of the work.
typedef struct stand {
    double share;        // of all frames, [0, 1]
    double frames_a_ms;  // frames traced per millisecond, with the current one in part
    double seconds_left; // not finite until something is known
} stand;

// Computes progress from the counters; `frame_share` is the finished part of the current frame.
static stand stand_of(const glint_progress_display *display, double frame_share)
{
    const double frames = display->frames > 0 ? (double)display->frames : 1;
    const double past = (double)display->past + frame_share;
    const double traced = (double)display->traced + frame_share;
    // Of the existing files, assume that the share skipped so far will also be skipped in future.
    const double looked_at = (double)(display->skipped + display->again);
    const double standing = fmax(0, (double)display->standing - looked_at);
    const double skipping = standing * ((double)display->skipped + 1) / (looked_at + 1);
    const double left = fmax(0, frames - past - skipping);
    const double elapsed = fmax(1e-3, glint_now_ms() - display->render_begun - display->passing_ms);
    return (stand){
        .share = past < frames ? past / frames : 1,
        .frames_a_ms = traced / elapsed,
        .seconds_left = left > 0 ? 1e-3 * elapsed * left / traced : 0,
    };
}

static void show_figures(glint_progress_display *display, const stand *now)
{
    char left[32], figures[128];
    const double rays = 1e3 * now->frames_a_ms * display->rays;
    format_seconds(now->seconds_left, left, sizeof left);
    if (display->frames > 0) {
        snprintf(figures, sizeof figures,
                 "%" PRIu64 "/%" PRIu64 "  %3.0f%%  %.3g frames/s  %.2f primary Mrays/s  %s left",
                 display->through, display->frames, 100 * now->share, 1e3 * now->frames_a_ms,
                 1e-6 * rays, left);
    } else {
        snprintf(figures, sizeof figures, "%3.0f%%  %.2f primary Mrays/s  %s left",
                 100 * now->share, 1e-6 * rays, left);
    }
    if (display->mode == GLINT_PROGRESS_BAR) {
        draw_bar(display, now->share, figures);
    } else {
        glint_say("%s", figures);
    }
}

static void put_frames(json_t *event, const glint_progress_display *display)
{
    if (display->frames > 0) {
        glint_json_put_count(event, "frames_done", display->through);
        glint_json_put_count(event, "frames", display->frames);
    }
}

static void print_progress(const glint_progress_display *display, const stand *now)
{
    json_t *event = make_event("progress");
    glint_json_put_real(event, "share", now->share);
    put_frames(event, display);
    if (display->frames > 0) {
        glint_json_put_real(event, "frames_per_second", 1e3 * now->frames_a_ms);
    }
    glint_json_put_real(event, "primary_rays_per_second", 1e3 * now->frames_a_ms * display->rays);
    glint_json_put_real(event, "seconds_left", now->seconds_left);
    print_event(display, event);
}

void glint_progress_step(glint_progress_display *display, uint64_t done, uint64_t total)
{
    static const double intervals[] = {[GLINT_PROGRESS_BAR] = BAR_INTERVAL,
                                       [GLINT_PROGRESS_PLAIN] = LINE_INTERVAL,
                                       [GLINT_PROGRESS_JSON] = JSON_INTERVAL};
    const double time = glint_now_ms();
    if (display->mode == GLINT_PROGRESS_NONE ||
        time - display->last_shown < intervals[display->mode] || total == 0) {
        return;
    }
    const stand now = stand_of(display, done < total ? (double)done / (double)total : 1);
    if (!(now.share > 0)) {
        return;
    }
    display->last_shown = time;
    if (display->mode == GLINT_PROGRESS_JSON) {
        print_progress(display, &now);
    } else {
        show_figures(display, &now);
    }
}

void glint_progress_traced(glint_progress_display *display)
{
    display->past++;
    display->traced++;
}

void glint_progress_failed(glint_progress_display *display, double ms)
{
    display->past++;
    display->passing_ms += ms;
}

void glint_progress_skipped(glint_progress_display *display, double ms)
{
    glint_progress_failed(display, ms);
    display->skipped++;
}

void glint_progress_standing(glint_progress_display *display, uint64_t frames)
{
    display->standing = frames;
}

void glint_progress_again(glint_progress_display *display)
{
    display->again++;
}

const char *glint_frame_outcome_name(glint_frame_outcome outcome)
{
    static const char *const names[] = {"rendered", "skipped", "failed"};
    return names[outcome];
}

static void print_frame(const glint_progress_display *display, const glint_progress_frame *frame,
                        double seconds_left)
{
    json_t *event = make_event("frame");
    glint_json_put(event, "frame", json_integer(frame->number));
    glint_json_put_text(event, "file", frame->file);
    glint_json_put_text(event, "outcome", glint_frame_outcome_name(frame->outcome));
    if (frame->outcome == GLINT_FRAME_RENDERED) {
        glint_json_put_real(event, "trace_ms", frame->trace_ms);
        glint_json_put_real(event, "write_ms", frame->write_ms);
    }
    put_frames(event, display);
    glint_json_put_real(event, "seconds_left", seconds_left);
    print_event(display, event);
}

void glint_progress_through(glint_progress_display *display, const glint_progress_frame *frame)
{
    display->through++;
    const stand now = stand_of(display, 0);
    if (display->mode == GLINT_PROGRESS_JSON) {
        print_frame(display, frame, now.seconds_left);
    } else if (display->mode == GLINT_PROGRESS_PLAIN) {
        char left[32], took[64] = "";
        format_seconds(now.seconds_left, left, sizeof left);
        if (frame->outcome == GLINT_FRAME_RENDERED) {
            snprintf(took, sizeof took, ", traced in %.0f ms, written in %.0f ms", frame->trace_ms,
                     frame->write_ms);
        }
        glint_say("frame %d %s%s: %s (%" PRIu64 " of %" PRIu64 ", %s left)", frame->number,
                  glint_frame_outcome_name(frame->outcome), took, frame->file, display->through,
                  display->frames, left);
        display->last_shown = glint_now_ms();
    }
}

void glint_progress_done(const glint_progress_display *display, uint64_t rendered, uint64_t skipped,
                         uint64_t failed)
{
    if (display->mode != GLINT_PROGRESS_JSON) {
        return;
    }
    json_t *event = make_event("done");
    glint_json_put_real(event, "ms", glint_progress_elapsed(display));
    if (display->frames > 0) {
        glint_json_put_count(event, "rendered", rendered);
        glint_json_put_count(event, "skipped", skipped);
        glint_json_put_count(event, "failed", failed);
    }
    print_event(display, event);
}
