// Proves which components are convex.
//
// Why this proves convexity. Suppose that, from an inner point, every triangle is seen from inside,
// and the solid angles add up to 4π. Then the surface, projected onto a sphere around this point,
// covers the sphere once. So it is star-shaped and meets itself nowhere. (A pentagram's pyramid
// also bends outwards at every edge, but covers the sphere twice.) If such a surface bends outwards
// at every edge, it is convex in a neighbourhood of each of its points. A closed surface of this
// kind bounds a convex body (Tietze 1928, Nakajima 1928).
//
// Rounding. Flat faces are cut into triangles, and their corners rounded to floats: half of these
// edges bend inwards by less than the rounding. Each edge may bend so much. But in a very fine mesh
// a whole hollow can hide below this limit. So one of two conditions must hold. Either the sum of
// these bends is slight, or no vertex lies in a hollow, by a search over the whole body
// (convexity.h).
#include "scene/shape/components.h"

#include "base/memory.h"
#include "scene/shape/convexity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UNSEEN 0xFFFFFFFFu

// Facts about the edges of one component.
typedef struct edge_facts {
    bool bends_inwards;    // some edge bends inwards by more than rounding
    double rounding_bends; // radians: sum of the inward bends that rounding explains
} edge_facts;

static glint_vec3 position_at(const glint_welding *weld, uint32_t corner)
{
    return glint_vec3_from_floats(glint_position_at(weld, corner));
}

// Bounds the error of judge_edge's determinant if its four points are off by some roundings. To
// first order it is the sum of |derivative| × |coordinate| × 2^-24.
static double rounding_of(const glint_vec3 *points, const glint_vec3 *derivatives)
{
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        sum += fabs(points[i].x * derivatives[i].x) + fabs(points[i].y * derivatives[i].y) +
               fabs(points[i].z * derivatives[i].z);
    }
    return GLINT_POSITION_ROUNDINGS * ldexp(sum, -24);
}

// Judges the edge from corner `left` to the next corner; its twin begins at corner `right`. The
// triangles are (a, b, c) and (b, a, d). The surface bends inwards if d is above the first one's
// plane. Doubles hold the differences of floats exactly. The determinant's own rounding, about
// 2^-50, is far below the tolerance.
static void judge_edge(const glint_welding *weld, uint32_t left, uint32_t right, edge_facts *facts)
{
    glint_vec3 a = position_at(weld, left);
    glint_vec3 b = position_at(weld, right);
    glint_vec3 c = position_at(weld, glint_next_corner(glint_next_corner(left)));
    glint_vec3 d = position_at(weld, glint_next_corner(glint_next_corner(right)));
    glint_vec3 edge = glint_vec3_subtract(b, a);
    glint_vec3 to_c = glint_vec3_subtract(c, a);
    glint_vec3 to_d = glint_vec3_subtract(d, a);
    glint_vec3 normal = glint_vec3_cross(edge, to_c);
    glint_vec3 other = glint_vec3_cross(to_d, edge);
    double height = glint_vec3_dot(normal, to_d);
    if (height <= 0) {
        return;
    }
    glint_vec3 by_b = glint_vec3_cross(to_c, to_d);
    glint_vec3 by_a = glint_vec3_add(by_b, glint_vec3_add(other, normal)); // negated
    const glint_vec3 points[4] = {a, b, c, d};
    const glint_vec3 derivatives[4] = {by_a, by_b, other, normal};
    if (!(height <= rounding_of(points, derivatives)) || !(glint_vec3_dot(normal, other) > 0)) {
        facts->bends_inwards = true;
        return;
    }
    // The sine of the bend, which is small.
    facts->rounding_bends +=
        height * glint_vec3_length(edge) / (glint_vec3_length(normal) * glint_vec3_length(other));
}

// Forgets which vertices of component i were visited.
static void clear_stamps(glint_components *all, size_t i)
{
    for (uint32_t k = 3 * all->first[i]; k < 3 * all->first[i + 1]; k++) {
        all->stamp[all->weld->vertex_of[3 * all->triangles[k / 3] + k % 3]] = UNSEEN;
    }
}

static edge_facts judge_edges(const glint_components *all, size_t i)
{
    const glint_welding *weld = all->weld;
    edge_facts facts = {false, 0};
    for (uint32_t k = 3 * all->first[i]; k < 3 * all->first[i + 1]; k++) {
        const uint32_t corner = 3 * all->triangles[k / 3] + k % 3;
        if (corner < weld->twin[corner]) {
            judge_edge(weld, corner, weld->twin[corner], &facts);
        }
    }
    return facts;
}

