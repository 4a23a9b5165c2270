// Runs work on a pool of waiting threads. See pool.h.
#include "embree/pool.h"

#include "base/clock.h"
#include "base/memory.h"

#include <immintrin.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

#define THREADS_MAX 256

struct bench_pool {
    pthread_mutex_t lock;
    pthread_cond_t begin, end;
    int threads;
    pthread_t handles[THREADS_MAX];
    // Guarded by the lock: the number of the run, and how many threads have finished it.
    unsigned long run;
    int finished;
    bool closing;
    // The current run.
    bench_pool_body *body;
    void *context;
    size_t count;
    double first_ms, last_ms; // guarded by the lock: when the first thread began and the last ended
    _Alignas(64) atomic_size_t next;
    _Alignas(64) atomic_int ready;
};

typedef struct worker {
    bench_pool *pool;
    int index;
} worker;

static void run_items(bench_pool *pool, int index)
{
    // Wait for all threads: waking up is not part of the measured work.
    atomic_fetch_add(&pool->ready, 1);
    while (atomic_load(&pool->ready) < pool->threads) {
        _mm_pause();
    }
    double first = glint_now_ms();
    for (;;) {
        size_t item = atomic_fetch_add(&pool->next, 1);
        if (item >= pool->count) {
            break;
        }
        pool->body(pool->context, item, index);
    }
    double last = glint_now_ms();
    pthread_mutex_lock(&pool->lock);
    pool->first_ms = pool->finished == 0 || first < pool->first_ms ? first : pool->first_ms;
    pool->last_ms = pool->finished == 0 || last > pool->last_ms ? last : pool->last_ms;
    if (++pool->finished == pool->threads) {
        pthread_cond_signal(&pool->end);
    }
    pthread_mutex_unlock(&pool->lock);
}

static void *work(void *argument)
{
    worker self = *(worker *)argument;
    free(argument);
    bench_pool *pool = self.pool;
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _mm_setcsr(_mm_getcsr() | 0x40); // count denormals as zero
    unsigned long done = 0;
    for (;;) {
        pthread_mutex_lock(&pool->lock);
        while (pool->run == done && !pool->closing) {
            pthread_cond_wait(&pool->begin, &pool->lock);
        }
        bool closing = pool->closing;
        done = pool->run;
        pthread_mutex_unlock(&pool->lock);
        if (closing) {
            return NULL;
        }
        run_items(pool, self.index);
    }
}

static int usable_cores(void)
{
    cpu_set_t set;
    CPU_ZERO(&set);
    int cores = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return cores < THREADS_MAX ? cores : THREADS_MAX;
}

glint_status bench_pool_create(bench_pool **pool, glint_error *error)
{
    bench_pool *made = glint_allocate(1, sizeof *made);
    *pool = NULL;
    if (made == NULL) {
        return glint_fail_memory(error, "threads");
    }
    pthread_mutex_init(&made->lock, NULL);
    pthread_cond_init(&made->begin, NULL);
    pthread_cond_init(&made->end, NULL);
    int wanted = usable_cores();
    for (; made->threads < wanted; made->threads++) {
        worker *self = malloc(sizeof *self);
        if (self != NULL) {
            *self = (worker){made, made->threads};
        }
        if (self == NULL || pthread_create(&made->handles[made->threads], NULL, work, self) != 0) {
            free(self);
            bench_pool_free(made);
            return glint_fail(error, GLINT_DEVICE_FAILED, "threads could not be started");
        }
    }
    *pool = made;
    return GLINT_OK;
}

void bench_pool_free(bench_pool *pool)
{
    if (pool == NULL) {
        return;
    }
    pthread_mutex_lock(&pool->lock);
    pool->closing = true;
    pthread_cond_broadcast(&pool->begin);
    pthread_mutex_unlock(&pool->lock);
    for (int i = 0; i < pool->threads; i++) {
        pthread_join(pool->handles[i], NULL);
    }
    pthread_cond_destroy(&pool->begin);
    pthread_cond_destroy(&pool->end);
    pthread_mutex_destroy(&pool->lock);
    free(pool);
}

int bench_pool_threads(const bench_pool *pool)
{
    return pool->threads;
}

double bench_pool_run(bench_pool *pool, size_t count, bench_pool_body *body, void *context)
{
    pthread_mutex_lock(&pool->lock);
    pool->body = body;
    pool->context = context;
    pool->count = count;
    pool->finished = 0;
    atomic_store(&pool->next, 0);
    atomic_store(&pool->ready, 0);
    pool->run++;
    pthread_cond_broadcast(&pool->begin);
    while (pool->finished < pool->threads) {
        pthread_cond_wait(&pool->end, &pool->lock);
    }
    double elapsed = pool->last_ms - pool->first_ms;
    pthread_mutex_unlock(&pool->lock);
    return elapsed;
}
