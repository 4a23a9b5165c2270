// The entry point: one work-item renders one tile of pixels, sample by sample: it finds what the
// primary rays meet, all at once, and then follows every path to its end, packet by packet.
//
// The host compiles this file with every GLINT_<FEATURE> of features.h as 0 or 1, and GLINT_WIDTH,
// GLINT_BVH_WIDTH, GLINT_DOUBLE, GLINT_HALF_TEXELS, GLINT_STACK_CAPACITY, GLINT_MEDIA_BITS,
// GLINT_MEDIA_CAPACITY, GLINT_TRAVERSAL_STACK and GLINT_TILES.
#if (GLINT_SOLID || GLINT_THIN_WALL) && !GLINT_GLASS
#error "SOLID and THIN_WALL need GLASS"
#endif
#if (GLINT_ABSORPTION || GLINT_NESTED_MEDIA) && !GLINT_SOLID
#error "ABSORPTION and NESTED_MEDIA need SOLID"
#endif
#if GLINT_GLOSS && !GLINT_PAINT
#error "GLOSS needs PAINT"
#endif
#if GLINT_SPLIT && !GLINT_GLASS
#error "SPLIT needs GLASS"
#endif
#if GLINT_HITS && !GLINT_GEOMETRY
#error "HITS needs GEOMETRY"
#endif

#include "layout.h"
#include "lanes.cl"
#include "blocks.cl"
#include "cubemap.cl"
#include "optics.cl"
#include "media.cl"
#include "frustum.cl"
#include "stack.cl"
#include "intersect.cl"
#include "traverse_packet.cl"
#include "traverse_tile.cl"
#include "lookups.cl"
#include "shade.cl"
#include "scatter.cl"
#include "branches.cl"

#define NEEDS_IRRADIANCE (GLINT_PAINT || GLINT_BLEND)
// Pixels get more than what the environment's look-ups bring.
#define GATHERS                                                                                    \
    (GLINT_PAINT || GLINT_BLEND || GLINT_UNLIT || GLINT_EMISSION || GLINT_TRANSPARENT || GLINT_HITS)

// What one work-item counts; added to the counters at its end.
typedef struct tally {
    ulong counts[GLINT_COUNTERS];
    real weight_by_depth, weight_by_min_weight, weight_by_stack;
} tally;

static inline tally no_tally(void)
{
    tally t;
    for (int i = 0; i < GLINT_COUNTERS; i++) {
        t.counts[i] = 0;
    }
    t.weight_by_depth = t.weight_by_min_weight = t.weight_by_stack = real_of(0);
    return t;
}

static inline real3 join_vector(const glint_split_vector *v)
{
    return real3_of(real_of(JOIN(v->high[0], v->low[0])), real_of(JOIN(v->high[1], v->low[1])),
                    real_of(JOIN(v->high[2], v->low[2])));
}

#if GLINT_ENV_ROTATION
// The environment turned by the angle a about +Y is looked up along d turned by −a.
static inline real3 turn_into_environment(const glint_frame_record *frame, real3 d)
{
    real c = real_of(JOIN(frame->env_rotation[0], frame->env_rotation[1]));
    real s = real_of(JOIN(frame->env_rotation[2], frame->env_rotation[3]));
    return real3_of(fused(c, d.x, -(s * d.z)), d.y, fused(s, d.x, c * d.z));
}
#else
static inline real3 turn_into_environment(const glint_frame_record *frame, real3 d) { return d; }
#endif

// A packet of primary rays, which pixels' samples they are, and what they meet.
typedef struct primary {
    real x, y;        // places on the image plane
    real length;      // of the directions before they were made unit vectors
    lanes_int places; // of the triangles hit, −1: none
} primary;

