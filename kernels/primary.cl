// Makes primary rays: where they start, their directions, and the paths that begin with them.

// A packet of primary rays: the pixels' samples that they belong to, and their hits.
typedef struct primary {
    real x, y;        // positions on the image plane
    real length;      // of the directions before normalisation
    lanes_int places; // of the triangles hit; −1: none
} primary;

// The primary rays of a group, and the triangles that they hit.
static inline primary primary_of(const tile *t, int group)
{
    primary first;
    first.x = t->x[group % TILE_COLUMNS];
    first.y = t->y[group / TILE_COLUMNS];
    first.places = t->place[group];
    return first;
}

// The directions of the primary rays through points (x, y) of the image plane, see
// glint_frame_record. Their length is 1 or more.
static inline real3 primary_directions(const glint_frame_record *frame, real x, real y)
{
    return scale_add(
        join_vector(&frame->direction_y), y,
        scale_add(join_vector(&frame->direction_x), x, join_vector(&frame->direction)));
}

// Sets the origins of the primary rays through points (x, y) of the image plane.
static inline void begin_at_eye(const glint_frame_record *frame, real x, real y, path *ray)
{
    const glint_split_vector *o = &frame->origin;
    ray->origin =
        scale_add(join_vector(&frame->origin_y), y,
                  scale_add(join_vector(&frame->origin_x), x, join_vector(o)));
#if LOCAL_RAYS
    ray->origin_low = real3_of(real_of(0), real_of(0), real_of(0));
    if (HAS_IN(frame, LOCAL_ORIGINS)) {
        const real3 from_middle =
            scale_add(join_vector(&frame->origin_y), y, scale(join_vector(&frame->origin_x), x));
        const pair at_x = sum_of(real_of(o->high[0]), from_middle.x);
        const pair at_y = sum_of(real_of(o->high[1]), from_middle.y);
        const pair at_z = sum_of(real_of(o->high[2]), from_middle.z);
        ray->origin = real3_of(at_x.high, at_y.high, at_z.high);
        ray->origin_low =
            real3_of(at_x.low + o->low[0], at_y.low + o->low[1], at_z.low + o->low[2]);
    }
#endif
}

// Makes the primary rays; sets the lengths in *first.
static inline path primary_rays(const glint_frame_record *frame, primary *first)
{
    real x = first->x, y = first->y;
    path ray;
    begin_at_eye(frame, x, y, &ray);
    real3 d = primary_directions(frame, x, y);
    real length_squared = dot3(d, d);
    real inverse = inverse_root(length_squared);
    real length = length_squared * inverse;
    first->length = length;
    ray.direction = scale(d, inverse);
    ray.weight = real3_of(real_of(1), real_of(1), real_of(1));
#if GLINT_ABSORPTION
    ray.travelled = length * JOIN(frame->start[0], frame->start[1]);
#endif
#if CARRIES_CONES
    ray.cone = primary_cone(frame, inverse);
#endif
    ray.from = int_of(-1);
    ray.met = int_of(0);
#if GLINT_ALPHA
    ray.passed = int_of(0);
#endif
    ray.media = int_of(0);
    ray.looked_up = int_of(0);
#if GLINT_ROUGH
    ray.held = real3_of(real_of(0), real_of(0), real_of(0));
    ray.shown = real_of(1);
#endif
#if GLINT_DISPERSION
    ray.dispersed = int_of(0);
#endif
#if GLINT_FACETS
    ray.lobe.width = ray.lobe.spread = real_of(0);
#endif
    return ray;
}
