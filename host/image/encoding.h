// Defines the request for an encoded file that glint sends to its codec (codec_messages.h).
//
// glint lays out the memory file: this job, the values of the pixels as the file holds them, then
// the texts. The child writes the encoded file to `file_offset` and answers with value_bytes, its
// bytes.
#ifndef GLINT_IMAGE_ENCODING_H
#define GLINT_IMAGE_ENCODING_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The type of a channel's values in a file.
typedef enum glint_value_type {
    GLINT_VALUE_CODE, // 8 bits
    GLINT_VALUE_HALF,
    GLINT_VALUE_FLOAT,
} glint_value_type;

#define GLINT_COMPRESSION_NAME 16

// The texts, each with its final zero: the names of the further channels, then name and string of
// each attribute, then the description.
typedef struct glint_encode_job {
    int32_t format; // a glint_written_kind
    int32_t width, height;
    int32_t color, channels; // channels of the picture: without alpha, and all
    int32_t value_type;      // a glint_value_type: of the picture
    int32_t envmap;          // a glint_envmap; EXR only
    uint32_t channel_count;  // further channels of floats, after the picture's; EXR only
    uint32_t attribute_count;
    char compression[GLINT_COMPRESSION_NAME]; // "": the format's default
    uint64_t pixel_offset;                    // [height][width] pixels
    uint64_t attribute_offset;                // [attribute_count] glint_encode_attribute
    uint64_t text_offset;
    uint64_t file_offset;
} glint_encode_job;

// A typed attribute of an EXR.
typedef struct glint_encode_attribute {
    int32_t type; // a glint_metadata_type
    int32_t integer;
    float real;
    float matrix[16];
} glint_encode_attribute;

#ifdef __cplusplus
}
#endif

#endif
