// Runs work on threads that sleep between measurements and cost nothing then.
#ifndef GLINT_BENCH_EMBREE_POOL_H
#define GLINT_BENCH_EMBREE_POOL_H

#include "base/status.h"

#include <stddef.h>

typedef struct bench_pool bench_pool; // opaque

// Starts one thread for each core that the process may use.
glint_status bench_pool_create(bench_pool **pool, glint_error *error);

// NULL is allowed.
void bench_pool_free(bench_pool *pool);

int bench_pool_threads(const bench_pool *pool);

// Calls body(context, item, thread) for each item below `count`; free threads take one item at a
// time. Returns the milliseconds from when all threads are ready to when the last item is done. The
// caller sleeps meanwhile. Denormal numbers count as zero in `body`, as Embree wants it.
typedef void bench_pool_body(void *context, size_t item, int thread);
double bench_pool_run(bench_pool *pool, size_t count, bench_pool_body *body, void *context);

#endif
