// Runs several self-test cases at the same time: each worker process has a thread that feeds it
// cases.
#ifndef GLINT_CLI_SELFTEST_POOL_H
#define GLINT_CLI_SELFTEST_POOL_H

#include "cli/selftest/worker.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

#define SELFTEST_WORKERS_MAX 16

// A case to run and its result.
typedef struct selftest_job {
    size_t index;  // index of the case
    bool is_first; // first job of its precision and width
    glint_selftest_options options;
    glint_selftest_result *result; // borrowed
    bool is_done;
    glint_status status; // `status` and `error` are valid once is_done
    glint_error error;
} selftest_job;

// Worker processes and the list of jobs. Zero is no pool.
typedef struct selftest_pool {
    selftest_worker workers[SELFTEST_WORKERS_MAX];
    int worker_count;
    selftest_job *jobs; // borrowed
    size_t job_count, next;
    bool stops;
    // protects the list of jobs and the members of finished jobs, but not the workers
    pthread_mutex_t lock;
    pthread_cond_t done;
} selftest_pool;

// Starts `count` workers, 1 to SELFTEST_WORKERS_MAX, each with the device and time limit of
// pool->workers[0]. Errors: as selftest_worker_start.
glint_status selftest_pool_start(selftest_pool *pool, int count, glint_error *error);

// Runs pool->jobs. Hands each finished job to `take`, in the order of the list and on the caller's
// thread. The run ends if `take` returns an error or `is_enough`, called after each job, returns
// true.
typedef struct selftest_taker {
    glint_status (*take)(void *context, selftest_job *job, glint_error *error);
    bool (*is_enough)(const void *context);
    void *context;
} selftest_taker;
glint_status selftest_pool_run(selftest_pool *pool, const selftest_taker *taker,
                               glint_error *error);

void selftest_pool_stop(selftest_pool *pool);

#endif
