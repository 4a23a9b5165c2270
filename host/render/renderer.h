// Defines the parts of a renderer. Used in this folder only.
#ifndef GLINT_RENDER_RENDERER_H
#define GLINT_RENDER_RENDERER_H

#include "render/device_scene.h"
#include "render/frame.h"
#include "render/kernels.h"
#include "render/launches.h"
#include "render/light.h"
#include "render/target.h"

// What a renderer lacks before it can render frames, as bits: the inputs that it last failed to
// take.
typedef enum glint_renderer_state {
    GLINT_RENDERER_IS_READY = 0,
    GLINT_RENDERER_LACKS_SETTINGS = 1,
    GLINT_RENDERER_LACKS_SCENE = 2,
    GLINT_RENDERER_LACKS_LIGHT = 4,
    GLINT_RENDERER_IS_WITHOUT_FRAMES = 8, // it renders no frames
} glint_renderer_state;

struct glint_renderer {
    glint_device *device;          // borrowed
    const char *kernel_dir;        // borrowed
    glint_settings first_settings; // settings of the creation
    glint_settings settings;       // settings of the next frames
    glint_plan plan;               // plan of `settings`
    unsigned state;                // glint_renderer_state
    glint_device_scene scene;
    glint_light light;
    glint_kernel_cache cache;
    const glint_kernels *kernels; // kernels of the plan, owned by the cache; NULL: none
    bool special_failed;          // glint_renderer_take_special could not build them
    glint_target target;
    double bands_per_ms; // bands of tiles per ms in the last frame; 0 before the first
    glint_phases phases;
};

// Adapts the plan to the camera: compiles other kernels if a proof of the plan does not hold for
// the camera, or holds again. Errors: as building kernels.
glint_status glint_renderer_suit(glint_renderer *r, const glint_camera *camera, glint_error *error);

glint_scene_arguments glint_renderer_scene_arguments(const glint_renderer *r);
glint_launcher glint_renderer_launcher(const glint_renderer *r);

#endif
