// Sends an answer to glint.
#ifndef GLINT_CODEC_ANSWER_H
#define GLINT_CODEC_ANSWER_H

#include "image/codec_messages.h"

#include <errno.h>
#include <sys/socket.h>

static inline void glint_codec_answer_send(int socket, const glint_codec_answer *answer)
{
    while (send(socket, answer, sizeof *answer, MSG_NOSIGNAL) < 0 && errno == EINTR) {
    }
}

#endif
