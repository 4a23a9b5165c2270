// The branches of a path that wait for their turn, on a stack of each ray's own. The path goes on
// with the lighter of two branches and the heavier waits: as the lighter has at most half of the
// weight, at most log2(1/min-weight) + 1 branches ever wait (the argument that bounds quicksort's
// stack), and GLINT_STACK_CAPACITY, chosen by the plan, holds them all unless the plan says not.
#if GLINT_SPLIT

#define BRANCH_REALS 9 // weight, direction, origin
#define BRANCH_INTS 4  // from, met, media, looked up

typedef struct branches {
    int count[GLINT_WIDTH];
    scalar reals[GLINT_STACK_CAPACITY * BRANCH_REALS * GLINT_WIDTH];
    lane_int ints[GLINT_STACK_CAPACITY * BRANCH_INTS * GLINT_WIDTH];
} branches;

static inline void save3(scalar *slot, real3 v, int lane)
{
    slot[0] = LANE(v.x, lane);
    slot[1] = LANE(v.y, lane);
    slot[2] = LANE(v.z, lane);
}

static inline void restore3(const scalar *slot, real3 *v, int lane)
{
    LANE(v->x, lane) = slot[0];
    LANE(v->y, lane) = slot[1];
    LANE(v->z, lane) = slot[2];
}

// True where only one more branch fits: it must then be looked up, and so must the one that goes
// on.
static inline mask nearly_full(const branches *waiting)
{
    lanes_int count;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE_INT(count, lane) = waiting->count[lane];
    }
    return count >= (lane_int)(GLINT_STACK_CAPACITY - 1);
}

static inline void push_branch(branches *waiting, const path *branch, mask pushed)
{
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        if (!lane_is_set(pushed, lane) || waiting->count[lane] >= GLINT_STACK_CAPACITY) {
            continue;
        }
        int slot = waiting->count[lane]++ * GLINT_WIDTH + lane;
        scalar *reals = waiting->reals + slot * BRANCH_REALS;
        lane_int *ints = waiting->ints + slot * BRANCH_INTS;
        save3(reals, branch->weight, lane);
        save3(reals + 3, branch->direction, lane);
        save3(reals + 6, branch->origin, lane);
        ints[0] = LANE_INT(branch->from, lane);
        ints[1] = LANE_INT(branch->met, lane);
        ints[2] = LANE_INT(branch->media, lane);
        ints[3] = LANE_INT(branch->looked_up, lane);
    }
}

// Gives each ray in `free` its latest waiting branch; the result says which rays got one.
static inline mask pop_branch(branches *waiting, path *ray, mask free)
{
    lanes_int got = int_of(0);
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        if (!lane_is_set(free, lane) || waiting->count[lane] == 0) {
            continue;
        }
        int slot = --waiting->count[lane] * GLINT_WIDTH + lane;
        const scalar *reals = waiting->reals + slot * BRANCH_REALS;
        const lane_int *ints = waiting->ints + slot * BRANCH_INTS;
        restore3(reals, &ray->weight, lane);
        restore3(reals + 3, &ray->direction, lane);
        restore3(reals + 6, &ray->origin, lane);
        LANE_INT(ray->from, lane) = ints[0];
        LANE_INT(ray->met, lane) = ints[1];
        LANE_INT(ray->media, lane) = ints[2];
        LANE_INT(ray->looked_up, lane) = ints[3];
        LANE_INT(got, lane) = 1;
    }
    return got != (lane_int)0;
}

#endif
