// Sends and receives requests. See codec_messages.h.
#include "image/codec_messages.h"

#include <errno.h>
#include <string.h>
#include <sys/socket.h>

#define FILES_LEAST (2 * sizeof(int))
#define FILES_MOST (3 * sizeof(int))

// Room for descriptors beside a packet.
typedef union rights_room {
    struct cmsghdr header;
    char bytes[CMSG_SPACE(FILES_MOST)];
} rights_room;

bool glint_codec_send(int socket, const glint_codec_request *request,
                      const glint_codec_files *files)
{
    const int given[] = {files->answers, files->results, files->image};
    const size_t length = files->image < 0 ? FILES_LEAST : FILES_MOST;
    rights_room control = {0};
    struct iovec packet = {(void *)request, sizeof *request};
    struct msghdr message = {.msg_iov = &packet,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             .msg_controllen = CMSG_SPACE(length)};
    struct cmsghdr *rights = CMSG_FIRSTHDR(&message);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(length);
    memcpy(CMSG_DATA(rights), given, length);
    ssize_t sent;
    do {
        sent = sendmsg(socket, &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent == (ssize_t)sizeof *request;
}

static bool find_files(struct msghdr *message, glint_codec_files *files)
{
    const struct cmsghdr *rights = CMSG_FIRSTHDR(message);
    if (rights == NULL || rights->cmsg_level != SOL_SOCKET || rights->cmsg_type != SCM_RIGHTS ||
        (rights->cmsg_len != CMSG_LEN(FILES_LEAST) && rights->cmsg_len != CMSG_LEN(FILES_MOST))) {
        return false;
    }
    int given[] = {-1, -1, -1};
    memcpy(given, CMSG_DATA(rights), rights->cmsg_len - CMSG_LEN(0));
    *files = (glint_codec_files){given[0], given[1], given[2]};
    return true;
}

bool glint_codec_receive(int socket, glint_codec_request *request, glint_codec_files *files)
{
    rights_room control;
    struct iovec packet = {request, sizeof *request};
    struct msghdr message = {.msg_iov = &packet,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             .msg_controllen = sizeof control};
    ssize_t length;
    do {
        length = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
    } while (length < 0 && errno == EINTR);
    return length == (ssize_t)sizeof *request && find_files(&message, files);
}
