// What a path carries on its way.

#define ESCAPES 2

// A path on its way: a ray, its weight and what it has passed.
typedef struct path {
    real3 origin, direction; // the direction is a unit vector
#if LOCAL_RAYS
    real3 origin_low; // what the origin lacks
#endif
    real3 weight;            // what a unit of radiance that arrives now adds to the pixel
#if GLINT_ABSORPTION
    real travelled; // the segment's length before its origin: primary rays start late
#endif
#if CARRIES_CONES
    cone cone;
#endif
    lanes_int from;      // place of the triangle that the ray starts on, −1: none
    lanes_int met;       // surfaces met so far
#if GLINT_ALPHA
    lanes_int passed; // of these, those that were not there where the ray met them
#endif
    lanes_int media;     // see media.cl
    lanes_int looked_up; // takes the environment along its direction, without being traced: 1 as
                         // it is cut short, ESCAPES as it meets nothing; else 0
#if GLINT_ROUGH
    real3 held; // light that it brings where it ends
    real shown; // how much of the environment's light it brings there: 1, or less beside that
#endif
#if GLINT_DISPERSION
    lanes_int dispersed; // 1: its light is of one wavelength
#endif
#if GLINT_FACETS
    cone lobe; // what of the lobes of rough glass its direction stands for; 0 before any
#endif
} path;

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
