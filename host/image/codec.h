// What image_io.c has the codec do: a library of its own (host/codec/, libglint_codec.so), which is
// loaded where the first image is read or written. OpenImageIO brings 260 libraries along, and to
// link them takes 0.4 s, more than most commands need.
#ifndef GLINT_IMAGE_CODEC_H
#define GLINT_IMAGE_CODEC_H

#include "image/formats.h"
#include "image/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct glint_codec {
    const char *version; // GLINT_VERSION: of the same build as the program
    // As the functions of image_io.h that are called like them, but for what they have made when
    // they fail: the caller frees that. Zero is what they begin with.
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
