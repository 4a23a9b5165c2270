// Collects look-ups in the environment and makes many of them together. Then the memory accesses of
// consecutive look-ups overlap. They would not if paths were traced in between.
//
// The results are summed for each pixel in the order of the requests, apart from the other light
// that paths gather. So the sums do not depend on when the look-ups are made.

#define LOOKUPS TILE_GROUPS // of packets of rays; capacity of the list

typedef struct lookups {
    int count;
    pixels pixels[LOOKUPS];
    uint wanted[LOOKUPS]; // rays, as bits
    bool white[LOOKUPS];  // all wanted rays have the weight 1
    cube_point points[LOOKUPS];
#if READS_LEVELS
    level_choice levels[LOOKUPS];
    cube_point coarser[LOOKUPS]; // the same points on the next level
    bool are_levels;             // else all points are on level 0
    int level_count;
    int level_starts[GLINT_LEVELS_MAX]; // number of texels before a level
#endif
    scalar weights[LOOKUPS * PIXEL_VALUES];
    scalar *sums; // of the tile's pixels: R, G, B; the fourth value is unused
} lookups;

#define ALL_RAYS ((uint)((1 << GLINT_WIDTH) - 1))

static inline void begin_lookups(lookups *l, const scene_buffers *scene, scalar *sums)
{
    const cube_map *map = &scene->environment;
    l->count = 0;
    l->sums = sums;
#if READS_LEVELS
    l->are_levels = HAS(MIP_LEVELS) || HAS(FACETS);
    l->level_count = 0;
    int start = 0;
    for (int edge = map->edge; edge > 0 && l->are_levels; edge /= 2) {
        const int pitch = edge + 2 * GLINT_CUBE_BORDER;
        l->level_starts[l->level_count++] = start;
        start += GLINT_CUBE_FACES * pitch * pitch;
    }
#endif
    for (int i = 0; i < TILE_GROUPS * PIXEL_VALUES; i++) {
        sums[i] = 0;
    }
}

static inline scalar4 fetch_at(const cube_point *point, const cube_map *map, int edge, int lane)
{
    return fetch_from_cube(map, edge, (size_t)LANE_INT(point->first, lane),
                           LANE(point->right, lane), LANE(point->down, lane));
}

static inline scalar4 look_up(const lookups *l, const cube_map *map, int i, int lane)
{
    int edge = map->edge;
#if READS_LEVELS
    if (!l->are_levels) {
        return fetch_at(&l->points[i], map, edge, lane);
    }
    edge >>= LANE_INT(l->levels[i].level, lane);
#endif
    scalar4 light = fetch_at(&l->points[i], map, edge, lane);
#if READS_LEVELS
    const scalar blend = LANE(l->levels[i].blend, lane);
    if (blend > R(0.0)) {
        light = fused((scalar4)blend, fetch_at(&l->coarser[i], map, edge / 2, lane) - light, light);
    }
#endif
    return light;
}

// Makes all waiting look-ups.
static inline void finish_lookups(lookups *l, const cube_map *map)
{
    for (int i = 0; i < l->count; i++) {
        const scalar *weights = l->weights + i * PIXEL_VALUES;
        if (l->white[i] && l->wanted[i] == ALL_RAYS) { // the most frequent case
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

#if READS_LEVELS
// The width of the environment's part that a ray sees, as an angle.
static inline real spread_seen(const scene_buffers *scene, const path *ray)
{
    real spread = real_of(0);
#if GLINT_FACETS
    spread = ray->lobe.spread;
#endif
#if GLINT_MIP_LEVELS
    if (HAS(MIP_LEVELS)) {
        spread = HAS(FACETS) ? joined_width(ray->cone.spread, spread) : ray->cone.spread;
    }
#endif
    return spread;
}
#endif

// Finds the points of the map in the directions of some rays, prefetches their texels, and stores
// the points for later.
static inline void find_points(lookups *l, const scene_buffers *scene, const path *rays,
                               real3 direction, uint wanted, int i)
{
    const cube_map *map = &scene->environment;
    lanes_int edges = int_of(map->edge), starts = int_of(0);
#if READS_LEVELS
    const int last = max(l->level_count - 1, 0);
    level_choice choice = {int_of(0), real_of(0)};
    if (l->are_levels) {
        choice = choose_level(spread_seen(scene, rays), direction, map->edge, last);
        l->levels[i] = choice;
    }
    if (any_lane((choice.level > (lane_int)0) | (choice.blend > R(0.0)))) {
        lanes_int next_edges = int_of(0), next = int_of(0);
        for (int lane = 0; lane < GLINT_WIDTH; lane++) {
            const int level = (int)LANE_INT(choice.level, lane), after = min(level + 1, last);
            LANE_INT(edges, lane) = map->edge >> level;
            LANE_INT(starts, lane) = l->level_starts[level];
            LANE_INT(next_edges, lane) = map->edge >> after;
            LANE_INT(next, lane) = l->level_starts[after];
        }
        l->coarser[i] = find_on_cube(direction, next_edges, next);
    }
#endif
    l->points[i] = find_on_cube(direction, edges, starts);
    for (; wanted != 0; wanted &= wanted - 1) {
        const int lane = lowest_bit(wanted);
        prefetch_texels(map, (int)LANE_INT(edges, lane),
                        (size_t)LANE_INT(l->points[i].first, lane));
    }
}

// Requests a look-up that adds the environment's light to the rays in `wanted`, times their
// weights. `direction` is the rays' direction in the environment's axes.
static inline void look_up_later(lookups *l, const scene_buffers *scene, const path *rays,
                                 real3 direction, mask wanted, const pixels *pixels)
{
    const real3 weight = rays->weight;
    if (l->count == LOOKUPS) {
        finish_lookups(l, &scene->environment);
    }
    int i = l->count++;
    l->pixels[i] = *pixels;
    l->wanted[i] = mask_bits(wanted);
    find_points(l, scene, rays, direction, l->wanted[i], i);
    mask tinted = (weight.x != R(1.0)) | (weight.y != R(1.0)) | (weight.z != R(1.0));
    l->white[i] = !any_lane(wanted & tinted);
    if (!l->white[i] || l->wanted[i] != ALL_RAYS) {
        to_pixels(weight.x, weight.y, weight.z, real_of(0), l->weights + i * PIXEL_VALUES);
    }
}
