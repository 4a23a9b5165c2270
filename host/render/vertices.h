// Shades vertices, once per frame before its tiles. Used in this folder only.
#ifndef GLINT_RENDER_VERTICES_H
#define GLINT_RENDER_VERTICES_H

#include "base/status.h"
#include "kernels/layout.h"
#include "render/launches.h"
#include "render/plan.h"

#include <stddef.h>

// Bytes of the shading results for a cluster's vertices; 0 if the plan shades pixels.
size_t glint_vertices_bytes(const glint_plan *plan);

// Shades the vertices of the first `clusters` clusters for the view, and waits for the end. Does
// nothing if the plan shades pixels. Errors: GLINT_DEVICE_FAILED.
glint_status glint_vertices_shade(const glint_launcher *launcher, const glint_frame_record *view,
                                  size_t clusters, glint_error *error);

#endif
