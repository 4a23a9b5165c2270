// Runs glint-codec, which decodes and encodes files for glint in child processes. See
// image/codec_messages.h.
//
// This process loads the libraries and never reads a file. So its children start clean and fast.
#include "codec/answer.h"
#include "codec/decode.h"
#include "codec/encoder.h"
#include "codec/sandbox.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

// A child, and the socket for its answer.
typedef struct job {
    pid_t process;
    int socket;
} job;

static struct {
    job *jobs;
    size_t count, capacity;
} running;

static void say_ready(void)
{
    glint_codec_answer ready = {.kind = GLINT_CODEC_IS_READY, .message = GLINT_VERSION};
    glint_codec_answer_send(GLINT_CODEC_SOCKET, &ready);
}

static void say_death(int socket, int how)
{
    glint_codec_answer death = {.kind = GLINT_CODEC_CHILD_DIED, .status = how};
    glint_codec_answer_send(socket, &death);
}

// ---- A child ------------------------------------------------------------------------------------

_Noreturn static void be_child(const glint_codec_request *request, const glint_codec_files *files)
{
    static glint_codec_answer answer;
    const int kept[] = {files->answers, files->results, files->image};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    glint_sandbox_close_others(kept, sizeof kept / sizeof kept[0]);
    (void)glint_sandbox_enter(true);
    glint_sandbox_limit(&request->limits, request->threads);
    glint_decode(request, files->results, &answer);
    glint_codec_answer_send(files->answers, &answer);
    _exit(0); // skips the exit handlers of libraries that may be broken
}

// ---- Requests -----------------------------------------------------------------------------------

static bool remember(pid_t process, int socket)
{
    if (running.count == running.capacity) {
        const size_t capacity = 2 * running.capacity + 8;
        job *more = realloc(running.jobs, capacity * sizeof *more);
        if (more == NULL) {
            return false;
        }
        running.jobs = more;
        running.capacity = capacity;
    }
    running.jobs[running.count++] = (job){process, socket};
    return true;
}

static void refuse(const glint_codec_request *request, int socket)
{
    glint_codec_answer refusal = {.kind = GLINT_CODEC_DONE, .status = GLINT_BAD_INPUT};
    snprintf(refusal.message, sizeof refusal.message, "%.800s: no process for it: %s (try again)",
             request->path, strerror(errno));
    glint_codec_answer_send(socket, &refusal);
}

static void decode(const glint_codec_request *request, const glint_codec_files *files)
{
    const pid_t process = fork();
    if (process == 0) {
        be_child(request, files);
    }
    if (process < 0) {
        refuse(request, files->answers);
        close(files->answers);
    } else if (!remember(process, files->answers)) {
        close(files->answers); // the child has its own copy
    }
}

static void encode(const glint_codec_request *request, const glint_codec_files *files)
{
    if (!glint_encoder_submit(request, files)) {
        refuse(request, files->answers);
    }
    close(files->answers);
}

static void begin(const glint_codec_request *request, const glint_codec_files *files)
{
    if (request->work == GLINT_ENCODE) {
        encode(request, files);
    } else {
        decode(request, files);
    }
    close(files->results);
    if (files->image >= 0) {
        close(files->image);
    }
}

// ---- Deaths -------------------------------------------------------------------------------------

// Reports a child's death. If the child answered before it ended, nobody reads the report.
static void bury(pid_t process, int how)
{
    if (glint_encoder_has_ended(process)) {
        return;
    }
    for (size_t i = 0; i < running.count; i++) {
        if (running.jobs[i].process == process) {
            say_death(running.jobs[i].socket, how);
            close(running.jobs[i].socket);
            running.jobs[i] = running.jobs[--running.count];
            return;
        }
    }
}

static void bury_all(int signals)
{
    struct signalfd_siginfo unused;
    (void)!read(signals, &unused, sizeof unused);
    int how;
    for (pid_t process; (process = waitpid(-1, &how, WNOHANG)) > 0;) {
        bury(process, how);
    }
}

int main(void)
{
    static glint_codec_request request;
    sigset_t deaths;
    sigemptyset(&deaths);
    sigaddset(&deaths, SIGCHLD);
    sigprocmask(SIG_BLOCK, &deaths, NULL);
    const int signals = signalfd(-1, &deaths, SFD_CLOEXEC | SFD_NONBLOCK);
    glint_codec_prepare();
    say_ready();
    for (;;) {
        struct pollfd waited[] = {{.fd = GLINT_CODEC_SOCKET, .events = POLLIN},
                                  {.fd = signals, .events = POLLIN}};
        if (poll(waited, 2, -1) < 0) {
            continue;
        }
        if (waited[1].revents != 0) {
            bury_all(signals);
        }
        if (waited[0].revents != 0) {
            glint_codec_files files;
            if (!glint_codec_receive(GLINT_CODEC_SOCKET, &request, &files)) {
                _exit(0); // glint has ended; the children end with this process
            }
            request.file = files.image;
            begin(&request, &files);
        }
    }
}
