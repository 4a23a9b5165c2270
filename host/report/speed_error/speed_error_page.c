// Writes the page of speed against error. See speed_error_page.h.
#include "report/speed_error/speed_error_page.h"

#include "image/output_file.h"
#include "render/ladder.h"
#include "report/speed_error/markup.h"
#include "report/speed_error/page_plot.h"
#include "report/speed_error/page_style.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *text_at(const json_t *root, const char *path)
{
    const char *text = glint_json_text_at(root, path);
    return text != NULL ? text : "";
}

static long long count_at(const json_t *root, const char *path)
{
    return (long long)json_integer_value(glint_json_at(root, path));
}

static void put(FILE *out, const char *before, const char *text, const char *after)
{
    fputs(before, out);
    glint_markup_text(out, text);
    fputs(after, out);
}

static void put_real(FILE *out, double value, const char *format, const char *unit)
{
    fputs("<td>", out);
    if (isnan(value)) {
        fputs("–", out);
    } else {
        char text[32];
        snprintf(text, sizeof text, format, value);
        put(out, "", text, unit);
    }
    fputs("</td>", out);
}

// ---- The head of a scene -----------------------------------------------------------------------

static void put_facts(const json_t *scene, FILE *out)
{
    put(out, "<h2>", text_at(scene, "name"), "</h2>\n");
    fprintf(out, "<p class=\"soft\">%lld triangles, %lld × %lld pixels, %lld sample%s a pixel",
            count_at(scene, "scene.triangle_count"), count_at(scene, "settings.width"),
            count_at(scene, "settings.height"), count_at(scene, "settings.samples"),
            count_at(scene, "settings.samples") == 1 ? "" : "s");
    put(out, "; environment ", text_at(scene, "environment.name"), "");
    put(out, "; on ", text_at(scene, "device.name"), "</p>\n");
}

static void put_plot(const json_t *scene, size_t number, FILE *out)
{
    const json_t *rungs = glint_json_at(scene, "rungs");
    glint_plot_point points[GLINT_RUNGS_MAX] = {{0}};
    char labels[GLINT_RUNGS_MAX][160], links[GLINT_RUNGS_MAX][32];
    size_t i;
    json_t *rung;
    json_array_foreach(rungs, i, rung)
    {
        if (i == GLINT_RUNGS_MAX) {
            break;
        }
        const double ms = glint_json_real_at(rung, "milliseconds.median");
        const double error = glint_json_real_at(rung, "error.relative_rmse");
        snprintf(labels[i], sizeof labels[i], "%s: %.4g ms, %.2g", text_at(rung, "name"), ms,
                 error);
        snprintf(links[i], sizeof links[i], "#s%zur%zu", number, i + 1);
        points[i] = (glint_plot_point){
            .ms = ms,
            .error = error,
            .low = glint_json_real_at(rung, "milliseconds.lower_quartile"),
            .high = glint_json_real_at(rung, "milliseconds.upper_quartile"),
            .is_optimal = json_is_true(glint_json_at(rung, "is_pareto_optimal")),
            .label = labels[i],
            .link = links[i],
        };
    }
    fputs("<figure>\n", out);
    glint_page_plot(points, i, out);
    fputs("<figcaption>Further down is nearer to the reference, further left is faster. The line "
          "joins the ways that no other beats in both; bars are the middle halves of the times."
          "</figcaption>\n</figure>\n",
          out);
}

// ---- Tables ------------------------------------------------------------------------------------

// Writes four digits, or all digits of the whole number if it has more; never an exponent.
static void put_ms(FILE *out, double ms)
{
    fprintf(out, ms < 9999.5 ? "%.4g" : "%.0f", ms);
}

static void put_figures(const json_t *of, FILE *out)
{
    fputs("<td>", out);
    put_ms(out, glint_json_real_at(of, "milliseconds.median"));
    fputs("</td><td>", out);
    put_ms(out, glint_json_real_at(of, "milliseconds.lower_quartile"));
    fputs(" – ", out);
    put_ms(out, glint_json_real_at(of, "milliseconds.upper_quartile"));
    fputs("</td>", out);
    put_real(out, glint_json_real_at(of, "error.relative_rmse"), "%.2g", "");
    put_real(out, glint_json_real_at(of, "error.p99"), "%.2g", "");
    put_real(out, glint_json_real_at(of, "error.largest"), "%.2g", "");
}

