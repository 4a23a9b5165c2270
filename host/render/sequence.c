// Traces and writes frames at the same time. See sequence.h.
//
// Frames live in slots. The caller's thread takes a free slot, traces into it and queues it. A
// writer takes the oldest slot in the queue, writes it, and puts it among the finished slots.
// Between launches, the caller's thread hands the finished frames to `done` and frees their slots.
// So threads share only the queues, and progress displays need no lock.
#include "render/sequence.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "image/output_file.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define MEMORY_IN_FLIGHT 1e9 // bytes of pixels
// Time between two checks for a stop.
#define WAIT_MS 100

typedef struct slot {
    glint_sequence_frame frame;
    struct slot *next; // next slot in a queue
} slot;

// A FIFO queue.
typedef struct queue {
    slot *first, *last;
} queue;

typedef struct pipeline {
    const glint_sequence *sequence;
    // All slots, and slots that hold a frame. Only the caller's thread uses these.
    size_t slot_count, busy;
    slot *slots;
    queue idle; // used by the caller's thread only
    pthread_mutex_t lock;
    pthread_cond_t work, finished;
    queue waiting, through; // guarded by the lock
    bool closed;            // guarded by the lock: no more frames will come
    bool ended;             // `done` stopped the sequence; used by the caller's thread only
    pthread_t *threads;
    size_t thread_count;
} pipeline;

static void push(queue *q, slot *s)
{
    s->next = NULL;
    if (q->first == NULL) {
        q->first = s;
    } else {
        q->last->next = s;
    }
    q->last = s;
}

static slot *pop(queue *q)
{
    slot *s = q->first;
    if (s != NULL) {
        q->first = s->next;
    }
    return s;
}

size_t glint_sequence_writers(double frame_bytes)
{
    const double room = fmin(MEMORY_IN_FLIGHT / frame_bytes - 2, GLINT_OUTPUT_FILES_AT_ONCE);
    return (size_t)fmax(1, fmin(room, glint_usable_cores()));
}

// ---- Writers -----------------------------------------------------------------------------------

static void write_slot(const glint_sequence *sequence, slot *s)
{
    const double begun = glint_now_ms();
    sequence->write(sequence->context, &s->frame);
    s->frame.write_ms = glint_now_ms() - begun;
}

