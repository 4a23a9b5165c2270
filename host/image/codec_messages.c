// Sends and receives requests. See codec_messages.h.
#include "image/codec_messages.h"

#include "base/packet.h"

bool glint_codec_send(int socket, const glint_codec_request *request,
                      const glint_codec_files *files)
{
    const int given[] = {files->answers, files->results, files->image};
    return glint_packet_send(socket, request, sizeof *request, given, files->image < 0 ? 2 : 3);
}

bool glint_codec_receive(int socket, glint_codec_request *request, glint_codec_files *files)
{
    int given[GLINT_PACKET_FILES_MAX];
    const ssize_t length = glint_packet_receive(socket, request, sizeof *request, given);
    *files = (glint_codec_files){given[0], given[1], given[2]};
    return length == (ssize_t)sizeof *request && given[0] >= 0 && given[1] >= 0;
}
