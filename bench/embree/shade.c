// Shades a tile of a frame: rays, optics and look-ups, sixteen rays at a time. See tile.h.
#include "embree/cube.h"
#include "embree/tile.h"

#include <math.h>

// Rays inside glass start this far along, in stored units. That is about ten roundings of a
// position within [−1, 1], and far less than a triangle.
#define SECONDARY_START 1e-5f

typedef struct tile_place {
    int x0, y0; // upper left corner of the tile, pixels
} tile_place;

// ---- Rays --------------------------------------------------------------------------------------

void embree_tile_prepare(embree_tile *tile, const embree_view *view)
{
    memset(tile, 0, sizeof *tile);
    for (int p = 0; p < TILE; p++) {
        struct RTCRayHit16 *first = &tile->primary[p], *second = &tile->secondary[p];
        store(first->ray.org_x, real_of(view->eye[0]));
        store(first->ray.org_y, real_of(view->eye[1]));
        store(first->ray.org_z, real_of(view->eye[2]));
        store(second->ray.tnear, real_of(SECONDARY_START));
        memset(first->ray.mask, -1, sizeof first->ray.mask);
        memset(second->ray.mask, -1, sizeof second->ray.mask);
        memset(first->hit.instID, -1, sizeof first->hit.instID);
        memset(second->hit.instID, -1, sizeof second->hit.instID);
    }
}

static inline reals3 ray_direction(const struct RTCRayHit16 *p)
{
    return (reals3){load(p->ray.dir_x), load(p->ray.dir_y), load(p->ray.dir_z)};
}

static inline void aim(struct RTCRayHit16 *p, reals3 direction)
{
    store(p->ray.dir_x, direction.x);
    store(p->ray.dir_y, direction.y);
    store(p->ray.dir_z, direction.z);
    memset(p->hit.geomID, -1, sizeof p->hit.geomID);
}

static inline ints rays_that_hit(const struct RTCRayHit16 *p)
{
    return *(const ints *)p->hit.geomID != (ints){0} - 1;
}

// The pixel of each lane of packet p.
static inline void packet_pixels(bool rows, tile_place place, int p, ints *x, ints *y)
{
    const ints lanes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    if (rows) {
        *x = place.x0 + lanes;
        *y = int_of(place.y0 + p);
    } else {
        *x = place.x0 + 4 * (p % 4) + (lanes & 3);
        *y = place.y0 + 4 * (p / 4) + (lanes >> 2);
    }
}

static void make_primary_rays(const embree_frame *frame, tile_place place,
                              struct RTCRayHit16 *packets)
{
    const embree_view *view = &frame->program->view;
    const float half_width = 0.5f * (float)frame->program->inputs.width;
    const float half_height = 0.5f * (float)frame->program->inputs.height;
    for (int p = 0; p < TILE; p++) {
        ints column, row;
        packet_pixels(frame->mode->rows, place, p, &column, &row);
        reals x = __builtin_convertvector(column, reals) + (0.5f - half_width);
        reals y = (half_height - 0.5f) - __builtin_convertvector(row, reals);
        const float *d = view->direction, *dx = view->direction_x, *dy = view->direction_y;
        aim(&packets[p], (reals3){d[0] + x * dx[0] + y * dy[0], d[1] + x * dx[1] + y * dy[1],
                                  d[2] + x * dx[2] + y * dy[2]});
        store(packets[p].ray.tfar, real_of(INFINITY));
    }
}

// ---- Optics ------------------------------------------------------------------------------------

// Interpolates the normals of the rays in `hit`, without normalising. Neighbouring rays mostly hit
// the same few triangles. The function fetches each triangle once and spreads its values over its
// lanes.
static inline reals3 interpolate_normals(const float *normals, const struct RTCRayHit16 *p,
                                         ints hit)
{
    ints triangles = *(const ints *)p->hit.primID;
    reals u = load(p->hit.u), v = load(p->hit.v);
    reals3 n = {{0}, {0}, {0}};
    for (unsigned left = bits_of(hit); left != 0;) {
        int which = (int)p->hit.primID[__builtin_ctz(left)];
        ints same = triangles == which;
        const float *m = normals + 9 * (size_t)which;
        n.x = choose(same, m[0] + u * m[3] + v * m[6], n.x);
        n.y = choose(same, m[1] + u * m[4] + v * m[7], n.y);
        n.z = choose(same, m[2] + u * m[5] + v * m[8], n.z);
        left &= ~bits_of(same);
    }
    return n;
}

