// Keeps the branches of a tile's paths that wait for their turn. Where paths split, the branches of
// a tile advance in lists. A list holds branches that have met equally many surfaces, at most one
// per pixel. When a path splits, the lighter branch joins the list that is followed next. The
// heavier branch joins a list that waits until the first list is empty. So each pixel's branches
// are followed depth first, in an order that does not depend on other pixels. A list fills packets
// completely, whatever happened to neighbouring pixels; it is sorted by the rays' directions.
//
// The lighter branch has at most half of the weight. So at most log2(1/min-weight) + 1 branches of
// a pixel wait at any time (the argument that bounds quicksort's stack). The plan chooses
// GLINT_STACK_CAPACITY: it holds all of them, except where the plan reports otherwise.

// The pixels of the tile that the rays of a packet belong to. Where paths do not split, they are
// the pixels of one group in their order.
#if GLINT_SPLIT
typedef lanes_int pixels;
#define pixels_of_group(group) (lane_numbers() + (lane_int)((group)*GLINT_WIDTH))
#define pixel_of(pixels, lane) ((int)LANE_INT(pixels, lane))
#else
typedef int pixels;
#define pixels_of_group(group) (group)
#define pixel_of(pixels, lane) ((pixels)*GLINT_WIDTH + (lane))
#endif

#if GLINT_SPLIT

// Kinds of branches: six for the directions of rays, then the branches that are looked up without
// tracing, by the value of path.looked_up.
#define BRANCH_KINDS (CUT_SHORT + ESCAPES)
#define CUT_SHORT 6

// Members of the path's state that wait.
#define IF_STORED(needs, waits) IF_BOTH(NEEDS_##needs, waits)

typedef struct branch {
#define STORE_REAL3(name) scalar name[3];
#define STORE_REAL(name) scalar name;
#define STORE_CONE(name) scalar name[2];
#define STORE_BITS(name) lane_int name;
#define STORE_COUNT(name) int name;
#define STORE(kind, name, needs, waits, start, meaning) IF_STORED(needs, waits)(STORE_##kind(name))
    GLINT_PATH_STATE(STORE)
#undef STORE
    int pixel, kind;
} branch;

// The host counts these bytes, rounded up to whole numbers.
#define BYTES(kind, name, needs, waits, start, meaning)                                            \
    IF_STORED(needs, waits)(+GLINT_BYTES_##kind(sizeof(scalar)))
typedef char branch_has_no_gaps
    [sizeof(branch) == (GLINT_BRANCH_OWN_BYTES GLINT_PATH_STATE(BYTES) + sizeof(scalar) - 1) /
                           sizeof(scalar) * sizeof(scalar)
         ? 1
         : -1];
#undef BYTES

typedef struct branches {
    int next_count, waiting_count;
    int of_pixel[TILE_PIXELS]; // number of waiting branches
    branch next[TILE_PIXELS];
    branch waiting[TILE_PIXELS * GLINT_STACK_CAPACITY]; // lists, separated by `met`, which rises
} branches;

static inline void no_branches(branches *b)
{
    b->next_count = b->waiting_count = 0;
    for (int i = 0; i < TILE_PIXELS; i++) {
        b->of_pixel[i] = 0;
    }
}

// True if only one more branch fits. Then the new branch must be looked up, and so must the branch
// that goes on.
static inline mask nearly_full(const branches *b, const pixels *pixels)
{
    lanes_int count;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE_INT(count, lane) = b->of_pixel[pixel_of(*pixels, lane)];
    }
    return count >= (lane_int)(GLINT_STACK_CAPACITY - 1);
}

static inline void save3(scalar *values, const real3 *v, int lane)
{
    values[0] = LANE(v->x, lane);
    values[1] = LANE(v->y, lane);
    values[2] = LANE(v->z, lane);
}

static inline void restore3(const scalar *values, real3 *v, int lane)
{
    LANE(v->x, lane) = values[0];
    LANE(v->y, lane) = values[1];
    LANE(v->z, lane) = values[2];
}

static inline lanes_int kinds_of_rays(const path *ray)
{
    const real3 d = ray->direction;
    mask x_major, y_major;
    find_major(d, &x_major, &y_major);
    real along = SELECT(x_major, d.x, SELECT(y_major, d.y, d.z));
    lanes_int kind = SELECT(x_major, int_of(0), SELECT(y_major, int_of(2), int_of(4)));
    kind += SELECT(along > R(0.0), int_of(1), int_of(0));
    return SELECT(ray->looked_up != (lane_int)0, ray->looked_up + (lane_int)(CUT_SHORT - 1), kind);
}

