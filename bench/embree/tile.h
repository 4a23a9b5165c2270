// Shared declarations of the Embree program. A tile has 16 × 16 pixels in sixteen packets of
// sixteen rays. It is the unit of work, and its packets are shaded in place.
#ifndef GLINT_BENCH_EMBREE_TILE_H
#define GLINT_BENCH_EMBREE_TILE_H

#include "embree/lanes.h"
#include "embree/reference.h"

#include <embree3/rtcore.h>

#define TILE 16 // pixels along an edge; packets in a tile
#define NO_TRIANGLE UINT32_MAX

// Rays through the image plane. (x, y) is a point in pixels from the middle, y upwards. Its ray
// starts at the eye and runs along direction + x direction_x + y direction_y, in stored
// coordinates. The direction is not normalised: its component along the axis of view is 1.
typedef struct embree_view {
    float eye[3], direction[3], direction_x[3], direction_y[3];
} embree_view;

// Working memory of a thread. The constant parts of the packets are filled once.
typedef struct embree_tile {
    struct RTCRayHit16 primary[TILE];
    struct RTCRayHit16 secondary[TILE];
    reals3 direction[TILE]; // for the look-up in the environment
    ints texel[TILE];       // the upper left of the four texels
    reals right[TILE], down[TILE];
} embree_tile;

struct embree_program {
    embree_inputs inputs;
    embree_view view;
    RTCDevice device;
    RTCScene scenes[EMBREE_QUALITIES];
    ssize_t allocated; // bytes that the device's monitor counts; several threads add to it
    size_t bytes[EMBREE_QUALITIES];
    // [triangle_count][9]: the normal of the first vertex, and the differences of the second and
    // third normals from it. Interpolation is then two multiply-adds.
    float *normals;
    // [6][pitch][pitch][2][4] halves: each texel together with the texel below it. One load of 32
    // bytes then fetches all four texels of a look-up.
    uint16_t *texel_pairs;
    float *pixels;      // [height][width][4]
    embree_hit *hits;   // [height][width]
    embree_tile *tiles; // one for each thread
};

// A frame, as the threads see it.
typedef struct embree_frame {
    const embree_program *program;
    RTCScene scene;
    bench_job job;
    int depth; // limit for BENCH_GLASS
    const embree_mode *mode;
} embree_frame;

// Traces the rays of the packets with tnear ≤ tfar.
void embree_trace(RTCScene scene, embree_query query, struct RTCRayHit16 *packets, int count);

// The number of tiles for embree_render_tile. Some of them lie outside the frame.
size_t embree_tile_count(const embree_inputs *inputs);

// Renders a tile by its number: a bench_pool_body with an embree_frame as context.
void embree_render_tile(void *context, size_t number, int thread);

// Renders a tile of glass with both branches, one ray at a time.
void embree_render_glass_tile(const embree_frame *frame, int x0, int y0);

// Fills the constant parts of the packets of primary and secondary rays.
void embree_tile_prepare(embree_tile *tile, const embree_view *view);

#endif
