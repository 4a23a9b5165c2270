// Runs work in a child process. See child.h.
#include "base/child.h"

#include "base/whole_io.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define ASK_MS 100       // interval between two calls of stop_requested
#define PATIENCE_MS 1000 // time from abandoning a child to SIGKILL
#define NAP_MS 5

// The first bytes that the child sends. The bytes of details and text follow, without their final
// 0.
typedef struct answer {
    glint_status status;
    char message[GLINT_MESSAGE_CAPACITY];
    size_t details_length, text_length;
    bool has_details;
} answer;

static int own_pipe = -1; // in a child: the pipe for its answer

bool glint_child_is_abandoned(void)
{
    // poll reports POLLERR for a pipe whose other end is closed, even if not asked for it.
    struct pollfd pipe = {.fd = own_pipe};
    return own_pipe >= 0 && poll(&pipe, 1, 0) > 0 && (pipe.revents & POLLERR) != 0;
}

_Noreturn static void be_child(const glint_child *child, int pipe)
{
    own_pipe = pipe;
    if (child->is_expendable) { // the child ends with its parent, even if it blocks signals
        prctl(PR_SET_PDEATHSIG, SIGKILL);
    }
    char *text = NULL;
    glint_error error = {0};
    answer reply = {.status = child->work(child->context, &text, &error)};
    memcpy(reply.message, error.message, sizeof reply.message);
    reply.has_details = error.details != NULL;
    reply.details_length = reply.has_details ? strlen(error.details) : 0;
    reply.text_length = text != NULL ? strlen(text) : 0;
    bool sent = glint_write_all(pipe, &reply, sizeof reply) &&
                glint_write_all(pipe, error.details, reply.details_length) &&
                glint_write_all(pipe, text, reply.text_length);
    _exit(sent ? 0 : 1);
}

// Returns true once `pipe` can be read, false if a stop is requested first.
static bool wait_for(int pipe, const glint_child *child)
{
    struct pollfd waited = {.fd = pipe, .events = POLLIN};
    for (;;) {
        if (child->stop_requested != NULL && child->stop_requested()) {
            return false;
        }
        if (poll(&waited, 1, ASK_MS) > 0) {
            return true;
        }
    }
}

static bool receive_all(int pipe, const glint_child *child, void *to, size_t size)
{
    for (char *bytes = to; size > 0;) {
        if (!wait_for(pipe, child)) {
            return false;
        }
        ssize_t done = read(pipe, bytes, size);
        if (done == 0 || (done < 0 && errno != EINTR)) {
            return false;
        }
        if (done > 0) {
            bytes += done;
            size -= (size_t)done;
        }
    }
    return true;
}

// Receives a text of `length` bytes and terminates it. NULL if it does not arrive or memory is
// short.
static char *receive_text(int pipe, const glint_child *child, size_t length)
{
    char *text = calloc(length + 1, 1);
    if (text != NULL && !receive_all(pipe, child, text, length)) {
        free(text);
        text = NULL;
    }
    return text;
}

// Returns false if the child did not send its whole answer.
static bool receive(int pipe, const glint_child *child, glint_status *status, char **text,
                    glint_error *error)
{
    answer reply;
    if (!receive_all(pipe, child, &reply, sizeof reply)) {
        return false;
    }
    *status = reply.status;
    if (reply.status != GLINT_OK) {
        glint_fail(error, reply.status, "%s", reply.message);
    }
    if (reply.has_details) {
        char *details = receive_text(pipe, child, reply.details_length);
        if (details == NULL) {
            return false;
        }
        if (error != NULL) {
            error->details = details;
        } else {
            free(details);
        }
    }
    if (reply.status == GLINT_OK) {
        // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): both callers have room for it
        *text = receive_text(pipe, child, reply.text_length);
    }
    return reply.status != GLINT_OK || *text != NULL;
}

