// Spreads independent pieces of work over the machine's cores. See parallel.h.
#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

#define THREADS_MAX 64

typedef struct job {
    atomic_size_t next;
    size_t count;
    void (*body)(size_t index, void *context);
    void *context;
} job;

static void *work(void *argument)
{
    job *shared = argument;
    for (;;) {
        size_t index = atomic_fetch_add(&shared->next, 1);
        if (index >= shared->count) {
            return NULL;
        }
        shared->body(index, shared->context);
    }
}

int glint_usable_cores(void)
{
    cpu_set_t set;
    CPU_ZERO(&set);
    int cores = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return cores < 1 ? 1 : cores;
}

size_t glint_parallel_threads(size_t threads)
{
    if (threads == 0) {
        threads = (size_t)glint_usable_cores();
    }
    return threads < THREADS_MAX ? threads : THREADS_MAX;
}

void glint_parallel_for_on(size_t threads, size_t count, void (*body)(size_t index, void *context),
                           void *context)
{
    job shared = {.count = count, .body = body, .context = context};
    size_t wanted = glint_parallel_threads(threads);
    wanted = wanted < count ? wanted : count;
    pthread_t workers[THREADS_MAX];
    size_t started = 0;
    // The caller is one of the workers, so start one thread less.
    while (started + 1 < wanted && pthread_create(&workers[started], NULL, work, &shared) == 0) {
        started++;
    }
    work(&shared);
    for (size_t i = 0; i < started; i++) {
        pthread_join(workers[i], NULL);
    }
}

void glint_parallel_for(size_t count, void (*body)(size_t index, void *context), void *context)
{
    glint_parallel_for_on(0, count, body, context);
}
