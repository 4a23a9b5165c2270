// Mending frames in single precision: where light jumps from one pixel to the next, at edges and
// folds and where curved glass scatters it, single precision shows the other side now and then, and
// double precision does not. For frame.c only.
#ifndef GLINT_RENDER_MEND_H
#define GLINT_RENDER_MEND_H

#include "render/pass.h"

// Renders again in double precision, with the renderer's settings but for layers and terms, the
// pixels that differ from one of their four neighbours by more than settings.mend times the
// frame's mean: root mean square over R, G and B; the mean over them of all pixels that are finite,
// those that are not differ from all. `request` has rendered the frame. Puts the pixels into its
// image, and adds what they took to its report. The settings are what they were. Errors: as
// glint_renderer_set_settings and glint_renderer_frame; the image is then half mended.
glint_status glint_mend(const glint_frame_request *request, glint_error *error);

#endif
