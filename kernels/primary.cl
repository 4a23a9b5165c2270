// Makes primary rays, and the paths that begin with them.

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

// Makes the primary rays; sets the lengths in *first.
static inline path primary_rays(const glint_frame_record *frame, primary *first)
{
    real x = first->x, y = first->y;
    path ray = path_at_start();
#if LOCAL_RAYS
    ray.origin = begin_at_eye(frame, x, y, &ray.origin_low);
#else
    ray.origin = begin_at_eye(frame, x, y, 0);
#endif
    real3 d = primary_directions(frame, x, y);
    real length_squared = dot3(d, d);
    real inverse = inverse_root(length_squared);
    real length = length_squared * inverse;
    first->length = length;
    ray.direction = scale(d, inverse);
#if GLINT_ABSORPTION
    ray.travelled = length * JOIN(frame->start[0], frame->start[1]);
#endif
#if CARRIES_CONES
    ray.cone = primary_cone(frame, inverse);
#endif
    return ray;
}
