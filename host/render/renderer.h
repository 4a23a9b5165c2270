// What a renderer is made of: for this floor only.
#ifndef GLINT_RENDER_RENDERER_H
#define GLINT_RENDER_RENDERER_H

#include "render/device_scene.h"
#include "render/frame.h"
#include "render/kernels.h"
#include "render/launches.h"
#include "render/light.h"
#include "render/target.h"

// What a renderer lacks before it can render frames, as bits: what it last failed to take.
typedef enum glint_renderer_state {
    GLINT_RENDERER_IS_READY = 0,
    GLINT_RENDERER_LACKS_SETTINGS = 1,
    GLINT_RENDERER_LACKS_SCENE = 2,
    GLINT_RENDERER_LACKS_LIGHT = 4,
    GLINT_RENDERER_IS_WITHOUT_FRAMES = 8, // none can be asked for
} glint_renderer_state;

struct glint_renderer {
    glint_device *device;          // borrowed
    const char *kernel_dir;        // likewise
    glint_settings first_settings; // those of the creation
    glint_settings settings;       // of the frames that follow
    glint_plan plan;               // theirs
    unsigned state;                // glint_renderer_state
    glint_device_scene scene;
    glint_light light;
    glint_kernel_cache cache;
    const glint_kernels *kernels; // the plan's, of the cache; NULL: none
    glint_target target;
    double bands_per_ms; // of tiles, in the last frame; 0 before the first
    glint_phases phases;
};

// Compiles other kernels where what the plan proved of the scene does not hold for the camera, or
// does again. Errors: as building them.
glint_status glint_renderer_suit(glint_renderer *r, const glint_camera *camera, glint_error *error);

glint_scene_arguments glint_renderer_scene_arguments(const glint_renderer *r);
glint_launcher glint_renderer_launcher(const glint_renderer *r);

#endif
