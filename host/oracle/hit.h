// Enumerates the triangles near a ray. Internal to the oracle.
#ifndef GLINT_ORACLE_HIT_H
#define GLINT_ORACLE_HIT_H

#include "oracle/oracle.h"
#include "oracle/vector.h"

typedef struct query {
    vector origin, direction;
    int left;             // triangle that the ray leaves, or −1
    int along, across[2]; // axes: the direction's largest component, and the others
    double shear[2];      // direction along `across` per unit along `along`
    double start_error;   // distance within which the origin may lie in another plane
    double margin;        // boxes are grown by this share of their distance
} query;

query oracle_query_from(const oracle_scene *scene, const oracle_ray *ray, int left);

typedef void (*visitor)(const oracle_scene *scene, const query *q, int index, void *state);

// Calls `visit` with every triangle (without a tree), or at least with those whose grown box the
// ray passes before *limit. *limit may shrink meanwhile.
void oracle_visit_triangles(const oracle_scene *scene, const query *q, visitor visit, void *state,
                            const double *limit);

// Calls `take` with every hit at a distance within `range`, in any order.
typedef void (*taker)(void *state, const oracle_hit *hit);
void oracle_each_hit(const oracle_scene *scene, const query *q, const double range[2], taker take,
                     void *state);

// The least ratio of (distance from the ray to an edge) to (path length up to the edge), at most
// ORACLE_EDGE_REACH. It covers the triangles that the ray meets or passes before `limit`.
// `travelled` is the path's length up to the ray's origin.
double oracle_ray_edge(const oracle_scene *scene, query q, double travelled, double limit);

#endif
