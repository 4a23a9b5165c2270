// Defines the messages between glint and glint-codec, the program that decodes and encodes files
// for it (host/codec/).
//
// glint starts the codec once and talks to it over a socket of packets. The codec forks a child for
// each file. So a hostile file meets neither glint's memory nor its threads, and no child has seen
// another file. With each request glint sends two descriptors: a socket for the answer, and a
// memory file. If it decodes an image that lies in memory, it sends a third: a file with the
// image's bytes. The child puts its results into the memory file and answers. If the child dies,
// the codec says how.
#ifndef GLINT_IMAGE_CODEC_MESSAGES_H
#define GLINT_IMAGE_CODEC_MESSAGES_H

#include "base/spawn.h"
#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_CODEC_SOCKET GLINT_SPAWN_SOCKET // the codec's descriptor of the socket to glint
#define GLINT_CODEC_PATH 4096
#define GLINT_PICTURE_CHANNELS_MAX 4096
#define GLINT_DECODE_NAMES_MAX (UINT64_C(16) << 20) // bytes of channels' names

typedef enum glint_codec_work {
    GLINT_DECODE_PICTURE,
    GLINT_DECODE_CHANNELS, // all channels of an EXR
    GLINT_ENCODE,          // pixels in the memory file (encoding.h)
} glint_codec_work;

// Limits for one file. 0: no limit.
typedef struct glint_decode_limits {
    uint64_t picture_bytes; // of the picture in floats
    uint64_t memory_bytes;  // address space, beside the program's own
    uint32_t cpu_seconds;   // of all threads together
    uint32_t seconds;       // wall-clock time
} glint_decode_limits;

typedef struct glint_codec_request {
    int32_t work;                // a glint_codec_work
    char path[GLINT_CODEC_PATH]; // to decode; for all other work, the file's name in messages
    char plugin[16];             // OpenImageIO's name of the format
    uint64_t file_bytes;         // the size of the file to decode
    glint_decode_limits limits;
    int32_t file;    // the codec sets it: the image to decode, in memory; −1: read the path
    int32_t threads; // 0: one for each core
} glint_codec_request;

// The descriptors of a request. The receiver owns them.
typedef struct glint_codec_files {
    int answers; // the socket for the answer
    int results; // the memory file
    int image;   // the image to decode; −1: none
} glint_codec_files;

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

// The bytes of one value.
static inline size_t glint_stored_value_bytes(const glint_stored_facts *facts)
{
    return facts->code_bits != 0 ? (size_t)facts->code_bits / 8
           : facts->is_half != 0 ? sizeof(uint16_t)
                                 : sizeof(float);
}

typedef enum glint_codec_answer_kind {
    GLINT_CODEC_IS_READY,   // the codec has started
    GLINT_CODEC_DONE,       // a child's answer
    GLINT_CODEC_CHILD_DIED, // a child ended; if it did not answer, this is the answer
} glint_codec_answer_kind;

// glint checks all values before it uses them: a child may have failed in any way.
typedef struct glint_codec_answer {
    int32_t kind;   // a glint_codec_answer_kind
    int32_t status; // a glint_status; for GLINT_CODEC_CHILD_DIED, waitpid's status
    char message[GLINT_MESSAGE_CAPACITY];
    glint_stored_facts facts; // of a decoded picture
    // Bytes of the results in the memory file. A picture begins at 0.
    uint64_t value_bytes;
    uint64_t name_bytes; // after the values: the channels' names, each with its zero
} glint_codec_answer;

// Send and receive a request with its descriptors as one packet. False if the other end is gone, or
// is no glint of this version.
bool glint_codec_send(int socket, const glint_codec_request *request,
                      const glint_codec_files *files);
bool glint_codec_receive(int socket, glint_codec_request *request, glint_codec_files *files);

#ifdef __cplusplus
}
#endif

#endif
