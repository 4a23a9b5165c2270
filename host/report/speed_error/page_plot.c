// Draws a plot of errors against times. See page_plot.h.
#include "report/speed_error/page_plot.h"

#include "report/speed_error/markup.h"

#include <math.h>

// The size of the picture in its own units, and the places of the axes.
#define WIDTH 760.0
#define HEIGHT 440.0
#define LEFT 70.0
#define RIGHT 740.0
#define TOP 20.0
#define BOTTOM 360.0
#define ZERO 385.0 // the line for errors of 0

typedef struct range {
    double low, high; // decimal logarithms
} range;

typedef struct plot {
    range ms, error;
    bool has_zero;
    FILE *out;
} plot;

static bool is_shown(const glint_plot_point *point)
{
    return point->ms > 0 && isfinite(point->ms) && point->error >= 0 && isfinite(point->error);
}

static void include(range *r, double value)
{
    r->low = fmin(r->low, log10(value));
    r->high = fmax(r->high, log10(value));
}

// Rounds a logarithm down (direction −1) or up (1) to a place where an axis may end. This is a
// whole decade; if `whole` is false, also 2 or 5 within a decade.
static double round_end(double value, int direction, bool whole)
{
    static const double steps[] = {0, 0.30103, 0.69897, 1};
    const double decade = floor(value), rest = value - decade;
    double end = direction < 0 ? 0 : 1;
    for (int i = 0; i < 4 && !whole; i++) {
        const bool is_beyond = direction < 0 ? steps[i] <= rest + 1e-9 : steps[i] >= rest - 1e-9;
        end = is_beyond ? (direction < 0 ? fmax(end, steps[i]) : fmin(end, steps[i])) : end;
    }
    return decade + (whole && direction > 0 && rest < 1e-9 ? 0 : end);
}

static void finish_range(range *r, bool whole)
{
    if (!(r->low <= r->high)) { // no points
        *r = (range){-1, 1};
    }
    const bool is_narrow = r->high - r->low < 1.5;
    r->low = round_end(r->low, -1, whole || !is_narrow);
    r->high = fmax(round_end(r->high, 1, whole), r->low + 0.3);
}

static double x_of(const plot *p, double ms)
{
    return LEFT + (log10(ms) - p->ms.low) / (p->ms.high - p->ms.low) * (RIGHT - LEFT);
}

static double y_of(const plot *p, double error)
{
    return error > 0 ? BOTTOM - (log10(error) - p->error.low) / (p->error.high - p->error.low) *
                                    (BOTTOM - TOP)
                     : ZERO;
}

static void draw_text(const plot *p, double x, double y, const char *anchor, const char *text)
{
    fprintf(p->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor);
    glint_markup_text(p->out, text);
    fputs("</text>\n", p->out);
}

typedef struct spot {
    double x, y;
} spot;

static void draw_line(const plot *p, const char *kind, spot from, spot to)
{
    fprintf(p->out, "<line class=\"%s\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", kind,
            from.x, from.y, to.x, to.y);
}

static void draw_axes(const plot *p)
{
    char text[32];
    for (int decade = (int)floor(p->ms.low); decade <= p->ms.high; decade++) {
        for (int k = 1; k < 10; k++) {
            const double ms = k * pow(10, decade), place = log10(ms);
            if (place < p->ms.low - 1e-6 || place > p->ms.high + 1e-6) {
                continue;
            }
            draw_line(p, k == 1 ? "grid" : "grid minor", (spot){x_of(p, ms), TOP},
                      (spot){x_of(p, ms), BOTTOM});
            if (k == 1 || k == 2 || k == 5) {
                snprintf(text, sizeof text, "%g", ms);
                draw_text(p, x_of(p, ms), ZERO + 25, "middle", text);
            }
        }
    }
    for (int decade = (int)p->error.low; decade <= p->error.high; decade++) {
        const double y = y_of(p, pow(10, decade));
        draw_line(p, "grid", (spot){LEFT, y}, (spot){RIGHT, y});
        snprintf(text, sizeof text, "%g", pow(10, decade));
        draw_text(p, LEFT - 8, y + 4, "end", text);
    }
    if (p->has_zero) {
        draw_line(p, "grid", (spot){LEFT, ZERO}, (spot){RIGHT, ZERO});
        draw_text(p, LEFT - 8, ZERO + 4, "end", "none");
    }
    draw_text(p, (LEFT + RIGHT) / 2, HEIGHT - 6, "middle", "milliseconds a frame");
    fprintf(p->out,
            "<text transform=\"translate(16 %.1f) rotate(-90)\" text-anchor=\"middle\">"
            "relative RMSE</text>\n",
            (TOP + BOTTOM) / 2);
}

