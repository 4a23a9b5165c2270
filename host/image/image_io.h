// Image files, through OpenImageIO: another process reads them (decoder.h), a library that is
// loaded when first needed writes them (codec.h).
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

// What OpenEXR's standard attribute `envmap` says of a file.
typedef enum glint_envmap {
    GLINT_ENVMAP_NONE,
    GLINT_ENVMAP_LATLONG,
    GLINT_ENVMAP_CUBE,
} glint_envmap;

typedef struct glint_image_facts {
    glint_envmap envmap;
    bool was_encoded;      // 8- or 16-bit integers with the sRGB curve, linearised on reading
    bool is_direct3d_cube; // DDS: six faces above each other, +X −X +Y −Y +Z −Z of Direct3D
} glint_image_facts;

// Reads exr, hdr, png, tiff, dds, jpeg or webp as linear Rec.709 with 1 to 4 channels. Files with
// more have R, G, B, A by name. Integer files tagged or assumed sRGB are linearised here, before
// any filtering; alpha is premultiplied, orientation applied. The content decides what the file is,
// not its extension. Another process decodes it (decoder.h), within limits on time and memory.
// Errors: GLINT_BAD_INPUT with the file's name and what is wrong. `facts` may be NULL.
glint_status glint_image_read(const char *path, glint_image *image, glint_image_facts *facts,
                              glint_error *error);

// All channels of an EXR, whatever their names, as they are. Zero is valid: none.
typedef struct glint_channels {
    int width, height, count;
    char **names;  // [count], owned
    float *values; // [height][width][count], owned
} glint_channels;

// Errors: GLINT_BAD_INPUT with the file's name, also for files of other formats.
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

// A further channel of an EXR, of 32-bit floats whatever the picture's are. (Not UINT: readers
// disagree on it. OpenEXR turns 5 into 5.0, OpenImageIO into 5/(2³² − 1).)
typedef struct glint_channel {
    const char *name;    // "depth.surfaces"; none of the picture's R, G, B, A and Y
    const float *values; // [height][width], borrowed
} glint_channel;

// All-zero means the defaults.
typedef struct glint_write_options {
    bool exr_float;          // EXR: 32-bit float channels instead of half
    const char *compression; // EXR: none rle zip zips piz pxr24 b44 b44a dwaa dwab; TIFF: none lzw
                             // zip packbits; PNG: a level "0".."9"; JPEG: a quality "1".."100".
                             // NULL: the format's default
    float exposure;          // stops, applied to PNG, JPEG and TIFF only; EXR and HDR stay linear
    glint_tone tone;         // likewise, after exposure
    const glint_metadata *metadata; // EXR: typed; PNG, JPEG and TIFF: as text, without matrices
    size_t metadata_count;
    glint_envmap envmap;           // EXR: written as the standard attribute
    const glint_channel *channels; // EXR: written after the picture's; other formats leave them out
    size_t channel_count;
} glint_write_options;

// True if the path's extension is one that can be written: exr hdr png jpg jpeg tif tiff.
bool glint_image_can_write(const char *path);

// Whether the path's extension names a format that is written linear: exr hdr.
bool glint_image_stays_linear(const char *path);

// GLINT_USAGE (naming what may be given) when the extension cannot be written or the compression
// does not suit the format. Called before any work is done.
glint_status glint_image_check_output(const char *path, const glint_write_options *options,
                                      glint_error *error);

// Writes linear premultiplied pixels. EXR and HDR as they are; PNG, JPEG and 8-bit TIFF after
// exposure, unpremultiplied where the format keeps alpha, the tone curve and the sRGB curve (HDR
// and JPEG keep no alpha: what is written is the premultiplied colour, over black). The file
// appears whole or not at all: a temporary name in the same folder, fsync, rename; stale
// temporaries of the same output whose process is gone are removed. A symbolic link is followed and
// stays; devices and pipes are refused. Values that a format cannot hold: see image_write.cpp.
// `options` may be NULL. Errors: GLINT_OUTPUT_FAILED with the file's name and the cause; nothing is
// left behind.
glint_status glint_image_write(const char *path, const glint_image *image,
                               const glint_write_options *options, glint_error *error);

// An encoded file in memory: malloc'd; zero is valid.
typedef struct glint_encoded {
    unsigned char *bytes;
    size_t size;
} glint_encoded;

// The bytes of the file that glint_image_write would put at `path`, of which the extension counts
// alone. Errors: as glint_image_write, GLINT_OUT_OF_MEMORY.
glint_status glint_image_encode(const char *path, const glint_image *image,
                                const glint_write_options *options, glint_encoded *encoded,
                                glint_error *error);

// glint_image_load_ahead starts a thread that loads OpenImageIO, for a caller who writes an image
// later. The caller must call glint_image_end_loading, which joins the thread, before the
// process exits: exit handlers unload libraries, and must not while the thread loads them. Both
// functions belong to the main thread.
void glint_image_load_ahead(void);
void glint_image_end_loading(void);

// How many threads each read or write may use: 0 is one for each core, as it begins; 1 the caller's
// alone, for those who encode several images side by side.
void glint_image_use_threads(int count);

#ifdef __cplusplus
}
#endif

#endif