#define SAVE_REAL3(to, from, lane) save3(to, &(from), lane)
#define SAVE_REAL(to, from, lane) to = LANE(from, lane)
#define SAVE_CONE(to, from, lane)                                                                  \
    to[0] = LANE(from.width, lane);                                                                \
    to[1] = LANE(from.spread, lane)
#define SAVE_BITS(to, from, lane) to = LANE_INT(from, lane)
#define SAVE_COUNT(to, from, lane) to = (int)LANE_INT(from, lane)

static inline void save_branch(const path *ray, const pixels *pixels, lanes_int kinds, int lane,
                               branch *b)
{
#define SAVE(kind, name, needs, waits, start, meaning)                                             \
    IF_STORED(needs, waits)(SAVE_##kind(b->name, ray->name, lane);)
    GLINT_PATH_STATE(SAVE)
#undef SAVE
    b->kind = (int)LANE_INT(kinds, lane);
    b->pixel = pixel_of(*pixels, lane);
}

#define RESTORE_REAL3(from, to, lane) restore3(from, &(to), lane)
#define RESTORE_REAL(from, to, lane) LANE(to, lane) = from
#define RESTORE_CONE(from, to, lane)                                                               \
    LANE(to.width, lane) = from[0];                                                                \
    LANE(to.spread, lane) = from[1]
#define RESTORE_BITS(from, to, lane) LANE_INT(to, lane) = from
#define RESTORE_COUNT(from, to, lane) LANE_INT(to, lane) = from

static inline void restore_branch(const branch *b, int lane, path *ray)
{
#define RESTORE(kind, name, needs, waits, start, meaning)                                          \
    IF_STORED(needs, waits)(RESTORE_##kind(b->name, ray->name, lane);)
    GLINT_PATH_STATE(RESTORE)
#undef RESTORE
    LANE_INT(ray->looked_up, lane) = max(b->kind - CUT_SHORT + 1, 0);
}

// Appends branches to the list that is followed next.
static inline void follow_next(branches *b, const path *ray, const pixels *pixels, mask these)
{
    lanes_int kinds = kinds_of_rays(ray);
    for (uint left = mask_bits(these); left != 0; left &= left - 1) {
        save_branch(ray, pixels, kinds, lowest_bit(left), &b->next[b->next_count++]);
    }
}

// Appends branches to the list that waits. Branches that do not fit are lost (see nearly_full).
static inline void let_wait(branches *b, const path *ray, const pixels *pixels, mask these)
{
    lanes_int kinds = kinds_of_rays(ray);
    for (uint left = mask_bits(these); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        int *of_pixel = &b->of_pixel[pixel_of(*pixels, lane)];
        if (*of_pixel < GLINT_STACK_CAPACITY) {
            (*of_pixel)++;
            save_branch(ray, pixels, kinds, lane, &b->waiting[b->waiting_count++]);
        }
    }
}

// Takes the list to follow now: the next list or, if it is empty, the latest waiting list. Sets its
// length.
static inline const branch *take_list(branches *b, int *count)
{
    *count = b->next_count;
    b->next_count = 0;
    if (*count > 0) {
        return b->next;
    }
    int begin = b->waiting_count;
    while (begin > 0 && b->waiting[begin - 1].met == b->waiting[b->waiting_count - 1].met) {
        begin--;
        b->of_pixel[b->waiting[begin].pixel]--;
    }
    *count = b->waiting_count - begin;
    b->waiting_count = begin;
    return b->waiting + begin;
}

// Fills packets with the list to follow now, sorted by kind. `active` marks the rays that exist.
static inline void take_branches(branches *b, path *rays, pixels *pixels, mask *active)
{
    int count;
    const branch *list = take_list(b, &count);
    int ends[BRANCH_KINDS + 1] = {0}; // where each kind ends so far, in the order of kinds
    // Sort by counting: find where each kind begins.
    for (int i = 0; i < count; i++) {
        ends[list[i].kind + 1]++;
    }
    for (int kind = 1; kind < BRANCH_KINDS; kind++) {
        ends[kind] += ends[kind - 1];
    }
    // Start all rays: unused lanes, and members that do not wait, keep these values.
    for (int g = 0; g < TILE_GROUPS; g++) {
        rays[g] = path_at_start();
    }
    // Copy each branch to its place.
    for (int i = 0; i < count; i++) {
        const int place = ends[list[i].kind]++;
        const int lane = place % GLINT_WIDTH;
        restore_branch(&list[i], lane, &rays[place / GLINT_WIDTH]);
        LANE_INT(pixels[place / GLINT_WIDTH], lane) = list[i].pixel;
    }
    // Mark the rays that exist.
    for (int g = 0; g < TILE_GROUPS; g++) {
        active[g] = lane_numbers() < (lane_int)(count - g * GLINT_WIDTH);
    }
}

#endif