// Prefetches the normals of all packets' hits. A triangle's normals may lie in two cache lines.
static void prefetch_normals(const float *normals, const struct RTCRayHit16 *packets, int count)
{
    for (int p = 0; p < count; p++) {
        for (unsigned left = bits_of(rays_that_hit(&packets[p])); left != 0; left &= left - 1) {
            const float *m = normals + 9 * (size_t)packets[p].hit.primID[__builtin_ctz(left)];
            __builtin_prefetch(m);
            __builtin_prefetch(m + 8);
        }
    }
}

static inline reals3 geometric_normal(const struct RTCRayHit16 *p)
{
    return (reals3){load(p->hit.Ng_x), load(p->hit.Ng_y), load(p->hit.Ng_z)};
}

// Folds `q` back across the surface's plane where `q` lies on the wrong side. The right side is
// that of n_g if `sign` is positive. Folding is rare, so a test for an early exit comes first.
static inline reals3 fold_to_side(reals3 q, reals3 geometric, reals sign, ints hit)
{
    reals along = dot(q, geometric);
    ints wrong = hit & (along * sign < 0.0f);
    if (bits_of(wrong) == 0) {
        return q;
    }
    reals twice = -2.0f * along / dot(geometric, geometric);
    return choose3(wrong, scale_add(geometric, twice, q), q);
}

// The mirror direction of the rays in `hit`, of any length. In r = 2n(n·v)/(n·n) − v the side of
// the normal and the lengths of n and v cancel out.
static inline reals3 reflect_packet(const float *normals, const struct RTCRayHit16 *p, ints hit)
{
    reals3 d = ray_direction(p), geometric = geometric_normal(p);
    reals3 n = interpolate_normals(normals, p, hit);
    reals twice = -2.0f * dot(n, d) * reciprocal(dot(n, n));
    reals3 r = scale_add(n, twice, d);
    return fold_to_side(r, geometric, -dot(d, geometric), hit);
}

// Applies Snell's law to the rays in `hit`. Returns the unit direction of the refracted ray, or of
// the reflected ray at total reflection.
static inline reals3 refract_packet(const float *normals, const struct RTCRayHit16 *p, ints hit)
{
    reals3 d = ray_direction(p), geometric = geometric_normal(p);
    d = scale(d, inverse_root(dot(d, d)));
    reals facing = -dot(d, geometric);
    reals3 n = interpolate_normals(normals, p, hit);
    n = scale(n, inverse_root(dot(n, n)));
    // Put the normal on the viewer's side of the surface, then turn it to the viewer.
    reals cosine = -dot(n, d);
    ints turned = cosine < 0.0f;
    n = choose3(turned, negate(n), n);
    cosine = absolute(cosine);
    reals eta = choose(facing > 0.0f, real_of(1 / BENCH_IOR), real_of(BENCH_IOR));
    reals scaled = eta * cosine;
    reals squared = scaled * scaled + (1.0f - eta) * (1.0f + eta);
    ints total = squared < 0.0f;
    reals cosine_t = square_root(larger(squared, real_of(0)));
    reals3 refracted = scale_add(n, scaled - cosine_t, scale(d, eta));
    reals3 reflected = scale_add(n, 2.0f * cosine, d);
    // A refracted direction belongs on the other side of the surface.
    reals side = choose(total, facing, -facing);
    return fold_to_side(choose3(total, reflected, refracted), geometric, side, hit);
}

// ---- Directions --------------------------------------------------------------------------------

