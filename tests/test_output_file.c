// Tests that output files appear whole or not at all, whatever goes wrong.
#include "image/image_io.h"
#include "image/output_file.h"
#include "support/scratch.h"

#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static glint_status write_text(const char *name, const char *text, glint_error *error)
{
    return glint_output_file_write(scratch_path(name), text, strlen(text), error);
}

static void assert_holds(const char *name, const char *text)
{
    size_t length;
    unsigned char *bytes = scratch_read(name, &length);
    assert_non_null(bytes);
    assert_int_equal(length, strlen(text));
    assert_memory_equal(bytes, text, length);
    free(bytes);
}

static void assert_fails(const char *path, const char *said)
{
    glint_error error = {0};
    assert_int_equal(glint_output_file_check(path, &error), GLINT_OUTPUT_FAILED);
    assert_int_equal(glint_output_file_write(path, "x", 1, &error), GLINT_OUTPUT_FAILED);
    if (strncmp(error.message, path, strlen(path)) != 0 || strstr(error.message, said) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, said);
    }
}

static void a_file_is_written_and_replaced_and_nothing_else_stays(void **state)
{
    (void)state;
    assert_int_equal(write_text("a.exr", "first", NULL), GLINT_OK);
    assert_holds("a.exr", "first");
    assert_int_equal(write_text("a.exr", "second, longer", NULL), GLINT_OK);
    assert_holds("a.exr", "second, longer");
    assert_int_equal(write_text("a.exr", "", NULL), GLINT_OK);
    assert_holds("a.exr", "");
    assert_int_equal(scratch_count(), 1);
}

static void permissions_follow_the_umask(void **state)
{
    (void)state;
    mode_t before = umask(027);
    assert_int_equal(write_text("a.exr", "x", NULL), GLINT_OK);
    umask(before);
    struct stat facts;
    assert_int_equal(stat(scratch_path("a.exr"), &facts), 0);
    assert_int_equal(facts.st_mode & 0777, 0640);
}

static void impossible_places_are_named(void **state)
{
    (void)state;
    assert_fails(scratch_path("missing/a.exr"), "make it first");
    assert_int_equal(mkdir(scratch_path("folder.exr"), 0777), 0);
    assert_fails(scratch_path("folder.exr"), "is a folder");
    scratch_write("file", "x", 1);
    assert_fails(scratch_path("file/a.exr"), "is no folder");
    assert_int_equal(mkfifo(scratch_path("pipe.exr"), 0666), 0);
    assert_fails(scratch_path("pipe.exr"), "no regular file");
    assert_int_equal(symlink("/dev/full", scratch_path("full.exr")), 0);
    assert_fails(scratch_path("full.exr"), "no regular file");
    assert_int_equal(symlink("nowhere", scratch_path("lost.exr")), 0);
    assert_fails(scratch_path("lost.exr"), "leads nowhere");
    assert_int_equal(scratch_count(), 5);
}

static void a_symbolic_link_is_followed_and_stays(void **state)
{
    (void)state;
    assert_int_equal(mkdir(scratch_path("elsewhere"), 0777), 0);
    scratch_write("elsewhere/real.exr", "old", -1);
    assert_int_equal(symlink("elsewhere/real.exr", scratch_path("link.exr")), 0);
    assert_int_equal(write_text("link.exr", "new", NULL), GLINT_OK);
    struct stat facts;
    assert_int_equal(lstat(scratch_path("link.exr"), &facts), 0);
    assert_true(S_ISLNK(facts.st_mode));
    assert_holds("elsewhere/real.exr", "new");
}

// Makes a temporary with the name that this program would use in another process.
static void make_temporary(const char *output, long process, char *name, size_t size)
{
    // The host part of the name is the FNV-1a hash of the machine's name, as output_file.c
    // documents. No temporary remains for inspection, even from a write that stops half-way.
    char host[256] = {0};
    gethostname(host, sizeof host - 1);
    uint32_t hash = 2166136261u;
    for (const char *c = host; *c != '\0'; c++) {
        hash = (hash ^ (unsigned char)*c) * 16777619u;
    }
    snprintf(name, size, ".%s.%ld-%08x-0.tmp.exr", output, process, hash);
    scratch_write(name, "half", -1);
}

static void temporaries_of_dead_processes_are_removed(void **state)
{
    (void)state;
    pid_t gone = fork();
    if (gone == 0) {
        _exit(0);
    }
    waitpid(gone, NULL, 0);
    char dead[256], alive[256], other[256], ours[256];
    make_temporary("a.exr", (long)gone, dead, sizeof dead);
    make_temporary("a.exr", (long)getppid(), alive, sizeof alive);
    make_temporary("b.exr", (long)gone, other, sizeof other);
    make_temporary("a.exr", (long)getpid(), ours, sizeof ours); // a process that ran before us
    scratch_write(".a.tmp.exr", "someone else's", -1);
    scratch_write(".a.exr.1-2-3x.tmp.exr", "someone else's", -1);
    assert_int_equal(write_text("a.exr", "x", NULL), GLINT_OK);
    assert_int_equal(access(scratch_path(dead), F_OK), -1);
    assert_int_equal(access(scratch_path(ours), F_OK), -1);
    assert_int_equal(access(scratch_path(alive), F_OK), 0);
    assert_int_equal(access(scratch_path(other), F_OK), -1);
    assert_int_equal(access(scratch_path(".a.tmp.exr"), F_OK), 0);
    assert_int_equal(access(scratch_path(".a.exr.1-2-3x.tmp.exr"), F_OK), 0);
}

