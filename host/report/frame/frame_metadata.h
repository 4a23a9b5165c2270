// What a frame's file says of itself.
#ifndef GLINT_REPORT_FRAME_FRAME_METADATA_H
#define GLINT_REPORT_FRAME_FRAME_METADATA_H

#include "image/image_io.h"
#include "render/settings_table.h"
#include "report/frame/subject.h"

#include <stddef.h>

// The two matrices of the OpenEXR standard attributes, for row vectors (p' = p M), as
// ImfStandardAttributes.h defines them:
// worldToCamera: camera space is left-handed, x right, y up, z the viewing direction.
// worldToNDC: (0, 0) is the upper left corner of the image and (1, 1) its lower right one, after
// division by w; z is of no meaning.
// `aspect` is the image's width over its height.
void glint_world_to_camera(const glint_camera *camera, float matrix[16]);
void glint_world_to_ndc(const glint_camera *camera, double aspect, float matrix[16]);

enum { GLINT_FRAME_METADATA_MAX = 28, GLINT_FRAME_METADATA_SETTINGS = 4 };

// Holds what `entries` point to: not to be copied.
typedef struct glint_frame_metadata {
    glint_metadata entries[GLINT_FRAME_METADATA_MAX];
    size_t count;
    char plan[512];
    char date[32];
    char device[700];
    char proxy[256];
    char settings[GLINT_FRAME_METADATA_SETTINGS][GLINT_SETTING_TEXT];
} glint_frame_metadata;

// `subject`: scene, environment, camera, settings, device and plan are needed, and must outlive
// `metadata`. `frame` is its number.
void glint_frame_metadata_fill(const glint_subject *subject, int frame, double exposure,
                               double render_ms, glint_frame_metadata *metadata);

// A further entry, while there is room; borrows the texts. An empty one is left out.
void glint_frame_metadata_add_text(glint_frame_metadata *metadata, const char *name,
                                   const char *text);
void glint_frame_metadata_add_real(glint_frame_metadata *metadata, const char *name, double value);

#endif
