// What the files of the Embree program share. A tile is 16 × 16 pixels and sixteen packets of
// sixteen rays; it is the unit of work, and its packets are shaded where Embree left them.
#ifndef GLINT_BENCH_EMBREE_TILE_H
#define GLINT_BENCH_EMBREE_TILE_H

#include "embree/lanes.h"
#include "embree/reference.h"

#include <embree3/rtcore.h>

#define TILE 16 // pixels along an edge; packets in a tile
#define NO_TRIANGLE UINT32_MAX

// The ray through the point (x, y) of the image plane, in pixels from its middle with y upwards,
// starts at the eye and runs along direction + x direction_x + y direction_y, in stored
// coordinates and not normalised: the direction's component along the axis of view is 1.
typedef struct embree_view {
    float eye[3], direction[3], direction_x[3], direction_y[3];
} embree_view;

// Where a thread works. The packets' constant parts are filled once.
typedef struct embree_tile {
    struct RTCRayHit16 primary[TILE];
    struct RTCRayHit16 secondary[TILE];
    reals3 direction[TILE]; // in which the environment is looked up
    ints texel[TILE];       // the upper left of the four texels
    reals right[TILE], down[TILE];
} embree_tile;

struct embree_program {
    embree_inputs inputs;
    embree_view view;
    RTCDevice device;
    RTCScene scenes[EMBREE_QUALITIES];
    ssize_t allocated; // by the device, as its monitor counts; several threads add to it
    size_t bytes[EMBREE_QUALITIES];
    // [triangle_count][9]: the first vertex's normal, and what the second's and the third's are
    // more than it: a normal is then two multiply-adds.
    float *normals;
    // [6][pitch][pitch][2][4] halves: each texel with the one below it, so that one load of 32
    // bytes fetches all four of a look-up.
    uint16_t *texel_pairs;
    float *pixels;      // [height][width][4]
    embree_hit *hits;   // [height][width]
    embree_tile *tiles; // one a thread
};

// One frame, as the threads see it.
typedef struct embree_frame {
    const embree_program *program;
    RTCScene scene;
    bench_job job;
    int depth; // of GLASS
    const embree_mode *mode;
} embree_frame;

// Traces those rays of the packets whose tnear is no larger than their tfar.
void embree_trace(RTCScene scene, embree_query query, struct RTCRayHit16 *packets, int count);

// How many numbers there are for embree_render_tile; some stand for tiles outside the frame.
size_t embree_tile_count(const embree_inputs *inputs);

// Renders the tile of that number: a bench_pool_body with an embree_frame as context.
void embree_render_tile(void *context, size_t number, int thread);

// Renders a tile of glass with both branches, a ray at a time.
void embree_render_glass_tile(const embree_frame *frame, int x0, int y0);

// Fills what never changes in packets of primary and secondary rays.
void embree_tile_prepare(embree_tile *tile, const embree_view *view);

#endif
