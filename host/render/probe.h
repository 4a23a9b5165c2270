// Single parts of the renderer, called on the device with rays and numbers of the caller's own:
// what self-tests look at. The kernels are compiled with the plan of a scene, as for its frames.
#ifndef GLINT_RENDER_PROBE_H
#define GLINT_RENDER_PROBE_H

#include "base/status.h"
#include "kernels/layout.h"
#include "render/frame.h"

#include <stddef.h>

// What can be called; kernels/probes.cl says what the numbers in and out are.
typedef enum glint_probe_part {
    GLINT_PROBE_TRACE,       // rays (glint_probe_ray) → hits (glint_probe_hit)
    GLINT_PROBE_BOUNCE_RAYS, // rays → what the next surface makes of them (glint_probe_bounce)
    GLINT_PROBE_FRESNEL,     // the others: four numbers in, four out
    GLINT_PROBE_DIRECTIONS,
    GLINT_PROBE_METAL,
    GLINT_PROBE_NORMALIZED,
    GLINT_PROBE_ENVIRONMENT,
    GLINT_PROBE_FACE,
    GLINT_PROBE_PRIMARY,
    GLINT_PROBE_PRIMARY_ORIGIN,
    GLINT_PROBE_TILE_PLACE,
    GLINT_PROBE_LOOP,
    GLINT_PROBE_PARTS,
} glint_probe_part;

// In stored coordinates; the direction is a unit vector.
typedef struct glint_probe_ray {
    double origin[3], direction[3];
    double from;  // place of the triangle that it starts on; −1: none
    double media; // the stack of media that it is inside, as the kernels pack it; 0: empty space
    double origin_low[3]; // what floats leave out of the origin, with LOCAL_ORIGINS; else 0
    double unused;
} glint_probe_ray;

typedef struct glint_probe_hit {
    double distance;       // along the direction; beyond 10²⁹ where nothing was hit
    double barycentric[2]; // weights of the second and third vertex
    double triangle;       // its number in the scene; −1: none
} glint_probe_hit;

// Without a hit, all but `hit` is 0.
typedef struct glint_probe_bounce {
    glint_probe_hit hit;
    double geometric_normal[3];            // unit, on the viewer's side
    double outside;                        // 1 where the ray came from outside, else 0
    double normal[3], cosine;              // the unit shading normal, and its cosine to the viewer
    double reflected[3], reflected_weight; // unit direction; the largest of the weights R, G, B
    double reflected_origin[3];
    double place; // of the triangle hit: `from` of the rays that leave it
    double reflected_media;
    double transmitted[3], transmitted_weight; // 0 where the scene has no glass
    double transmitted_origin[3];
    double transmitted_media;
    double total_reflection;                     // 1 where all is reflected
    double reflected_low[3], transmitted_low[3]; // as origin_low
} glint_probe_bounce;

typedef struct glint_probe glint_probe;

// Everything but the frames' kernel: as glint_renderer_create. inputs->device must outlive it.
glint_status glint_probe_create(const glint_renderer_inputs *inputs, glint_probe **probe,
                                glint_error *error);
void glint_probe_free(glint_probe *probe); // NULL is allowed

const glint_plan *glint_probe_plan(const glint_probe *probe);

// The values that a frame of these settings (the size alone counts) seen by `camera` would be
// rendered with; without a camera no view, all 0 but the edges of the maps.
void glint_probe_view(const glint_probe *probe, const glint_camera *camera,
                      const glint_settings *settings, glint_frame_record *frame);

// Elements for a part. `in` and `out` hold numbers of double whatever the precision, rounded to
// float in single precision.
typedef struct glint_probe_work {
    glint_probe_part part;
    const glint_frame_record *frame; // as from glint_probe_view; NULL: no view
    const double *in;
    double *out;
    size_t count;
} glint_probe_work;

// Calls a part on the elements. Errors: GLINT_DEVICE_FAILED; a kernel that does not compile leaves
// the build log in error->details.
glint_status glint_probe_call(glint_probe *probe, const glint_probe_work *work, glint_error *error);

#endif
