// Measures how near a ray passes an edge. Near an edge another precision may rightly give a
// different pixel; far from edges a different pixel is wrong.
#include "oracle/hit.h"

typedef struct measure {
    double least;     // least ratio so far
    double travelled; // path length up to the ray's origin
    double limit;     // distance of the hit on this ray
} measure;

// The ray is near the triangle if, for each edge's line, it passes inside or outside by less than
// the reach. At a sharp corner this region reaches past the triangle. So it may call a sound pixel
// near, never the reverse.
static void visit_for_edge(const oracle_scene *scene, const query *q, int index, void *state)
{
    measure *m = state;
    if (index == q->left)
        return;
    const oracle_triangle *triangle = &scene->triangles[index];
    // Take the corners relative to the ray's origin.
    vector corners[3], centre = {{0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++) {
        corners[i] = minus(vector_of(triangle->position[i]), q->origin);
        centre = plus(centre, scaled(corners[i], 1.0 / 3.0));
    }
    vector across = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    double slope = dot(across, q->direction);
    double away = dot(centre, q->direction);
    // If the triangle is edge-on, its plane gives no distance. Then use its centre.
    if (fabs(slope) > 1e-6 * length(across))
        away = dot(across, corners[0]) / slope;
    if (!(away > 0.0) || away > m->limit * (1.0 + 1e-6))
        return;

    // Edge functions are positive inside if the triangle faces the ray.
    double sign = slope < 0.0 ? 1.0 : -1.0;
    // Find the least ratio over the edges.
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        vector from = corners[(i + 1) % 3], to = corners[(i + 2) % 3];
        double edge = sign * dot(q->direction, cross(to, from));
        // The distance of two lines: |B·(d × e)|/|d × e|.
        double distance = edge / length(cross(q->direction, minus(to, from)));
        double ratio = distance / (m->travelled + away);
        if (!(ratio > -ORACLE_EDGE_REACH))
            return;
        least = fmin(least, fabs(ratio));
    }
    m->least = fmin(m->least, least);
}

double oracle_ray_edge(const oracle_scene *scene, query q, double travelled, double limit)
{
    measure m = {ORACLE_EDGE_REACH, travelled, limit};
    // The reach is a share of the whole path, but boxes are grown by a share of this ray.
    q.margin = limit < INFINITY && limit > 0.0 ? ORACLE_EDGE_REACH * (1.0 + travelled / limit)
                                               : ORACLE_EDGE_REACH * (1.0 + travelled);
    oracle_visit_triangles(scene, &q, visit_for_edge, &m, &limit);
    return m.least;
}
