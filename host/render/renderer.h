// What a renderer is made of: for this floor only.
#ifndef GLINT_RENDER_RENDERER_H
#define GLINT_RENDER_RENDERER_H

#include "render/frame.h"
#include "render/pixels.h"
#include "render/upload.h"
#include "render/view.h"

struct glint_renderer {
    glint_device *device; // borrowed
    glint_settings settings;
    glint_plan plan;
    glint_bvh_report bvh;
    glint_phases phases;
    glint_stored_space space;
    glint_scene_memory memory;
    int environment_edge, irradiance_edge;
    cl_kernel kernel; // NULL without frames
    glint_pixels pixels;
    cl_mem counters, layers;
    size_t pixel_count;
    double bands_per_ms; // of tiles, in the last frame; 0 before the first
};

#endif