// The primary rays through the points (x, y) of the image plane, see glint_frame_record.
static inline path primary_rays(const glint_frame_record *frame, primary *first)
{
    real x = first->x, y = first->y;
    path ray;
    ray.origin = scale_add(join_vector(&frame->origin_y), y,
                           scale_add(join_vector(&frame->origin_x), x, join_vector(&frame->origin)));
    real3 d = scale_add(join_vector(&frame->direction_y), y,
                        scale_add(join_vector(&frame->direction_x), x,
                                  join_vector(&frame->direction)));
    real length_squared = dot3(d, d); // 1 or more
    real inverse = inverse_root(length_squared);
    real length = length_squared * inverse;
    first->length = length;
    ray.direction = scale(d, inverse);
    ray.weight = real3_of(real_of(1), real_of(1), real_of(1));
#if GLINT_ABSORPTION
    ray.travelled = length * JOIN(frame->start[0], frame->start[1]);
#endif
    ray.from = int_of(-1);
    ray.met = int_of(0);
    ray.media = int_of(0);
    ray.looked_up = int_of(0);
    return ray;
}

// One branch that leaves the surface: a ray along `direction`, on the side that `sign` says (+1 the
// viewer's, −1 the other).
static inline path make_branch(const path *ray, const surface *s, const closest *hit,
                               real3 direction, scalar sign)
{
    path branch = *ray;
    branch.direction = direction;
    branch.met = ray->met + (lane_int)1;
#if GLINT_INTERREFLECTION
    branch.origin = scale_add(s->geometric_normal, s->offset * sign, s->position);
    branch.from = hit->place;
#endif
#if GLINT_ABSORPTION
    branch.travelled = real_of(0);
#endif
    return branch;
}

// Rule 7: a branch that has met all the surfaces it may, or weighs too little, takes the environment
// along its direction. What that leaves out is counted.
static inline void end_branch(const glint_frame_record *frame, path *branch, mask exists,
                              tally *tally)
{
    real weight = largest3(branch->weight);
    mask deep = exists & (branch->met >= (lane_int)frame->depth);
    mask light = exists & !deep & (weight < (scalar)frame->min_weight);
    const real zero = real_of(0);
    tally->weight_by_depth += SELECT(deep, weight, zero);
    tally->weight_by_min_weight += SELECT(light, weight, zero);
    branch->looked_up = SELECT(deep | light, int_of(1), int_of(0));
}

#if GLINT_ABSORPTION
// The light that is left of the segment that ends here, in the medium on top of the stack.
static inline real3 absorbed_weight(const scene_buffers *scene, const path *ray, real t)
{
    real3 left =
        medium_transmittance(scene->media, medium_on_top(ray->media), t + ray->travelled);
    return multiply(ray->weight, left);
}
#endif

// *ray = *branch for the rays in `yes`.
static inline void assign_path(path *ray, const path *branch, mask yes)
{
    ray->origin = select3(yes, branch->origin, ray->origin);
    ray->direction = select3(yes, branch->direction, ray->direction);
    ray->weight = select3(yes, branch->weight, ray->weight);
#if GLINT_ABSORPTION
    ray->travelled = SELECT(yes, branch->travelled, ray->travelled);
#endif
    ray->from = SELECT(yes, branch->from, ray->from);
    ray->met = SELECT(yes, branch->met, ray->met);
    ray->media = SELECT(yes, branch->media, ray->media);
    ray->looked_up = SELECT(yes, branch->looked_up, ray->looked_up);
}

#if GLINT_GLASS
static inline void count_transmissions(const surface *s, mask transmits, tally *tally)
{
    mask solid = HAS_FLAG(*s, GLINT_MATERIAL_SOLID);
    tally->counts[GLINT_COUNT_REFRACTED_IN] += (ulong)count_lanes(transmits & solid & s->outside);
    tally->counts[GLINT_COUNT_REFRACTED_OUT] += (ulong)count_lanes(transmits & solid & !s->outside);
    tally->counts[GLINT_COUNT_TRANSMITTED] += (ulong)count_lanes(transmits & !solid);
}

