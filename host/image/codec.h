// The codec: a shared library of its own (host/codec/, libglint_codec.so) that holds all calls of
// OpenImageIO. image_io.c loads it when glint first reads or writes an image. OpenImageIO depends
// on 260 libraries. Linking them takes 0.4 s, more than most commands need.
#ifndef GLINT_IMAGE_CODEC_H
#define GLINT_IMAGE_CODEC_H

#include "image/formats.h"
#include "image/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct glint_codec {
    const char *version; // GLINT_VERSION: must be that of the program
    // These work like the functions of the same name in image_io.h, with two differences. The
    // results are zero when the caller passes them. On failure the caller frees what is in them.
    glint_status (*read)(const glint_image_source *source, glint_image *image,
                         glint_image_facts *facts, glint_error *error);
    glint_status (*read_channels)(const char *path, glint_channels *channels, glint_error *error);
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
