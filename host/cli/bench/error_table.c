// Prints the table of speed against error. See error_table.h.
#include "cli/bench/error_table.h"

#include "cli/bench/bench_table.h"

#include <math.h>

static void print_figure(double value, const char *format, int width, FILE *out)
{
    char text[32];
    snprintf(text, sizeof text, format, value);
    fprintf(out, " %*s", width, isnan(value) ? "-" : text);
}

static void print_times(const json_t *of, FILE *out)
{
    const json_t *times = glint_json_at(of, "milliseconds");
    fprintf(out, " %9.2f %9.2f – %-9.2f", glint_json_real_at(times, "median"),
            glint_json_real_at(times, "lower_quartile"),
            glint_json_real_at(times, "upper_quartile"));
}

static void print_error(const json_t *error, FILE *out)
{
    static const char *const figures[] = {"relative_rmse", "p99", "largest"};
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++) {
        print_figure(glint_json_real_at(error, figures[i]), "%.2g", 8, out);
    }
}

static const char *text_at(const json_t *root, const char *path)
{
    const char *text = glint_json_text_at(root, path);
    return text != NULL ? text : "";
}

static void print_rung(const json_t *rungs, size_t which, FILE *out)
{
    const json_t *rung = json_array_get(rungs, which);
    const json_t *wrong = glint_json_at(rung, "wrong_hits");
    const char *by = glint_json_text_at(rung, "dominated_by");
    const bool is_optimal = json_is_true(glint_json_at(rung, "is_pareto_optimal"));
    const long long lost =
        (long long)json_integer_value(glint_json_at(rung, "error.nonfinite_pixels"));
    fprintf(out, "  %c%2zu", is_optimal ? '*' : ' ', which + 1);
    print_times(rung, out);
    print_error(glint_json_at(rung, "error"), out);
    print_figure(glint_json_real_at(rung, "directions.mean_degrees"), "%.3g", 8, out);
    print_figure(glint_json_real_at(rung, "directions.p99_degrees"), "%.3g", 8, out);
    print_figure(json_is_integer(wrong) ? (double)json_integer_value(wrong) : NAN, "%.0f", 6, out);
    fprintf(out, "  %s", text_at(rung, "name"));
    if (lost > 0) {
        fprintf(out, ", %lld PIXELS NOT FINITE", lost);
    }
    if (by != NULL) {
        fprintf(out, " (%lld is better)",
                (long long)json_integer_value(glint_json_at(rung, "dominated_by_number")));
    }
    fprintf(out, "\n");
}

static void print_rungs(const json_t *scene, FILE *out)
{
    const json_t *rungs = glint_json_at(scene, "rungs");
    fprintf(out,
            "\n        ms a frame   quartiles            relative  99%%      largest  degrees  "
            "99%%      wrong\n"
            "                                             RMSE      within           off      "
            "within   hits  rung\n");
    for (size_t i = 0; i < json_array_size(rungs); i++) {
        print_rung(rungs, i, out);
    }
    fprintf(out, "  *: no other is both as fast and as right\n");
}

static void print_sampling(const json_t *scene, FILE *out)
{
    size_t i;
    json_t *row;
    if (!json_is_object(glint_json_at(scene, "sampling"))) {
        return;
    }
    fprintf(out, "\n  error of sampling, apart from the above: against %.0f samples a pixel\n",
            (double)json_integer_value(glint_json_at(scene, "sampling.reference_samples")));
    json_array_foreach(glint_json_at(scene, "sampling.rows"), i, row)
    {
        fprintf(out, "     ");
        print_times(row, out);
        print_error(glint_json_at(row, "error"), out);
        fprintf(out, "  samples %lld, filter %s\n",
                (long long)json_integer_value(glint_json_at(row, "samples")),
                text_at(row, "filter"));
    }
}

void glint_error_print_scene(const json_t *scene, FILE *out)
{
    glint_bench_print_subject(scene, out);
    const json_t *reference = glint_json_at(scene, "reference");
    fprintf(
        out,
        "  reference %s\n            %.0f ms a frame; four times the weights change it by %.2g, "
        "twice the depth by %.2g\n",
        text_at(reference, "options"), glint_json_real_at(reference, "milliseconds.median"),
        glint_json_real_at(reference, "change_by_four_times_the_weights.relative_rmse"),
        glint_json_real_at(reference, "change_by_twice_the_depth.relative_rmse"));
    print_rungs(scene, out);
    print_sampling(scene, out);
}
