// Defines the state of a path.

#define ESCAPES 2

// A path on its way: a ray, its weight and its history.
typedef struct path {
    real3 origin, direction; // the direction is a unit vector
#if LOCAL_RAYS
    real3 origin_low; // the low parts of the origin
#endif
    real3 weight;            // factor of arriving radiance in the pixel's value
#if GLINT_ABSORPTION
    real travelled; // length of the segment before the origin: primary rays start late
#endif
#if CARRIES_CONES
    cone cone;
#endif
    lanes_int from;      // place of the triangle that the ray starts on; −1: none
    lanes_int met;       // surfaces met so far
#if GLINT_ALPHA
    lanes_int passed; // number of these that were absent where the ray met them
#endif
    lanes_int media;     // see media.cl
    // If it is not 0, the path takes the environment along its direction without tracing. 1: the
    // path is cut short; ESCAPES: it meets nothing.
    lanes_int looked_up;
#if GLINT_ROUGH
    // A lobe's light. At its end the path takes `held`, and the environment's light times `shown`.
    real3 held;
    real shown;
#endif
#if GLINT_DISPERSION
    lanes_int dispersed; // 1: its light is of one wavelength
#endif
#if GLINT_FACETS
    cone lobe; // part of rough glass's lobes that the direction stands for; 0 before any
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