#if GLINT_SPLIT
// Where a path splits it goes on with the lighter branch, and the heavier waits; where the stack has
// room for one more only, both are looked up, and counted.
static inline mask split_path(branches *waiting, path *reflected, path *transmitted, mask reflects,
                              mask transmits, path *ray, tally *tally)
{
    mask both = reflects & transmits;
    mask reflect_first = reflects & (!transmits | (largest3(reflected->weight) <=
                                                   largest3(transmitted->weight)));
    mask full = both & nearly_full(waiting);
    if (any_lane(full)) {
        const real zero = real_of(0);
        mask unended_r = full & (reflected->looked_up == (lane_int)0);
        mask unended_t = full & (transmitted->looked_up == (lane_int)0);
        tally->weight_by_stack += SELECT(unended_r, largest3(reflected->weight), zero) +
                                  SELECT(unended_t, largest3(transmitted->weight), zero);
        reflected->looked_up = SELECT(full, int_of(1), reflected->looked_up);
        transmitted->looked_up = SELECT(full, int_of(1), transmitted->looked_up);
    }
    assign_path(ray, reflected, reflects);
    assign_path(ray, transmitted, transmits & !reflect_first);
    assign_path(reflected, transmitted, both & reflect_first);
    push_branch(waiting, reflected, both);
    return reflects | transmits;
}
#endif
#endif

// Shades the rays in `met`, adds what the surfaces emit to `radiance`, and puts the branch that goes
// on into `ray`. The result says which rays go on.
static inline mask meet_surfaces(const scene_buffers *scene, const glint_frame_record *frame,
                                 const closest *hit, const triangle *triangles, mask met,
                                 path *ray, real3 *radiance,
#if GLINT_SPLIT
                                 branches *waiting,
#endif
                                 tally *tally)
{
    surface s = find_surface(scene, ray, hit, triangles);
    real3 v = negate(ray->direction);
    real3 irradiance = real3_of(real_of(0), real_of(0), real_of(0));
#if NEEDS_IRRADIANCE
    irradiance = sample_cube(&scene->irradiance, turn_into_environment(frame, s.normal), met);
#endif
    mask media_lost;
    lanes_int media = ray->media;
    scattering out = scatter(scene, &s, v, &media, irradiance, &media_lost);
    ray->media = SELECT(met, media, ray->media);
#if GLINT_ABSORPTION
    ray->weight = select3(met, absorbed_weight(scene, ray, hit->t), ray->weight);
#endif
    real3 gathered = add(*radiance, multiply(ray->weight, out.emitted));
    *radiance = select3(met, gathered, *radiance);
    tally->counts[GLINT_COUNT_MEDIA_OVERFLOWS] += (ulong)count_lanes(met & media_lost);

    path reflected = make_branch(ray, &s, hit, out.reflected, R(1.0));
    reflected.weight = multiply(ray->weight, out.reflected_weight);
    reflected.media = out.media_reflected;
    // A weight of exactly 0 adds nothing; NaN compares false and ends the path.
    mask reflects = met & (largest3(reflected.weight) > R(0.0));
    end_branch(frame, &reflected, reflects, tally);
    tally->counts[GLINT_COUNT_REFLECTED] += (ulong)count_lanes(reflects);
#if GLINT_GLASS
    path transmitted = make_branch(ray, &s, hit, out.transmitted, R(-1.0));
    transmitted.weight = multiply(ray->weight, out.transmitted_weight);
    transmitted.media = out.media_transmitted;
    mask transmits = met & (largest3(transmitted.weight) > R(0.0));
    end_branch(frame, &transmitted, transmits, tally);
    count_transmissions(&s, transmits, tally);
    tally->counts[GLINT_COUNT_TOTAL_REFLECTIONS] +=
        (ulong)count_lanes(reflects & out.total_reflection);
#if GLINT_SPLIT
    return split_path(waiting, &reflected, &transmitted, reflects, transmits, ray, tally);
#else
    assign_path(ray, &transmitted, transmits);
    assign_path(ray, &reflected, reflects);
    return reflects | transmits;
#endif
#else
    assign_path(ray, &reflected, reflects);
    return reflects;
#endif
}