// The solid angle of a triangle, seen from the origin, by Van Oosterom and Strackee (1983).
// Positive if seen from the inside.
static double solid_angle(glint_vec3 a, glint_vec3 b, glint_vec3 c)
{
    double la = glint_vec3_length(a);
    double lb = glint_vec3_length(b);
    double lc = glint_vec3_length(c);
    double numerator = glint_vec3_dot(a, glint_vec3_cross(b, c));
    double denominator = la * lb * lc + glint_vec3_dot(a, b) * lc + glint_vec3_dot(b, c) * la +
                         glint_vec3_dot(c, a) * lb;
    return 2 * atan2(numerator, denominator);
}

// True if every triangle of component i is seen from inside, from the mean of its vertices, and
// they cover the whole sphere once.
static bool is_seen_from_inside(glint_components *all, size_t i)
{
    const glint_welding *weld = all->weld;
    glint_vec3 sum = {0, 0, 0};
    double total = 0;
    clear_stamps(all, i);
    for (uint32_t k = 3 * all->first[i]; k < 3 * all->first[i + 1]; k++) {
        const uint32_t corner = 3 * all->triangles[k / 3] + k % 3;
        uint32_t *stamp = &all->stamp[weld->vertex_of[corner]];
        if (*stamp == UNSEEN) {
            *stamp = 0;
            sum = glint_vec3_add(sum, position_at(weld, corner));
        }
    }
    const glint_vec3 mean = glint_vec3_scale(sum, 1 / (double)all->vertices[i]);
    for (uint32_t k = all->first[i]; k < all->first[i + 1]; k++) {
        const uint32_t corner = 3 * all->triangles[k];
        const double angle = solid_angle(glint_vec3_subtract(position_at(weld, corner), mean),
                                         glint_vec3_subtract(position_at(weld, corner + 1), mean),
                                         glint_vec3_subtract(position_at(weld, corner + 2), mean));
        if (!(angle > 0)) {
            return false;
        }
        total += angle;
    }
    // Multiples of 4π are far apart compared with the sum's rounding.
    return fabs(total - 4 * GLINT_PI) < 0.1;
}

// ---- Hollows ------------------------------------------------------------------------------------

// True if the bends that rounding explains may hide a hollow. If they add up to less than the
// limit, a line that leaves the surface more steeply than the limit does not meet it again. A
// hollow would have to bend more than the limit.
static bool bends_add_up(const edge_facts *facts)
{
    return facts->rounding_bends > 1.0 / 1024;
}

// Gathers the vertices of component i, with the sums of their triangles' normals.
static void gather_points(glint_components *all, size_t i, glint_surface_point *points)
{
    const glint_welding *weld = all->weld;
    uint32_t count = 0;
    clear_stamps(all, i);
    for (uint32_t k = 3 * all->first[i]; k < 3 * all->first[i + 1]; k++) {
        const uint32_t corner = 3 * all->triangles[k / 3] + k % 3;
        const uint32_t vertex = weld->vertex_of[corner];
        const uint32_t next = glint_next_corner(corner);
        if (all->stamp[vertex] == UNSEEN) {
            all->stamp[vertex] = count++;
            memcpy(points[all->stamp[vertex]].position, glint_position_at(weld, corner),
                   sizeof points->position);
        }
        const glint_vec3 here = position_at(weld, corner);
        const glint_vec3 normal =
            glint_vec3_cross(glint_vec3_subtract(position_at(weld, next), here),
                             glint_vec3_subtract(position_at(weld, glint_next_corner(next)), here));
        glint_vec3 *sum = &points[all->stamp[vertex]].normal;
        *sum = glint_vec3_add(*sum, normal);
    }
}

// True if no vertex lies in a hollow. If memory is short, nothing is proved.
static bool has_no_hollow(glint_components *all, size_t i)
{
    glint_surface_point *points = glint_allocate(all->vertices[i], sizeof *points);
    bool none = false;
    if (points != NULL) {
        gather_points(all, i, points);
        none = glint_points_are_extreme(points, all->vertices[i]);
    }
    free(points);
    return none;
}

// ------------------------------------------------------------------------------------------------

void glint_components_judge(glint_components *all)
{
    for (size_t i = 0; i < all->count; i++) {
        glint_component *c = &all->of[i];
        // Every edge of a closed component has two triangles, so V − E + F is V − F/2.
        c->simple = c->closed && !all->is_crowded[i] &&
                    2 * (size_t)all->vertices[i] == c->triangle_count + 4;
        if (c->simple) {
            const edge_facts facts = judge_edges(all, i);
            c->convex = !facts.bends_inwards && is_seen_from_inside(all, i) &&
                        !(bends_add_up(&facts) && !has_no_hollow(all, i));
        }
    }
}
