// Look-ups in the environment that wait until there are many of them: the memory's answers to one
// overlap with the questions of the next, which they do not while paths are traced in between.
//
// What they bring is added up for each pixel, in the order in which they were asked for, apart from
// what paths gather otherwise: so the sums do not depend on when the look-ups are made.

#define LOOKUPS TILE_GROUPS // of packets of rays

typedef struct lookups {
    int count;
    pixels pixels[LOOKUPS];
    uint wanted[LOOKUPS]; // rays, as bits
    bool white[LOOKUPS];  // all wanted rays weigh 1
    lanes_int first[LOOKUPS];
    real right[LOOKUPS], down[LOOKUPS]; // see cube_point
    scalar weights[LOOKUPS * PIXEL_VALUES];
    scalar sums[TILE_GROUPS * PIXEL_VALUES]; // R, G, B; the fourth value means nothing
} lookups;

#define ALL_RAYS ((uint)((1 << GLINT_WIDTH) - 1))

static inline void begin_lookups(lookups *l)
{
    l->count = 0;
    for (int i = 0; i < TILE_GROUPS * PIXEL_VALUES; i++) {
        l->sums[i] = 0;
    }
}

static inline scalar4 look_up(const lookups *l, const cube_map *map, int i, int lane)
{
    return fetch_from_cube(map, (size_t)LANE_INT(l->first[i], lane), LANE(l->right[i], lane),
                           LANE(l->down[i], lane));
}

// Makes all look-ups that wait.
static inline void finish_lookups(lookups *l, const cube_map *map)
{
    for (int i = 0; i < l->count; i++) {
        const scalar *weights = l->weights + i * PIXEL_VALUES;
        if (l->white[i] && l->wanted[i] == ALL_RAYS) { // most are
            for (int lane = 0; lane < GLINT_WIDTH; lane++) {
                const int pixel = pixel_of(l->pixels[i], lane);
                vstore4(vload4(pixel, l->sums) + look_up(l, map, i, lane), pixel, l->sums);
            }
            continue;
        }
        for (uint left = l->wanted[i]; left != 0; left &= left - 1) {
            int lane = lowest_bit(left);
            scalar4 light = vload4(lane, weights) * look_up(l, map, i, lane);
            const int pixel = pixel_of(l->pixels[i], lane);
            vstore4(vload4(pixel, l->sums) + light, pixel, l->sums);
        }
    }
    l->count = 0;
}

// Adds what the environment sends against the directions, times the weights, for the rays in
// `wanted`.
static inline void look_up_later(lookups *l, const cube_map *map, real3 direction, real3 weight,
                                 mask wanted, const pixels *pixels)
{
    if (l->count == LOOKUPS) {
        finish_lookups(l, map);
    }
    int i = l->count++;
    cube_point point = find_on_cube(direction, map->edge);
    l->pixels[i] = *pixels;
    l->wanted[i] = mask_bits(wanted);
    l->first[i] = point.first;
    l->right[i] = point.right;
    l->down[i] = point.down;
    for (uint left = l->wanted[i]; left != 0; left &= left - 1) {
        prefetch_texels(map, (size_t)LANE_INT(point.first, lowest_bit(left)));
    }
    mask tinted = (weight.x != R(1.0)) | (weight.y != R(1.0)) | (weight.z != R(1.0));
    l->white[i] = !any_lane(wanted & tinted);
    if (!l->white[i] || l->wanted[i] != ALL_RAYS) {
        to_pixels(weight.x, weight.y, weight.z, real_of(0), l->weights + i * PIXEL_VALUES);
    }
}
