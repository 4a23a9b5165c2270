// Tests the processes that read and write image files: threads share them, a fork has its own, and
// those that died are started anew.
#include "image/image_io.h"
#include "support/image_files.h"
#include "support/scratch.h"

#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

// Threads share one codec.
static void *read_and_write(void *argument)
{
    const char *name = argument;
    for (int round = 0; round < 12; round++) {
        glint_image read;
        if (glint_image_read(scratch_path("shared.jpg"), &read, NULL, NULL) != GLINT_OK ||
            glint_image_write(name, &read, NULL, NULL) != GLINT_OK) {
            return argument;
        }
        glint_image_free(&read);
    }
    return NULL;
}

static void threads_may_read_and_write_at_once(void **state)
{
    (void)state;
    enum { THREADS = 4 };
    static const char *const names[THREADS] = {"t.exr", "t.png", "t.tif", "t.hdr"};
    static char paths[THREADS][512];
    pthread_t threads[THREADS];
    image_file_write_noise("shared.jpg", 3);
    for (int i = 0; i < THREADS; i++) {
        snprintf(paths[i], sizeof paths[i], "%s", scratch_path(names[i]));
        assert_int_equal(pthread_create(&threads[i], NULL, read_and_write, paths[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        void *failed = NULL;
        pthread_join(threads[i], &failed);
        assert_null(failed);
    }
    assert_int_equal(scratch_count(), THREADS + 1);
}

// The one child of a process. Its main thread must have started it.
static pid_t child_of(pid_t process)
{
    char path[64];
    int child = 0;
    snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)process, (int)process);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        print_message("skipped: this kernel does not list children\n");
        skip();
    }
    assert_int_equal(fscanf(file, "%d", &child), 1);
    fclose(file);
    return child;
}

// Kills the codec, our child. Waits until all its threads are gone, and leaves a zombie.
static void end_codec(pid_t codec)
{
    siginfo_t how;
    assert_int_equal(kill(codec, SIGKILL), 0);
    assert_int_equal(waitid(P_PID, (id_t)codec, &how, WEXITED | WNOWAIT), 0);
}

// Kills the encoder, a child of the codec. Waits until the codec has noticed.
static void end_encoder(pid_t encoder)
{
    assert_int_equal(kill(encoder, SIGKILL), 0);
    while (kill(encoder, 0) == 0) {
        usleep(1000);
    }
}

static void processes_that_died_are_started_anew(void **state)
{
    (void)state;
    image_file_write_noise("a.exr", 4);
    const pid_t codec = child_of(getpid());
    end_encoder(child_of(codec));
    image_file_write_noise("b.exr", 4);
    assert_int_equal(child_of(getpid()), codec);
    end_codec(codec);
    image_file_write_noise("c.exr", 4);
    assert_true(child_of(getpid()) != codec);
    size_t lengths[3];
    for (int i = 0; i < 3; i++) {
        static const char *const names[] = {"a.exr", "b.exr", "c.exr"};
        glint_image read = image_file_read(names[i], NULL);
        glint_image_free(&read);
        free(scratch_read(names[i], &lengths[i]));
    }
    assert_true(lengths[0] == lengths[1] && lengths[0] == lengths[2]);
    assert_int_equal(scratch_count(), 3);
}

static void *write_small(void *path)
{
    float pixel[3] = {0.25f, 0.5f, 1.0f};
    const glint_image image = {1, 1, 3, pixel};
    return glint_image_write(path, &image, NULL, NULL) == GLINT_OK ? NULL : path;
}

// A regression test: the first images of an encoder each set OpenImageIO's number of threads, at
// once, and it crashed.
static void a_new_encoder_may_begin_with_several_images(void **state)
{
    (void)state;
    enum { THREADS = 4, ROUNDS = 60 };
    static char paths[THREADS][512];
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d.%s", i, i % 2 == 0 ? "hdr" : "exr");
        snprintf(paths[i], sizeof paths[i], "%s", scratch_path(name));
    }
    for (int round = 0; round < ROUNDS; round++) {
        glint_image_use_threads(1 + round % 2);
        for (int i = 0; i < THREADS; i++) {
            assert_int_equal(pthread_create(&threads[i], NULL, write_small, paths[i]), 0);
        }
        for (int i = 0; i < THREADS; i++) {
            void *failed = NULL;
            pthread_join(threads[i], &failed);
            assert_null(failed);
        }
        if (round % 3 != 0) { // the others change the number in an encoder that runs
            end_encoder(child_of(child_of(getpid())));
        }
    }
    glint_image_use_threads(0);
}

// A process that forks must not share memory files or the codec with its child.
static void a_fork_writes_too(void **state)
{
    (void)state;
    image_file_write_noise("a.exr", 4);
    const pid_t process = fork();
    if (process == 0) {
        glint_image image;
        const bool is_written =
            glint_image_read(scratch_path("a.exr"), &image, NULL, NULL) == GLINT_OK &&
            glint_image_write(scratch_path("b.exr"), &image, NULL, NULL) == GLINT_OK;
        _exit(is_written ? 0 : 1);
    }
    for (int i = 0; i < 20; i++) {
        image_file_write_noise("c.exr", 3);
    }
    int how = 0;
    assert_int_equal(waitpid(process, &how, 0), process);
    assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 0);
    glint_image first = image_file_read("a.exr", NULL), second = image_file_read("b.exr", NULL);
    assert_memory_equal(first.pixels, second.pixels, sizeof(float) * 40 * 30 * 4);
    glint_image_free(&first);
    glint_image_free(&second);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(threads_may_read_and_write_at_once),
        IN_FOLDER(processes_that_died_are_started_anew),
        IN_FOLDER(a_new_encoder_may_begin_with_several_images),
        IN_FOLDER(a_fork_writes_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
