// Stands in for glint-codec. The variable OTHER_CODEC says what is wrong with it:
//   version  it is of another version (the default)
//   packet   its packets have another size
//   halfs    it says that the channels of an EXR are halfs; glint asked for floats
#include "image/codec_messages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

static bool say(int socket, const glint_codec_answer *answer, size_t bytes)
{
    return send(socket, answer, bytes, MSG_NOSIGNAL) == (ssize_t)bytes;
}

static bool answer_halfs(void)
{
    enum { EDGE = 8, CHANNELS = 4 };
    glint_codec_request request;
    glint_codec_files files;
    const glint_codec_answer done = {
        .kind = GLINT_CODEC_DONE,
        .facts = {.width = EDGE, .height = EDGE, .channels = CHANNELS, .is_half = 1},
        .value_bytes = EDGE * EDGE * CHANNELS * sizeof(uint16_t)};
    return glint_codec_receive(GLINT_CODEC_SOCKET, &request, &files) &&
           request.work == GLINT_DECODE_CHANNELS &&
           ftruncate(files.results, (off_t)done.value_bytes) == 0 &&
           say(files.answers, &done, sizeof done);
}

int main(void)
{
    const char *fault = getenv("OTHER_CODEC");
    fault = fault != NULL ? fault : "version";
    glint_codec_answer ready = {.kind = GLINT_CODEC_IS_READY};
    snprintf(ready.message, sizeof ready.message, "%s",
             strcmp(fault, "version") == 0 ? "0.0.0" : GLINT_VERSION);
    const size_t bytes = strcmp(fault, "packet") == 0 ? sizeof ready - 8 : sizeof ready;
    if (!say(GLINT_CODEC_SOCKET, &ready, bytes) ||
        (strcmp(fault, "halfs") == 0 && !answer_halfs())) {
        return 1;
    }
    char byte;
    (void)!read(GLINT_CODEC_SOCKET, &byte, 1); // until glint closes the socket
    return 0;
}
