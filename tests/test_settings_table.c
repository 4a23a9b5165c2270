// Tests the table of settings and its readers. The tests hold for every row, so a new row needs no
// new test.
#include "render/settings_table.h"
#include "report/frame/fingerprint.h"
#include "report/json.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const glint_capabilities able = {.has_double = true};
static const glint_scene nothing = {0};

static glint_status check(const glint_settings *settings, glint_error *error)
{
    return glint_settings_check(settings, &able, &nothing, error);
}

// Reads `text` as the option's value. Errors: those of the option.
static glint_status read(const glint_setting *setting, const char *text, glint_settings *settings)
{
    char *destination = (char *)settings + glint_setting_destination(setting);
    return glint_option_parse(&setting->option, text, destination, NULL);
}

// Changes a setting to a valid value that is not its default. Choices change to the second; the
// first is 0.
static void change(const glint_setting *setting, glint_settings *settings)
{
    static const char *const texts[] = {"1", "2", "0.5", "16", "4", "tir", "transparent", "64x48"};
    char *member = (char *)settings + setting->offset;
    if (setting->group == GLINT_SETTINGS_INTERNAL) {
        *member = 1; // the least byte of an int, an enum or a bool
        return;
    }
    if (setting->option.choices != NULL) {
        assert_int_equal(read(setting, setting->option.choices[1], settings), GLINT_OK);
    }
    for (size_t i = 0; !glint_setting_differs(setting, settings, &glint_settings_default); i++) {
        assert_true(i < sizeof texts / sizeof *texts);
        (void)read(setting, texts[i], settings);
    }
}

static const glint_setting *row(size_t i, glint_settings *changed)
{
    *changed = glint_settings_default;
    change(&glint_setting_table[i], changed);
    return &glint_setting_table[i];
}

static void defaults_are_in_range(void **state)
{
    (void)state;
    assert_int_equal(check(&glint_settings_default, NULL), GLINT_OK);
}

static void a_value_is_read_as_it_is_printed(void **state)
{
    (void)state;
    for (size_t i = 0; i < glint_setting_count; i++) {
        glint_settings changed, again = glint_settings_default;
        const glint_setting *setting = row(i, &changed);
        if (setting->group != GLINT_SETTINGS_INTERNAL) {
            char text[GLINT_SETTING_TEXT];
            glint_setting_print(setting, &changed, text);
            assert_int_equal(read(setting, text, &again), GLINT_OK);
            assert_false(glint_setting_differs(setting, &again, &changed));
            assert_int_equal(check(&changed, NULL), GLINT_OK);
        }
    }
}

static void refuses(const glint_settings *settings, const glint_setting *setting)
{
    char name[64];
    glint_error error = {0};
    snprintf(name, sizeof name, "--%s", setting->option.name);
    assert_int_equal(check(settings, &error), GLINT_USAGE);
    assert_true(strncmp(error.message, name, strlen(name)) == 0);
}

static void numbers_out_of_range_are_refused_by_name(void **state)
{
    (void)state;
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        const glint_option *option = &setting->option;
        glint_settings settings = glint_settings_default;
        void *member = (char *)&settings + setting->offset;
        if (option->kind == GLINT_OPTION_REAL) {
            const double wrong[] = {nextafter(option->minimum, -INFINITY),
                                    nextafter(option->maximum, INFINITY), (double)NAN, INFINITY};
            for (int k = 0; k < 4; k++) {
                *(double *)member = wrong[k];
                refuses(&settings, setting);
            }
        } else if (setting->group != GLINT_SETTINGS_INTERNAL &&
                   setting->type != GLINT_SETTING_BOOL) {
            *(int *)member = -1;
            refuses(&settings, setting);
            *(int *)member = 1 << 20;
            refuses(&settings, setting);
        }
    }
}

static void settings_that_do_not_go_together_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < glint_exclusion_count; i++) {
        const glint_setting *one = glint_setting_at(glint_exclusion_table[i].one);
        const glint_setting *other = glint_setting_at(glint_exclusion_table[i].other);
        glint_settings settings = glint_settings_default;
        change(one, &settings);
        assert_int_equal(check(&settings, NULL), GLINT_OK);
        change(other, &settings);
        char names[2][GLINT_SETTING_TEXT];
        glint_setting_print_name(one, &settings, names[0]);
        glint_setting_print_name(other, &settings, names[1]);
        glint_error error = {0};
        assert_int_equal(check(&settings, &error), GLINT_USAGE);
        assert_non_null(strstr(error.message, names[0]));
        assert_non_null(strstr(error.message, names[1]));
    }
}