static void put_row(const json_t *rungs, size_t number, size_t which, FILE *out)
{
    const json_t *rung = json_array_get(rungs, which - 1);
    const json_t *wrong = glint_json_at(rung, "wrong_hits");
    const bool optimal = json_is_true(glint_json_at(rung, "is_pareto_optimal"));
    fprintf(out, "<tr class=\"%s\"><td>%zu</td>", optimal ? "optimal" : "dominated", which);
    fprintf(out, "<td class=\"left\"><a href=\"#s%zur%zu\">", number, which);
    glint_markup_text(out, text_at(rung, "name"));
    fputs("</a></td>", out);
    put_figures(rung, out);
    put_real(out, glint_json_real_at(rung, "directions.mean_degrees"), "%.3g", "°");
    put_real(out, glint_json_real_at(rung, "directions.p99_degrees"), "%.3g", "°");
    put_real(out, json_is_integer(wrong) ? (double)json_integer_value(wrong) : NAN, "%.0f", "");
    put_real(out, 100 * glint_json_real_at(rung, "truncated_weight.total"), "%.2g", "%");
    put_real(out, (double)count_at(rung, "error.nonfinite_pixels"), "%.0f", "");
    put_real(out, optimal ? NAN : (double)count_at(rung, "dominated_by_number"), "%.0f", "");
    fputs("</tr>\n", out);
}

static void put_table(const json_t *scene, size_t number, FILE *out)
{
    const json_t *rungs = glint_json_at(scene, "rungs");
    fputs("<div class=\"scroll\"><table>\n<thead><tr><th></th><th class=\"left\">way</th>"
          "<th>ms</th><th>middle half</th><th>relative RMSE</th><th>99% within</th>"
          "<th>largest</th><th>directions</th><th>99% within</th><th>wrong hits</th>"
          "<th>truncated</th><th>NaN, ∞</th><th>beaten by</th></tr></thead>\n<tbody>\n",
          out);
    for (size_t i = 0; i < json_array_size(rungs); i++) {
        put_row(rungs, number, i + 1, out);
    }
    fputs("</tbody></table></div>\n", out);
}