// What the rays in `traced` meet, and the corners of the triangles there.
static inline closest find_hits(const scene_buffers *scene, const image_space *image,
                                const path *ray, const primary *first, mask traced,
                                triangle *triangles)
{
    closest hit;
    if (first != 0) {
        hit.place = SELECT(traced, first->places, int_of(-1));
    } else {
        hit = trace_packet(scene, ray->origin, ray->direction, ray->from, traced);
    }
    mask met = hit.place >= (lane_int)0;
    if (any_lane(met)) {
        *triangles = load_triangles(scene, hit.place, met);
        if (first != 0) {
            measure_hits(image, triangles->vertices, first->x, first->y, first->length, met, &hit);
        }
    }
    return hit;
}

// Follows the primary rays of a group, those in `active`, to their ends. What they gather from the
// environment is looked up later; the result is the radiance that they gather on their way.
static inline real3 follow_paths(const scene_buffers *scene, const glint_frame_record *frame,
                                 const image_space *image, const primary *first, int group,
                                 path *ray, mask active, lookups *later, tally *tally)
{
    real3 radiance = real3_of(real_of(0), real_of(0), real_of(0));
    lanes_int deepest = int_of(0);
#if GLINT_SPLIT
    branches waiting;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        waiting.count[lane] = 0;
    }
#endif
    while (any_lane(active)) {
        mask met = mask_none();
#if GLINT_GEOMETRY
        closest hit;
        triangle triangles;
        // At depth 1 only primary rays are traced.
        if (GLINT_INTERREFLECTION || first != 0) {
            mask traced = active & (ray->looked_up == (lane_int)0);
            hit = find_hits(scene, image, ray, first, traced, &triangles);
            met = hit.place >= (lane_int)0;
        }
#endif
        mask escaped = active & !met;
        if (any_lane(escaped) && !(GLINT_TRANSPARENT && first != 0)) {
            look_up_later(later, &scene->environment, turn_into_environment(frame, ray->direction),
                          ray->weight, escaped, group);
        }
        active = mask_none();
#if GLINT_GEOMETRY
        mask ended = escaped;
        if (any_lane(met)) {
            deepest = SELECT(met & (ray->met >= deepest), ray->met + (lane_int)1, deepest);
            active = meet_surfaces(scene, frame, &hit, &triangles, met, ray, &radiance,
#if GLINT_SPLIT
                                   &waiting,
#endif
                                   tally);
            ended = ended | (met & !active);
        }
#if GLINT_SPLIT
        if (any_lane(ended)) {
            active = active | pop_branch(&waiting, ray, ended);
        }
#endif
#endif
        first = 0;
    }
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        ulong depth = (ulong)LANE_INT(deepest, lane);
        tally->counts[GLINT_COUNT_DEEPEST] = max(tally->counts[GLINT_COUNT_DEEPEST], depth);
    }
    return radiance;
}

// Adds to a counter of 64 bits in two words: devices need not have atomics of 64 bits.
static inline void add_to_counter(global uint *counter, ulong amount)
{
    uint low = (uint)amount, high = (uint)(amount >> 32);
    uint before = low != 0 ? atomic_add(counter, low) : 0;
    high += before + low < before ? 1 : 0;
    if (high != 0) {
        atomic_add(counter + 1, high);
    }
}

// A sum of weights in the counters' unit.
static inline ulong weight_units(real weights)
{
    return (ulong)(sum_of_lanes(weights) * (scalar)(1UL << GLINT_WEIGHT_BITS));
}

