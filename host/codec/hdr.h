// Reads Radiance pictures (HDR, RGBE).
#ifndef GLINT_CODEC_HDR_H
#define GLINT_CODEC_HDR_H

#include "base/status.h"
#include "codec/primaries.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A file in memory. All members are borrowed.
typedef struct glint_hdr_file {
    const char *path; // for messages
    const unsigned char *bytes;
    size_t size;
} glint_hdr_file;

typedef struct glint_hdr {
    int32_t length, scanlines; // pixels of a scanline, and their number
    int32_t orientation;       // 1 to 8 as in TIFF: which sides the scanlines begin at
    size_t pixels_at;          // offset in the file
    bool is_converted;         // the matrix is not the identity
    glint_color_matrix matrix; // to linear Rec. 709, without exposure
} glint_hdr;

// Reads the header. Errors: GLINT_BAD_INPUT, also if the file is too short for its scanlines.
glint_status glint_hdr_read_header(const glint_hdr_file *file, glint_hdr *header,
                                   glint_error *error);

// Decodes [scanlines][length][3] values of linear Rec. 709. Errors: GLINT_BAD_INPUT,
// GLINT_OUT_OF_MEMORY.
glint_status glint_hdr_read_pixels(const glint_hdr_file *file, const glint_hdr *header,
                                   float *pixels, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
