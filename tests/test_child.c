// Tests work in a child process.
#include "base/child.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static glint_status run(glint_status (*work)(void *, char **, glint_error *), void *context,
                        char **text, glint_error *error)
{
    const glint_child child = {.work = work, .context = context};
    return glint_child_run(&child, text, error);
}

static glint_status count_up(void *context, char **text, glint_error *error)
{
    (void)error;
    int *number = context;
    (*number)++;
    size_t length = 300000; // more than a pipe holds
    *text = calloc(length + 1, 1);
    memset(*text, 'x', length);
    (*text)[0] = (char)('0' + *number);
    return GLINT_OK;
}

static void a_text_comes_back_and_nothing_else(void **state)
{
    (void)state;
    int number = 4;
    char *text;
    assert_int_equal(run(count_up, &number, &text, NULL), GLINT_OK);
    assert_int_equal(strlen(text), 300000);
    assert_int_equal(text[0], '5');
    assert_int_equal(number, 4);
    free(text);
}

static glint_status fail_with_details(void *context, char **text, glint_error *error)
{
    (void)context;
    (void)text;
    error->details = strdup("line one\nline two\n");
    return glint_fail(error, GLINT_BAD_INPUT, "scene.gltf: 100%% wrong");
}

static void an_error_comes_back_with_its_details(void **state)
{
    (void)state;
    char *text;
    glint_error error = {0};
    assert_int_equal(run(fail_with_details, NULL, &text, &error), GLINT_BAD_INPUT);
    assert_null(text);
    assert_string_equal(error.message, "scene.gltf: 100% wrong");
    assert_string_equal(error.details, "line one\nline two\n");
    glint_error_free(&error);
    assert_int_equal(run(fail_with_details, NULL, &text, NULL), GLINT_BAD_INPUT);
}

static glint_status crash(void *context, char **text, glint_error *error)
{
    (void)text;
    (void)error;
    const struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    raise(*(int *)context);
    return GLINT_OK;
}

static glint_status leave(void *context, char **text, glint_error *error)
{
    (void)context;
    (void)text;
    (void)error;
    _exit(3);
}

static void a_child_that_crashes_is_an_error(void **state)
{
    (void)state;
    char *text;
    int signal_number = SIGKILL;
    glint_error error = {0};
    assert_int_equal(run(crash, &signal_number, &text, &error), GLINT_DEVICE_FAILED);
    assert_non_null(strstr(error.message, "signal 9"));
    assert_int_equal(run(leave, NULL, &text, &error), GLINT_DEVICE_FAILED);
    assert_non_null(strstr(error.message, "status 3"));
    assert_null(text);
}

static int questions;

static bool stop_at_the_third_question(void)
{
    return ++questions >= 3;
}

static glint_status sleep_long(void *context, char **text, glint_error *error)
{
    (void)context;
    (void)text;
    (void)error;
    const struct timespec minute = {.tv_sec = 60};
    nanosleep(&minute, NULL);
    return GLINT_OK;
}

static void a_stop_ends_a_child_that_heeds_nothing(void **state)
{
    (void)state;
    for (int expendable = 0; expendable <= 1; expendable++) {
        const glint_child child = {.work = sleep_long,
                                   .stop_requested = stop_at_the_third_question,
                                   .is_expendable = expendable == 1};
        char *text;
        questions = 0;
        time_t begun = time(NULL);
        assert_int_equal(glint_child_run(&child, &text, NULL), GLINT_INTERRUPTED);
        assert_true(time(NULL) - begun < 30); // the child's sleep is a minute
        assert_null(text);
    }
}

// Removes the file once the child is abandoned.
static glint_status wait_and_clean_up(void *context, char **text, glint_error *error)
{
    (void)text;
    const struct timespec nap = {.tv_nsec = 1000000};
    while (!glint_child_is_abandoned()) {
        nanosleep(&nap, NULL);
    }
    unlink(context);
    return glint_fail(error, GLINT_INTERRUPTED, "stopped");
}

static void a_child_that_is_abandoned_can_clean_up(void **state)
{
    (void)state;
    assert_false(glint_child_is_abandoned());
    scratch_write("left", "behind", -1);
    const char *path = scratch_path("left");
    assert_int_equal(access(path, F_OK), 0);
    const glint_child child = {.work = wait_and_clean_up,
                               .context = (void *)path,
                               .stop_requested = stop_at_the_third_question};
    char *text;
    questions = 0;
    assert_int_equal(glint_child_run(&child, &text, NULL), GLINT_INTERRUPTED);
    assert_int_equal(access(path, F_OK), -1);
}

// The first takes longest. The third crashes.
static glint_status work_or_crash(void *context, char **text, glint_error *error)
{
    (void)error;
    const int number = *(const int *)context;
    const struct timespec nap = {.tv_nsec = number == 0 ? 50000000 : 1000000};
    nanosleep(&nap, NULL);
    if (number == 2) {
        _exit(7);
    }
    return asprintf(text, "%d of pid %d", number, (int)getpid()) < 0 ? GLINT_OUT_OF_MEMORY
                                                                     : GLINT_OK;
}

static void several_children_work_together(void **state)
{
    (void)state;
    enum { COUNT = 7 };
    for (int at_once = 0; at_once < 9; at_once += 4) {
        int numbers[COUNT];
        glint_child children[COUNT];
        glint_child_answer answers[COUNT];
        for (int i = 0; i < COUNT; i++) {
            numbers[i] = i;
            children[i] = (glint_child){.work = work_or_crash, .context = &numbers[i]};
        }
        glint_children_run(children, COUNT, at_once, answers);
        for (int i = 0; i < COUNT; i++) {
            assert_int_equal(answers[i].status, i == 2 ? GLINT_DEVICE_FAILED : GLINT_OK);
            assert_true(i == 2 ? strstr(answers[i].error.message, "status 7") != NULL
                               : answers[i].text[0] == '0' + i);
            free(answers[i].text);
            glint_error_free(&answers[i].error);
        }
    }
}

// Without a descriptor for a pipe no child starts, and nothing waits for one.
static void children_that_cannot_start_are_errors(void **state)
{
    (void)state;
    int number = 0;
    struct rlimit before;
    glint_child_answer answers[2];
    const glint_child child = {.work = work_or_crash, .context = &number};
    const glint_child children[] = {child, child};
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    const struct rlimit none = {.rlim_cur = 3, .rlim_max = before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &none), 0);
    alarm(60);
    glint_children_run(children, 2, 2, answers);
    alarm(0);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(answers[i].status, GLINT_DEVICE_FAILED);
        assert_non_null(strstr(answers[i].error.message, "no pipe"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_text_comes_back_and_nothing_else),
        cmocka_unit_test(an_error_comes_back_with_its_details),
        cmocka_unit_test(a_child_that_crashes_is_an_error),
        cmocka_unit_test(several_children_work_together),
        cmocka_unit_test(children_that_cannot_start_are_errors),
        cmocka_unit_test(a_stop_ends_a_child_that_heeds_nothing),
        cmocka_unit_test_setup_teardown(a_child_that_is_abandoned_can_clean_up, scratch_setup,
                                        scratch_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
