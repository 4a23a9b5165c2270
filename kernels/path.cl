// Expands the table of a path's state (path_state.h) to the struct, its start and its assignment.

#define ESCAPES 2

// 1 or 0: what paths need. LOCAL_RAYS and CARRIES_CONES stand in places.cl and cones.cl.
#define NEEDS_ALWAYS 1
#if LOCAL_RAYS
#define NEEDS_LOW_PARTS 1
#else
#define NEEDS_LOW_PARTS 0
#endif
#if CARRIES_CONES
#define NEEDS_CONES 1
#else
#define NEEDS_CONES 0
#endif
#define NEEDS_ABSORPTION GLINT_ABSORPTION
#define NEEDS_ALPHA GLINT_ALPHA
#define NEEDS_ROUGH GLINT_ROUGH
#define NEEDS_FACETS GLINT_FACETS
#define NEEDS_DISPERSION GLINT_DISPERSION

// The host takes the conditions of the table.
#define NEED(name, condition)                                                                      \
    typedef char paths_need_##name##_as_on_the_host[NEEDS_##name == ((condition) ? 1 : 0) ? 1 : -1];
GLINT_PATH_NEEDS(NEED, IS_COMPILED, GLINT_DOUBLE)
#undef NEED

// IF_BOTH(a, b)(text): the text if both are 1, else nothing.
#define IF_00(...)
#define IF_01(...)
#define IF_10(...)
#define IF_11(...) __VA_ARGS__
#define PASTE3(a, b, c) a##b##c
#define IF_BOTH(a, b) PASTE3(IF_, a, b) // its arguments are replaced before they are pasted

// IF_NEEDED(needs)(text): the text if paths have what the row needs.
#define IF_NEEDED(needs) IF_BOTH(NEEDS_##needs, 1)

typedef struct path {
#define DECLARE_REAL3 real3
#define DECLARE_REAL real
#define DECLARE_CONE cone
#define DECLARE_BITS lanes_int
#define DECLARE_COUNT lanes_int
#define DECLARE(kind, name, needs, waits, start, meaning) IF_NEEDED(needs)(DECLARE_##kind name;)
    GLINT_PATH_STATE(DECLARE)
#undef DECLARE
} path;

#define START_REAL3(value) real3_of(real_of(value), real_of(value), real_of(value))
#define START_REAL(value) real_of(value)
#define START_CONE(value) make_cone(real_of(value), real_of(value))
#define START_BITS(value) int_of(value)
#define START_COUNT(value) int_of(value)

// A path that has not met anything. Origin and direction are the caller's to set.
static inline path path_at_start(void)
{
    path ray;
#define START(kind, name, needs, waits, start, meaning)                                            \
    IF_NEEDED(needs)(ray.name = START_##kind(start);)
    GLINT_PATH_STATE(START)
#undef START
    return ray;
}

#define CHOOSE_REAL3(yes, a, b) select3(yes, a, b)
#define CHOOSE_REAL(yes, a, b) SELECT(yes, a, b)
#define CHOOSE_CONE(yes, a, b)                                                                     \
    make_cone(SELECT(yes, a.width, b.width), SELECT(yes, a.spread, b.spread))
#define CHOOSE_BITS(yes, a, b) SELECT(yes, a, b)
#define CHOOSE_COUNT(yes, a, b) SELECT(yes, a, b)

// *ray = *branch for the rays in `yes`.
static inline void assign_path(path *ray, const path *branch, mask yes)
{
#define ASSIGN(kind, name, needs, waits, start, meaning)                                           \
    IF_NEEDED(needs)(ray->name = CHOOSE_##kind(yes, branch->name, ray->name);)
    GLINT_PATH_STATE(ASSIGN)
#undef ASSIGN
}

static inline packet packet_of_paths(const path *rays)
{
    packet p = make_packet(rays->origin, rays->direction);
#if LOCAL_RAYS
    p.origin_low[0] = rays->origin_low.x;
    p.origin_low[1] = rays->origin_low.y;
    p.origin_low[2] = rays->origin_low.z;
#endif
    return p;
}
