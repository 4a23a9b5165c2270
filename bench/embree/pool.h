// Threads that wait for work between measurements and cost nothing meanwhile.
#ifndef GLINT_BENCH_EMBREE_POOL_H
#define GLINT_BENCH_EMBREE_POOL_H

#include "base/status.h"

#include <stddef.h>

typedef struct bench_pool bench_pool; // opaque

// One thread for each core that the process may use.
glint_status bench_pool_create(bench_pool **pool, glint_error *error);

// NULL is allowed.
void bench_pool_free(bench_pool *pool);

int bench_pool_threads(const bench_pool *pool);

// Calls body(context, item, thread) for each item below `count`, an item at a time on whichever
// thread is free, and returns the milliseconds from when all threads were awake and ready to when
// the last item was done. The caller sleeps meanwhile. Denormal numbers count as zero in `body`,
// which is how Embree wants to be called.
typedef void bench_pool_body(void *context, size_t item, int thread);
double bench_pool_run(bench_pool *pool, size_t count, bench_pool_body *body, void *context);

#endif
