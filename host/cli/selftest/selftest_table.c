// Prints the results of a self-test as a table. See selftest_table.h.
#include "cli/selftest/selftest_table.h"

#include <string.h>

#define CASE_COLUMNS 23
#define WHAT_COLUMNS 50

// Prints UTF-8 text padded with spaces to `columns`; printf would count bytes.
static void print_filled(const char *text, int columns, FILE *out)
{
    int written = 0;
    for (const char *c = text; *c != '\0'; c++) {
        written += (*c & 0xC0) != 0x80; // not a continuation byte
    }
    fprintf(out, "%s%*s", text, columns > written ? columns - written : 0, "");
}

void glint_selftest_print_device(const glint_capabilities *device, FILE *out)
{
    fprintf(out, "device   %s\nplatform %s, driver %s\n", device->name, device->platform,
            device->driver);
}

void glint_selftest_print_head(const glint_selftest_result *result, FILE *out)
{
    const bool is_double = result->precision == GLINT_PRECISION_DOUBLE;
    fprintf(out, "\n%s, packets of %d ray%s; u is 2^%d\n\n", is_double ? "double" : "float",
            result->width, result->width == 1 ? "" : "s", is_double ? -53 : -24);
    print_filled("case", CASE_COLUMNS, out);
    print_filled("measured", WHAT_COLUMNS, out);
    fprintf(out, "%10s %10s  %-14s\n", "worst", "bound", "unit");
}

static void print_measure(const char *name, const glint_measure *m, bool expected, FILE *out)
{
    const bool holds = glint_measure_holds(m);
    print_filled(name, CASE_COLUMNS, out);
    print_filled(m->what, WHAT_COLUMNS, out);
    fprintf(out, "%10.4g %10.4g  ", m->measured, m->bound);
    print_filled(m->unit, 14, out);
    fprintf(out, " %s\n", holds ? "ok" : expected ? "failed, as expected" : "FAILED");
    if (!holds) {
        fprintf(out, "    %s\n",
                m->judged == 0        ? "nothing was judged"
                : m->worst[0] != '\0' ? m->worst
                                      : "no value was the worst");
    }
}

void glint_selftest_print(const glint_selftest_result *result, FILE *out)
{
    if (result->verdict == GLINT_SKIPPED || result->verdict == GLINT_BROKEN) {
        print_filled(result->name, CASE_COLUMNS, out);
        fprintf(out, "%s: %s\n",
                result->verdict == GLINT_SKIPPED ? "skipped"
                : result->expected               ? "broken, as expected"
                                                 : "BROKEN",
                result->reason);
        return;
    }
    for (int i = 0; i < result->measure_count; i++) {
        print_measure(i == 0 ? result->name : "", &result->measures[i], result->expected, out);
    }
}
