// Tests the comparison with an earlier run, on crafted reports.
#include "report/bench/baseline.h"

#include "render/settings_table.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// The compared part of a scene in a report: the median, and quartiles 4% to either side.
typedef struct crafted {
    const char *name, *device, *environment;
    double median;
    int width, triangles;
} crafted;

static const crafted plain = {"mirror", "a processor", "studio", 10, 1920, 81920};

static void format_scene(const crafted *scene, char *text, size_t capacity)
{
    snprintf(text, capacity,
             "{\"name\": \"%s\", \"device\": {\"name\": \"%s\", \"compute_units\": 2},"
             " \"settings\": {\"width\": %d, \"height\": 1080, \"depth\": \"auto\"},"
             " \"environment\": {\"name\": \"%s\", \"width\": 0},"
             " \"camera\": {\"eye\": [0.0, 0.0, 2.5]}, \"scene\": {\"triangle_count\": %d},"
             " \"frames\": {\"kernel\": {\"median\": %.6f, \"lower_quartile\": %.6f,"
             " \"upper_quartile\": %.6f}}}",
             scene->name, scene->device, scene->width, scene->environment, scene->triangles,
             scene->median, 0.96 * scene->median, 1.04 * scene->median);
}

// An entry of this run, with all settings. An older file may lack some.
static json_t *scene_of(const crafted *scene)
{
    char text[1024];
    format_scene(scene, text, sizeof text);
    json_t *value = json_loads(text, 0, NULL);
    assert_non_null(value);
    glint_settings settings = glint_settings_default;
    settings.width = scene->width;
    settings.height = 1080;
    json_object_set_new(value, "settings", glint_json_settings(&settings));
    return value;
}

static json_t *baseline_of(const crafted *scene)
{
    json_t *baseline = json_object();
    json_object_set_new(baseline, "scenes", json_pack("[o]", scene_of(scene)));
    return baseline;
}

static glint_status compare(const crafted *before, const crafted *now, glint_comparison *comparison,
                            glint_error *error)
{
    json_t *baseline = baseline_of(before);
    json_t *scene = scene_of(now);
    glint_status status = glint_baseline_compare(&(glint_baseline){baseline, "old.json", 0.1},
                                                 scene, comparison, error);
    json_decref(scene);
    json_decref(baseline);
    return status;
}

static glint_verdict verdict_at(double median)
{
    crafted now = plain;
    now.median = median;
    glint_comparison comparison;
    assert_int_equal(compare(&plain, &now, &comparison, NULL), GLINT_OK);
    assert_true(comparison.before == 10 && fabs(comparison.now - median) < 1e-6);
    return comparison.verdict;
}

static void within_the_margin_nothing_has_changed(void **state)
{
    (void)state;
    assert_int_equal(verdict_at(10), GLINT_VERDICT_SAME);
    assert_int_equal(verdict_at(10.99), GLINT_VERDICT_SAME);
    assert_int_equal(verdict_at(9.11), GLINT_VERDICT_SAME);
}

static void past_the_margin_it_is_slower_or_faster(void **state)
{
    (void)state;
    assert_int_equal(verdict_at(11.5), GLINT_VERDICT_SLOWER);
    assert_int_equal(verdict_at(1000), GLINT_VERDICT_SLOWER);
    assert_int_equal(verdict_at(8.5), GLINT_VERDICT_FASTER);
}

// Quartiles at 4% from the medians overlap up to a ratio of 1.04/0.96 = 1.083.
static void a_shift_within_the_noise_is_none_whatever_the_margin(void **state)
{
    (void)state;
    crafted now = plain;
    json_t *baseline = baseline_of(&plain);
    for (int step = 1; step <= 2; step++) {
        now.median = step == 1 ? 10.8 : 10.9;
        json_t *scene = scene_of(&now);
        glint_comparison comparison;
        assert_int_equal(glint_baseline_compare(&(glint_baseline){baseline, "old.json", 0.01},
                                                scene, &comparison, NULL),
                         GLINT_OK);
        assert_int_equal(comparison.verdict, step == 1 ? GLINT_VERDICT_SAME : GLINT_VERDICT_SLOWER);
        json_decref(scene);
    }
    json_decref(baseline);
}

