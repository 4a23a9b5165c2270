// What a renderer is made of: for this floor only.
#ifndef GLINT_RENDER_RENDERER_H
#define GLINT_RENDER_RENDERER_H

#include "render/frame.h"
#include "render/pixels.h"
#include "render/upload.h"
#include "render/view.h"

struct glint_renderer {
    glint_device *device;         // borrowed
    glint_renderer_inputs inputs; // borrowed; the scene is that of the creation, and may be gone
    glint_settings settings;
    glint_plan plan;
    glint_bvh_report bvh;
    glint_phases phases;
    glint_stored_space space;
    glint_geometry_memory geometry;
    glint_light_memory light;
    int environment_edge, irradiance_edge;
    cl_kernel kernel; // NULL without frames
    glint_pixels pixels;
    cl_mem counters, layers;
    size_t pixel_count;
    bool has_failed;     // to take another scene
    double bands_per_ms; // of tiles, in the last frame; 0 before the first
};

#endif
