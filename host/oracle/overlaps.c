// Finds which solid absorbs a path's light, also where solids touch or overlap (rule 5).
//
// It looks at points: a solid is there if its surface surrounds the point. So there is no stack,
// and the order of triangles does not matter.
#include "oracle/overlaps.h"
#include "oracle/hit.h"
#include "oracle/surface.h"
#include "oracle/walk.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

enum { MATERIALS = 64 }; // most materials of solids

// The distance beside a surface at which its sides are examined, and at which rays leave it. Both
// are shares of the largest coordinate.
#define BESIDE 2e-5
#define LEAVING 2e-6

// Sums over the triangles of a material.
typedef struct solid_sum {
    double angle;  // solid angle of its surface seen from a point; 4π from inside
    double volume; // six times the volume
} solid_sum;

static vector corner_from(const oracle_triangle *t, int i, vector point)
{
    return minus(vector_of(t->position[i]), point);
}

// The signed solid angle of a triangle (Van Oosterom and Strackee 1983).
static void add_triangle(const oracle_triangle *t, vector point, solid_sum *sum)
{
    vector a = corner_from(t, 0, point), b = corner_from(t, 1, point), c = corner_from(t, 2, point);
    double across = dot(a, cross(b, c));
    double along = length(a) * length(b) * length(c) + dot(a, b) * length(c) +
                   dot(b, c) * length(a) + dot(c, a) * length(b);
    sum->angle += 2.0 * atan2(across, along);
    sum->volume += across;
}

static void add_solids(const oracle_scene *scene, vector point, solid_sum sums[MATERIALS])
{
    for (int i = 0; i < scene->triangle_count; i++) {
        const oracle_triangle *t = &scene->triangles[i];
        if (t->material < MATERIALS && oracle_is_solid(&scene->materials[t->material]))
            add_triangle(t, point, &sums[t->material]);
    }
}

// True if the first of two materials wins: higher priority, or the same and less volume. −1 (none)
// loses to all.
static bool is_over(const oracle_scene *scene, const solid_sum *sums, int one, int other)
{
    if (one < 0 || other < 0)
        return one >= 0;
    double more = scene->materials[one].priority - scene->materials[other].priority;
    return more > 0.0 || (more == 0.0 && sums[one].volume < sums[other].volume);
}

// The material of the solid at a point, or −1.
static int solid_at(const oracle_scene *scene, const solid_sum *sums)
{
    int best = -1;
    for (int m = 0; m < MATERIALS; m++) {
        if (sums[m].angle > 2.0 * PI && is_over(scene, sums, m, best))
            best = m;
    }
    return best;
}

enum { NO_SOLID = -2 }; // in place of a material: a surface that bounds no solid

// Selects the triangle of a material with the lowest number among those in one place.
typedef struct choice {
    const oracle_scene *scene;
    int material;
    oracle_hit *hit;
    bool found;
} choice;

static void choose(void *state, const oracle_hit *hit)
{
    choice *c = state;
    int material = c->scene->triangles[hit->triangle].material;
    if (!oracle_is_solid(&c->scene->materials[material]))
        material = NO_SOLID;
    if (material != c->material || (c->found && hit->triangle > c->hit->triangle))
        return;
    *c->hit = *hit;
    c->found = true;
}

static double largest_coordinate(const oracle_triangle *t)
{
    double most = 0.0;
    for (int i = 0; i < 9; i++)
        most = fmax(most, fabs(t->position[i / 3][i % 3]));
    return most;
}

static vector normal_of(const oracle_triangle *t)
{
    vector first = vector_of(t->position[0]);
    return unit(
        cross(minus(vector_of(t->position[1]), first), minus(vector_of(t->position[2]), first)));
}

bool oracle_sides(const oracle_scene *scene, const oracle_ray *ray, oracle_hit *hit, int sides[2])
{
    const oracle_triangle *t = &scene->triangles[hit->triangle];
    vector d = vector_of(ray->direction);
    vector point = plus(vector_of(ray->origin), scaled(d, hit->distance));
    vector n = normal_of(t);
    double size = largest_coordinate(t), slope = dot(n, d);
    vector step = scaled(n, slope > 0.0 ? BESIDE * size : -BESIDE * size);
    solid_sum before[MATERIALS] = {{0.0, 0.0}}, beyond[MATERIALS] = {{0.0, 0.0}};
    add_solids(scene, minus(point, step), before);
    add_solids(scene, plus(point, step), beyond);
    sides[0] = solid_at(scene, before);
    sides[1] = solid_at(scene, beyond);
    bool near = is_over(scene, beyond, sides[0], sides[1]);
    choice c = {scene, NO_SOLID, hit, false};
    double reach = LEAVING * size / fmax(fabs(slope), 1e-6);
    const double range[2] = {hit->distance - reach, hit->distance + reach};
    query q = oracle_query_from(scene, ray, -1);
    oracle_each_hit(scene, &q, range, choose, &c);
    if (c.found)
        return true;
    c.material = sides[near ? 0 : 1];
    oracle_each_hit(scene, &q, range, choose, &c);
    return sides[0] != sides[1];
}

oracle_hit oracle_pass_eye(const oracle_scene *scene, const oracle_ray *ray, oracle_hit hit)
{
    oracle_ray later = *ray;
    vector d = vector_of(ray->direction);
    double passed = 0.0;
    while (hit.triangle >= 0) {
        const oracle_triangle *t = &scene->triangles[hit.triangle];
        double height = fabs(dot(normal_of(t), d)) * (passed + hit.distance);
        if (height > LEAVING * largest_coordinate(t))
            break;
        vector at = plus(vector_of(later.origin), scaled(d, hit.distance));
        vector beside = oracle_start_beside(scene, hit.triangle, at, d);
        passed += hit.distance;
        vector_store(beside, later.origin);
        hit = oracle_closest_hit(scene, &later, -1);
    }
    hit.distance += passed;
    return hit;
}

vector oracle_start_beside(const oracle_scene *scene, int triangle, vector point, vector direction)
{
    const oracle_triangle *t = &scene->triangles[triangle];
    vector n = normal_of(t);
    double step = LEAVING * largest_coordinate(t);
    return plus(point, scaled(n, dot(direction, n) < 0.0 ? -step : step));
}

// The segment that ends at this surface was inside the topmost solid. If the path is inside none
// and meets the back face of a solid, it began inside this solid.
void oracle_absorb(const oracle_scene *scene, path *p, const surface *s, double distance)
{
    if (p->inside.count == 0 && !s->front && oracle_is_solid(s->material) && !scene->overlaps)
        media_enter(&p->inside, s->index);
    if (p->inside.count == 0)
        return;
    const oracle_material *m = &scene->materials[p->inside.solid[p->inside.count - 1]];
    for (int i = 0; i < 3; i++)
        p->weight.at[i] *=
            oracle_transmittance(m->attenuation[i], m->attenuation_distance, distance);
}
