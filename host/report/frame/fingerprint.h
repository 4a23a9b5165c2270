// What decides a frame's pixels, as a short text: two frames with the same one are the same.
#ifndef GLINT_REPORT_FRAME_FINGERPRINT_H
#define GLINT_REPORT_FRAME_FINGERPRINT_H

#include "base/status.h"
#include "image/image_io.h"
#include "report/frame/subject.h"

#include <stdbool.h>
#include <stdint.h>

// Zero is valid, and nobody's.
typedef struct glint_fingerprint {
    uint64_t high, low;
} glint_fingerprint;

static inline bool glint_fingerprints_equal(glint_fingerprint a, glint_fingerprint b)
{
    return a.high == b.high && a.low == b.low;
}

#define GLINT_FINGERPRINT_TEXT 33 // 32 hexadecimal digits and the end

// Of what the frames of a run share: the program's version and its kernels, the settings, the kind
// of texels, and how a file is encoded; not of the device, nor of the names of files. `subject`:
// settings are needed, and the plan unless it may be another in another frame. `path` names
// the format by its extension. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_fingerprint_run(const glint_subject *subject, const char *path,
                                   const glint_write_options *options,
                                   glint_fingerprint *fingerprint, glint_error *error);

// Of a scene's triangles and materials, each of which is read once. Errors likewise.
glint_status glint_fingerprint_scene(const glint_scene *scene, glint_fingerprint *fingerprint,
                                     glint_error *error);

// Of an environment's radiance, every texel of which is read once. Errors likewise.
glint_status glint_fingerprint_environment(const glint_environment *environment,
                                           glint_fingerprint *fingerprint, glint_error *error);

// Of a file's bytes. Errors: GLINT_BAD_INPUT where it cannot be read.
glint_status glint_fingerprint_file(const char *path, glint_fingerprint *fingerprint,
                                    glint_error *error);

// Of several things together, 8 at most, in this order, and of what `text` (under 500 bytes) says
// beside them.
glint_fingerprint glint_fingerprint_join(const glint_fingerprint *parts, size_t count,
                                         const char *text);

// Of a frame: what it is made of, and how `camera` sees that.
void glint_fingerprint_frame(const glint_fingerprint *parts, size_t count,
                             const glint_camera *camera, char text[GLINT_FINGERPRINT_TEXT]);

// The name of the entry that holds it in a file's metadata.
#define GLINT_FINGERPRINT_NAME "glint:fingerprint"

// The fingerprint in a file that was written with one, whatever its format; "" where there is none,
// or no file. It says nothing of whether the pixels behind it are whole.
void glint_fingerprint_find(const char *path, char text[GLINT_FINGERPRINT_TEXT]);

#endif