// Draws a stepped line through the optimal points from left to right.
static void draw_front(const plot *p, const glint_plot_point *points, size_t count)
{
    double last = -INFINITY;
    const char *command = "M";
    double y_before = 0;
    fputs("<path class=\"front\" d=\"", p->out);
    for (;;) {
        const glint_plot_point *next = NULL;
        for (size_t i = 0; i < count; i++) {
            const glint_plot_point *point = &points[i];
            if (is_shown(point) && point->is_optimal && point->ms > last &&
                (next == NULL || point->ms < next->ms)) {
                next = point;
            }
        }
        if (next == NULL) {
            break;
        }
        const double x = x_of(p, next->ms), y = y_of(p, next->error);
        if (*command == 'L') {
            fprintf(p->out, "L%.1f %.1f", x, y_before);
        }
        fprintf(p->out, "%s%.1f %.1f", command, x, y);
        command = "L";
        y_before = y;
        last = next->ms;
    }
    if (*command == 'M') { // no optimal points, but a path must begin somewhere
        fprintf(p->out, "M%.1f %.1f", LEFT, BOTTOM);
    }
    fputs("\"/>\n", p->out);
}

static void draw_point(const plot *p, const glint_plot_point *point, size_t number)
{
    const double x = x_of(p, point->ms), y = y_of(p, point->error);
    fputs("<a href=\"", p->out);
    glint_markup_text(p->out, point->link);
    fprintf(p->out, "\" class=\"%s\"><title>", point->is_optimal ? "optimal" : "dominated");
    glint_markup_text(p->out, point->label);
    fputs("</title>\n", p->out);
    if (point->low > 0 && point->high > point->low) {
        draw_line(p, "spread", (spot){x_of(p, point->low), y}, (spot){x_of(p, point->high), y});
    }
    fprintf(p->out,
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"9\"/><text x=\"%.1f\" y=\"%.1f\" "
            "text-anchor=\"middle\">%zu</text></a>\n",
            x, y, x, y + 4, number);
}

void glint_page_plot(const glint_plot_point *points, size_t count, FILE *out)
{
    plot p = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, false, out};
    for (size_t i = 0; i < count; i++) {
        if (is_shown(&points[i])) {
            include(&p.ms, points[i].ms);
            include(&p.ms, points[i].low > 0 ? points[i].low : points[i].ms);
            include(&p.ms, points[i].high > 0 ? points[i].high : points[i].ms);
            p.has_zero = p.has_zero || points[i].error == 0;
            if (points[i].error > 0) {
                include(&p.error, points[i].error);
            }
        }
    }
    finish_range(&p.ms, false);
    finish_range(&p.error, true);
    fprintf(out,
            "<svg class=\"plot\" viewBox=\"0 0 %g %g\" role=\"img\" aria-label=\"errors "
            "against times\">\n",
            WIDTH, HEIGHT);
    draw_axes(&p);
    draw_front(&p, points, count);
    for (int optimal = 0; optimal <= 1; optimal++) { // optimal points last, above the others
        for (size_t i = 0; i < count; i++) {
            if (is_shown(&points[i]) && points[i].is_optimal == (optimal == 1)) {
                draw_point(&p, &points[i], i + 1);
            }
        }
    }
    fputs("</svg>\n", out);
}
