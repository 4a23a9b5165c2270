// Runs glint-decoder, which decodes image files for glint, each in a child process. See
// image/decoding.h.
//
// This process loads the libraries and never reads a file. So its children start clean and fast.
#include "decoder/decode.h"
#include "decoder/sandbox.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
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

static void send_answer(int socket, const glint_decode_answer *answer)
{
    while (send(socket, answer, sizeof *answer, MSG_NOSIGNAL) < 0 && errno == EINTR) {
    }
}

static void say_ready(void)
{
    glint_decode_answer ready = {.kind = GLINT_DECODER_IS_READY, .message = GLINT_VERSION};
    send_answer(GLINT_DECODER_SOCKET, &ready);
}

static void say_death(int socket, int how)
{
    glint_decode_answer death = {.kind = GLINT_DECODER_DIED, .status = how};
    send_answer(socket, &death);
}

// ---- A child ------------------------------------------------------------------------------------

// The descriptors of a request: the socket for the answer, the file for the values, the image.
typedef struct descriptors {
    int socket, memory, image; // image −1: read a path
} descriptors;

_Noreturn static void be_child(const glint_decode_request *request, const descriptors *given)
{
    static glint_decode_answer answer;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(GLINT_DECODER_SOCKET);
    (void)glint_sandbox_enter();
    glint_sandbox_limit(&request->limits, request->threads);
    glint_decode(request, given->memory, &answer);
    send_answer(given->socket, &answer);
    _exit(0); // skips the exit handlers of libraries that may be broken
}

// ---- Requests -----------------------------------------------------------------------------------

// Finds the descriptors that came with a request. False if there are none.
static bool find_descriptors(struct msghdr *message, descriptors *given)
{
    const struct cmsghdr *rights = CMSG_FIRSTHDR(message);
    if (rights == NULL || rights->cmsg_level != SOL_SOCKET || rights->cmsg_type != SCM_RIGHTS ||
        (rights->cmsg_len != CMSG_LEN(2 * sizeof(int)) &&
         rights->cmsg_len != CMSG_LEN(GLINT_DECODE_DESCRIPTORS * sizeof(int)))) {
        return false;
    }
    int files[GLINT_DECODE_DESCRIPTORS] = {-1, -1, -1};
    memcpy(files, CMSG_DATA(rights), rights->cmsg_len - CMSG_LEN(0));
    given->socket = files[0];
    given->memory = files[1];
    given->image = files[2];
    return true;
}

// Receives a request. False if glint has ended.
static bool receive_request(glint_decode_request *request, descriptors *given)
{
    union {
        struct cmsghdr header;
        char bytes[CMSG_SPACE(GLINT_DECODE_DESCRIPTORS * sizeof(int))];
    } control;
    struct iovec packet = {request, sizeof *request};
    struct msghdr message = {.msg_iov = &packet,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             .msg_controllen = sizeof control};
    ssize_t length;
    do {
        length = recvmsg(GLINT_DECODER_SOCKET, &message, MSG_CMSG_CLOEXEC);
    } while (length < 0 && errno == EINTR);
    if (length != (ssize_t)sizeof *request || !find_descriptors(&message, given)) {
        return false;
    }
    request->file = given->image;
    return true;
}

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

static void begin(const glint_decode_request *request, const descriptors *given)
{
    const pid_t process = fork();
    if (process == 0) {
        be_child(request, given);
    }
    close(given->memory);
    if (given->image >= 0) {
        close(given->image);
    }
    if (process < 0) {
        glint_decode_answer refusal = {.kind = GLINT_DECODED, .status = GLINT_BAD_INPUT};
        snprintf(refusal.message, sizeof refusal.message, "%.800s: no process to decode it: %s",
                 request->path, strerror(errno));
        send_answer(given->socket, &refusal);
        close(given->socket);
    } else if (!remember(process, given->socket)) {
        close(given->socket); // the child has its own copy
    }
}

// ---- Deaths -------------------------------------------------------------------------------------

// Reports a child's death. If the child answered before it ended, nobody reads the report.
static void bury(pid_t process, int how)
{
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
    static glint_decode_request request;
    sigset_t deaths;
    sigemptyset(&deaths);
    sigaddset(&deaths, SIGCHLD);
    sigprocmask(SIG_BLOCK, &deaths, NULL);
    const int signals = signalfd(-1, &deaths, SFD_CLOEXEC | SFD_NONBLOCK);
    glint_decode_prepare();
    say_ready();
    for (;;) {
        struct pollfd waited[] = {{.fd = GLINT_DECODER_SOCKET, .events = POLLIN},
                                  {.fd = signals, .events = POLLIN}};
        if (poll(waited, 2, -1) < 0) {
            continue;
        }
        if (waited[1].revents != 0) {
            bury_all(signals);
        }
        if (waited[0].revents != 0) {
            descriptors given;
            if (!receive_request(&request, &given)) {
                _exit(0); // the children end with this process
            }
            begin(&request, &given);
        }
    }
}