static void only_some_are_variations_of_a_renderers(void **state)
{
    (void)state;
    for (size_t i = 0; i < glint_setting_count; i++) {
        glint_settings changed;
        const glint_setting *setting = row(i, &changed);
        assert_int_equal(glint_settings_are_variation(&changed, &glint_settings_default),
                         (setting->roles & GLINT_SETTING_VARIES) != 0);
    }
}

static glint_fingerprint fingerprint_of(const glint_settings *settings)
{
    const glint_plan plan = {.half_texels = true};
    const glint_subject subject = {.settings = settings, .plan = &plan};
    const glint_write_options options = {0};
    glint_fingerprint fingerprint;
    assert_int_equal(glint_fingerprint_run(&subject, "a.exr", &options, &fingerprint, NULL),
                     GLINT_OK);
    return fingerprint;
}

static void what_decides_pixels_decides_the_fingerprint(void **state)
{
    (void)state;
    bool is_taken[GLINT_FINGERPRINT_PLACES] = {false};
    const glint_fingerprint usual = fingerprint_of(&glint_settings_default);
    for (size_t i = 0; i < glint_setting_count; i++) {
        glint_settings changed;
        const glint_setting *setting = row(i, &changed);
        assert_int_equal(glint_fingerprints_equal(fingerprint_of(&changed), usual),
                         setting->fingerprint == 0);
        for (size_t k = 0; setting->fingerprint > 0 && k < glint_setting_number_count(setting);
             k++) {
            bool *place = &is_taken[(size_t)setting->fingerprint - 1 + k];
            assert_false(*place);
            *place = true;
        }
    }
    for (int i = 0; i < GLINT_FINGERPRINT_PLACES; i++) {
        assert_true(is_taken[i]);
    }
}

// Numbers stay numbers; auto and choices are words.
static void reports_hold_what_the_options_take(void **state)
{
    (void)state;
    for (size_t i = 0; i < glint_setting_count; i++) {
        glint_settings changed, again = glint_settings_default;
        const glint_setting *setting = row(i, &changed);
        json_t *object = glint_json_settings(&changed);
        const json_t *value =
            setting->key != NULL ? json_object_get(object, setting->key) : json_null();
        assert_non_null(value);
        char text[64] = "";
        if (json_is_string(value)) {
            snprintf(text, sizeof text, "%s", json_string_value(value));
        } else if (json_is_number(value)) {
            snprintf(text, sizeof text, "%.17g", json_number_value(value));
        }
        if (setting->key != NULL) {
            assert_int_equal(read(setting, text, &again), GLINT_OK);
            assert_false(glint_setting_differs(setting, &again, &changed));
        }
        assert_int_equal(json_integer_value(json_object_get(object, "width")), changed.width);
        assert_int_equal(json_integer_value(json_object_get(object, "height")), changed.height);
        json_decref(object);
    }
}

static void zeros_of_both_signs_are_one_value(void **state)
{
    (void)state;
    glint_settings settings = glint_settings_default;
    settings.mend = settings.env_rotate = -0.0;
    assert_null(glint_settings_find_changed(&settings, ~0u));
    assert_true(glint_settings_are_variation(&settings, &glint_settings_default));
    settings.mend = NAN; // NaN equals no value, not even itself
    assert_non_null(glint_settings_find_changed(&settings, ~0u));
}

static void what_weighs_errors_is_found_when_it_is_changed(void **state)
{
    (void)state;
    const unsigned role = GLINT_SETTING_WEIGHS_ERRORS;
    assert_null(glint_settings_find_changed(&glint_settings_default, role));
    for (size_t i = 0; i < glint_setting_count; i++) {
        glint_settings changed;
        const glint_setting *setting = row(i, &changed);
        assert_ptr_equal(glint_settings_find_changed(&changed, role),
                         (setting->roles & role) != 0 ? setting : NULL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_in_range),
        cmocka_unit_test(a_value_is_read_as_it_is_printed),
        cmocka_unit_test(numbers_out_of_range_are_refused_by_name),
        cmocka_unit_test(settings_that_do_not_go_together_are_refused),
        cmocka_unit_test(only_some_are_variations_of_a_renderers),
        cmocka_unit_test(what_decides_pixels_decides_the_fingerprint),
        cmocka_unit_test(reports_hold_what_the_options_take),
        cmocka_unit_test(zeros_of_both_signs_are_one_value),
        cmocka_unit_test(what_weighs_errors_is_found_when_it_is_changed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