static void trace(const embree_frame *frame, embree_query query, struct RTCRayHit16 *packets,
                  int count)
{
    embree_trace(frame->scene, query, packets, count);
    if (frame->job != BENCH_TRAVERSE && frame->mode->shading == EMBREE_STAGED) {
        prefetch_normals(frame->program->normals, packets, count);
    }
}

// Makes the rays inside the glass, and skips packets without rays. Returns the number of packets;
// `origin` names the packet of primary rays that each packet continues.
static int make_secondary_rays(const embree_frame *frame, embree_tile *tile, int origin[TILE])
{
    int count = 0;
    for (int p = 0; p < TILE; p++) {
        const struct RTCRayHit16 *from = &tile->primary[p];
        ints hit = rays_that_hit(from);
        reals3 d = ray_direction(from);
        tile->direction[p] = d;
        if (bits_of(hit) == 0) {
            continue;
        }
        struct RTCRayHit16 *to = &tile->secondary[count];
        reals3 inward = refract_packet(frame->program->normals, from, hit);
        inward = choose3(hit, inward, d);
        aim(to, inward);
        reals t = load(from->ray.tfar);
        store(to->ray.org_x, load(from->ray.org_x) + t * d.x);
        store(to->ray.org_y, load(from->ray.org_y) + t * d.y);
        store(to->ray.org_z, load(from->ray.org_z) + t * d.z);
        store(to->ray.tfar, choose(hit, real_of(INFINITY), real_of(-INFINITY)));
        tile->direction[p] = inward;
        origin[count++] = p;
    }
    return count;
}

static void find_refracted(const embree_frame *frame, embree_tile *tile)
{
    int origin[TILE];
    int count = make_secondary_rays(frame, tile, origin);
    trace(frame, frame->mode->secondary, tile->secondary, count);
    for (int i = 0; i < count; i++) {
        const struct RTCRayHit16 *packet = &tile->secondary[i];
        ints hit = rays_that_hit(packet);
        reals3 *direction = &tile->direction[origin[i]];
        reals3 outward = refract_packet(frame->program->normals, packet, hit);
        *direction = choose3(hit, outward, *direction);
    }
}

static inline void find_reflected(const embree_frame *frame, embree_tile *tile, int p)
{
    const struct RTCRayHit16 *packet = &tile->primary[p];
    ints hit = rays_that_hit(packet);
    reals3 d = ray_direction(packet);
    tile->direction[p] = d;
    if (bits_of(hit) != 0) {
        reals3 r = reflect_packet(frame->program->normals, packet, hit);
        tile->direction[p] = choose3(hit, r, d);
    }
}

// ---- Look-ups ----------------------------------------------------------------------------------

static void look_up_floats(const embree_frame *frame, tile_place place, const reals3 *direction,
                           int p)
{
    const embree_program *program = frame->program;
    const glint_cube *cube = program->inputs.environment;
    reals right, down;
    ints texel = find_on_cube(*direction, cube->edge, &right, &down);
    ints x, y;
    packet_pixels(frame->mode->rows, place, p, &x, &y);
    ints pixel = y * program->inputs.width + x;
    for (int lane = 0; lane < LANES; lane++) {
        quad color = sample_floats(cube, texel[lane], right[lane], down[lane]);
        *(quad *)(program->pixels + 4 * (size_t)pixel[lane]) = color;
    }
}

// Finds the texels of a packet and prefetches them.
static inline void prepare_look_up(const embree_program *program, embree_tile *tile, int p)
{
    const int edge = program->inputs.environment->edge;
    ints texel = find_on_cube(tile->direction[p], edge, &tile->right[p], &tile->down[p]);
    tile->texel[p] = texel;
    for (int lane = 0; lane < LANES; lane++) {
        const uint16_t *pairs = program->texel_pairs + PAIR_HALVES * (size_t)texel[lane];
        __builtin_prefetch(pairs);
        __builtin_prefetch(pairs + 2 * PAIR_HALVES - 1);
    }
}

