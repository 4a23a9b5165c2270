// Tells how two triangles meet. See faces.h.
#include "scene/shape/faces.h"

#include "kernels/layout.h"

#include <math.h>
#include <string.h>

#define FARTHER 4.0 // factor on the kernels' distance
// Rays are exact to a share of this many times the distance to a small part (LARGE_TRIANGLE).
#define NEIGHBOURHOOD 16
// The least cosine between coinciding planes; the kernels use 0.99.
#define NEARLY_PARALLEL 0.9

// The first term covers the rounding of the corners. The second covers the rounding of rays, for
// planes through the origin. Near a smaller part, rays are as exact as this part is.
double glint_face_reach(const glint_face *f, const glint_face *other)
{
    const double size = fmin(f->size, NEIGHBOURHOOD * other->size);
    return FARTHER * (double)GLINT_TOUCHING * (f->along_normal + 0.5 * size);
}

glint_face glint_face_of(const glint_scene *scene, size_t triangle)
{
    glint_face f;
    double most[3] = {0, 0, 0};
    for (size_t i = 0; i < 3; i++) {
        const float *told = glint_scene_told(scene, triangle, i);
        f.at[i] = glint_scene_corner(scene, triangle, i);
        for (int k = 0; k < 3; k++) {
            most[k] = fmax(most[k], fabs((double)told[k]));
        }
    }
    f.size = scene->parts.count > 0 ? fmax(most[0], fmax(most[1], most[2])) : 1;
    f.normal = glint_vec3_normalize(glint_vec3_cross(glint_vec3_subtract(f.at[1], f.at[0]),
                                                     glint_vec3_subtract(f.at[2], f.at[0])));
    f.along_normal =
        fabs(f.normal.x) * most[0] + fabs(f.normal.y) * most[1] + fabs(f.normal.z) * most[2];
    return f;
}

bool glint_face_faces(const glint_face *f, glint_vec3 point, double reach)
{
    for (int i = 0; i < 3; i++) {
        const glint_vec3 along = glint_vec3_subtract(f->at[(i + 1) % 3], f->at[i]);
        const glint_vec3 inwards = glint_vec3_normalize(glint_vec3_cross(f->normal, along));
        if (glint_vec3_dot(inwards, glint_vec3_subtract(point, f->at[i])) < -reach) {
            return false;
        }
    }
    return true;
}

// Heights of the corners of `above` over the plane of `f`; 0 within its reach.
static void find_heights(const glint_face *f, const glint_face *above, double reach,
                         double heights[3])
{
    for (int i = 0; i < 3; i++) {
        const double h = glint_vec3_dot(f->normal, glint_vec3_subtract(above->at[i], f->at[0]));
        heights[i] = fabs(h) <= reach ? 0 : h;
    }
}

static int count_zeros(const double heights[3])
{
    return (heights[0] == 0) + (heights[1] == 0) + (heights[2] == 0);
}

static bool on_one_side(const double heights[3])
{
    return (heights[0] >= 0 && heights[1] >= 0 && heights[2] >= 0) ||
           (heights[0] <= 0 && heights[1] <= 0 && heights[2] <= 0);
}

// True if some edge of `a` separates the two faces within the plane of `a`.
static bool edge_separates(const glint_face *a, const glint_face *b, double reach)
{
    for (int i = 0; i < 3; i++) {
        const glint_vec3 from = a->at[i];
        const glint_vec3 along = glint_vec3_subtract(a->at[(i + 1) % 3], from);
        const glint_vec3 out = glint_vec3_normalize(glint_vec3_cross(along, a->normal));
        double least = INFINITY;
        for (int k = 0; k < 3; k++) {
            least = fmin(least, glint_vec3_dot(out, glint_vec3_subtract(b->at[k], from)));
        }
        if (least >= -reach) {
            return true;
        }
    }
    return false;
}

