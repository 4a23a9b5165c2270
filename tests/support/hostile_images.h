// Image files that broke decoders: small ones that would cost much, and some that OpenImageIO 2.4
// dies of. Each is put together from its format's specification.
#ifndef GLINT_TESTS_HOSTILE_IMAGES_H
#define GLINT_TESTS_HOSTILE_IMAGES_H

#include "support/image_bytes.h"

typedef struct hostile_image {
    const char *name;
    image_bytes (*make)(void);
    const char *said; // part of the message
} hostile_image;

extern const hostile_image hostile_images[];
extern const size_t hostile_image_count;

#endif
