// The bar, the plain lines and the JSON lines of progress. See progress.h.
#include "cli/progress.h"

#include "cli/cli.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#define BAR_INTERVAL 0.1   // seconds: ten redraws a second are as many as anybody sees
#define LINE_INTERVAL 5.0  // seconds: few enough lines for the log of a farm
#define JSON_INTERVAL 0.25 // seconds
#define LINE_CAPACITY 256

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

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
    *display = (glint_progress_display){.mode = mode, .begun = now()};
    if (mode == GLINT_PROGRESS_AUTO) {
        const char *terminal = getenv("TERM");
        bool can_erase = terminal != NULL && strcmp(terminal, "dumb") != 0;
        display->mode =
            isatty(STDERR_FILENO) && can_erase ? GLINT_PROGRESS_BAR : GLINT_PROGRESS_PLAIN;
    }
}

double glint_progress_elapsed(const glint_progress_display *display)
{
    return 1e3 * (now() - display->begun);
}

void glint_progress_clear(glint_progress_display *display)
{
    if (display->line_is_drawn) {
        fputs("\r\033[K", stderr);
        display->line_is_drawn = false;
    }
}

// One write a line: another process's output may come between lines, not into them.
static void draw_line(glint_progress_display *display, const char *text)
{
    // The last column stays free: some terminals go to the next line when it is written.
    fprintf(stderr, "\r%.*s\033[K", terminal_columns() - 1, text);
    fflush(stderr);
    display->line_is_drawn = true;
}

void glint_progress_phase(glint_progress_display *display, const char *name, const char *text)
{
    if (display->mode == GLINT_PROGRESS_BAR) {
        draw_line(display, text);
    } else if (display->mode == GLINT_PROGRESS_JSON) {
        fprintf(stderr, "{\"event\": \"phase\", \"name\": \"%s\", \"ms\": %.1f}\n", name,
                glint_progress_elapsed(display));
    }
    // Plain lines begin with the frame: an error before that is the only line there is.
}

void glint_progress_frame(glint_progress_display *display, double total_rays, const char *text)
{
    display->frame_begun = now();
    display->last_shown = display->frame_begun;
    display->total_rays = total_rays;
    if (display->mode == GLINT_PROGRESS_PLAIN) {
        glint_say("%s", text);
    } else {
        glint_progress_phase(display, "render", text);
    }
}

static void format_seconds(double seconds, char *text, size_t capacity)
{
    // The comparison also catches NaN and infinity.
    if (!(seconds < 359999)) {
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

void glint_progress_step(glint_progress_display *display, uint64_t done, uint64_t total)
{
    static const double intervals[] = {[GLINT_PROGRESS_BAR] = BAR_INTERVAL,
                                       [GLINT_PROGRESS_PLAIN] = LINE_INTERVAL,
                                       [GLINT_PROGRESS_JSON] = JSON_INTERVAL};
    double time = now();
    if (display->mode == GLINT_PROGRESS_NONE ||
        time - display->last_shown < intervals[display->mode] || total == 0 || done == 0) {
        return;
    }
    display->last_shown = time;
    double share = done < total ? (double)done / (double)total : 1;
    double elapsed = time - display->frame_begun;
    double left = elapsed * (1 - share) / share;
    double rate = display->total_rays * share / elapsed;
    char left_text[32];
    char figures[96];
    format_seconds(left, left_text, sizeof left_text);
    snprintf(figures, sizeof figures, "%3.0f%%  %.2f Mrays/s  %s left", 100 * share, 1e-6 * rate,
             left_text);
    if (display->mode == GLINT_PROGRESS_BAR) {
        draw_bar(display, share, figures);
    } else if (display->mode == GLINT_PROGRESS_PLAIN) {
        glint_say("%s", figures);
    } else {
        fprintf(stderr,
                "{\"event\": \"progress\", \"share\": %.6f, \"primary_rays_per_second\": %.0f, "
                "\"seconds_left\": %.2f}\n",
                share, rate, left);
    }
}
