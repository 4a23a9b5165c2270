// Renders the same frames by Embree 3, as fast as Embree allows: the program that glint is measured
// against. bench/README.md lists the work that its times include.
#ifndef GLINT_BENCH_EMBREE_REFERENCE_H
#define GLINT_BENCH_EMBREE_REFERENCE_H

#include "base/status.h"
#include "embree/aimed_rays.h"
#include "embree/pool.h"
#include "environment/environment.h"
#include "scenes.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Embree's calls for tracing rays.
typedef enum embree_call {
    EMBREE_INTERSECT_1,  // rtcIntersect1
    EMBREE_INTERSECT_8,  // rtcIntersect8
    EMBREE_INTERSECT_16, // rtcIntersect16
    EMBREE_STREAM_16_1,  // rtcIntersectNM, N = 16, M = 1
    EMBREE_STREAM_16_16, // rtcIntersectNM, N = 16, M = 16: a tile of 16 × 16 pixels at once
    EMBREE_CALLS,
} embree_call;

typedef struct embree_query {
    embree_call call;
    bool coherent; // RTC_INTERSECT_CONTEXT_FLAG_COHERENT
} embree_query;

typedef enum embree_quality {
    EMBREE_MEDIUM, // RTC_BUILD_QUALITY_MEDIUM
    EMBREE_HIGH,   // RTC_BUILD_QUALITY_HIGH: spatial splits
    EMBREE_QUALITIES,
} embree_quality;

typedef enum embree_shading {
    EMBREE_PLAIN,  // a packet's normals, directions and look-ups in one loop, texels of four floats
    EMBREE_STAGED, // a tile's normals and directions, then its look-ups, prefetched, texels of
                   // halves, stores past the caches
    EMBREE_SHADINGS,
} embree_shading;

typedef struct embree_mode {
    embree_query primary;
    embree_query secondary; // for rays inside glass
    bool rows;              // a packet has 16 × 1 pixels, otherwise 4 × 4
    embree_quality quality;
    embree_shading shading;
} embree_mode;

// Describes a mode, as far as it matters for `job`: "NM 16x16 coherent, then 16 incoherent, 4x4,
// MEDIUM, plain".
void embree_mode_describe(const embree_mode *mode, bench_job job, char *text, size_t capacity);

// The hit of a primary ray, for BENCH_TRAVERSE. `t` is the depth in stored units: it counts in
// lengths of the ray's direction, whose component along the axis of view is 1 stored unit.
typedef struct embree_hit {
    float t;
    uint32_t triangle; // UINT32_MAX: none
} embree_hit;

typedef struct embree_inputs {
    const bench_scene *scene;      // borrowed, must outlive the program
    const glint_cube *environment; // borrowed, must outlive the program
    bench_pool *pool;              // borrowed, must outlive the program
    int width, height;             // pixels, multiples of 16
    bool robust;                   // RTC_SCENE_FLAG_ROBUST
    bool high;                     // build a tree of quality HIGH beside the MEDIUM tree
} embree_inputs;

typedef struct embree_program embree_program; // opaque

// Errors: GLINT_DEVICE_FAILED.
glint_status embree_program_create(const embree_inputs *inputs, embree_program **program,
                                   glint_error *error);

// NULL is allowed.
void embree_program_free(embree_program *program);

// Renders a frame and returns its milliseconds. BENCH_TRAVERSE writes hits, the other jobs write
// pixels. `depth` limits the surfaces of a path of BENCH_GLASS; the other jobs ignore it.
double embree_program_frame(embree_program *program, bench_job job, int depth,
                            const embree_mode *mode);

const float *embree_program_pixels(const embree_program *program);    // [height][width][4]
const embree_hit *embree_program_hits(const embree_program *program); // [height][width]

// Builds the tree again, discards it and returns the milliseconds of rtcCommitScene.
double embree_program_build(embree_program *program, embree_quality quality);

// Bytes of Embree's tree, with the triangles in its leaves.
size_t embree_program_bytes(const embree_program *program, embree_quality quality);

// Bytes of the program's data for shading: normals.
size_t embree_program_shading_bytes(const embree_program *program);

// Writes Embree's version, such as "3.13.5".
void embree_version(char *text, size_t capacity);

// Counts Embree's leaks among the first `count` aimed rays, rounded down to whole packets.
leak_count embree_program_leaks(embree_program *program, uint64_t count);

#endif
