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

typedef struct branch {
    scalar origin[3], direction[3], weight[3];
#if LOCAL_RAYS
    scalar origin_low[3];
#endif
#if CARRIES_CONES
    scalar width, spread; // see cone
#endif
    lane_int from, media;
    int pixel, met, kind;
#if GLINT_ALPHA
    int passed;
#endif
#if GLINT_DISPERSION
    int dispersed;
#endif
#if GLINT_FACETS
    scalar lobe_width, lobe_spread;
#endif
#if GLINT_ROUGH
    scalar held[3], shown;
#endif
} branch;

// The host relies on this size when it reserves room for a tile's branches.
typedef char branch_is_as_large_as_layout_h_says
    [sizeof(branch) == GLINT_BRANCH_BYTES(sizeof(scalar), CARRIES_CONES, GLINT_ALPHA, GLINT_ROUGH,
                                          GLINT_FACETS, GLINT_DISPERSION, LOCAL_RAYS)
         ? 1
         : -1];

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

static inline void save_branch(const path *ray, const pixels *pixels, lanes_int kinds, int lane,
                               branch *b)
{
    save3(b->origin, &ray->origin, lane);
#if LOCAL_RAYS
    save3(b->origin_low, &ray->origin_low, lane);
#endif
    save3(b->direction, &ray->direction, lane);
    save3(b->weight, &ray->weight, lane);
#if CARRIES_CONES
    b->width = LANE(ray->cone.width, lane);
    b->spread = LANE(ray->cone.spread, lane);
#endif
    b->from = LANE_INT(ray->from, lane);
    b->media = LANE_INT(ray->media, lane);
    b->met = (int)LANE_INT(ray->met, lane);
#if GLINT_ALPHA
    b->passed = (int)LANE_INT(ray->passed, lane);
#endif
#if GLINT_DISPERSION
    b->dispersed = (int)LANE_INT(ray->dispersed, lane);
#endif
#if GLINT_FACETS
    b->lobe_width = LANE(ray->lobe.width, lane);
    b->lobe_spread = LANE(ray->lobe.spread, lane);
#endif
#if GLINT_ROUGH
    save3(b->held, &ray->held, lane);
    b->shown = LANE(ray->shown, lane);
#endif
    b->kind = (int)LANE_INT(kinds, lane);
    b->pixel = pixel_of(*pixels, lane);
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
    // Copy each branch to its place.
    for (int i = 0; i < count; i++) {
        const int place = ends[list[i].kind]++;
        const int lane = place % GLINT_WIDTH;
        path *ray = &rays[place / GLINT_WIDTH];
        restore3(list[i].origin, &ray->origin, lane);
#if LOCAL_RAYS
        restore3(list[i].origin_low, &ray->origin_low, lane);
#endif
        restore3(list[i].direction, &ray->direction, lane);
        restore3(list[i].weight, &ray->weight, lane);
#if CARRIES_CONES
        LANE(ray->cone.width, lane) = list[i].width;
        LANE(ray->cone.spread, lane) = list[i].spread;
#endif
        LANE_INT(ray->from, lane) = list[i].from;
        LANE_INT(ray->media, lane) = list[i].media;
#if GLINT_ALPHA
        LANE_INT(ray->passed, lane) = list[i].passed;
#endif
#if GLINT_DISPERSION
        LANE_INT(ray->dispersed, lane) = list[i].dispersed;
#endif
#if GLINT_FACETS
        LANE(ray->lobe.width, lane) = list[i].lobe_width;
        LANE(ray->lobe.spread, lane) = list[i].lobe_spread;
#endif
#if GLINT_ROUGH
        restore3(list[i].held, &ray->held, lane);
        LANE(ray->shown, lane) = list[i].shown;
#endif
        LANE_INT(ray->looked_up, lane) = max(list[i].kind - CUT_SHORT + 1, 0);
        LANE_INT(pixels[place / GLINT_WIDTH], lane) = list[i].pixel;
    }
    // Mark the rays that exist.
    for (int g = 0; g < TILE_GROUPS; g++) {
        active[g] = lane_numbers() < (lane_int)(count - g * GLINT_WIDTH);
        rays[g].met = int_of(count > 0 ? list[0].met : 0);
#if GLINT_ABSORPTION
        rays[g].travelled = real_of(0);
#endif
    }
}

#endif