// A limit on file sizes simulates a full disk: write() then fails in the same place.
static void a_write_that_fails_leaves_nothing_and_keeps_what_was(void **state)
{
    (void)state;
    assert_int_equal(write_text("a.exr", "before", NULL), GLINT_OK);
    pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        struct rlimit small = {1000, 1000};
        setrlimit(RLIMIT_FSIZE, &small);
        static char text[5000];
        glint_status status =
            glint_output_file_write(scratch_path("a.exr"), text, sizeof text, NULL);
        _exit(status == GLINT_OUTPUT_FAILED ? 0 : 1);
    }
    int status;
    waitpid(child, &status, 0);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_holds("a.exr", "before");
    assert_int_equal(scratch_count(), 1);
}

// Every format's encoder, with a disk too small for its file.
static void images_that_do_not_fit_on_the_disk_leave_nothing(void **state)
{
    (void)state;
    static const char *const names[] = {"a.exr", "a.hdr", "a.png", "a.jpg", "a.tif"};
    for (int k = 0; k < 5; k++) {
        pid_t child = fork();
        if (child == 0) {
            signal(SIGXFSZ, SIG_IGN);
            struct rlimit small = {300, 300};
            setrlimit(RLIMIT_FSIZE, &small);
            glint_image image;
            glint_image_create(64, 64, 3, &image, NULL);
            for (int i = 0; i < 64 * 64 * 3; i++) {
                image.pixels[i] = (float)((i * 7919) % 1009) / 1009.0f;
            }
            glint_status status = glint_image_write(scratch_path(names[k]), &image, NULL, NULL);
            _exit(status == GLINT_OUTPUT_FAILED ? 0 : 1);
        }
        int status;
        waitpid(child, &status, 0);
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    assert_int_equal(scratch_count(), 0);
}

static void stop(int number)
{
    glint_output_file_discard_all(); // NOLINT(bugprone-signal-handler,cert-sig30-c): as
                                     // documented
    _exit(128 + number);
}

// A signal stops a process that writes without end, many times at different moments. The result
// must be nothing or a whole file, and never a temporary.
static void a_signal_leaves_no_temporary(void **state)
{
    (void)state;
    enum { SIZE = 200000 };
    for (int round = 0; round < 25; round++) {
        pid_t child = fork();
        if (child == 0) {
            signal(SIGTERM, stop);
            char *bytes = calloc(1, SIZE);
            for (;;) {
                glint_output_file_write(scratch_path("a.exr"), bytes, SIZE, NULL);
            }
        }
        usleep((useconds_t)(2000 + round * 700));
        kill(child, SIGTERM);
        waitpid(child, NULL, 0);
        size_t length = 0;
        unsigned char *bytes = scratch_read("a.exr", &length);
        assert_true(bytes == NULL || length == SIZE);
        assert_int_equal(scratch_count(), bytes == NULL ? 0 : 1);
        free(bytes);
    }
}

static void *write_without_end(void *name)
{
    for (;;) {
        glint_output_file_write(name, "x", 1, NULL);
    }
    return NULL;
}

// The signal reaches one thread while other threads create temporaries.
static void a_signal_to_another_thread_leaves_no_temporary(void **state)
{
    (void)state;
    enum { WRITERS = 4, ROUNDS = 60 };
    for (int round = 0; round < ROUNDS; round++) {
        static const char *const names[WRITERS] = {"0.exr", "1.exr", "2.exr", "3.exr"};
        pid_t child = fork();
        if (child == 0) {
            for (int k = 0; k < WRITERS; k++) {
                pthread_t thread;
                pthread_create(&thread, NULL, write_without_end, (void *)scratch_path(names[k]));
            }
            usleep((useconds_t)(1000 + round * 50));
            stop(SIGTERM);
        }
        waitpid(child, NULL, 0);
        int whole = 0;
        for (int k = 0; k < WRITERS; k++) {
            whole += access(scratch_path(names[k]), F_OK) == 0;
        }
        assert_int_equal(scratch_count(), whole);
    }
}

static void long_names_find_a_temporary(void **state)
{
    (void)state;
    char name[251];
    memset(name, 'n', 246);
    memcpy(name + 246, ".exr", 5);
    assert_int_equal(write_text(name, "x", NULL), GLINT_OK);
    assert_holds(name, "x");
    assert_int_equal(scratch_count(), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(a_file_is_written_and_replaced_and_nothing_else_stays),
        IN_FOLDER(permissions_follow_the_umask),
        IN_FOLDER(impossible_places_are_named),
        IN_FOLDER(a_symbolic_link_is_followed_and_stays),
        IN_FOLDER(temporaries_of_dead_processes_are_removed),
        IN_FOLDER(a_write_that_fails_leaves_nothing_and_keeps_what_was),
        IN_FOLDER(images_that_do_not_fit_on_the_disk_leave_nothing),
        IN_FOLDER(a_signal_leaves_no_temporary),
        IN_FOLDER(a_signal_to_another_thread_leaves_no_temporary),
        IN_FOLDER(long_names_find_a_temporary),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
