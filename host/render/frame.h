// Rendering one frame: upload, launch, read back. Returns pixels, writes no file.
#ifndef GLINT_RENDER_FRAME_H
#define GLINT_RENDER_FRAME_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/device.h"
#include "environment/environment.h"
#include "image/image.h"
#include "render/counts.h"
#include "render/plan.h"
#include "render/progress.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

// Wall-clock milliseconds of the phases that floor 5 sees.
typedef struct glint_phases {
    double analysis;     // topology and plan
    double bvh;          // tree
    double irradiance;   // irradiance map, where paint needs one: all of them
    double cells;        // likewise what rough surfaces see of the environment
    double kernel_build; // compiling, or fetching from the driver's cache: all kernels so far
    double upload;       // of this scene, and of this environment for all settings so far
    double kernel;       // all launches of the frame
    double readback;
} glint_phases;

typedef struct glint_frame_report {
    glint_ray_counts rays;
    glint_truncation truncation;
    uint32_t deepest; // surfaces met by the longest path
    uint64_t
        nonfinite_pixels; // pixels with a NaN or infinite component (0 unless something is wrong)
    uint64_t
        mended_pixels; // that were rendered again in double precision, see glint_settings.mend;
                       // rays and times count them, the rest is of single precision
    double kernel_ms, readback_ms; // of this frame
} glint_frame_report;

// A scene on a device, ready to render frames. Opaque.
typedef struct glint_renderer glint_renderer;

typedef struct glint_renderer_inputs {
    glint_device *device;                 // borrowed, must outlive the renderer
    const glint_scene *scene;             // borrowed during creation only
    const glint_environment *environment; // borrowed during creation; as long as the renderer lives
                                          // where it is given other scenes or settings
    const glint_settings *settings;       // borrowed during creation only
    const char *kernel_dir;               // NULL: the embedded kernels; borrowed as long as the
                                          // renderer lives
    bool without_frames;                  // no frame will be asked for (see probe.h)
} glint_renderer_inputs;

// Analyses, plans, builds the tree and the kernels, uploads. Errors: GLINT_USAGE, GLINT_BAD_INPUT,
// GLINT_DEVICE_FAILED; a kernel that does not compile leaves the build log in error->details.
glint_status glint_renderer_create(const glint_renderer_inputs *inputs, glint_renderer **renderer,
                                   glint_error *error);

// Another scene in the place of the one that there was, for the frames that follow: its plan is
// made, its tree too or fitted from the last one's (see accel/bvh.h), and uploaded; kernels are
// compiled only where the plan has changed, the environment stays. The scene is borrowed during the
// call. Errors as above; a renderer that failed may be given another scene, and renders no frame
// until then.
glint_status glint_renderer_set_scene(glint_renderer *renderer, const glint_scene *scene,
                                      glint_error *error);

// The same in two steps, the first of which may be taken on another thread while frames of the
// scene before are rendered: what needs no device, plan and tree; and the rest. The renderer then
// holds two trees. glint_renderer_set_prepared is given the scene that was prepared last. Where
// preparing failed, the renderer is as it was. Errors as above.
glint_status glint_renderer_prepare(glint_renderer *renderer, const glint_scene *scene,
                                    glint_error *error);
glint_status glint_renderer_set_prepared(glint_renderer *renderer, const glint_scene *scene,
                                         glint_error *error);

// Another environment in the place of the one that there was, for the frames that follow; what the
// plan says of its texels is found anew, and kernels are compiled only where that changes. It is
// borrowed as at the creation. Not to be called while a scene is prepared, and a scene that has
// been is prepared no more. Errors as above; a renderer that failed may be given another
// environment, and renders no frame until then.
glint_status glint_renderer_set_environment(glint_renderer *renderer,
                                            const glint_environment *environment,
                                            glint_error *error);

// Other settings for the frames that follow, as glint_plan_vary allows them: those of a coarser or
// a finer frame of the same scene, or of a grid of its pixels (grid_step). What the last few need
// is kept, so that going back is quick. Another scene or environment brings the settings of the
// creation back. Errors: as creating; a renderer that failed may be given other settings, and
// renders no frame until then; one that failed to take a scene or an environment needs that first.
glint_status glint_renderer_set_settings(glint_renderer *renderer, const glint_settings *settings,
                                         glint_error *error);

// The plan of the settings that there are, and for the last frame's camera; that of the creation's
// settings, for any camera from which what is proved of the scene holds.
const glint_plan *glint_renderer_plan(const glint_renderer *renderer);
const glint_plan *glint_renderer_first_plan(const glint_renderer *renderer);
const glint_bvh_report *glint_renderer_bvh(const glint_renderer *renderer);
const glint_phases *glint_renderer_phases(const glint_renderer *renderer);

// Bytes that the device works on; a CPU's lie in the host's memory. Buffers that were needed for
// larger frames of other settings stay, and are not counted.
typedef struct glint_device_bytes {
    size_t scene;       // clusters of triangles, normals, materials
    size_t tree;        // nodes
    size_t environment; // with the irradiance map
    size_t frame;       // pixels, and their layers
} glint_device_bytes;

glint_device_bytes glint_renderer_device_bytes(const glint_renderer *renderer);

// Bytes of the compiled kernels as the driver would hand them out; 0 where it does not.
size_t glint_renderer_program_bytes(const glint_renderer *renderer);

// A frame to render. Pointers are borrowed.
typedef struct glint_frame_request {
    glint_renderer *renderer;
    const glint_camera *camera;
    const glint_progress *progress; // may be NULL
    glint_image *image; // zero, or one whose memory is used again where it has the frame's size:
                        // on a CPU that saves what fresh memory costs
    glint_frame_report *report; // may be NULL
} glint_frame_request;

// Renders into an RGBA image (premultiplied, linear). On failure the image is left empty.
glint_status glint_renderer_frame(const glint_frame_request *request, glint_error *error);

// The pixels of the last frame in double precision as the device computed them
// ([height][width][4], malloc'd), before they are rounded to float: for tests. GLINT_USAGE in other
// precisions.
glint_status glint_renderer_exact_pixels(glint_renderer *renderer, double **pixels,
                                         glint_error *error);

// The layers of the last frame: those that the settings ask for. *layers need not be set; the
// caller frees it. Errors: GLINT_USAGE where the settings ask for none, GLINT_DEVICE_FAILED;
// *layers is then empty.
glint_status glint_renderer_layers(glint_renderer *renderer, glint_layers *layers,
                                   glint_error *error);

// NULL is allowed.
void glint_renderer_free(glint_renderer *renderer);

#endif
