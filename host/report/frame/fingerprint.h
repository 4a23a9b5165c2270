// Computes fingerprints: short texts of everything that decides a frame's pixels. Frames with equal
// fingerprints are equal.
#ifndef GLINT_REPORT_FRAME_FINGERPRINT_H
#define GLINT_REPORT_FRAME_FINGERPRINT_H

#include "base/status.h"
#include "image/image_io.h"
#include "report/frame/subject.h"

#include <stdbool.h>
#include <stdint.h>

// A 128-bit hash. Zero is valid and matches no real fingerprint.
typedef struct glint_fingerprint {
    uint64_t high, low;
} glint_fingerprint;

static inline bool glint_fingerprints_equal(glint_fingerprint a, glint_fingerprint b)
{
    return a.high == b.high && a.low == b.low;
}

#define GLINT_FINGERPRINT_TEXT 33 // 32 hexadecimal digits and the terminating zero

// Computes the fingerprint of everything that the frames of a run share: the program's version and
// kernels, the settings, the kind of texels, and the encoding of the file. The device and the names
// of files do not count.
//
// `subject` needs the settings. It also needs the plan, except if the plan may change from frame to
// frame. `path` names the format by its extension. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_fingerprint_run(const glint_subject *subject, const char *path,
                                   const glint_write_options *options,
                                   glint_fingerprint *fingerprint, glint_error *error);

// Computes the fingerprint of a scene's triangles and materials; reads each once. Errors:
// GLINT_OUT_OF_MEMORY.
glint_status glint_fingerprint_scene(const glint_scene *scene, glint_fingerprint *fingerprint,
                                     glint_error *error);

// Computes the fingerprint of an environment's radiance; reads every texel once. Errors:
// GLINT_OUT_OF_MEMORY.
glint_status glint_fingerprint_environment(const glint_environment *environment,
                                           glint_fingerprint *fingerprint, glint_error *error);

// Computes the fingerprint of a file's bytes. Errors: GLINT_BAD_INPUT if it cannot be read.
glint_status glint_fingerprint_file(const char *path, glint_fingerprint *fingerprint,
                                    glint_error *error);

// Joins up to 8 fingerprints, in this order, and a text of less than 500 bytes.
glint_fingerprint glint_fingerprint_join(const glint_fingerprint *parts, size_t count,
                                         const char *text);

// Writes the fingerprint of a frame: of its parts and of the camera that sees them.
void glint_fingerprint_frame(const glint_fingerprint *parts, size_t count,
                             const glint_camera *camera, char text[GLINT_FINGERPRINT_TEXT]);

// The name of the fingerprint's entry in a file's metadata.
#define GLINT_FINGERPRINT_NAME "glint:fingerprint"

// Reads the fingerprint from a file of any format; "" if the file is missing or has none. It does
// not tell whether the pixels in the file are whole.
void glint_fingerprint_find(const char *path, char text[GLINT_FINGERPRINT_TEXT]);

#endif
