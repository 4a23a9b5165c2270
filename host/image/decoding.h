// Defines the messages between glint and its decoder, a program of its own (host/decoder/). The
// decoder decodes image files, so that a hostile file meets neither glint's memory nor its threads.
//
// glint starts the decoder once and talks to it over a socket of packets. The decoder forks a child
// for each file, so no child has seen another file. With each request glint sends two descriptors:
// a socket for the answer, and a memory file. If the image lies in memory, it sends a third: a file
// with its bytes. The child puts the values into the memory file and answers. If the child dies,
// the decoder says how.
#ifndef GLINT_IMAGE_DECODING_H
#define GLINT_IMAGE_DECODING_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_DECODER_SOCKET 3 // the decoder's descriptor of the socket to glint
#define GLINT_DECODE_PATH 4096
#define GLINT_DECODE_DESCRIPTORS 3 // most descriptors of a request
#define GLINT_PICTURE_CHANNELS_MAX 4096
#define GLINT_DECODE_NAMES_MAX (UINT64_C(16) << 20) // bytes of channels' names

// Limits for one file. 0: no limit.
typedef struct glint_decode_limits {
    uint64_t picture_bytes; // of the picture in floats
    uint64_t memory_bytes;  // address space, beside the program's own
    uint32_t cpu_seconds;   // of all threads together
    uint32_t seconds;       // wall-clock time
} glint_decode_limits;

typedef struct glint_decode_request {
    char path[GLINT_DECODE_PATH]; // for an image in memory: its name in messages
    char plugin[16];              // OpenImageIO's name of the format
    uint64_t file_bytes;          // the file's size
    glint_decode_limits limits;
    int32_t file;         // the decoder sets it: the image in memory; −1: read the path
    int32_t threads;      // 0: one for each core
    int32_t is_mesh;      // decode a Draco mesh in the memory file (mesh_decoding.h)
    int32_t all_channels; // decode all channels of an EXR, instead of a picture
} glint_decode_request;

typedef enum glint_transfer {
    GLINT_TRANSFER_LINEAR,
    GLINT_TRANSFER_SRGB,
    GLINT_TRANSFER_POWER,
} glint_transfer;

// A picture as its file stores it.
typedef struct glint_stored_facts {
    int32_t width, height, channels; // pictures have 1 to 4 channels
    int32_t code_bits;               // 8 or 16: integers; 0: floats or halfs
    int32_t is_half;                 // the values are halfs
    int32_t transfer;                // a glint_transfer
    float gamma;                     // for GLINT_TRANSFER_POWER: linear = code^gamma
    int32_t is_unassociated;         // alpha is not multiplied into the colour
    int32_t orientation;             // 1 to 8 as in TIFF and EXIF
    int32_t envmap;                  // a glint_envmap
    int32_t is_direct3d_cube;
} glint_stored_facts;

typedef enum glint_decode_kind {
    GLINT_DECODER_IS_READY, // the decoder has started
    GLINT_DECODED,          // a child's answer
    GLINT_DECODER_DIED,     // a child ended; if it did not answer, this is the answer
} glint_decode_kind;

// glint checks all values before it uses them: a child may have failed in any way.
typedef struct glint_decode_answer {
    int32_t kind;   // a glint_decode_kind
    int32_t status; // a glint_status; for GLINT_DECODER_DIED, waitpid's status
    char message[GLINT_MESSAGE_CAPACITY];
    glint_stored_facts facts;
    uint64_t value_bytes; // from the beginning of the memory file
    uint64_t name_bytes;  // after the values: the channels' names, each with its zero
} glint_decode_answer;

#ifdef __cplusplus
}
#endif

#endif
