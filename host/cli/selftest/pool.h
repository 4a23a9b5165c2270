// The self-test's cases, several at a time: each worker has a thread here that gives it cases.
#ifndef GLINT_CLI_SELFTEST_POOL_H
#define GLINT_CLI_SELFTEST_POOL_H

#include "cli/selftest/worker.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

#define SELFTEST_WORKERS_MAX 16

typedef struct selftest_job {
    size_t index;  // of the case
    bool is_first; // of its precision and width
    glint_selftest_options options;
    glint_selftest_result *result; // borrowed
    bool is_done;
    glint_status status; // then this, and the error
    glint_error error;
} selftest_job;

// Zero is no pool.
typedef struct selftest_pool {
    selftest_worker workers[SELFTEST_WORKERS_MAX];
    int worker_count;
    selftest_job *jobs; // borrowed
    size_t job_count, next;
    bool stops;
    pthread_mutex_t lock; // of all above but the workers, and of what the jobs hold when done
    pthread_cond_t done;
} selftest_pool;

// Starts `count` workers, 1 to SELFTEST_WORKERS_MAX, each as the first of pool->workers says.
// Errors: as selftest_worker_start.
glint_status selftest_pool_start(selftest_pool *pool, int count, glint_error *error);

// Runs pool->jobs, and hands each to `take`, in their order and in the caller's thread, once it is
// done. What it returns other than GLINT_OK ends the run; so does `is_enough`, asked after each.
typedef struct selftest_taker {
    glint_status (*take)(void *context, selftest_job *job, glint_error *error);
    bool (*is_enough)(const void *context);
    void *context;
} selftest_taker;
glint_status selftest_pool_run(selftest_pool *pool, const selftest_taker *taker,
                               glint_error *error);

void selftest_pool_stop(selftest_pool *pool);

#endif
