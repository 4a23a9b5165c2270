// Reads and writes image files in the scratch folder. A failure fails the test with glint's
// message.
#ifndef GLINT_TESTS_SUPPORT_IMAGE_FILES_H
#define GLINT_TESTS_SUPPORT_IMAGE_FILES_H

#include "image/image_io.h"

// The caller frees the image. `facts` may be NULL.
glint_image image_file_read(const char *name, glint_image_facts *facts);

// Writes 40 x 30 pixels of noise from 0 to 1. No encoding makes noise short, so every part of the
// file matters.
void image_file_write_noise(const char *name, int channels);

#endif
