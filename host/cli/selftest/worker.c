// Runs self-test cases in a child process. See worker.h.
//
// The child is a fork. So pointers to static texts are valid in both processes, and results are
// sent as they are.
#include "cli/selftest/worker.h"

#include "base/clock.h"
#include "base/whole_io.h"
#include "render/plan_device.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#define LAST_WORDS_MS 100

typedef struct request {
    size_t index;
    glint_selftest_options options;
} request;

// The child's answer: first about the device, then about each case. The text of the details
// follows.
typedef struct answer {
    glint_status status;
    char message[GLINT_MESSAGE_CAPACITY];
    size_t details_length;
    glint_capabilities capabilities;
    glint_selftest_result result;
} answer;

// ---- In the worker ------------------------------------------------------------------------------

static bool send_answer(int to, answer *a, const glint_error *error)
{
    memcpy(a->message, error->message, sizeof a->message);
    a->details_length = error->details != NULL ? strlen(error->details) : 0;
    return glint_write_all(to, a, sizeof *a) &&
           glint_write_all(to, error->details, a->details_length);
}

static void work(const char *device_name, int requests, int answers)
{
    glint_error error = {0};
    glint_device *device = NULL;
    static answer a;
    a.status = glint_device_open(device_name, &device, &error);
    if (device != NULL) {
        a.capabilities = *glint_device_capabilities(device);
    }
    bool goes_on = send_answer(answers, &a, &error) && device != NULL;
    request wanted;
    while (goes_on && glint_read_all(requests, &wanted, sizeof wanted)) {
        glint_error_free(&error);
        error = (glint_error){0};
        wanted.options.device = device;
        a.status = glint_selftest_run(wanted.index, &wanted.options, &a.result, &error);
        goes_on = send_answer(answers, &a, &error);
    }
    _exit(0); // skips the driver's exit handlers: their faults belong to no case
}

// ---- In the self-test ---------------------------------------------------------------------------

// Copies the child's stderr to ours, and keeps its end.
static void hear(selftest_worker *w)
{
    char text[4096];
    const ssize_t length = read(w->words, text, sizeof text - 1);
    if (length <= 0) {
        close(w->words);
        w->words = -1;
        return;
    }
    (void)!write(STDERR_FILENO, text, (size_t)length);
    text[length] = '\0';
    const size_t held = strlen(w->said), all = held + (size_t)length;
    const size_t room = sizeof w->said - 1, lost = all > room ? all - room : 0;
    if (lost >= held) {
        memcpy(w->said, text + (lost - held), all - lost + 1);
    } else {
        memmove(w->said, w->said + lost, held - lost);
        memcpy(w->said + held - lost, text, (size_t)length + 1);
    }
}

// Reads `size` bytes from the child until `deadline` (ms; 0: none). False if the child ended or is
// late.
static bool receive(selftest_worker *w, void *to, size_t size, double deadline, bool *is_late)
{
    char *bytes = to;
    while (size > 0) {
        struct pollfd waited[2] = {{.fd = w->answers, .events = POLLIN},
                                   {.fd = w->words, .events = POLLIN}};
        const double left = deadline > 0 ? deadline - glint_now_ms() : 1000;
        *is_late = left <= 0;
        if (*is_late) {
            return false;
        }
        if (poll(waited, 2, left < 1000 ? (int)left + 1 : 1000) <= 0) {
            continue;
        }
        if (waited[1].revents != 0) {
            hear(w);
        }
        if (waited[0].revents != 0) {
            const ssize_t done = read(w->answers, bytes, size);
            if (done == 0 || (done < 0 && errno != EINTR)) {
                return false;
            }
            bytes += done > 0 ? done : 0;
            size -= done > 0 ? (size_t)done : 0;
        }
    }
    return true;
}

static bool receive_answer(selftest_worker *w, answer *a, double limit_s, glint_error *error,
                           bool *is_late)
{
    const double deadline = limit_s > 0 ? glint_now_ms() + 1000 * limit_s : 0;
    if (!receive(w, a, sizeof *a, deadline, is_late)) {
        return false;
    }
    if (a->message[0] != '\0') {
        glint_fail(error, a->status, "%s", a->message);
    }
    if (a->details_length > 0) {
        error->details = calloc(a->details_length + 1, 1);
        return error->details != NULL &&
               receive(w, error->details, a->details_length, deadline, is_late);
    }
    return true;
}

static void close_pipes(selftest_worker *w)
{
    close(w->requests);
    close(w->answers);
    if (w->words >= 0) {
        close(w->words);
    }
}

// The last line that is not empty. Cuts the newlines at the end of `said`.
static const char *last_line(char *said)
{
    size_t end = strlen(said);
    while (end > 0 && said[end - 1] == '\n') {
        said[--end] = '\0';
    }
    const char *line = strrchr(said, '\n');
    return line != NULL ? line + 1 : said;
}

