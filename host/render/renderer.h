// What a renderer is made of: for this floor only.
#ifndef GLINT_RENDER_RENDERER_H
#define GLINT_RENDER_RENDERER_H

#include "kernels/layout.h"
#include "render/equipment.h"
#include "render/frame.h"
#include "render/pixels.h"
#include "render/upload.h"
#include "render/view.h"

// All that a scene needs before the device comes in. Zero is valid.
typedef struct glint_prepared_scene {
    glint_plan plan;      // of the settings that the renderer was made with
    glint_sight sight;    // what is proved of the scene, where these settings may heed it or
                          // variations of them
    glint_bvh tree;       // of a scene that moves, less the arrays that the device has; else empty
    glint_bvh_report bvh; // outlives the tree
    double built_cost, built_area; // the tree's when it was last built, see make_tree
    double analysis_ms, bvh_ms;
} glint_prepared_scene;

// What kernels read of the light: some of the equipment's.
typedef struct glint_light {
    cl_mem environment, irradiance;
} glint_light;

struct glint_renderer {
    glint_device *device;          // borrowed
    glint_renderer_inputs inputs;  // borrowed; the scene is that of the creation, and may be gone
    glint_settings first_settings; // those of the creation
    glint_settings settings;       // of the frames that follow
    glint_plan plan;               // theirs
    glint_half_rounding half;      // what the environment loses as halfs
    bool half_is_known;
    glint_prepared_scene shown; // whose frames are rendered
    glint_prepared_scene next;  // made meanwhile; its tree is fitted from that of the last but one
    bool is_next_ready;
    glint_phases phases;
    glint_stored_space space;
    glint_geometry_memory geometry;
    glint_equipment equipment;
    glint_light light;
    int environment_edge, irradiance_edge;
    glint_proxy proxy;       // the environment's
    cl_kernel kernel;        // the equipment's; NULL without frames
    cl_kernel vertex_kernel; // likewise; NULL where pixels are shaded
    cl_mem vertices;         // what it finds
    glint_pixels pixels;
    cl_mem counters, layers, terms, doubts, list;
    bool has_failed;     // to take another scene
    bool is_dark;        // it failed to take another environment
    double bands_per_ms; // of tiles, in the last frame; 0 before the first
};

// The kernel's arguments that change from frame to frame; the others are the renderer's buffers, in
// the order of set_buffers in equipment.c.
#define GLINT_PIXELS_ARGUMENT 8
#define GLINT_FRAME_ARGUMENT 15

// Of a frame, whose size has been checked.
static inline size_t glint_renderer_pixel_count(const glint_renderer *r)
{
    int size[2];
    glint_settings_pixels(&r->settings, size);
    return (size_t)size[0] * (size_t)size[1];
}

glint_status glint_renderer_set_argument(const glint_renderer *r, cl_uint index, size_t size,
                                         const void *value, glint_error *error);

// Compiles other kernels where what the plan proved of the scene does not hold for the camera, or
// does again. Errors: as building them.
glint_status glint_renderer_suit(glint_renderer *r, const glint_camera *camera, glint_error *error);

// Begins to render `bands` bands of tiles from `first` on. glint_renderer_wait waits for the end,
// and takes `done`.
glint_status glint_renderer_launch(glint_renderer *r, glint_frame_record *record, size_t first,
                                   size_t bands, cl_event *done, glint_error *error);
glint_status glint_renderer_wait(const glint_renderer *r, cl_event done, glint_error *error);

// Reads a buffer of the device's into memory that the caller frees; NULL on failure. `what` says
// what that is, for messages.
glint_status glint_renderer_read(const glint_renderer *r, const char *what, cl_mem buffer,
                                 size_t bytes, void **copy, glint_error *error);

#endif