static void *writer(void *context)
{
    pipeline *p = context;
    pthread_mutex_lock(&p->lock);
    while (true) {
        slot *s = pop(&p->waiting);
        if (s != NULL) {
            pthread_mutex_unlock(&p->lock);
            write_slot(p->sequence, s);
            pthread_mutex_lock(&p->lock);
            push(&p->through, s);
            pthread_cond_signal(&p->finished);
        } else if (p->closed) {
            break;
        } else {
            pthread_cond_wait(&p->work, &p->lock);
        }
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

// Starts as many writers as possible. If none starts, the caller's thread writes.
static void start_writers(pipeline *p)
{
    while (p->thread_count < p->sequence->writers &&
           pthread_create(&p->threads[p->thread_count], NULL, writer, p) == 0) {
        p->thread_count++;
    }
}

static void join_writers(pipeline *p)
{
    pthread_mutex_lock(&p->lock);
    p->closed = true;
    pthread_cond_broadcast(&p->work);
    pthread_mutex_unlock(&p->lock);
    for (size_t i = 0; i < p->thread_count; i++) {
        pthread_join(p->threads[i], NULL);
    }
}

// ---- The caller's thread -----------------------------------------------------------------------

// Hands the finished frames to `done` and frees their slots.
static void collect(pipeline *p)
{
    pthread_mutex_lock(&p->lock);
    queue through = p->through;
    p->through = (queue){0};
    pthread_mutex_unlock(&p->lock);
    for (slot *s = pop(&through); s != NULL; s = pop(&through)) {
        if (!p->sequence->done(p->sequence->context, &s->frame)) {
            p->ended = true;
        }
        glint_error_free(&s->frame.error);
        glint_layers_free(&s->frame.layers);
        p->busy--;
        push(&p->idle, s);
    }
}

// Waits for a writer to finish a frame, at most WAIT_MS.
static void wait_for_writers(pipeline *p)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += WAIT_MS * 1000000L;
    until.tv_sec += until.tv_nsec / 1000000000L;
    until.tv_nsec %= 1000000000L;
    pthread_mutex_lock(&p->lock);
    int code = 0;
    while (p->through.first == NULL && code != ETIMEDOUT) {
        code = pthread_cond_timedwait(&p->finished, &p->lock, &until);
    }
    pthread_mutex_unlock(&p->lock);
}

// Called between launches.
static bool step(void *context, uint64_t done, uint64_t total)
{
    pipeline *p = context;
    const glint_progress *progress = &p->sequence->progress;
    collect(p);
    return progress->step == NULL || progress->step(progress->context, done, total);
}

static glint_status trace(pipeline *p, slot *s, glint_error *error)
{
    glint_renderer *renderer = p->sequence->renderer;
    const glint_progress progress = {step, p};
    const double begun = glint_now_ms();
    const glint_sequence *sequence = p->sequence;
    glint_status status =
        sequence->render != NULL
            ? sequence->render(sequence->context, &s->frame, &progress, error)
            : glint_renderer_frame(&(glint_frame_request){renderer, &s->frame.camera, &progress,
                                                          &s->frame.image, &s->frame.report},
                                   error);
    if (status == GLINT_OK && p->sequence->with_layers) {
        status = glint_renderer_layers(renderer, &s->frame.layers, error);
    }
    s->frame.trace_ms = glint_now_ms() - begun;
    return status;
}

static void queue_for_writing(pipeline *p, slot *s)
{
    p->busy++;
    if (p->thread_count == 0) {
        write_slot(p->sequence, s);
        push(&p->through, s);
        return;
    }
    pthread_mutex_lock(&p->lock);
    push(&p->waiting, s);
    pthread_cond_signal(&p->work);
    pthread_mutex_unlock(&p->lock);
}

// Returns an idle slot, and waits if all slots hold frames. Returns NULL if the sequence is
// stopped.
static slot *take_slot(pipeline *p, glint_status *status, glint_error *error)
{
    while (true) {
        if (!step(p, 0, 1)) {
            *status = glint_fail(error, GLINT_INTERRUPTED, "stopped");
            return NULL;
        }
        if (p->ended) {
            return NULL;
        }
        slot *s = pop(&p->idle);
        if (s != NULL) {
            return s;
        }
        wait_for_writers(p);
    }
}

// Asks for the next frame, traces and queues it. *is_over: there is none.
static glint_status feed_one(pipeline *p, slot *s, bool *is_over, glint_error *error)
{
    const glint_sequence *sequence = p->sequence;
    // Reuse the image's memory.
    s->frame = (glint_sequence_frame){.image = s->frame.image};
    const glint_sequence_next next = sequence->next(sequence->context, &s->frame);
    *is_over = next == GLINT_NEXT_NONE;
    if (next == GLINT_NEXT_FRAME) {
        TRY(trace(p, s, error));
        sequence->traced(sequence->context, &s->frame);
    }
    if (next == GLINT_NEXT_FRAME || next == GLINT_NEXT_TRACED) {
        queue_for_writing(p, s);
        return GLINT_OK;
    }
    push(&p->idle, s);
    if (next == GLINT_NEXT_WAIT) {
        wait_for_writers(p);
    }
    return GLINT_OK;
}

static glint_status feed(pipeline *p, glint_error *error)
{
    glint_status status = GLINT_OK;
    bool is_over = false;
    while (status == GLINT_OK && !is_over) {
        slot *s = take_slot(p, &status, error);
        if (s == NULL) {
            break;
        }
        status = feed_one(p, s, &is_over, error);
    }
    return status;
}

static glint_status run(pipeline *p, glint_error *error)
{
    for (size_t i = 0; i < p->slot_count; i++) {
        push(&p->idle, &p->slots[i]);
    }
    start_writers(p);
    glint_status status = feed(p, error);
    while (p->busy > 0) {
        collect(p);
        if (p->busy > 0) {
            wait_for_writers(p);
        }
    }
    join_writers(p);
    return status;
}

static void make_conditions(pipeline *p)
{
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->work, NULL);
    pthread_cond_init(&p->finished, &attributes);
    pthread_condattr_destroy(&attributes);
}

glint_status glint_sequence_run(const glint_sequence *sequence, glint_error *error)
{
    pipeline p = {.sequence = sequence, .slot_count = sequence->writers + 2};
    p.slots = glint_allocate(p.slot_count, sizeof *p.slots);
    p.threads = glint_allocate(sequence->writers, sizeof *p.threads);
    if (p.slots == NULL || p.threads == NULL) {
        free(p.slots);
        free(p.threads);
        return glint_fail_memory(error, "the frames in flight");
    }
    make_conditions(&p);
    glint_status status = run(&p, error);
    pthread_cond_destroy(&p.work);
    pthread_cond_destroy(&p.finished);
    pthread_mutex_destroy(&p.lock);
    for (size_t i = 0; i < p.slot_count; i++) {
        glint_image_free(&p.slots[i].frame.image);
        glint_layers_free(&p.slots[i].frame.layers);
        glint_error_free(&p.slots[i].frame.error);
    }
    free(p.slots);
    free(p.threads);
    return status;
}