static void a_scene_that_is_not_there_is_missing(void **state)
{
    (void)state;
    crafted now = plain;
    now.name = "glass";
    glint_comparison comparison;
    assert_int_equal(compare(&plain, &now, &comparison, NULL), GLINT_OK);
    assert_int_equal(comparison.verdict, GLINT_VERDICT_MISSING);
    json_t *json = glint_comparison_json("glass", &comparison);
    assert_string_equal(glint_json_text_at(json, "verdict"), "not in the baseline");
    assert_true(json_is_null(json_object_get(json, "change")));
    json_decref(json);
}

static void refuses(const crafted *before, const char *text)
{
    glint_comparison comparison;
    glint_error error = {0};
    assert_int_equal(compare(before, &plain, &comparison, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "old.json: scene mirror: "));
    if (strstr(error.message, text) == NULL) {
        print_error("%s\n", error.message);
        fail();
    }
}

static void only_like_is_compared_with_like(void **state)
{
    (void)state;
    crafted before = plain;
    before.device = "another";
    refuses(&before, "device.name is \"another\" there and \"a processor\" here");
    before = plain;
    before.width = 640;
    refuses(&before, "settings.width is 640 there and 1920 here");
    before = plain;
    before.environment = "sky.hdr";
    refuses(&before, "environment.name");
    before = plain;
    before.triangles = 12;
    refuses(&before, "scene.triangle_count is 12 there");
}

static void entries_without_times_are_refused(void **state)
{
    (void)state;
    static const char *const frames[] = {"null", "{}", "{\"kernel\": {\"median\": 1}}",
                                         "{\"kernel\": {\"median\": \"1\", \"lower_quartile\": 1, "
                                         "\"upper_quartile\": 1}}"};
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        json_t *baseline = baseline_of(&plain);
        json_t *scene = scene_of(&plain);
        json_t *entry = json_array_get(json_object_get(baseline, "scenes"), 0);
        json_object_set_new(entry, "frames", json_loads(frames[i], JSON_DECODE_ANY, NULL));
        glint_comparison comparison;
        glint_error error = {0};
        assert_int_equal(glint_baseline_compare(&(glint_baseline){baseline, "old.json", 0.1}, scene,
                                                &comparison, &error),
                         GLINT_BAD_INPUT);
        assert_non_null(strstr(error.message, "frames.kernel"));
        json_decref(scene);
        json_decref(baseline);
    }
}

static void malformed_files_are_refused_by_name(void **state)
{
    (void)state;
    static const struct {
        const char *content, *complaint;
    } files[] = {
        {"", "line 1"},
        {"{\"format\": \"glint bench\", \"schema\"", "line 1"},
        {"[]", "not a result of glint bench"},
        {"7", "line 1"},
        {"{\"format\": \"another\"}", "not a result of glint bench"},
        {"{\"format\": \"glint bench\", \"schema\": 99, \"scenes\": []}", "schema 99"},
        {"{\"format\": \"glint bench\", \"scenes\": [{\"name\": \"a\"}]}", "schema 0"},
        {"{\"format\": \"glint bench\", \"schema\": 1}", "scenes"},
        {"{\"format\": \"glint bench\", \"schema\": 1, \"scenes\": {}}", "scenes"},
        {"{\"format\": \"glint bench\", \"schema\": 1, \"scenes\": []}", "scenes"},
        {"{\"format\": \"glint bench\", \"schema\": 1, \"scenes\": [{\"name\": \"a\"}, 3]}",
         "scenes[1]"},
        {"{\"format\": \"glint bench\", \"format\": \"glint bench\"}", "duplicate"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        scratch_write("old.json", files[i].content, -1);
        glint_error error = {0};
        json_t *baseline;
        assert_int_equal(glint_baseline_load(scratch_path("old.json"), &baseline, &error),
                         GLINT_BAD_INPUT);
        assert_null(baseline);
        assert_non_null(strstr(error.message, "old.json"));
        if (strstr(error.message, files[i].complaint) == NULL) {
            print_error("%s: %s\n", files[i].content, error.message);
            fail();
        }
    }
    glint_error error = {0};
    json_t *baseline;
    assert_int_equal(glint_baseline_load(scratch_path("missing.json"), &baseline, &error),
                     GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "missing.json"));
}

