// Writes the JSON of glint selftest --json. See selftest_json.h.
#include "report/selftest/selftest_json.h"

#include <stdio.h>

static json_t *measure_json(const glint_measure *m)
{
    json_t *object = json_object();
    glint_json_put_text(object, "what", m->what);
    glint_json_put_text(object, "unit", m->unit);
    glint_json_put_real(object, "measured", m->measured);
    glint_json_put_real(object, "bound", m->bound);
    glint_json_put_count(object, "judged", m->judged);
    glint_json_put_flag(object, "holds", glint_measure_holds(m));
    glint_json_put_text(object, "worst", m->worst);
    return object;
}

// The names of the features in a set, separated by spaces.
static json_t *feature_set_json(uint64_t set)
{
    char names[64 * 24] = "";
    size_t length = 0;
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        if ((set >> i & 1) != 0 && length < sizeof names) {
            length += (size_t)snprintf(names + length, sizeof names - length, "%s%s",
                                       length > 0 ? " " : "", glint_feature_name((glint_feature)i));
        }
    }
    return json_string(names);
}

static json_t *result_json(const glint_selftest_result *r)
{
    json_t *object = json_object(), *measures = json_array(), *sets = json_array();
    for (int i = 0; i < r->feature_set_count; i++) {
        (void)json_array_append_new(sets, feature_set_json(r->feature_sets[i]));
    }
    for (int i = 0; i < r->measure_count; i++) {
        (void)json_array_append_new(measures, measure_json(&r->measures[i]));
    }
    glint_json_put_text(object, "case", r->name);
    glint_json_put_text(object, "precision",
                        r->precision == GLINT_PRECISION_DOUBLE ? "double" : "float");
    glint_json_put_count(object, "width", (uint64_t)r->width);
    glint_json_put_text(object, "verdict", glint_verdict_name(r->verdict));
    glint_json_put_flag(object, "expected", r->expected);
    glint_json_put_text(object, "reason", r->reason);
    glint_json_put_real(object, "milliseconds", r->ms);
    glint_json_put(object, "measures", measures);
    glint_json_put(object, "feature_sets", sets);
    return object;
}

json_t *glint_selftest_json(const glint_selftest_run_report *run)
{
    json_t *object = json_object(), *results = json_array();
    for (size_t i = 0; i < run->count; i++) {
        (void)json_array_append_new(results, result_json(&run->results[i]));
    }
    glint_json_put_text(object, "format", "glint selftest");
    glint_json_put_count(object, "schema", GLINT_SELFTEST_SCHEMA);
    glint_json_put_text(object, "glint", GLINT_VERSION);
    glint_json_put_text(object, "date", run->date);
    glint_json_put_text(object, "system", run->machine);
    glint_json_put(object, "device", glint_json_device(run->device));
    glint_json_put_count(object, "rays", run->rays);
    glint_json_put_count(object, "seed", run->seed);
    glint_json_put(object, "results", results);
    return object;
}
