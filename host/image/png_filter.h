// Filters rows of a PNG (PNG specification, chapter 9).
#ifndef GLINT_IMAGE_PNG_FILTER_H
#define GLINT_IMAGE_PNG_FILTER_H

#include <stddef.h>

// Filters a row of `bytes` bytes and writes the number of the filter and the row to `to`:
// [1 + bytes]. Takes the filter with the least sum of magnitudes, as the specification recommends.
// Both lines begin with a pixel of zeros, of `pixel_bytes` bytes, which is not part of the row.
void glint_png_filter(const unsigned char *line, const unsigned char *line_above, size_t bytes,
                      size_t pixel_bytes, unsigned char *to);

#endif
