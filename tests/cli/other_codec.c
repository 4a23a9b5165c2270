// Stands in for glint-codec: a codec of another version.
#include "image/codec_messages.h"

#include <stdio.h>
#include <sys/socket.h>
#include <unistd.h>

int main(void)
{
    static const glint_codec_answer ready = {.kind = GLINT_CODEC_IS_READY, .message = "0.0.0"};
    if (send(GLINT_CODEC_SOCKET, &ready, sizeof ready, MSG_NOSIGNAL) != (ssize_t)sizeof ready) {
        return 1;
    }
    char byte;
    (void)!read(GLINT_CODEC_SOCKET, &byte, 1); // until glint closes the socket
    return 0;
}
