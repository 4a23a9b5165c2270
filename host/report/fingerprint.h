// What decides a frame's pixels, as a short text: two frames with the same one are the same.
#ifndef GLINT_REPORT_FINGERPRINT_H
#define GLINT_REPORT_FINGERPRINT_H

#include "base/status.h"
#include "image/image_io.h"
#include "report/subject.h"

#include <stdint.h>

// What the frames of a run share: the program's version and its kernels, the scene, the
// environment, the settings, the plan, and how a file is encoded; not the device, nor the names of
// files.
typedef struct glint_fingerprint {
    uint64_t high, low;
} glint_fingerprint;

#define GLINT_FINGERPRINT_TEXT 33 // 32 hexadecimal digits and the end

// `subject`: scene, environment, settings and plan are needed. `path` names the format by its
// extension. Reads every triangle and texel once. Errors: GLINT_DEVICE_FAILED (memory).
glint_status glint_fingerprint_make(const glint_subject *subject, const char *path,
                                    const glint_write_options *options,
                                    glint_fingerprint *fingerprint, glint_error *error);

// Of the frame that `camera` sees. From any thread.
void glint_fingerprint_frame(const glint_fingerprint *fingerprint, const glint_camera *camera,
                             char text[GLINT_FINGERPRINT_TEXT]);

// The name of the entry that holds it in a file's metadata.
#define GLINT_FINGERPRINT_NAME "glint:fingerprint"

// The fingerprint in a file that was written with one, whatever its format; "" where there is none,
// or no file. It says nothing of whether the pixels behind it are whole.
void glint_fingerprint_find(const char *path, char text[GLINT_FINGERPRINT_TEXT]);

#endif