// Index of the first of the four neighbouring pixels of lanes 4 group … 4 group + 3 of packet p.
static inline size_t group_pixel(const embree_frame *frame, tile_place place, int p, int group)
{
    const bool rows = frame->mode->rows;
    int x = place.x0 + (rows ? 4 * group : 4 * (p % 4));
    int y = place.y0 + (rows ? p : 4 * (p / 4) + group);
    return (size_t)y * (size_t)frame->program->inputs.width + (size_t)x;
}

static void look_up_halves(const embree_frame *frame, tile_place place, const embree_tile *tile)
{
    const embree_program *program = frame->program;
    for (int p = 0; p < TILE; p++) {
        const int *texels = (const int *)&tile->texel[p];
        for (int group = 0; group < 4; group++) {
            reals colors =
                sample_halves(program->texel_pairs, texels, tile->right[p], tile->down[p], group);
            stream(program->pixels + 4 * group_pixel(frame, place, p, group), colors);
        }
    }
}

static void store_hits(const embree_frame *frame, tile_place place, const embree_tile *tile)
{
    for (int p = 0; p < TILE; p++) {
        const struct RTCRayHit16 *packet = &tile->primary[p];
        reals triangle = (reals)(*(const ints *)packet->hit.primID | ~rays_that_hit(packet));
        reals t = load(packet->ray.tfar);
        const reals pairs[2] = {
            __builtin_shufflevector(t, triangle, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7,
                                    23),
            __builtin_shufflevector(t, triangle, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14,
                                    30, 15, 31),
        };
        for (int group = 0; group < 4; group++) {
            memcpy(frame->program->hits + group_pixel(frame, place, p, group),
                   (const embree_hit *)pairs + 4 * group, 4 * sizeof(embree_hit));
        }
    }
}

// ---- Tiles -------------------------------------------------------------------------------------

static void shade_plain(const embree_frame *frame, tile_place place, embree_tile *tile)
{
    for (int p = 0; p < TILE; p++) {
        if (frame->job == BENCH_REFLECT) {
            find_reflected(frame, tile, p);
        }
        look_up_floats(frame, place, &tile->direction[p], p);
    }
}

static void shade_staged(const embree_frame *frame, tile_place place, embree_tile *tile)
{
    for (int p = 0; p < TILE; p++) {
        if (frame->job == BENCH_REFLECT) {
            find_reflected(frame, tile, p);
        }
        prepare_look_up(frame->program, tile, p);
    }
    look_up_halves(frame, place, tile);
}

static void render_tile(const embree_frame *frame, tile_place place, embree_tile *tile)
{
    make_primary_rays(frame, place, tile->primary);
    trace(frame, frame->mode->primary, tile->primary, TILE);
    if (frame->job == BENCH_REFRACT) {
        find_refracted(frame, tile);
    }
    if (frame->job == BENCH_TRAVERSE) {
        store_hits(frame, place, tile);
    } else if (frame->mode->shading == EMBREE_PLAIN) {
        shade_plain(frame, place, tile);
    } else {
        shade_staged(frame, place, tile);
    }
}

// Takes tiles in blocks of 4 × 4: a block shares more of the tree than a row does.
static size_t blocks_across(int pixels)
{
    return ((size_t)pixels + 4 * TILE - 1) / (4 * TILE);
}

size_t embree_tile_count(const embree_inputs *inputs)
{
    return 16 * blocks_across(inputs->width) * blocks_across(inputs->height);
}

void embree_render_tile(void *context, size_t number, int thread)
{
    const embree_frame *frame = context;
    const embree_inputs *inputs = &frame->program->inputs;
    const size_t block = number / 16, within = number % 16, across = blocks_across(inputs->width);
    tile_place place = {TILE * (int)(4 * (block % across) + within % 4),
                        TILE * (int)(4 * (block / across) + within / 4)};
    if (place.x0 >= inputs->width || place.y0 >= inputs->height) {
        return;
    }
    if (frame->job == BENCH_GLASS) {
        embree_render_glass_tile(frame, place.x0, place.y0);
    } else {
        render_tile(frame, place, &frame->program->tiles[thread]);
    }
}
