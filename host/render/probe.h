// Calls single parts of the renderer on the device with rays and numbers of the caller, for
// self-tests. The kernels are compiled with the plan of a scene, as for its frames.
#ifndef GLINT_RENDER_PROBE_H
#define GLINT_RENDER_PROBE_H

#include "base/status.h"
#include "kernels/layout.h"
#include "render/frame.h"

#include <stddef.h>

// The parts that can be called. kernels/probes.cl describes the numbers in and out.
typedef enum glint_probe_part {
    GLINT_PROBE_TRACE,       // rays (glint_probe_ray) → hits (glint_probe_hit)
    GLINT_PROBE_BOUNCE_RAYS, // rays → reflected and transmitted rays at the next surface
                             // (glint_probe_bounce)
    GLINT_PROBE_FRESNEL,     // this part and all below: four numbers in, four out
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

// A ray in stored coordinates; the direction is a unit vector.
typedef struct glint_probe_ray {
    double origin[3], direction[3];
    double from; // place of the triangle that the ray starts on; −1: none
    // The stack of media at the origin, as the kernels pack it; 0: empty space.
    double media;
    // The part of the origin that a float cannot hold, with LOCAL_ORIGINS; else 0.
    double origin_low[3];
    double unused;
} glint_probe_ray;

typedef struct glint_probe_hit {
    double distance;       // along the direction; more than 10²⁹ if nothing was hit
    double barycentric[2]; // weights of the second and third vertex
    double triangle;       // its number in the scene; −1: none
} glint_probe_hit;

// Without a hit, all but `hit` is 0.
typedef struct glint_probe_bounce {
    glint_probe_hit hit;
    double geometric_normal[3];            // unit, on the viewer's side
    double outside;                        // 1 if the ray came from outside, else 0
    double normal[3], cosine;              // the unit shading normal, and its cosine to the viewer
    double reflected[3], reflected_weight; // unit direction; the largest of the weights R, G, B
    double reflected_origin[3];
    double place; // place of the triangle hit: `from` of the rays that leave it
    double reflected_media;
    double transmitted[3], transmitted_weight; // 0 if the scene has no glass
    double transmitted_origin[3];
    double transmitted_media;
    double total_reflection;                     // 1 for total reflection
    double reflected_low[3], transmitted_low[3]; // as origin_low
} glint_probe_bounce;

typedef struct glint_probe glint_probe;

// Creates a probe: a renderer without the kernel for frames. Errors: as glint_renderer_create.
// inputs->device must outlive it.
glint_status glint_probe_create(const glint_renderer_inputs *inputs, glint_probe **probe,
                                glint_error *error);
void glint_probe_free(glint_probe *probe); // NULL is allowed

const glint_plan *glint_probe_plan(const glint_probe *probe);

// Fills the record of a frame with these settings (only the size counts), seen by `camera`. Without
// a camera, all values are 0 except the edges of the maps.
void glint_probe_view(const glint_probe *probe, const glint_camera *camera,
                      const glint_settings *settings, glint_frame_record *frame);

// The elements for a part. `in` and `out` hold doubles in any precision; in single precision they
// are rounded to float.
typedef struct glint_probe_work {
    glint_probe_part part;
    const glint_frame_record *frame; // from glint_probe_view; NULL: no view
    const double *in;
    double *out;
    size_t count;
} glint_probe_work;

// Calls a part on the elements. Errors: GLINT_DEVICE_FAILED. If a kernel does not compile,
// error->details holds the build log.
glint_status glint_probe_call(glint_probe *probe, const glint_probe_work *work, glint_error *error);

#endif
