// Reads and writes image files. Another process decodes them, and encodes all but PNG, with
// OpenImageIO (codec_messages.h).
#ifndef GLINT_IMAGE_IMAGE_IO_H
#define GLINT_IMAGE_IMAGE_IO_H

#include "base/status.h"
#include "image/image.h"
#include "image/tone.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The value of OpenEXR's standard attribute `envmap`.
typedef enum glint_envmap {
    GLINT_ENVMAP_NONE,
    GLINT_ENVMAP_LATLONG,
    GLINT_ENVMAP_CUBE,
} glint_envmap;

typedef struct glint_image_facts {
    glint_envmap envmap;
    bool was_encoded; // 8- or 16-bit integers with the sRGB curve, linearised on reading
    int code_bits;    // 8 or 16: integers, up to white; 0: floats or halfs
    // DDS: six faces stacked vertically, +X −X +Y −Y +Z −Z of Direct3D.
    bool is_direct3d_cube;
} glint_image_facts;

// Reads exr, hdr, png, tiff, dds, jpeg or webp as linear Rec.709 with 1 to 4 channels. From files
// with more channels it takes R, G, B, A by name. It linearises integer files that are tagged or
// assumed sRGB, before any filtering. It premultiplies alpha and applies the orientation. The
// content decides the format, not the extension. Another process decodes the file (decoder.h),
// within limits on time and memory. Errors: GLINT_BAD_INPUT with the file's name and the fault.
// `facts` may be NULL.
glint_status glint_image_read(const char *path, glint_image *image, glint_image_facts *facts,
                              glint_error *error);

// All channels of an EXR, unconverted. Zero is valid: no channels.
typedef struct glint_channels {
    int width, height, count;
    char **names;  // [count], owned
    float *values; // [height][width][count], owned
} glint_channels;

// Reads all channels. Errors: GLINT_BAD_INPUT with the file's name, also for other formats.
glint_status glint_image_read_channels(const char *path, glint_channels *channels,
                                       glint_error *error);
void glint_channels_free(glint_channels *channels);

typedef enum glint_metadata_type {
    GLINT_METADATA_STRING,
    GLINT_METADATA_INT,
    GLINT_METADATA_FLOAT,
    GLINT_METADATA_MATRIX, // 16 floats, rows of a row-vector matrix as OpenEXR stores them
} glint_metadata_type;

typedef struct glint_metadata {
    const char *name;
    glint_metadata_type type;
    const char *string;
    int integer;
    float real;
    float matrix[16];
} glint_metadata;

// An additional channel of an EXR, always of 32-bit floats. (Not UINT, because readers disagree:
// OpenEXR turns 5 into 5.0, OpenImageIO into 5/(2³² − 1).)
typedef struct glint_channel {
    const char *name;    // "depth.surfaces"; not the picture's R, G, B, A or Y
    const float *values; // [height][width], borrowed
} glint_channel;

// All-zero means the defaults.
typedef struct glint_write_options {
    bool exr_float; // EXR: 32-bit float channels instead of half
    // EXR: none rle zip zips piz pxr24 b44 b44a dwaa dwab; TIFF: none lzw zip packbits; PNG: a
    // level "0".."9"; JPEG: a quality "1".."100". NULL: the format's default.
    const char *compression;
    float exposure;                 // stops; only for PNG, JPEG and TIFF: EXR and HDR stay linear
    glint_tone tone;                // only for PNG, JPEG and TIFF; after exposure
    const glint_metadata *metadata; // EXR: typed; PNG, JPEG and TIFF: as text, without matrices
    size_t metadata_count;
    glint_envmap envmap; // EXR: written as the standard attribute
    // EXR: additional channels, written after the picture's. Other formats leave them out.
    const glint_channel *channels;
    size_t channel_count;
} glint_write_options;

// True if glint can write the path's extension: exr hdr png jpg jpeg tif tiff.
bool glint_image_can_write(const char *path);

// True if the path's extension names a linear format: exr hdr.
bool glint_image_stays_linear(const char *path);

// Fails with GLINT_USAGE, naming the choices, if glint cannot write the extension or if the
// compression does not suit the format. Call it before any work.
glint_status glint_image_check_output(const char *path, const glint_write_options *options,
                                      glint_error *error);

// Writes linear premultiplied pixels. EXR and HDR get them unchanged. PNG, JPEG and 8-bit TIFF get
// exposure, then unpremultiplied colours if the format keeps alpha, then the tone curve and the
// sRGB curve. (HDR and JPEG keep no alpha: they get the premultiplied colour, over black.)
//
// The file appears whole or not at all: a temporary name in the same folder, fsync, rename. Stale
// temporaries of dead processes are removed. A symbolic link is followed and stays; devices and
// pipes are refused. file_values.h says what becomes of values that a format cannot hold.
// `options` may be NULL. Errors: GLINT_OUTPUT_FAILED with the file's name and the cause; then no
// file is left behind.
glint_status glint_image_write(const char *path, const glint_image *image,
                               const glint_write_options *options, glint_error *error);

// An encoded file in memory: malloc'd; zero is valid.
typedef struct glint_encoded {
    unsigned char *bytes;
    size_t size;
} glint_encoded;

// Encodes the file that glint_image_write would write to `path`. Only the extension of `path`
// matters. Errors: as glint_image_write, GLINT_OUT_OF_MEMORY.
glint_status glint_image_encode(const char *path, const glint_image *image,
                                const glint_write_options *options, glint_encoded *encoded,
                                glint_error *error);

// Starts the process that encodes, for a caller who writes an image to `path` later. PNG needs no
// other process.
void glint_image_write_ahead(const char *path);

// Sets the number of threads for each read or write. 0, the default, is one for each core. 1 is the
// caller's thread alone, for callers that encode several images in parallel.
void glint_image_use_threads(int count);

#ifdef __cplusplus
}
#endif

#endif