static inline void report(tally *tally, global uint *counters)
{
    const uint slot = (uint)(get_global_id(1) * get_global_size(0) + get_global_id(0));
    ulong *counts = tally->counts;
    counts[GLINT_COUNT_WEIGHT_BY_DEPTH] = weight_units(tally->weight_by_depth);
    counts[GLINT_COUNT_WEIGHT_BY_MIN_WEIGHT] = weight_units(tally->weight_by_min_weight);
    counts[GLINT_COUNT_WEIGHT_BY_STACK] = weight_units(tally->weight_by_stack);
    global uint *mine = counters + 2 * GLINT_COUNTERS * (slot % GLINT_COUNTER_SLOTS);
    for (int i = 0; i < GLINT_COUNTERS; i++) {
        if (counts[i] == 0) {
            continue;
        }
        if (i == GLINT_COUNT_DEEPEST) {
            atomic_max(mine + 2 * i, (uint)counts[i]);
        } else {
            add_to_counter(mine + 2 * i, counts[i]);
        }
    }
}

#if GLINT_HITS
// Instead of a colour: distance, barycentric weights, and the triangle's number as the alpha.
static inline real3 describe_hits(const scene_buffers *scene, const image_space *image,
                                  const primary *first, real *number)
{
    const real zero = real_of(0);
    mask met = first->places >= (lane_int)0;
    if (!any_lane(met)) {
        *number = real_of(-1);
        return real3_of(zero, zero, zero);
    }
    triangle triangles = load_triangles(scene, first->places, met);
    closest hit;
    measure_hits(image, triangles.vertices, first->x, first->y, first->length, met, &hit);
    *number = triangles.number;
    return real3_of(SELECT(met, hit.t, zero), SELECT(met, hit.b1, zero),
                    SELECT(met, hit.b2, zero));
}
#endif

// What a tile's pixels have gathered so far without the environment, sample by sample.
typedef struct gathered {
#if GATHERS
    real3 color[TILE_GROUPS];
    real alpha[TILE_GROUPS];
#endif
} gathered;

// Adds one sample of each pixel of a group.
static inline void render_group(const scene_buffers *scene, const glint_frame_record *frame,
                                const image_space *image, const tile *t, int group, mask inside,
                                gathered *sum, lookups *later, tally *tally)
{
    primary first;
    first.x = t->x[group % TILE_COLUMNS];
    first.y = t->y[group / TILE_COLUMNS];
    first.places = t->place[group];
    path ray = primary_rays(frame, &first);
    real alpha = real_of(1);
#if GLINT_HITS
    real3 color = describe_hits(scene, image, &first, &alpha);
#else
    real3 color = follow_paths(scene, frame, image, &first, group, &ray, inside, later, tally);
#if GLINT_TRANSPARENT
    alpha = SELECT(first.places >= (lane_int)0, alpha, real_of(0));
#endif
#endif
#if GATHERS
    sum->color[group] = add(sum->color[group], color);
    sum->alpha[group] += alpha;
#endif
}

// Adds what a group's pixels have gathered to what look-ups brought.
static inline void add_gathered(const gathered *sum, int group, scalar *sums)
{
#if GATHERS
    const real3 color = sum->color[group];
#if GLINT_HITS
    to_pixels(color.x, color.y, color.z, sum->alpha[group], sums);
#else
    scalar values[PIXEL_VALUES];
    to_pixels(color.x, color.y, color.z, sum->alpha[group], values);
    for (int j = 0; j < PACKET_HEIGHT; j++) {
        pixel_row light = without_alpha(load_pixel_row(j, sums));
        store_pixel_row(load_pixel_row(j, values) + light, j, sums);
    }
#endif
#endif
}

