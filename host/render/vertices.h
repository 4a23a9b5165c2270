// Shading at vertices: once per frame, before its tiles. For this floor only.
#ifndef GLINT_RENDER_VERTICES_H
#define GLINT_RENDER_VERTICES_H

#include "base/status.h"
#include "kernels/layout.h"
#include "render/renderer.h"

// Bytes of what is found of the vertices of so many clusters; 0 where the plan shades pixels.
size_t glint_vertices_bytes(const glint_plan *plan, size_t clusters);

// Makes room for the vertices of the scene that is shown, in the place of the last one's. Errors:
// GLINT_DEVICE_FAILED.
glint_status glint_vertices_allocate(glint_renderer *r, glint_error *error);

// Launches the kernel once for no vertex, see equipment.c. Nothing where the plan shades pixels.
// Errors: GLINT_DEVICE_FAILED.
glint_status glint_vertices_warm_up(const glint_renderer *r, glint_error *error);

// Shades all vertices for the view, and waits for the end. Nothing where the plan shades pixels.
// Errors: GLINT_DEVICE_FAILED.
glint_status glint_vertices_shade(const glint_renderer *r, const glint_frame_record *view,
                                  glint_error *error);

#endif
