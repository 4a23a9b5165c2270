// Makes image files that broke decoders: small files with high costs, and files that crash
// OpenImageIO 2.4. Each is built from the specification of its format.
#ifndef GLINT_TESTS_HOSTILE_IMAGES_H
#define GLINT_TESTS_HOSTILE_IMAGES_H

#include "support/image_bytes.h"

typedef struct hostile_image {
    const char *name;
    image_bytes (*make)(void);
    const char *said; // expected part of the message
} hostile_image;

extern const hostile_image hostile_images[];
extern const size_t hostile_image_count;

#endif