// Writes a group's pixels that lie inside the image: the sums of samples of which each has `share`.
static inline void store_group(global scalar *pixels, const glint_frame_record *frame, int x0,
                               int y0, const scalar *sums, scalar share)
{
    const bool aligned = frame->width % PACKET_WIDTH == 0;
    for (int j = 0; j < PACKET_HEIGHT && y0 + j < frame->height; j++) {
        pixel_row means = load_pixel_row(j, sums) * (pixel_row)share;
        means = GATHERS ? means : opaque(means);
        global scalar *row = pixels + 4 * ((size_t)(y0 + j) * (size_t)frame->width + (size_t)x0);
        if (x0 + PACKET_WIDTH <= frame->width) {
            if (aligned) {
                stream_pixel_row(means, row);
            } else {
                store_pixel_row(means, 0, row);
            }
        } else {
            for (int i = 0; i < 4 * (frame->width - x0); i++) {
                row[i] = ((scalar *)&means)[i];
            }
        }
    }
}

// Renders the tile whose first pixel is in the given column and row.
static inline void render_tile(const scene_buffers *scene, const glint_frame_record *frame,
                               int column, int row, global scalar *pixels, global uint *counters)
{
    const image_space image = make_image_space(frame);
    tally tally = no_tally();
    gathered sum;
    lookups later;
    mask inside[TILE_GROUPS];
    for (int g = 0; g < TILE_GROUPS; g++) {
#if GATHERS
        const real zero = real_of(0);
        sum.color[g] = real3_of(zero, zero, zero);
        sum.alpha[g] = zero;
#endif
        inside[g] = group_in_image(frame, column, row, g);
    }
#if GLINT_SUPERSAMPLING
    const int k = frame->samples_per_axis;
#else
    const int k = 1;
#endif
    begin_lookups(&later);
    for (int sample = 0; sample < k * k; sample++) {
        tile t;
        begin_tile(&image, frame, column, row, ((scalar)(sample % k) + R(0.5)) / (scalar)k,
                   ((scalar)(sample / k) + R(0.5)) / (scalar)k, &t);
#if GLINT_GEOMETRY
        trace_tile(&image, &t, scene);
#endif
        for (int g = 0; g < TILE_GROUPS; g++) {
            render_group(scene, frame, &image, &t, g, inside[g], &sum, &later, &tally);
        }
    }
    finish_lookups(&later, &scene->environment);
    // Before the pixels are stored: an atomic operation waits for all stores before it.
    report(&tally, counters);
    scalar share = R(1.0) / (scalar)(k * k);
    for (int g = 0; g < TILE_GROUPS; g++) {
        scalar *sums = later.sums + PIXEL_VALUES * g;
        add_gathered(&sum, g, sums);
        store_group(pixels, frame, column + g % TILE_COLUMNS * PACKET_WIDTH,
                    row + g / TILE_COLUMNS * PACKET_HEIGHT, sums, share);
    }
}

// Work-item (i, j) of the global range renders tile i of band first_band + j of the frame. (An offset
// of the range itself would make PoCL compile the kernel once more.)
//  pixels: [height][width][4] (R, G, B premultiplied, alpha). counters: see layout.h. The
// other buffers are described in layout.h too; those that no compiled feature needs may be of any
// size.
kernel void render_tiles(global const float *nodes, global const float *clusters,
                         global const float *normals, global const int *numbers,
                         global const glint_material_record *materials,
                         global const glint_medium_record *media,
                         global const void *environment, global const float *irradiance,
                         global scalar *pixels, global uint *counters,
                         const glint_frame_record frame)
{
    const scene_buffers scene = {nodes, clusters, normals, numbers, materials, media,
                                 {environment, frame.environment_edge, GLINT_HALF_TEXELS},
                                 {irradiance, frame.irradiance_edge, false}};
    const int across = (int)get_global_id(0), down = (int)get_global_id(1);
    const int band = GLINT_BAND(GLINT_TILES);
    const int column = across / band * PACKET_WIDTH * TILE_COLUMNS;
    const int row = ((down + frame.first_band) * band + across % band) * PACKET_HEIGHT * TILE_ROWS;
    if (column >= frame.width || row >= frame.height) {
        return;
    }
    render_tile(&scene, &frame, column, row, pixels, counters);
}
