// Converts an image's pixels to the values that a file of some format holds.
//
// Values that a format cannot hold:
//   EXR half   beyond ±65504, also infinite: ±65504. NaN stays NaN: it marks a fault, and a file
//              that is fit for comparison must not hide it.
//   EXR float  unchanged.
//   EXR by DWA beyond ±60000: ±60000. B44 with halfs: beyond −32752: −32752. So the error of the
//              compression makes nothing infinite. Both make a number of NaN.
//   HDR        NaN and negative values become 0; infinity becomes 1.6e38, the limit of RGBE.
//   8 bits     NaN and negative values become 0; above 1 becomes 1, unless a tone curve maps it.
// Grey stays grey if the format has it (EXR, PNG, TIFF, JPEG). TIFF is written with 8 bits, sRGB.
#ifndef GLINT_IMAGE_FILE_VALUES_H
#define GLINT_IMAGE_FILE_VALUES_H

#include "image/encoding.h"
#include "image/formats.h"
#include "image/image_io.h"

#include <stddef.h>

// What a file holds of an image. The image and the options are borrowed.
typedef struct glint_file_values {
    const glint_written_format *format;
    const glint_image *image;
    const glint_write_options *options;
    int color, channels; // channels of the picture: without alpha, and all
    glint_value_type type;
    float lowest, highest; // of an EXR
    size_t picture_bytes;  // bytes of a pixel without further channels
    size_t pixel_bytes;    // bytes of a pixel, with the further channels of an EXR
} glint_file_values;

// Decides the channels and the type of the values.
glint_file_values glint_file_values_of(const glint_written_format *format, const glint_image *image,
                                       const glint_write_options *options);

// Writes all pixels to `to`: [height][width] pixels, packed tightly. Converts them on `threads`
// threads (0: one for each core).
void glint_file_values_fill(const glint_file_values *values, size_t threads, unsigned char *to);

#endif
