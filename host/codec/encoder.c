// Runs the encoder. See encoder.h.
#include "codec/encoder.h"

#include "codec/answer.h"
#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/sandbox.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

static struct {
    pid_t process; // 0: it does not run
    int socket;    // to it
} encoder;

// ---- The encoder's process ----------------------------------------------------------------------

typedef struct job {
    glint_codec_request request;
    glint_codec_files files;
    glint_codec_answer answer;
} job;

// The jobs at work. `lock` guards the count.
static struct {
    pthread_mutex_t lock;
    pthread_cond_t is_none;
    size_t count;
} jobs = {.lock = PTHREAD_MUTEX_INITIALIZER, .is_none = PTHREAD_COND_INITIALIZER};

static void *work(void *context)
{
    job *own = context;
    glint_encode(&own->request, own->files.results, &own->answer);
    glint_codec_answer_send(own->files.answers, &own->answer);
    close(own->files.answers);
    close(own->files.results);
    free(own);
    pthread_mutex_lock(&jobs.lock);
    jobs.count--;
    if (jobs.count == 0) {
        pthread_cond_signal(&jobs.is_none);
    }
    pthread_mutex_unlock(&jobs.lock);
    return NULL;
}

// OpenImageIO's threads must not change in number while it works.
static void use_threads(int wanted)
{
    static int threads = -1;
    if (threads != wanted) {
        pthread_mutex_lock(&jobs.lock);
        while (jobs.count > 0) {
            pthread_cond_wait(&jobs.is_none, &jobs.lock);
        }
        pthread_mutex_unlock(&jobs.lock);
        glint_codec_set_threads(wanted);
        threads = wanted;
    }
}

// Without a thread for the job, this thread does it.
static void begin(job *received)
{
    use_threads(received->request.threads);
    pthread_mutex_lock(&jobs.lock);
    jobs.count++;
    pthread_mutex_unlock(&jobs.lock);
    pthread_t thread;
    if (pthread_create(&thread, NULL, work, received) == 0) {
        pthread_detach(thread);
    } else {
        work(received);
    }
}

_Noreturn static void be_encoder(int socket)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    glint_sandbox_close_others(&socket, 1);
    (void)glint_sandbox_enter(true);
    glint_sandbox_leave_no_core();
    for (;;) {
        job *next = calloc(1, sizeof *next);
        if (next == NULL || !glint_codec_receive(socket, &next->request, &next->files)) {
            _exit(0); // the codec has ended, or memory is short
        }
        begin(next);
    }
}

// ---- The codec's side ---------------------------------------------------------------------------

static bool start(void)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return false;
    }
    const pid_t process = fork();
    if (process == 0) {
        be_encoder(ends[1]);
    }
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return false;
    }
    encoder.process = process;
    encoder.socket = ends[0];
    return true;
}

bool glint_encoder_submit(const glint_codec_request *request, const glint_codec_files *files)
{
    if (encoder.process != 0 && glint_codec_send(encoder.socket, request, files)) {
        return true;
    }
    // It does not run, or has just died.
    if (encoder.process != 0) {
        (void)glint_encoder_has_ended(encoder.process);
    }
    return start() && glint_codec_send(encoder.socket, request, files);
}

bool glint_encoder_has_ended(pid_t process)
{
    if (process != encoder.process) {
        return false;
    }
    close(encoder.socket);
    encoder.process = 0;
    return true;
}
