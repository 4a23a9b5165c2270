// Tests the sandbox of the codec's children: it may only read files, compute in threads, and
// answer.
#include "codec/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#define MIB (UINT64_C(1) << 20)

#define NO_SANDBOX 100

// Runs in a child, because a sandbox cannot be left. Returns the number of the first failed
// attempt, or 0. Skips on systems without sandboxes.
static int in_child(bool may_open, int (*attempt)(void))
{
    const pid_t process = fork();
    if (process == 0) {
        _exit(glint_sandbox_enter(may_open) ? attempt() : NO_SANDBOX);
    }
    int how = 0;
    assert_int_equal(waitpid(process, &how, 0), process);
    assert_true(WIFEXITED(how));
    if (WEXITSTATUS(how) == NO_SANDBOX) {
        print_message("skipped: this system has no seccomp\n");
        skip();
    }
    return WEXITSTATUS(how);
}

static int is_refused(long result)
{
    return result == -1 && errno == EPERM;
}

static int reach_out(void)
{
    char program[] = "/bin/true";
    char *const arguments[] = {program, NULL};
    return !is_refused(open("/tmp/glint-escaped", O_WRONLY | O_CREAT, 0600))        ? 1
           : !is_refused(open("/dev/null", O_RDWR))                                 ? 2
           : !is_refused(creat("/tmp/glint-escaped", 0600))                         ? 3
           : !is_refused(unlink("/tmp/glint-escaped"))                              ? 4
           : !is_refused(rename("/tmp/a", "/tmp/b"))                                ? 5
           : !is_refused(mkdir("/tmp/glint-escaped", 0700))                         ? 6
           : !is_refused(socket(AF_INET, SOCK_STREAM, 0))                           ? 7
           : !is_refused(fork())                                                    ? 8
           : !is_refused(kill(getppid(), 0))                                        ? 9
           : !is_refused(execv(program, arguments))                                 ? 10
           : !is_refused(prlimit(getppid(), RLIMIT_CPU, &(struct rlimit){0}, NULL)) ? 11
           : !is_refused(chmod("/tmp", 01777))                                      ? 12
                                                                                    : 0;
}

static int open_files(void)
{
    return !is_refused(open("/dev/null", O_RDONLY))                     ? 1
           : !is_refused(openat(AT_FDCWD, ".", O_RDONLY | O_DIRECTORY)) ? 2
                                                                        : 0;
}

// The decoder of scenes opens none.
static void no_file_can_be_opened(void **state)
{
    (void)state;
    assert_int_equal(in_child(false, open_files), 0);
}

static void others_cannot_be_reached(void **state)
{
    (void)state;
    assert_int_equal(in_child(true, reach_out), 0);
    assert_int_equal(access("/tmp/glint-escaped", F_OK), -1);
}

static void *add_one(void *number)
{
    ++*(int *)number;
    return NULL;
}

static int work(void)
{
    pthread_t thread;
    int number = 1, file = open("/proc/self/statm", O_RDONLY);
    char byte;
    return file < 0 || read(file, &byte, 1) != 1                  ? 1
           : pthread_create(&thread, NULL, add_one, &number) != 0 ? 2
           : pthread_join(thread, NULL) != 0 || number != 2       ? 3
                                                                  : 0;
}

static void work_goes_on(void **state)
{
    (void)state;
    assert_int_equal(in_child(true, work), 0);
}

static int keep_two(void)
{
    int ends[2], other = open("/dev/null", O_RDONLY);
    if (other < 0 || pipe(ends) != 0) {
        return 1;
    }
    const int high = fcntl(ends[1], F_DUPFD, 200), kept[] = {high, -1, ends[0]};
    glint_sandbox_close_others(kept, 3);
    return fcntl(ends[0], F_GETFD) < 0                                  ? 2
           : fcntl(high, F_GETFD) < 0                                   ? 3
           : fcntl(STDERR_FILENO, F_GETFD) < 0                          ? 4
           : fcntl(other, F_GETFD) >= 0 || fcntl(ends[1], F_GETFD) >= 0 ? 5
           : fcntl(high + 1, F_GETFD) >= 0                              ? 6
                                                                        : 0;
}

static void only_given_descriptors_stay_open(void **state)
{
    (void)state;
    assert_int_equal(in_child(true, keep_two), 0);
}

static int use_memory(void)
{
    const glint_decode_limits limits = {.memory_bytes = 64 * MIB, .cpu_seconds = 5, .seconds = 60};
    glint_sandbox_limit(&limits, 1);
    void *small = malloc(32 * MIB), *large = malloc(256 * MIB);
    const int result = small == NULL ? 1 : large != NULL ? 2 : 0;
    free(small);
    free(large);
    return result;
}

static void memory_is_limited(void **state)
{
    (void)state;
#ifdef __SANITIZE_ADDRESS__
    print_message("skipped: AddressSanitizer reserves more memory than any limit\n");
    skip();
#endif
    assert_int_equal(in_child(true, use_memory), 0);
}

static void time_is_limited(void **state)
{
    (void)state;
    const pid_t process = fork();
    if (process == 0) {
        const glint_decode_limits limits = {.cpu_seconds = 1};
        glint_sandbox_limit(&limits, 1);
        for (volatile unsigned count = 0;; count = count + 1) {
        }
    }
    int how = 0;
    assert_int_equal(waitpid(process, &how, 0), process);
    assert_true(WIFSIGNALED(how));
    assert_int_equal(WTERMSIG(how), SIGXCPU);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(others_cannot_be_reached),
        cmocka_unit_test(no_file_can_be_opened),
        cmocka_unit_test(work_goes_on),
        cmocka_unit_test(only_given_descriptors_stay_open),
        cmocka_unit_test(memory_is_limited),
        cmocka_unit_test(time_is_limited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
