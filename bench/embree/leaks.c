// Counts the aimed rays that pass between Embree's triangles. See reference.h.
#include "embree/tile.h"

#include "embree/aimed_rays.h"

#include <math.h>
#include <stdatomic.h>

typedef struct leak_search {
    const embree_program *program;
    uint64_t count;
    atomic_ullong at_vertices, at_edges;
} leak_search;

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

// Traces the rays of one item: odd lanes at edges, even lanes at vertices.
static void search_item(void *context, size_t item, int thread)
{
    (void)thread;
    leak_search *search = context;
    const embree_program *program = search->program;
    glint_random random = {item + 1};
    const embree_query packets = {EMBREE_INTERSECT_16, false};
    uint64_t first = item * AIMED_RAYS_PER_ITEM;
    uint64_t left =
        search->count - first < AIMED_RAYS_PER_ITEM ? search->count - first : AIMED_RAYS_PER_ITEM;
    unsigned long long leaks[2] = {0, 0};
    for (uint64_t ray = 0; ray < left; ray += LANES) {
        struct RTCRayHit16 packet;
        memset(&packet, 0, sizeof packet);
        memset(packet.ray.mask, -1, sizeof packet.ray.mask);
        memset(packet.hit.geomID, -1, sizeof packet.hit.geomID);
        memset(packet.hit.instID, -1, sizeof packet.hit.instID);
        float distances[LANES];
        for (int lane = 0; lane < LANES; lane++) {
            aimed_ray aimed = aim_ray(program->inputs.scene, lane % 2 == 1, &random);
            set_ray(&packet, lane, &aimed);
            distances[lane] = aimed.distance;
        }
        embree_trace(program->scenes[EMBREE_MEDIUM], packets, &packet, 1);
        for (int lane = 0; lane < LANES; lane++) {
            // NaN is a leak too.
            leaks[lane % 2] +=
                !((double)packet.ray.tfar[lane] <= AIMED_BEHIND * (double)distances[lane]);
        }
    }
    atomic_fetch_add(&search->at_vertices, leaks[0]);
    atomic_fetch_add(&search->at_edges, leaks[1]);
}

leak_count embree_program_leaks(embree_program *program, uint64_t count)
{
    leak_search search = {.program = program, .count = count / LANES * LANES};
    size_t items = (size_t)((search.count + AIMED_RAYS_PER_ITEM - 1) / AIMED_RAYS_PER_ITEM);
    bench_pool_run(program->inputs.pool, items, search_item, &search);
    return (leak_count){search.count, search.at_vertices, search.at_edges};
}
