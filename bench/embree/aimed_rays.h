// Aims rays at shared vertices and edges, to test if a program's intersection is watertight.
#ifndef GLINT_BENCH_EMBREE_AIMED_RAYS_H
#define GLINT_BENCH_EMBREE_AIMED_RAYS_H

#include "base/random.h"
#include "device/device.h"
#include "scenes.h"

#include <stdbool.h>
#include <stdint.h>

#define AIMED_RAYS_PER_ITEM 4096 // they share one seed: the item's number plus 1
// A hit is at the target if it lies before this many times the distance. The margin is far more
// than rounding, and far less than the way to the next surface.
#define AIMED_BEHIND 1.001

typedef struct aimed_ray {
    float origin[3], direction[3]; // direction: a unit vector within rounding
    float distance;                // to the target
} aimed_ray;

// Half of the rays are aimed at vertices, half at edges. A leak is a ray that passes through the
// surface there.
typedef struct leak_count {
    uint64_t rays;
    uint64_t at_vertices, at_edges;
} leak_count;

// Makes a ray at the first vertex of a random triangle, or at a point of its first edge. The ray's
// random origin sees the target. Each component of the direction is right within a unit in the last
// place. The scene must be closed and smooth.
aimed_ray aim_ray(const bench_scene *scene, bool at_edge, glint_random *random);

// Counts the leaks of glint among the first leaks->rays rays. Odd rays are aimed at edges, even
// rays at vertices. Errors: as glint_probe_create.
glint_status count_leaks_of_glint(const bench_scene *scene, const glint_environment *environment,
                                  glint_device *device, leak_count *leaks, glint_error *error);

#endif