// Finds the stretch of a line that lies on a face, in the direction `along`. The face crosses the
// line.
static void find_stretch(const glint_face *f, const double heights[3], glint_vec3 along,
                         double ends[2])
{
    ends[0] = INFINITY;
    ends[1] = -INFINITY;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        if (heights[i] * heights[j] > 0 || heights[i] == heights[j]) {
            continue;
        }
        const double share = heights[i] / (heights[i] - heights[j]);
        const glint_vec3 at = glint_vec3_add(
            f->at[i], glint_vec3_scale(glint_vec3_subtract(f->at[j], f->at[i]), share));
        const double where = glint_vec3_dot(along, at);
        ends[0] = fmin(ends[0], where);
        ends[1] = fmax(ends[1], where);
    }
}

// Möller, "A Fast Triangle-Triangle Intersection Test" (1997).
glint_meeting glint_faces_meet(const glint_face *a, const glint_face *b)
{
    double of_b[3];
    double of_a[3];
    const double reach_a = glint_face_reach(a, b);
    const double reach_b = glint_face_reach(b, a);
    find_heights(a, b, reach_a, of_b);
    find_heights(b, a, reach_b, of_a);
    if (count_zeros(of_a) == 3 || count_zeros(of_b) == 3) {
        const bool alike = fabs(glint_vec3_dot(a->normal, b->normal)) > NEARLY_PARALLEL;
        return alike && !edge_separates(a, b, reach_a) && !edge_separates(b, a, reach_b)
                   ? GLINT_FACES_TOUCH
                   : GLINT_FACES_APART;
    }
    if (on_one_side(of_a) || on_one_side(of_b)) {
        return count_zeros(of_a) == 2 || count_zeros(of_b) == 2 ? GLINT_FACES_MEET_IN_EDGE
                                                                : GLINT_FACES_APART;
    }
    const glint_vec3 along = glint_vec3_normalize(glint_vec3_cross(a->normal, b->normal));
    double one[2];
    double other[2];
    find_stretch(a, of_a, along, one);
    find_stretch(b, of_b, along, other);
    const double common = fmin(one[1], other[1]) - fmax(one[0], other[0]);
    return common > fmax(reach_a, reach_b) ? GLINT_FACES_CROSS : GLINT_FACES_APART;
}

// True if a part of the edge from p to q is within the face, not on its boundary.
static bool runs_within(const glint_face *f, glint_vec3 p, glint_vec3 q, double reach)
{
    double first = 0;
    double last = 1;
    for (int i = 0; i < 3; i++) {
        const glint_vec3 from = f->at[i];
        const glint_vec3 along = glint_vec3_subtract(f->at[(i + 1) % 3], from);
        const glint_vec3 inwards = glint_vec3_normalize(glint_vec3_cross(f->normal, along));
        const double at_p = glint_vec3_dot(inwards, glint_vec3_subtract(p, from)) - reach;
        const double at_q = glint_vec3_dot(inwards, glint_vec3_subtract(q, from)) - reach;
        if (at_p <= 0 && at_q <= 0) {
            return false;
        }
        const double share = at_p / (at_p - at_q);
        first = at_p < 0 ? fmax(first, share) : first;
        last = at_q < 0 ? fmin(last, share) : last;
    }
    return first < last;
}

bool glint_edge_on_face(const glint_face *f, const glint_face *other, glint_face_edge *edge)
{
    double heights[3];
    const double reach = glint_face_reach(f, other);
    find_heights(f, other, reach, heights);
    if (count_zeros(heights) != 2) {
        return false;
    }
    const int third = heights[0] != 0 ? 0 : heights[1] != 0 ? 1 : 2;
    const glint_vec3 p = other->at[(third + 1) % 3];
    const glint_vec3 q = other->at[(third + 2) % 3];
    const bool swaps = p.x != q.x ? p.x > q.x : p.y != q.y ? p.y > q.y : p.z > q.z;
    edge->ends[0] = swaps ? q : p;
    edge->ends[1] = swaps ? p : q;
    edge->is_above = heights[third] > 0;
    return runs_within(f, p, q, reach);
}
