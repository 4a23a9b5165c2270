// Runs several self-test cases at the same time. See pool.h.
#include "cli/selftest/pool.h"

typedef struct attendant {
    selftest_pool *pool;
    selftest_worker *worker;
    pthread_t thread;
} attendant;

glint_status selftest_pool_start(selftest_pool *pool, int count, glint_error *error)
{
    for (int i = 0; i < count; i++) {
        pool->workers[i].device = pool->workers[0].device;
        pool->workers[i].limit_s = pool->workers[0].limit_s;
        TRY(selftest_worker_start(&pool->workers[i], error));
        pool->worker_count = i + 1;
    }
    return GLINT_OK;
}

void selftest_pool_stop(selftest_pool *pool)
{
    for (int i = 0; i < pool->worker_count; i++) {
        selftest_worker_stop(&pool->workers[i]);
    }
}

// The next job; NULL if there is none left or the run stops.
static selftest_job *next_job(selftest_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    const bool is_over = pool->stops || pool->next == pool->job_count;
    selftest_job *job = is_over ? NULL : &pool->jobs[pool->next++];
    pthread_mutex_unlock(&pool->lock);
    return job;
}

static void *attend(void *context)
{
    const attendant *a = context;
    for (selftest_job *job = next_job(a->pool); job != NULL; job = next_job(a->pool)) {
        const glint_status status =
            selftest_worker_run(a->worker, job->index, &job->options, job->result, &job->error);
        pthread_mutex_lock(&a->pool->lock);
        job->status = status;
        job->is_done = true;
        pthread_cond_broadcast(&a->pool->done);
        pthread_mutex_unlock(&a->pool->lock);
    }
    return NULL;
}

static void wait_for(selftest_pool *pool, const selftest_job *job)
{
    pthread_mutex_lock(&pool->lock);
    while (!job->is_done) {
        pthread_cond_wait(&pool->done, &pool->lock);
    }
    pthread_mutex_unlock(&pool->lock);
}

static void stop_giving(selftest_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    pool->stops = true;
    pthread_mutex_unlock(&pool->lock);
}

glint_status selftest_pool_run(selftest_pool *pool, const selftest_taker *taker, glint_error *error)
{
    attendant attendants[SELFTEST_WORKERS_MAX];
    int attending = 0;
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->done, NULL);
    for (int i = 0; i < pool->worker_count; i++) {
        attendant *a = &attendants[attending];
        *a = (attendant){.pool = pool, .worker = &pool->workers[i]};
        attending += pthread_create(&a->thread, NULL, attend, a) == 0;
    }
    glint_status status = attending > 0 ? GLINT_OK
                                        : glint_fail(error, GLINT_OUT_OF_MEMORY,
                                                     "no thread for the self-test's cases");
    for (size_t i = 0; status == GLINT_OK && i < pool->job_count; i++) {
        wait_for(pool, &pool->jobs[i]);
        status = taker->take(taker->context, &pool->jobs[i], error);
        if (taker->is_enough(taker->context)) {
            break;
        }
    }
    stop_giving(pool);
    for (int i = 0; i < attending; i++) {
        pthread_join(attendants[i].thread, NULL);
    }
    pthread_cond_destroy(&pool->done);
    pthread_mutex_destroy(&pool->lock);
    return status;
}
