// Renders one frame: uploads, launches, reads back. Returns pixels and writes no file.
#ifndef GLINT_RENDER_FRAME_H
#define GLINT_RENDER_FRAME_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/device.h"
#include "environment/environment.h"
#include "image/image.h"
#include "render/counts.h"
#include "render/general.h"
#include "render/plan.h"
#include "render/progress.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

// Wall-clock times of the phases of rendering, in milliseconds.
typedef struct glint_phases {
    double analysis;     // topology and plan
    double bvh;          // tree
    double irradiance;   // all irradiance maps so far; only paint needs them
    double cells;        // all environment cells so far; only rough surfaces need them
    double kernel_build; // all kernels so far: compiling, or fetching from the driver's cache
    // This scene, and this environment for all settings so far.
    double upload;
    double kernel; // all launches of the frame
    double readback;
} glint_phases;

typedef struct glint_frame_report {
    glint_ray_counts rays;
    glint_truncation truncation;
    uint32_t deepest; // surfaces that the longest path met
    // Pixels with a NaN or infinite component (0 unless something is wrong).
    uint64_t nonfinite_pixels;
    // Pixels rendered again in double precision (see glint_settings.mend). Rays and times
    // include them; all other counts are of single precision.
    uint64_t mended_pixels;
    double kernel_ms, readback_ms; // of this frame
} glint_frame_report;

// A scene on a device, ready to render frames. Opaque.
typedef struct glint_renderer glint_renderer;

typedef struct glint_renderer_inputs {
    glint_device *device;     // borrowed, must outlive the renderer
    const glint_scene *scene; // borrowed during creation only
    // Borrowed during creation; as long as the renderer lives if it gets other scenes or settings.
    const glint_environment *environment;
    const glint_settings *settings; // borrowed during creation only
    // NULL: the embedded kernels. Borrowed as long as the renderer lives.
    const char *kernel_dir;
    bool without_frames; // the renderer will render no frame (see probe.h)
} glint_renderer_inputs;

// Analyses the scene, makes the plan, builds the tree and the kernels, and uploads. Errors:
// GLINT_USAGE, GLINT_BAD_INPUT, GLINT_DEVICE_FAILED, GLINT_DEVICE_LACKS. If a kernel does not
// compile, error->details holds the build log.
glint_status glint_renderer_create(const glint_renderer_inputs *inputs, glint_renderer **renderer,
                                   glint_error *error);

// Replaces the scene for the next frames. Makes its plan, builds its tree or refits the last tree
// (see accel/bvh_build.h), and uploads both. Compiles kernels only if the plan changed; the
// environment stays. The scene is borrowed during the call. Errors as above. After a failure, the
// renderer renders no frame until it gets another scene.
glint_status glint_renderer_set_scene(glint_renderer *renderer, const glint_scene *scene,
                                      glint_error *error);

// Replace the scene in two steps. glint_renderer_prepare makes plan and tree and needs no device.
// It may run on another thread while the renderer renders frames of the previous scene. The
// renderer then holds two trees. glint_renderer_set_prepared does the rest, for the scene that was
// prepared last. If preparing fails, the renderer does not change. Errors as above.
glint_status glint_renderer_prepare(glint_renderer *renderer, const glint_scene *scene,
                                    glint_error *error);
glint_status glint_renderer_set_prepared(glint_renderer *renderer, const glint_scene *scene,
                                         glint_error *error);

// Replaces the environment for the next frames. Chooses its texels again, and compiles kernels only
// if this choice changes. The environment is borrowed as at creation. Do not call this while a
// scene is being prepared. Afterwards, a prepared scene must be prepared again. Errors as above.
// After a failure, the renderer renders no frame until it gets another environment.
glint_status glint_renderer_set_environment(glint_renderer *renderer,
                                            const glint_environment *environment,
                                            glint_error *error);

// Replaces the settings for the next frames, as far as glint_plan_vary allows: a coarser or finer
// frame of the same scene, or a grid of its pixels (grid_step). The renderer caches the data of the
// last few settings, so that going back is quick. A new scene or environment restores the settings
// of the creation. Errors: as glint_renderer_create. After a failure, the renderer renders no frame
// until it gets other settings. If it failed to take a scene or an environment, it needs this
// first.
glint_status glint_renderer_set_settings(glint_renderer *renderer, const glint_settings *settings,
                                         glint_error *error);

// The plan of the current settings for the last frame's camera, and the plan of the creation's
// settings. The second holds for any camera for which the proofs about the scene hold.
const glint_plan *glint_renderer_plan(const glint_renderer *renderer);
const glint_plan *glint_renderer_first_plan(const glint_renderer *renderer);
const glint_bvh_report *glint_renderer_bvh(const glint_renderer *renderer);
const glint_phases *glint_renderer_phases(const glint_renderer *renderer);

// Bytes of the buffers in use on the device. A CPU's buffers lie in the host's memory. Buffers that
// stay allocated from larger frames of other settings do not count.
typedef struct glint_device_bytes {
    size_t scene;       // clusters of triangles, normals, materials
    size_t tree;        // nodes
    size_t environment; // with the irradiance map
    size_t frame;       // pixels, and their layers
} glint_device_bytes;

glint_device_bytes glint_renderer_device_bytes(const glint_renderer *renderer);

// The kind of kernels that the next frame runs, unless its camera needs others.
glint_kernel_kind glint_renderer_kernels(const glint_renderer *renderer);

// True if the settings leave the choice of kernels to glint, and general ones run. Then the kernels
// that glint_plan_build_options describes would be faster.
bool glint_renderer_wants_special(const glint_renderer *renderer);

// Takes special kernels that somebody has compiled since. If they cannot be built, general ones go
// on.
void glint_renderer_take_special(glint_renderer *renderer);

// A frame to render. Pointers are borrowed.
typedef struct glint_frame_request {
    glint_renderer *renderer;
    const glint_camera *camera;
    const glint_progress *progress; // may be NULL
    // Zero, or an image whose memory is reused if it has the frame's size. On a CPU this saves the
    // cost of fresh memory.
    glint_image *image;
    glint_frame_report *report; // may be NULL
} glint_frame_request;

// Renders into an RGBA image (premultiplied, linear). On failure the image is left empty.
glint_status glint_renderer_frame(const glint_frame_request *request, glint_error *error);

// The pixels of the last frame in double precision as the device computed them, before they are
// rounded to float ([height][width][4], malloc'd). For tests. GLINT_USAGE in other precisions.
glint_status glint_renderer_exact_pixels(glint_renderer *renderer, double **pixels,
                                         glint_error *error);

// The layers of the last frame that the settings ask for. *layers may be unset; the caller frees
// it. Errors: GLINT_USAGE if the settings ask for none, GLINT_DEVICE_FAILED; *layers is then empty.
glint_status glint_renderer_layers(glint_renderer *renderer, glint_layers *layers,
                                   glint_error *error);

// NULL is allowed.
void glint_renderer_free(glint_renderer *renderer);

#endif
