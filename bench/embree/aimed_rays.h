// Rays aimed at what triangles share, for counting those that pass between them.
#ifndef GLINT_BENCH_EMBREE_AIMED_RAYS_H
#define GLINT_BENCH_EMBREE_AIMED_RAYS_H

#include "base/random.h"
#include "device/device.h"
#include "scenes.h"

#include <stdbool.h>
#include <stdint.h>

#define AIMED_RAYS_PER_ITEM 4096 // rays of one seed, which is the item's number and 1
// A hit is at the target if it lies before this many times the distance: far more than rounding,
// far less than the way to the next surface.
#define AIMED_BEHIND 1.001

typedef struct aimed_ray {
    float origin[3], direction[3]; // the direction is a unit vector but for rounding
    float distance;                // of the target
} aimed_ray;

// Half of the rays are aimed at vertices, half at edges. A leak is a ray that passes through the
// surface there.
typedef struct leak_count {
    uint64_t rays;
    uint64_t at_vertices, at_edges;
} leak_count;

// A ray at a random triangle's first vertex, or at a point of its first edge, from a random origin
// that sees it; the direction is right within a unit in the last place of each component. The scene
// must be closed and smooth.
aimed_ray aim_ray(const bench_scene *scene, bool at_edge, glint_random *random);

// What glint lets through of the first leaks->rays rays: odd ones are aimed at edges, even ones at
// vertices. Errors: as glint_probe_create.
glint_status count_leaks_of_glint(const bench_scene *scene, const glint_environment *environment,
                                  glint_device *device, leak_count *leaks, glint_error *error);

#endif