// Ends the child and describes how it ended by itself or that it was late.
static void bury(selftest_worker *w, bool is_late, char *text, size_t capacity)
{
    kill(w->process, SIGKILL); // no effect on a child that has already ended
    int how = 0;
    while (waitpid(w->process, &how, 0) < 0 && errno == EINTR) {
    }
    // Read the rest of its stderr. A process that the driver started may still hold the pipe open
    // without writing.
    struct pollfd said = {.fd = w->words, .events = POLLIN};
    while (w->words >= 0 && poll(&said, 1, LAST_WORDS_MS) > 0) {
        hear(w);
    }
    w->process = 0;
    close_pipes(w);
    char ended[64];
    if (is_late) {
        snprintf(ended, sizeof ended, "did not come back within %g s", w->limit_s);
    } else if (WIFSIGNALED(how)) {
        snprintf(ended, sizeof ended, "ended the process: %s", strsignal(WTERMSIG(how)));
    } else {
        snprintf(ended, sizeof ended, "ended the process with status %d", WEXITSTATUS(how));
    }
    const char *last = last_line(w->said);
    snprintf(text, capacity, "the driver %s%s%s%s", ended, last[0] != '\0' ? " (it said: " : "",
             last, last[0] != '\0' ? ")" : "");
}

// Forks one child at a time: otherwise a second child would inherit the first one's pipes and keep
// them open.
static glint_status fork_worker(selftest_worker *w, glint_error *error)
{
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    int pipes[3][2];
    int made = 0;
    pthread_mutex_lock(&one_at_a_time);
    // With O_CLOEXEC, programs that the driver starts, such as a linker, do not keep the pipes
    // open.
    while (made < 3 && pipe2(pipes[made], O_CLOEXEC) == 0) {
        made++;
    }
    const pid_t self = getpid();
    const pid_t process = made == 3 ? fork() : -1;
    // Set up the child: it ends with its parent, and its stderr goes into the pipe.
    if (process == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != self) {
            _exit(0);
        }
        dup2(pipes[2][1], STDERR_FILENO);
        close(pipes[0][1]);
        close(pipes[1][0]);
        work(w->device, pipes[0][0], pipes[1][1]);
    }
    // Close the ends of the pipes that the parent does not use.
    const bool done = process > 0;
    for (int i = 0; i < made; i++) {
        close(pipes[i][i == 0 ? 0 : 1]);
        if (!done) {
            close(pipes[i][i == 0 ? 1 : 0]);
        }
    }
    pthread_mutex_unlock(&one_at_a_time);
    if (!done) {
        return glint_fail(error, GLINT_DEVICE_FAILED, "no process for the device's work: %s",
                          strerror(errno));
    }
    w->process = process;
    w->requests = pipes[0][1];
    w->answers = pipes[1][0];
    w->words = pipes[2][0];
    w->said[0] = '\0';
    return GLINT_OK;
}

glint_status selftest_worker_start(selftest_worker *w, glint_error *error)
{
    TRY(fork_worker(w, error));
    static _Thread_local answer a; // too large for a stack
    bool is_late;
    if (!receive_answer(w, &a, w->limit_s, error, &is_late)) {
        char how[GLINT_MESSAGE_CAPACITY];
        bury(w, is_late, how, sizeof how);
        glint_error_free(error);
        return glint_fail(error, GLINT_DEVICE_FAILED, "while devices were looked for, %s", how);
    }
    if (a.status != GLINT_OK) {
        selftest_worker_stop(w);
        return a.status;
    }
    w->capabilities = a.capabilities;
    return GLINT_OK;
}

glint_status selftest_worker_run(selftest_worker *w, size_t index,
                                 const glint_selftest_options *options,
                                 glint_selftest_result *result, glint_error *error)
{
    if (w->process == 0) {
        TRY(selftest_worker_start(w, error));
    }
    const double begun = glint_now_ms();
    const request wanted = {index, *options};
    static _Thread_local answer a; // too large for a stack
    bool is_late = false;
    w->said[0] = '\0';
    if (glint_write_all(w->requests, &wanted, sizeof wanted) &&
        receive_answer(w, &a, w->limit_s, error, &is_late)) {
        *result = a.result;
        return a.status;
    }
    glint_error_free(error);
    *error = (glint_error){0};
    *result = (glint_selftest_result){
        .name = glint_selftest_name(index),
        .width = options->width > 0 ? options->width
                                    : glint_plan_native_width(&w->capabilities, options->precision),
        .precision = options->precision,
        .verdict = GLINT_BROKEN,
    };
    bury(w, is_late, result->reason, sizeof result->reason);
    result->ms = glint_now_ms() - begun;
    return GLINT_OK;
}

void selftest_worker_stop(selftest_worker *w)
{
    if (w->process > 0) {
        // The child waits for a case. Closing its pipe may not end it, because another child may
        // hold the pipe open too.
        kill(w->process, SIGKILL);
        close_pipes(w);
        int how;
        while (waitpid(w->process, &how, 0) < 0 && errno == EINTR) {
        }
        w->process = 0;
    }
}
