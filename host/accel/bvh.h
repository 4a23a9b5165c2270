// The bounding volume hierarchy: a wide tree over triangles, in the device's layout; and the
// triangles that it is built from.
#ifndef GLINT_ACCEL_BVH_H
#define GLINT_ACCEL_BVH_H

#include "base/status.h"
#include "base/vector.h"
#include "kernels/layout.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// An upper bound of the builder's memory, bytes per triangle, besides the scene. The finished tree
// takes half of it.
#define GLINT_BVH_BYTES_WHILE_BUILT 75

// A leaf's triangles as the host sees them; kernels/layout.h describes the values.
typedef struct glint_cluster {
    float positions[3][GLINT_CLUSTER_LANES]; // x, y, z of each vertex
    uint8_t corners[3][GLINT_CLUSTER_LANES]; // first, second, third corner of each triangle
    int32_t facts;                           // see glint_cluster_count and glint_cluster_material
    float anchor[3];
} glint_cluster;

static inline int32_t glint_cluster_count(const glint_cluster *cluster)
{
    return cluster->facts & GLINT_CLUSTER_COUNT_MASK;
}

static inline int32_t glint_cluster_material(const glint_cluster *cluster)
{
    return cluster->facts >> GLINT_CLUSTER_COUNT_BITS;
}

// Facts about a built tree, for `info` and statistics.
typedef struct glint_bvh_report {
    size_t triangle_count; // triangles with an area
    size_t node_count;
    size_t cluster_count;
    int depth; // nodes on the longest way from the root
    // The number of nodes and clusters that a random ray through the root's box is expected to meet
    // (surface area heuristic).
    double sah_cost;
    double root_area; // half of the surface area of the root's box, stored units squared
    double fill;      // share of the clusters' lanes that hold a triangle
    size_t bytes;     // of all arrays
    double bytes_per_triangle;
    bool is_refitted; // true after glint_bvh_refit
    int stack_need;   // entries that a traversal's stack must hold
} glint_bvh_report;

// Zero is valid: a tree without triangles. All arrays are aligned to 64 bytes.
typedef struct glint_bvh {
    int width; // children of a node: 8 or 16
    size_t node_count, cluster_count;
    size_t input_count; // triangles given to the builder, including those without area
    // [node_count][7 × width] 32-bit values, see kernels/layout.h; node 0 is the root. Boxes are a
    // little wider than their triangles. So rounding in the tests of boxes and triangles leaves no
    // gap (watertight).
    float *nodes;
    glint_cluster *clusters; // [cluster_count]
    float *normals;          // [cluster_count][GLINT_CLUSTER_NORMALS], or NULL without normals
    int32_t *numbers;        // [cluster_count][GLINT_CLUSTER_LANES]
    glint_bvh_report report;
} glint_bvh;

// Triangles as a scene holds them. Pointers are borrowed.
typedef struct glint_bvh_inputs {
    const uint32_t *indices; // [triangle_count][3] or NULL, see glint_triangle_vertex
    const float *positions;  // [vertex][3], magnitudes below GLINT_FAR
    const float *told;       // positions relative to their parts' anchors; NULL: there are no parts
    const uint32_t *part_of; // [triangle_count], the part of each triangle; only with parts
    const float (*anchors)[3];   // the parts' anchors
    const float *normals;        // [vertex][3], or NULL
    bool has_normals_by_corner;  // normals: [triangle_count][3][3]
    const uint32_t *material_of; // [triangle_count]
    size_t triangle_count;
    int width;      // children of a node: 8 or 16
    size_t threads; // 0: one per core; the tree is the same for any number
} glint_bvh_inputs;

// Returns three floats of a corner: its position or normal.
typedef const float *glint_bvh_value(const glint_bvh_inputs *in, size_t triangle, size_t corner);

// Returns a corner's position as clusters store it: relative to the anchor if there are parts.
static inline const float *glint_bvh_told(const glint_bvh_inputs *in, size_t triangle,
                                          size_t corner)
{
    return (in->told != NULL ? in->told : in->positions) +
           3 * glint_triangle_vertex(in->indices, triangle, corner);
}

// Returns a corner's normal; only with normals.
static inline const float *glint_bvh_normal(const glint_bvh_inputs *in, size_t triangle,
                                            size_t corner)
{
    return in->normals + 3 * (in->has_normals_by_corner
                                  ? 3 * triangle + corner
                                  : glint_triangle_vertex(in->indices, triangle, corner));
}

static inline bool glint_bvh_has_area(const glint_bvh_inputs *in, size_t triangle)
{
    return glint_triangle_has_area(glint_bvh_told(in, triangle, 0), glint_bvh_told(in, triangle, 1),
                                   glint_bvh_told(in, triangle, 2));
}

// Returns the anchor to which a triangle's stored corners are relative.
static inline const float *glint_bvh_anchor(const glint_bvh_inputs *in, size_t triangle)
{
    static const float origin[3] = {0, 0, 0};
    return in->told != NULL ? in->anchors[in->part_of[triangle]] : origin;
}

// Returns the triangle's group. A cluster holds triangles of one group: one material, one anchor.
static inline uint64_t glint_bvh_group(const glint_bvh_inputs *in, size_t triangle)
{
    const uint64_t part = in->told != NULL ? in->part_of[triangle] : 0;
    return part << 32 | in->material_of[triangle];
}

#endif