// Writes a file of one scene and reads it.
static json_t *written_and_read(const char *scene)
{
    char text[1200];
    snprintf(text, sizeof text, "{\"format\": \"glint bench\", \"schema\": 1, \"scenes\": [%s]}",
             scene);
    scratch_write("old.json", text, -1);
    json_t *baseline;
    assert_int_equal(glint_baseline_load(scratch_path("old.json"), &baseline, NULL), GLINT_OK);
    return baseline;
}

static void a_report_that_was_written_is_read(void **state)
{
    (void)state;
    char scene[1024];
    format_scene(&plain, scene, sizeof scene);
    json_t *baseline = written_and_read(scene), *now = scene_of(&plain);
    glint_comparison comparison;
    assert_int_equal(
        glint_baseline_compare(&(glint_baseline){baseline, "old.json", 0}, now, &comparison, NULL),
        GLINT_OK);
    assert_int_equal(comparison.verdict, GLINT_VERDICT_SAME);
    json_decref(now);
    json_decref(baseline);
}

static glint_status compare_with(const json_t *baseline, const json_t *settings)
{
    json_t *now = scene_of(&plain);
    json_object_set(now, "settings", (json_t *)settings);
    glint_comparison comparison;
    const glint_status status =
        glint_baseline_compare(&(glint_baseline){baseline, "old.json", 0}, now, &comparison, NULL);
    json_decref(now);
    return status;
}

// A file from before a setting existed was made with its present default. This holds for every
// setting.
static void a_report_from_before_a_setting_has_its_default(void **state)
{
    (void)state;
    for (size_t i = 0; i < glint_setting_count; i++) {
        const char *key = glint_setting_table[i].key;
        if (key == NULL) {
            continue;
        }
        json_t *settings = glint_json_settings(&glint_settings_default);
        json_t *older = scene_of(&plain);
        json_object_set_new(older, "settings", json_copy(settings));
        json_object_del(json_object_get(older, "settings"), key);
        char *text = json_dumps(older, 0);
        json_t *baseline = written_and_read(text);
        assert_int_equal(compare_with(baseline, settings), GLINT_OK);
        json_object_set_new(settings, key, json_string("another"));
        assert_int_equal(compare_with(baseline, settings), GLINT_BAD_INPUT);
        free(text);
        json_decref(baseline);
        json_decref(older);
        json_decref(settings);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(within_the_margin_nothing_has_changed),
        cmocka_unit_test(past_the_margin_it_is_slower_or_faster),
        cmocka_unit_test(a_shift_within_the_noise_is_none_whatever_the_margin),
        cmocka_unit_test(a_scene_that_is_not_there_is_missing),
        cmocka_unit_test(only_like_is_compared_with_like),
        cmocka_unit_test(entries_without_times_are_refused),
        cmocka_unit_test_setup_teardown(malformed_files_are_refused_by_name, scratch_setup,
                                        scratch_teardown),
        cmocka_unit_test_setup_teardown(a_report_that_was_written_is_read, scratch_setup,
                                        scratch_teardown),
        cmocka_unit_test_setup_teardown(a_report_from_before_a_setting_has_its_default,
                                        scratch_setup, scratch_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
