// Mends frames in single precision. At edges, folds and curved glass, light jumps from one pixel to
// the next. Single precision sometimes shows the wrong side of the jump; double precision does not.
// For frame.c only.
#ifndef GLINT_RENDER_MEND_H
#define GLINT_RENDER_MEND_H

#include "render/pass.h"

// Renders again, in double precision, the pixels that differ from one of their four neighbours by
// more than settings.mend times the frame's mean. The difference is the root mean square over R, G
// and B. The mean is over R, G and B of all finite pixels; pixels that are not finite differ from
// all others. Uses the renderer's settings without layers and terms, and restores them afterwards.
// `request` must have rendered the frame. Writes the pixels into its image, and adds their rays and
// times to its report. Errors: as glint_renderer_set_settings and glint_renderer_frame; the image
// is then half mended.
glint_status glint_mend(const glint_frame_request *request, glint_error *error);

#endif
