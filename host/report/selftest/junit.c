// Writes JUnit XML. See junit.h. It needs only elements and escaped texts: a library would save a
// dozen lines, but would be one more package to install.
#include "report/selftest/junit.h"

#include "image/output_file.h"
#include "report/speed_error/markup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_attribute(FILE *out, const char *name, const char *value)
{
    fprintf(out, " %s=\"", name);
    glint_markup_text(out, value);
    fputc('"', out);
}

static void put_property(FILE *out, const char *name, const char *value)
{
    fputs("      <property", out);
    put_attribute(out, "name", name);
    put_attribute(out, "value", value);
    fputs("/>\n", out);
}

static void put_measures(FILE *out, const glint_selftest_result *r)
{
    for (int i = 0; i < r->measure_count; i++) {
        const glint_measure *m = &r->measures[i];
        char line[256];
        snprintf(line, sizeof line, "%s: %.6g %s, at most %.6g (%llu judged): %s\n", m->what,
                 m->measured, m->unit, m->bound, (unsigned long long)m->judged,
                 glint_measure_holds(m) ? "holds" : "fails");
        glint_markup_text(out, line);
        if (m->worst[0] != '\0') {
            fputs("  worst: ", out);
            glint_markup_text(out, m->worst);
            fputc('\n', out);
        }
    }
}

// Writes an element that says why a case did not pass.
static void put_trouble(FILE *out, const glint_selftest_result *r)
{
    const glint_measure *worst = glint_selftest_worst(r);
    char message[GLINT_MESSAGE_CAPACITY + 512];
    snprintf(message, sizeof message, "%s", r->reason);
    if (r->verdict == GLINT_FAILED && worst != NULL) {
        snprintf(message, sizeof message, "%s: %.6g %s, at most %.6g; %s", worst->what,
                 worst->measured, worst->unit, worst->bound,
                 worst->judged > 0 ? worst->worst : "nothing was judged");
    }
    const char *element = r->verdict == GLINT_SKIPPED || r->expected ? "skipped"
                          : r->verdict == GLINT_BROKEN               ? "error"
                                                                     : "failure";
    char whole[sizeof message + 32];
    snprintf(whole, sizeof whole, "%s%s", r->expected ? "failed, as expected: " : "", message);
    fprintf(out, "      <%s", element);
    put_attribute(out, "message", whole);
    fputs("/>\n", out);
}

static void put_case(FILE *out, const char *suite, const glint_selftest_result *r)
{
    fputs("    <testcase", out);
    put_attribute(out, "classname", suite);
    put_attribute(out, "name", r->name);
    fprintf(out, " time=\"%.3f\">\n", r->ms / 1e3);
    if (r->verdict != GLINT_PASSED) {
        put_trouble(out, r);
    }
    fputs("      <system-out>", out);
    put_measures(out, r);
    fputs("</system-out>\n    </testcase>\n", out);
}

typedef struct suite_counts {
    size_t tests, failures, errors, skipped;
    double ms;
} suite_counts;

static suite_counts count_results(const glint_selftest_result *results, size_t count)
{
    suite_counts c = {.tests = count};
    for (size_t i = 0; i < count; i++) {
        const bool counts = !results[i].expected;
        c.failures += counts && results[i].verdict == GLINT_FAILED;
        c.errors += counts && results[i].verdict == GLINT_BROKEN;
        c.skipped += !counts || results[i].verdict == GLINT_SKIPPED;
        c.ms += results[i].ms;
    }
    return c;
}

static void put_counts(FILE *out, const suite_counts *c)
{
    fprintf(out, " tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" skipped=\"%zu\" time=\"%.3f\"",
            c->tests, c->failures, c->errors, c->skipped, c->ms / 1e3);
}

static bool in_one_suite(const glint_selftest_result *a, const glint_selftest_result *b)
{
    return a->precision == b->precision && a->width == b->width;
}

static void put_suite(FILE *out, const glint_selftest_run_report *run,
                      const glint_selftest_result *results, size_t count)
{
    char name[64];
    snprintf(name, sizeof name, "glint.selftest.%s.width%d",
             results->precision == GLINT_PRECISION_DOUBLE ? "double" : "float", results->width);
    const suite_counts counts = count_results(results, count);
    fputs("  <testsuite", out);
    put_attribute(out, "name", name);
    put_counts(out, &counts);
    put_attribute(out, "timestamp", run->date);
    char seed[16];
    snprintf(seed, sizeof seed, "%u", (unsigned)run->seed);
    fputs(">\n    <properties>\n", out);
    put_property(out, "glint", GLINT_VERSION);
    put_property(out, "system", run->machine);
    put_property(out, "seed", seed);
    put_property(out, "device", run->device->name);
    put_property(out, "platform", run->device->platform);
    put_property(out, "driver", run->device->driver);
    put_property(out, "opencl", run->device->opencl_version);
    fputs("    </properties>\n", out);
    for (size_t i = 0; i < count; i++) {
        put_case(out, name, &results[i]);
    }
    fputs("  </testsuite>\n", out);
}

static void put_document(FILE *out, const glint_selftest_run_report *run)
{
    const suite_counts counts = count_results(run->results, run->count);
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"glint selftest\"", out);
    put_counts(out, &counts);
    fputs(">\n", out);
    for (size_t first = 0; first < run->count;) {
        size_t end = first + 1;
        while (end < run->count && in_one_suite(&run->results[first], &run->results[end])) {
            end++;
        }
        put_suite(out, run, &run->results[first], end - first);
        first = end;
    }
    fputs("</testsuites>\n", out);
}

glint_status glint_junit_write(const char *path, const glint_selftest_run_report *run,
                               glint_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL) {
        return glint_fail_memory(error, "a report");
    }
    put_document(out, run);
    const bool whole = ferror(out) == 0;
    const glint_status status = fclose(out) == 0 && whole
                                    ? glint_output_file_write(path, text, size, error)
                                    : glint_fail_memory(error, "a report");
    free(text);
    return status;
}
