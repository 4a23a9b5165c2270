// Declares the codec: a separate shared library (host/codec/, libglint_codec.so) that encodes
// images through OpenImageIO. image_io.c loads it when glint first writes an image. OpenImageIO
// depends on 260 libraries. Linking them takes 0.4 s, more than most commands need.
#ifndef GLINT_IMAGE_CODEC_H
#define GLINT_IMAGE_CODEC_H

#include "image/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct glint_codec {
    const char *version; // GLINT_VERSION; must equal the program's
    // Encodes as glint_image_encode. The caller passes a zero result.
    glint_status (*encode)(const char *path, const glint_image *image,
                           const glint_write_options *options, glint_encoded *encoded,
                           glint_error *error);
    void (*use_threads)(int count);
} glint_codec;

// The codec's only symbol.
extern const glint_codec glint_codec_functions;

#ifdef __cplusplus
}
#endif

#endif
