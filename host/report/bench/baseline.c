// Compares a run of the benchmark with an earlier run. See baseline.h.
#include "report/bench/baseline.h"

#include "report/bench/bench_json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The members that must be equal to make two times comparable. The versions of driver and program,
// the plan and the kernels may differ: the comparison is about them.
static const char *const identity[] = {
    "device.name", "device.compute_units", "settings", "environment.name", "environment.width",
    "camera",      "scene.triangle_count",
};

static const json_t *find_scene(const json_t *baseline, const char *name)
{
    const json_t *list = json_object_get(baseline, "scenes");
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *scene = json_array_get(list, i);
        const char *found = glint_json_text_at(scene, "name");
        if (found != NULL && strcmp(found, name) == 0) {
            return scene;
        }
    }
    return NULL;
}

static glint_status check_form(const json_t *root, const char *path, glint_error *error)
{
    const char *format = glint_json_text_at(root, "format");
    if (format == NULL || strcmp(format, GLINT_BENCH_FORMAT) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: not a result of glint bench (write one with --json)", path);
    }
    const json_t *schema = json_object_get(root, "schema");
    if (json_integer_value(schema) != GLINT_BENCH_SCHEMA) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: schema %lld, and this program reads schema %d (measure anew)", path,
                          (long long)json_integer_value(schema), GLINT_BENCH_SCHEMA);
    }
    const json_t *list = json_object_get(root, "scenes");
    if (json_array_size(list) == 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: scenes: a list with entries is expected",
                          path);
    }
    for (size_t i = 0; i < json_array_size(list); i++) {
        if (glint_json_text_at(json_array_get(list, i), "name") == NULL) {
            return glint_fail(error, GLINT_BAD_INPUT, "%s: scenes[%zu]: it has no name", path, i);
        }
    }
    return GLINT_OK;
}

// Adds the settings that an older file lacks. Their defaults are the behaviour of that time.
static void complete_settings(json_t *root)
{
    json_t *usual = glint_json_settings(&glint_settings_default);
    json_t *list = json_object_get(root, "scenes");
    for (size_t i = 0; i < json_array_size(list); i++) {
        json_t *settings = json_object_get(json_array_get(list, i), "settings");
        (void)json_object_update_missing(settings, usual); // fails if `settings` is no object
    }
    json_decref(usual);
}

glint_status glint_baseline_load(const char *path, json_t **baseline, glint_error *error)
{
    TRY(glint_json_read(path, baseline, error));
    glint_status status = check_form(*baseline, path, error);
    if (status != GLINT_OK) {
        json_decref(*baseline);
        *baseline = NULL;
    } else {
        complete_settings(*baseline);
    }
    return status;
}

// Formats a value for a message: shortened, or "missing".
static void format_value(const json_t *value, char *text, size_t capacity)
{
    char *dump = value != NULL ? json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT) : NULL;
    snprintf(text, capacity, "%.100s", dump != NULL ? dump : "missing");
    free(dump);
}

// The place of an entry, for messages.
typedef struct place {
    const char *path, *scene;
} place;

static glint_status fail_different(const place *at, const char *what, const json_t *now,
                                   const json_t *before, glint_error *error)
{
    char here[128], there[128];
    format_value(now, here, sizeof here);
    format_value(before, there, sizeof there);
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: scene %s: %s is %s there and %s here (only like is compared with like)",
                      at->path, at->scene, what, there, here);
}

// Fails if the member `what` differs. If it is an object, the message names its first differing
// member.
static glint_status check_member(const place *at, const char *what, json_t *now, json_t *before,
                                 glint_error *error)
{
    if (json_equal(now, before)) {
        return GLINT_OK;
    }
    const char *key;
    json_t *value;
    json_object_foreach(now, key, value)
    {
        json_t *other = json_object_get(before, key);
        if (!json_equal(value, other)) {
            char name[128];
            snprintf(name, sizeof name, "%s.%s", what, key);
            return fail_different(at, name, value, other, error);
        }
    }
    return fail_different(at, what, now, before, error);
}

static glint_status check_identity(const place *at, const json_t *now, const json_t *before,
                                   glint_error *error)
{
    for (size_t i = 0; i < sizeof identity / sizeof *identity; i++) {
        TRY(check_member(at, identity[i], glint_json_at(now, identity[i]),
                         glint_json_at(before, identity[i]), error));
    }
    return GLINT_OK;
}

// The times that decide a comparison, milliseconds per frame.
typedef struct times {
    double median, lower, upper;
} times;

static glint_status read_times(const place *at, const json_t *scene, times *result,
                               glint_error *error)
{
    const json_t *kernel = glint_json_at(scene, "frames.kernel");
    *result =
        (times){glint_json_real_at(kernel, "median"), glint_json_real_at(kernel, "lower_quartile"),
                glint_json_real_at(kernel, "upper_quartile")};
    // This form also refuses NaN.
    if (!(result->lower > 0 && result->median >= result->lower &&
          result->upper >= result->median)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: scene %s: frames.kernel holds no median and quartiles (it was not "
                          "measured, or its picture was wrong)",
                          at->path, at->scene);
    }
    return GLINT_OK;
}

static glint_verdict judge(const times *before, const times *now, double margin)
{
    if (now->median > before->median * (1 + margin) && now->lower > before->upper) {
        return GLINT_VERDICT_SLOWER;
    }
    if (before->median > now->median * (1 + margin) && before->lower > now->upper) {
        return GLINT_VERDICT_FASTER;
    }
    return GLINT_VERDICT_SAME;
}

glint_status glint_baseline_compare(const glint_baseline *baseline, const json_t *scene,
                                    glint_comparison *comparison, glint_error *error)
{
    *comparison = (glint_comparison){GLINT_VERDICT_MISSING, NAN, NAN};
    const char *name = glint_json_text_at(scene, "name");
    const json_t *earlier = find_scene(baseline->document, name);
    if (earlier == NULL) {
        return GLINT_OK;
    }
    const place there = {baseline->path, name}, here = {"this run", name};
    times before = {0}, now = {0};
    TRY(check_identity(&there, scene, earlier, error));
    TRY(read_times(&there, earlier, &before, error));
    TRY(read_times(&here, scene, &now, error));
    *comparison =
        (glint_comparison){judge(&before, &now, baseline->margin), before.median, now.median};
    return GLINT_OK;
}

json_t *glint_comparison_json(const char *name, const glint_comparison *comparison)
{
    static const char *const verdicts[] = {
        [GLINT_VERDICT_SAME] = "same",
        [GLINT_VERDICT_FASTER] = "faster",
        [GLINT_VERDICT_SLOWER] = "slower",
        [GLINT_VERDICT_MISSING] = "not in the baseline",
    };
    json_t *object = json_object();
    glint_json_put_text(object, "name", name);
    glint_json_put_text(object, "verdict", verdicts[comparison->verdict]);
    glint_json_put_real(object, "milliseconds_before", comparison->before);
    glint_json_put_real(object, "milliseconds_now", comparison->now);
    glint_json_put_real(object, "change", comparison->now / comparison->before - 1);
    return object;
}
