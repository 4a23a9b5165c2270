// The encoder: a child of the codec that encodes images, each in a thread of its own.
//
// It is apart from the processes that decode, so it meets no foreign file. It is sandboxed as they
// are. It stays, because a fork of this process takes longer than a small image.
#ifndef GLINT_CODEC_ENCODER_H
#define GLINT_CODEC_ENCODER_H

#include "image/codec_messages.h"

#include <stdbool.h>
#include <sys/types.h>

// Hands a request to the encoder, and starts it if it does not run. The caller keeps the files.
// False if it cannot be started; errno says why.
bool glint_encoder_submit(const glint_codec_request *request, const glint_codec_files *files);

// Call it when a child has ended. Returns whether that was the encoder. The requests that the
// encoder had are lost: glint finds the sockets for their answers closed.
bool glint_encoder_has_ended(pid_t process);

#endif
