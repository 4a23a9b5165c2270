// Rays aimed at what triangles share: how many pass between them. See embree_reference.h.
#include "embree_tile.h"

#include "base/random.h"

#include <math.h>
#include <stdatomic.h>

#define RAYS_PER_ITEM 4096 // a multiple of LANES
// A ray comes from within 75° of the normals of the vertices that it is aimed at. The meshes are
// smooth, so all triangles around face it, and the next surface behind them is far away.
#define LEAST_COSINE 0.26f
// A hit is at the target if it lies before this many times the distance: far more than rounding,
// far less than the way to the next surface.
#define BEHIND 1.001f

typedef struct leak_search {
    const embree_program *program;
    uint64_t count;
    atomic_ullong at_vertices, at_edges;
} leak_search;

typedef struct aimed_ray {
    float origin[3], direction[3]; // the target lies at origin + direction
} aimed_ray;

// One of the two neighbours of x, or x.
static float nudge(float x, glint_random *random)
{
    double which = glint_random_number(random);
    return which < 1.0 / 3   ? nextafterf(x, -INFINITY)
           : which < 2.0 / 3 ? nextafterf(x, INFINITY)
                             : x;
}

static float cosine_at(const float *normal, const float *direction)
{
    double along = 0, squares = 0;
    for (int k = 0; k < 3; k++) {
        along -= (double)normal[k] * (double)direction[k];
        squares += (double)direction[k] * (double)direction[k];
    }
    return (float)(along / sqrt(squares));
}

// A ray at a random triangle's first vertex, or at a point of its first edge, from a random origin
// that sees it; the direction is right within a unit in the last place of each component.
static aimed_ray aim_ray(const bench_scene *scene, bool at_edge, glint_random *random)
{
    for (;;) {
        const uint32_t *triangle = scene->triangles + 3 * (size_t)(glint_random_number(random) *
                                                                   (double)scene->triangle_count);
        const float *a = scene->positions + 3 * (size_t)triangle[0];
        const float *b = scene->positions + 3 * (size_t)triangle[at_edge ? 1 : 0];
        double share = glint_random_number(random), distance = 1 + glint_random_number(random);
        glint_vec3 from = glint_vec3_scale(glint_random_direction(random), distance);
        const double away[3] = {from.x, from.y, from.z};
        aimed_ray ray;
        for (int k = 0; k < 3; k++) {
            float target = (float)((double)a[k] + share * ((double)b[k] - (double)a[k]));
            ray.origin[k] = (float)((double)target + away[k]);
            ray.direction[k] = nudge(target - ray.origin[k], random);
        }
        const float *normal_a = scene->normals + 3 * (size_t)triangle[0];
        const float *normal_b = scene->normals + 3 * (size_t)triangle[at_edge ? 1 : 0];
        if (cosine_at(normal_a, ray.direction) >= LEAST_COSINE &&
            cosine_at(normal_b, ray.direction) >= LEAST_COSINE) {
            return ray;
        }
    }
}

static void set_ray(struct RTCRayHit16 *packet, int lane, const aimed_ray *ray)
{
    packet->ray.org_x[lane] = ray->origin[0];
    packet->ray.org_y[lane] = ray->origin[1];
    packet->ray.org_z[lane] = ray->origin[2];
    packet->ray.dir_x[lane] = ray->direction[0];
    packet->ray.dir_y[lane] = ray->direction[1];
    packet->ray.dir_z[lane] = ray->direction[2];
    packet->ray.tfar[lane] = INFINITY;
}

// Odd lanes are aimed at edges, even ones at vertices.
static void search_item(void *context, size_t item, int thread)
{
    (void)thread;
    leak_search *search = context;
    const embree_program *program = search->program;
    glint_random random = {item + 1};
    const embree_query packets = {EMBREE_INTERSECT_16, false};
    uint64_t first = item * RAYS_PER_ITEM;
    uint64_t left = search->count - first < RAYS_PER_ITEM ? search->count - first : RAYS_PER_ITEM;
    unsigned long long leaks[2] = {0, 0};
    for (uint64_t ray = 0; ray < left; ray += LANES) {
        struct RTCRayHit16 packet;
        memset(&packet, 0, sizeof packet);
        memset(packet.ray.mask, -1, sizeof packet.ray.mask);
        memset(packet.hit.geomID, -1, sizeof packet.hit.geomID);
        memset(packet.hit.instID, -1, sizeof packet.hit.instID);
        for (int lane = 0; lane < LANES; lane++) {
            aimed_ray aimed = aim_ray(program->inputs.scene, lane % 2 == 1, &random);
            set_ray(&packet, lane, &aimed);
        }
        embree_trace(program->scenes[EMBREE_MEDIUM], packets, &packet, 1);
        for (int lane = 0; lane < LANES; lane++) {
            // NaN is a leak too.
            leaks[lane % 2] += !(packet.ray.tfar[lane] <= BEHIND);
        }
    }
    atomic_fetch_add(&search->at_vertices, leaks[0]);
    atomic_fetch_add(&search->at_edges, leaks[1]);
}

embree_leaks embree_program_leaks(embree_program *program, uint64_t count)
{
    leak_search search = {.program = program, .count = count / LANES * LANES};
    size_t items = (size_t)((search.count + RAYS_PER_ITEM - 1) / RAYS_PER_ITEM);
    bench_pool_run(program->inputs.pool, items, search_item, &search);
    return (embree_leaks){search.count, search.at_vertices, search.at_edges};
}
