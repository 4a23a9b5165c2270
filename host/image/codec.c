// Starts glint-codec and sends it requests. See codec.h.
#include "image/codec.h"

#include "base/spawn.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define PATIENCE_SECONDS 30 // for an answer, beyond the request's time

static atomic_int threads_each; // set by glint_codec_use_threads

// ---- The codec's process ------------------------------------------------------------------------

// `lock` guards the other members.
static struct {
    pthread_mutex_t lock;
    pid_t owner;   // the process that started the codec; a fork of it must start its own
    pid_t process; // the codec
    int socket;    // to the codec; valid if owner is this process
    bool is_ready; // the codec has reported that it is ready
} codec = {.lock = PTHREAD_MUTEX_INITIALIZER};

bool glint_codec_find(char path[PATH_MAX])
{
    return glint_spawn_find(GLINT_CODEC_PROGRAM, path);
}

// Starts the codec unless it runs. The caller holds the lock. On a failure the error's code is
// `failure`.
static glint_status start(glint_status failure, glint_error *error)
{
    if (codec.owner == getpid()) {
        return GLINT_OK;
    }
    char path[PATH_MAX];
    if (!glint_codec_find(path)) {
        return glint_fail(error, failure,
                          GLINT_CODEC_PROGRAM ": the program that decodes and encodes images is "
                                              "not there (install glint anew)");
    }
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return glint_fail(error, failure, GLINT_CODEC_PROGRAM ": no socket to it: %s (try again)",
                          strerror(errno));
    }
    char name[] = GLINT_CODEC_PROGRAM;
    char *const arguments[] = {name, NULL};
    const int fault = glint_spawn(path, arguments, ends[1], &codec.process);
    close(ends[1]);
    if (fault != 0) {
        close(ends[0]);
        return glint_fail(error, failure, "%s: cannot be started: %s (install glint anew)", path,
                          strerror(fault));
    }
    codec.owner = getpid();
    codec.socket = ends[0];
    codec.is_ready = false;
    return GLINT_OK;
}

// Stops the codec. The caller holds the lock.
static int stop(void)
{
    close(codec.socket);
    codec.owner = 0;
    return glint_spawn_stop(codec.process);
}

// Receives one packet, an answer if it has an answer's size. Returns its bytes; 0 or −1 if the
// other end is gone, or does not answer in time (−1: wait for ever).
static ssize_t receive(int socket, int milliseconds, glint_codec_answer *answer)
{
    struct pollfd waited = {.fd = socket, .events = POLLIN};
    ssize_t length;
    do {
        const int ready = poll(&waited, 1, milliseconds);
        length = ready > 0 ? recv(socket, answer, sizeof *answer, MSG_TRUNC) : ready;
    } while (length < 0 && errno == EINTR);
    answer->message[GLINT_MESSAGE_CAPACITY - 1] = '\0';
    return length;
}

// Says why the codec did not report that it is ready, and `how` it ended. `version` is the one that
// it reported; "": it ended before.
static glint_status fail_of_start(glint_status failure, int how, const char *version,
                                  glint_error *error)
{
    if (version[0] != '\0') {
        return glint_fail(error, failure,
                          GLINT_CODEC_PROGRAM ": it is of glint %.40s, not of " GLINT_VERSION
                                              " (install glint anew)",
                          version);
    }
    if (WIFSIGNALED(how)) {
        return glint_fail(error, failure,
                          GLINT_CODEC_PROGRAM ": it was ended by signal %d, %s (free some memory, "
                                              "or run this again)",
                          WTERMSIG(how), strsignal(WTERMSIG(how)));
    }
    return glint_fail(error, failure,
                      GLINT_CODEC_PROGRAM ": it does not run (status %d) (install glint anew)",
                      WEXITSTATUS(how));
}

// Waits until the codec has loaded its libraries. The caller holds the lock. `answer` is room for
// its message.
static glint_status await_ready(glint_status failure, glint_codec_answer *answer,
                                glint_error *error)
{
    if (codec.is_ready) {
        return GLINT_OK;
    }
    const ssize_t length = receive(codec.socket, -1, answer);
    const bool is_known = length == (ssize_t)sizeof *answer && answer->kind == GLINT_CODEC_IS_READY;
    codec.is_ready = is_known && strcmp(answer->message, GLINT_VERSION) == 0;
    if (codec.is_ready) {
        return GLINT_OK;
    }
    const char *version = is_known ? answer->message : length > 0 ? "of an unknown version" : "";
    return fail_of_start(failure, stop(), version, error);
}

// ---- Requests -----------------------------------------------------------------------------------

// Submits a request. If the codec is gone, starts it once more. The caller holds the lock.
static glint_status submit(const glint_codec_request *request, const glint_codec_files *files,
                           glint_codec_answer *answer, glint_error *error)
{
    const glint_status failure =
        request->work == GLINT_ENCODE ? GLINT_OUTPUT_FAILED : GLINT_BAD_INPUT;
    for (int attempt = 0; attempt < 2; attempt++) {
        TRY(start(failure, error));
        TRY(await_ready(failure, answer, error));
        if (glint_codec_send(codec.socket, request, files)) {
            return GLINT_OK;
        }
        (void)stop();
    }
    return glint_fail(error, failure, "%s: " GLINT_CODEC_PROGRAM " does not listen (try again)",
                      request->path);
}

// Milliseconds until a request's answer is given up; −1: never. The codec ends its children itself.
static int patience_of(const glint_codec_request *request)
{
    const uint32_t seconds = request->limits.seconds;
    return seconds > 0 && seconds < INT_MAX / 1000 - PATIENCE_SECONDS
               ? (int)(seconds + PATIENCE_SECONDS) * 1000
               : -1;
}

glint_status glint_codec_ask(const glint_codec_request *request, int results, int image,
                             glint_codec_answer *answer, glint_error *error)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return glint_fail(error,
                          request->work == GLINT_ENCODE ? GLINT_OUTPUT_FAILED : GLINT_BAD_INPUT,
                          "%s: no socket to " GLINT_CODEC_PROGRAM ": %s (try again)", request->path,
                          strerror(errno));
    }
    const glint_codec_files files = {ends[1], results, image};
    pthread_mutex_lock(&codec.lock);
    const glint_status status = submit(request, &files, answer, error);
    pthread_mutex_unlock(&codec.lock);
    close(ends[1]);
    if (status == GLINT_OK &&
        receive(ends[0], patience_of(request), answer) != (ssize_t)sizeof *answer) {
        *answer = (glint_codec_answer){.kind = GLINT_CODEC_CHILD_DIED};
    }
    close(ends[0]);
    return status;
}

// ---- For callers --------------------------------------------------------------------------------

void glint_codec_start(void)
{
    // If the lock is taken, another thread starts the codec already.
    if (pthread_mutex_trylock(&codec.lock) == 0) {
        (void)start(GLINT_OK, NULL);
        pthread_mutex_unlock(&codec.lock);
    }
}

void glint_codec_abandon(void)
{
    pthread_mutex_lock(&codec.lock);
    if (codec.owner == getpid() && !codec.is_ready) {
        (void)stop();
    }
    pthread_mutex_unlock(&codec.lock);
}

void glint_codec_use_threads(int count)
{
    atomic_store(&threads_each, count);
}

int glint_codec_threads(void)
{
    return atomic_load(&threads_each);
}
