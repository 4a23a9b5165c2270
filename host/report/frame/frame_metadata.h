// Collects the metadata that a frame's file stores.
#ifndef GLINT_REPORT_FRAME_FRAME_METADATA_H
#define GLINT_REPORT_FRAME_FRAME_METADATA_H

#include "image/image_io.h"
#include "render/settings_table.h"
#include "report/frame/subject.h"

#include <stddef.h>

// Compute the two matrices of the OpenEXR standard attributes, for row vectors (p' = p M), as in
// ImfStandardAttributes.h. `aspect` is width over height of the image.
//   worldToCamera: camera space is left-handed, x right, y up, z the viewing direction.
//   worldToNDC: after division by w, (0, 0) is the upper left corner of the image and (1, 1) the
//   lower right one. z has no meaning.
void glint_world_to_camera(const glint_camera *camera, float matrix[16]);
void glint_world_to_ndc(const glint_camera *camera, double aspect, float matrix[16]);

enum { GLINT_FRAME_METADATA_MAX = 28, GLINT_FRAME_METADATA_SETTINGS = 4 };

// The metadata of a frame. Do not copy it: `entries` point into it.
typedef struct glint_frame_metadata {
    glint_metadata entries[GLINT_FRAME_METADATA_MAX];
    size_t count;
    char plan[512];
    char date[32];
    char device[700];
    char proxy[256];
    char settings[GLINT_FRAME_METADATA_SETTINGS][GLINT_SETTING_TEXT];
} glint_frame_metadata;

// Fills the metadata. `subject` needs scene, environment, camera, settings, device and plan; they
// must outlive `metadata`. `frame` is the frame's number.
void glint_frame_metadata_fill(const glint_subject *subject, int frame, double exposure,
                               double render_ms, glint_frame_metadata *metadata);

// Add an entry if there is room; the texts are borrowed. Empty texts are left out.
void glint_frame_metadata_add_text(glint_frame_metadata *metadata, const char *name,
                                   const char *text);
void glint_frame_metadata_add_real(glint_frame_metadata *metadata, const char *name, double value);

#endif