static pid_t reap(pid_t process, int *how, int options)
{
    pid_t result;
    do {
        result = waitpid(process, how, options);
    } while (result < 0 && errno == EINTR);
    return result;
}

// Ends an abandoned child whose pipe is closed: waits up to PATIENCE_MS, then kills it.
static void end_child(pid_t process, bool is_expendable)
{
    int how;
    const struct timespec nap = {.tv_nsec = NAP_MS * 1000000L};
    for (int waited = 0; !is_expendable && waited < PATIENCE_MS; waited += NAP_MS) {
        if (reap(process, &how, WNOHANG) != 0) {
            return;
        }
        nanosleep(&nap, NULL);
    }
    kill(process, SIGKILL);
    reap(process, &how, 0);
}

// Describes the end of a child that gave no answer.
static glint_status fail_without_answer(int how, glint_error *error)
{
    if (WIFSIGNALED(how)) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "the process that did the work was ended by signal %d, %s (the driver's "
                          "fault, or too little memory)",
                          WTERMSIG(how), strsignal(WTERMSIG(how)));
    }
    return glint_fail(error, GLINT_DEVICE_FAILED,
                      "the process that did the work ended early, with status %d",
                      WIFEXITED(how) ? WEXITSTATUS(how) : -1);
}

typedef struct running {
    const glint_child *child;
    pid_t process;
    int pipe; // its answer
} running;

// Returns false with GLINT_DEVICE_FAILED in `error`.
static bool start(const glint_child *child, running *started, glint_error *error)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        glint_fail(error, GLINT_DEVICE_FAILED, "no pipe to another process: %s", strerror(errno));
        return false;
    }
    const pid_t process = fork();
    if (process == 0) {
        close(ends[0]);
        be_child(child, ends[1]);
    }
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        glint_fail(error, GLINT_DEVICE_FAILED, "no other process: %s", strerror(errno));
        return false;
    }
    *started = (running){child, process, ends[0]};
    return true;
}

// Waits for the answer and for the end of the child.
static glint_status finish(const running *r, char **text, glint_error *error)
{
    const glint_child *child = r->child;
    glint_status status = GLINT_OK;
    const bool answered = receive(r->pipe, child, &status, text, error);
    close(r->pipe);
    if (!answered && child->stop_requested != NULL && child->stop_requested()) {
        end_child(r->process, child->is_expendable);
        return glint_fail(error, GLINT_INTERRUPTED, "stopped");
    }
    int how = 0;
    reap(r->process, &how, 0);
    return answered ? status : fail_without_answer(how, error);
}

glint_status glint_child_run(const glint_child *child, char **text, glint_error *error)
{
    running r = {0};
    *text = NULL;
    return start(child, &r, error) ? finish(&r, text, error) : GLINT_DEVICE_FAILED;
}

void glint_children_run(const glint_child *children, size_t count, int at_once,
                        glint_child_answer *answers)
{
    enum { MOST = 64 };
    running all[MOST] = {{0}};
    struct pollfd pipes[MOST] = {{0}};
    const size_t most = at_once < 1 ? 1 : at_once > MOST ? MOST : (size_t)at_once;
    size_t next = 0, together = 0;
    memset(answers, 0, count * sizeof *answers);
    while (next < count || together > 0) {
        for (; next < count && together < most; next++) {
            glint_child_answer *a = &answers[next];
            a->status = GLINT_DEVICE_FAILED;
            together += start(&children[next], &all[together], &a->error);
        }
        for (size_t i = 0; i < together; i++) {
            pipes[i] = (struct pollfd){.fd = all[i].pipe, .events = POLLIN};
        }
        if (together > 0) { // else none could be started
            poll(pipes, (nfds_t)together, -1);
        }
        for (size_t i = together; i-- > 0;) {
            if (pipes[i].revents != 0) {
                glint_child_answer *a = &answers[all[i].child - children];
                a->status = finish(&all[i], &a->text, &a->error);
                all[i] = all[--together];
            }
        }
    }
}