static void put_sampling(const json_t *scene, FILE *out)
{
    size_t i;
    json_t *row;
    if (!json_is_object(glint_json_at(scene, "sampling"))) {
        return;
    }
    fprintf(out,
            "<h3>Sampling</h3>\n<p class=\"soft\">What more samples a pixel give is another error, "
            "apart from those above: of the program's defaults, against %lld samples.</p>\n"
            "<div class=\"scroll\"><table>\n<thead><tr><th class=\"left\">samples</th><th>ms</th>"
            "<th>middle half</th><th>relative RMSE</th><th>99%% within</th><th>largest</th></tr>"
            "</thead>\n<tbody>\n",
            count_at(scene, "sampling.reference_samples"));
    json_array_foreach(glint_json_at(scene, "sampling.rows"), i, row)
    {
        fprintf(out, "<tr><td class=\"left\">%lld, filter %s</td>", count_at(row, "samples"),
                text_at(row, "filter"));
        put_figures(row, out);
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table></div>\n", out);
}

// ---- Pictures ----------------------------------------------------------------------------------

// Puts the reference's picture into the page once; each rung shows it by a link.
static void define_reference(const json_t *scene, size_t number, FILE *out)
{
    const long long width = count_at(scene, "settings.width");
    const long long height = count_at(scene, "settings.height");
    fprintf(out,
            "<svg class=\"hidden\" aria-hidden=\"true\"><defs><image id=\"s%zu\" width=\"%lld\" "
            "height=\"%lld\" href=\"%s\"/></defs></svg>\n",
            number, width, height, text_at(scene, "reference.picture"));
}

static void put_pictures(const json_t *scene, size_t number, FILE *out)
{
    const long long width = count_at(scene, "settings.width");
    const long long height = count_at(scene, "settings.height");
    size_t i;
    json_t *rung;
    fputs("<h3>Pictures</h3>\n<p class=\"soft\">Each way; the reference; and where they differ, by "
          "what share of the reference or of its mean.</p>\n",
          out);
    define_reference(scene, number, out);
    json_array_foreach(glint_json_at(scene, "rungs"), i, rung)
    {
        fprintf(out, "<figure class=\"rung\" id=\"s%zur%zu\">\n<div class=\"three\">", number,
                i + 1);
        put(out, "<img alt=\"", text_at(rung, "name"), "\"");
        fprintf(out, " width=\"%lld\" height=\"%lld\" src=\"%s\">\n", width, height,
                text_at(rung, "picture"));
        fprintf(out,
                "<svg viewBox=\"0 0 %lld %lld\" role=\"img\" aria-label=\"the reference\">"
                "<use href=\"#s%zu\"/></svg>\n",
                width, height, number);
        put(out, "<img alt=\"errors of ", text_at(rung, "name"), "\"");
        fprintf(out, " src=\"%s\"></div>\n", text_at(rung, "heat"));
        fprintf(out, "<figcaption>%zu. ", i + 1);
        put(out, "", text_at(rung, "name"), "");
        put(out, " (<code>", text_at(rung, "options"), "</code>)");
        fprintf(out, ": %.4g ms, relative RMSE %.2g</figcaption>\n</figure>\n",
                glint_json_real_at(rung, "milliseconds.median"),
                glint_json_real_at(rung, "error.relative_rmse"));
    }
}

// ---- What made it ------------------------------------------------------------------------------

static void put_fact(FILE *out, const char *name, const char *text)
{
    put(out, "<dt>", name, "</dt>");
    put(out, "<dd>", text, "</dd>\n");
}

static void put_making(const json_t *scene, FILE *out)
{
    char text[512];
    fputs("<h3>What made it</h3>\n<dl>\n", out);
    snprintf(text, sizeof text, "%s (%s, driver %s), %s, %lld compute units",
             text_at(scene, "device.name"), text_at(scene, "device.platform"),
             text_at(scene, "device.driver"), text_at(scene, "device.opencl"),
             count_at(scene, "device.compute_units"));
    put_fact(out, "device", text);
    put_fact(out, "scene", text_at(scene, "scene.fingerprint"));
    put_fact(out, "environment", text_at(scene, "environment.fingerprint"));
    snprintf(text, sizeof text,
             "%s: %.4g ms a frame, %.3g%% of the weight truncated. With four times the weights it "
             "changes by %.2g, with twice the depth by %.2g",
             text_at(scene, "reference.options"),
             glint_json_real_at(scene, "reference.milliseconds.median"),
             100 * glint_json_real_at(scene, "reference.truncated_weight.total"),
             glint_json_real_at(scene, "reference.change_by_four_times_the_weights.relative_rmse"),
             glint_json_real_at(scene, "reference.change_by_twice_the_depth.relative_rmse"));
    put_fact(out, "reference", text);
    fputs("</dl>\n<div class=\"scroll\"><table>\n<thead><tr><th class=\"left\">before the first "
          "frame, "
          "ms</th><th>analysis</th><th>tree</th><th>irradiance</th><th>cells</th><th>upload</th>"
          "<th>kernels</th><th class=\"left\">plan</th></tr></thead>\n<tbody>\n",
          out);
    size_t i;
    json_t *rung;
    json_array_foreach(glint_json_at(scene, "rungs"), i, rung)
    {
        static const char *const phases[] = {"phases.analysis",   "phases.bvh",
                                             "phases.irradiance", "phases.cells",
                                             "phases.upload",     "phases.kernel_build"};
        put(out, "<tr><td class=\"left\">", text_at(rung, "name"), "</td>");
        for (size_t k = 0; k < sizeof phases / sizeof *phases; k++) {
            put_real(out, glint_json_real_at(rung, phases[k]), "%.1f", "");
        }
        put(out, "<td class=\"left\">", text_at(rung, "plan"), "</td></tr>\n");
    }
    fputs("</tbody></table></div>\n", out);
}

// ------------------------------------------------------------------------------------------------

static void put_scene(const json_t *scene, size_t number, FILE *out)
{
    fputs("<section>\n", out);
    put_facts(scene, out);
    put_plot(scene, number, out);
    put_table(scene, number, out);
    put_sampling(scene, out);
    put_pictures(scene, number, out);
    put_making(scene, out);
    fputs("</section>\n", out);
}

static void put_page(const json_t *document, FILE *out)
{
    fprintf(out,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            "<title>glint: speed against error</title>\n<style>\n%s</style>\n</head>\n<body>\n"
            "<h1>Speed against error</h1>\n",
            glint_page_style);
    put(out, "<p class=\"soft\">glint ", text_at(document, "glint"), "");
    put(out, ", ", text_at(document, "date"), "");
    put(out, "; ", text_at(document, "host.cpu"), "");
    fprintf(out, ", %lld cores", count_at(document, "host.cores"));
    put(out, ", ", text_at(document, "host.system"), "");
    fprintf(out, ", load %.2f at the start</p>\n",
            glint_json_real_at(document, "host.load_average"));
    put(out, "<p><code>", text_at(document, "command"), "</code></p>\n");
    fputs("<p>Each scene was rendered in several ways, from crude to exact. Their errors are "
          "counted from a reference in double precision, of the same samples a pixel: "
          "<em>relative RMSE</em> is the root of the mean square difference over the reference's "
          "mean. Times are medians of frames that were rendered in turns.</p>\n",
          out);
    size_t i;
    json_t *scene;
    json_array_foreach(glint_json_at(document, "scenes"), i, scene)
    {
        put_scene(scene, i + 1, out);
    }
    fputs("</body>\n</html>\n", out);
}

glint_status glint_speed_error_page_write(const char *path, const json_t *document,
                                          glint_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL) {
        return glint_fail_memory(error, "a page");
    }
    put_page(document, out);
    const bool whole = ferror(out) == 0;
    const glint_status status = fclose(out) == 0 && whole
                                    ? glint_output_file_write(path, text, size, error)
                                    : glint_fail_memory(error, "a page");
    free(text);
    return status;
}
