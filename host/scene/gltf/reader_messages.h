// The packets between glint and glint-decoder, the program that reads glTF files (host/decoder/).
//
// glint starts a decoder for each file, and sends it the open file and a memory file. The decoder
// opens no file itself: it asks for each file that the scene refers to, and glint opens it if it
// lies beside the scene. The decoder writes a document (scene/document.h) and says that it is done.
#ifndef GLINT_SCENE_GLTF_READER_MESSAGES_H
#define GLINT_SCENE_GLTF_READER_MESSAGES_H

#include "base/packet.h"
#include "base/spawn.h"
#include "base/status.h"

#include <limits.h>
#include <stdint.h>

#define GLINT_READER_SOCKET GLINT_SPAWN_SOCKET // the decoder's descriptor of the socket to glint

typedef enum glint_reader_kind {
    GLINT_READER_START, // glint: read this file into that memory file
    GLINT_READER_ASK,   // the decoder: open the file that a URI names
    GLINT_READER_GIVE,  // glint: the open file, or why there is none
    GLINT_READER_DONE,  // the decoder: the document is written, or why it is not
} glint_reader_kind;

typedef struct glint_reader_packet {
    char version[16];    // of the program that sends it
    int32_t kind;        // a glint_reader_kind
    int32_t status;      // of GIVE and DONE: a glint_status
    uint64_t free_bytes; // of START: the memory that is free
    // START: the file's name. ASK: the URI, with its zero. GIVE and DONE: the error's message.
    char text[3 * PATH_MAX];
} glint_reader_packet;

#endif
