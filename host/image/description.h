// Writes metadata as text, for formats without typed attributes.
#ifndef GLINT_IMAGE_DESCRIPTION_H
#define GLINT_IMAGE_DESCRIPTION_H

#include "image/image_io.h"

// Returns lines "name: value" for all metadata but matrices; "" if there is none. The caller frees
// the text. NULL: not enough memory.
char *glint_description_make(const glint_write_options *options);

#endif
