// Sends and receives packets with descriptors. See packet.h.
#include "base/packet.h"

#include <errno.h>
#include <string.h>
#include <sys/socket.h>

// Room for descriptors beside a packet.
typedef union rights_room {
    struct cmsghdr header;
    char bytes[CMSG_SPACE(GLINT_PACKET_FILES_MAX * sizeof(int))];
} rights_room;

bool glint_packet_send(int socket, const void *packet, size_t bytes, const int *files, size_t count)
{
    const size_t length = count * sizeof(int);
    rights_room control = {0};
    struct iovec one = {(void *)packet, bytes};
    struct msghdr message = {.msg_iov = &one, .msg_iovlen = 1};
    if (count > 0) {
        message.msg_control = &control;
        message.msg_controllen = CMSG_SPACE(length);
        struct cmsghdr *rights = CMSG_FIRSTHDR(&message);
        rights->cmsg_level = SOL_SOCKET;
        rights->cmsg_type = SCM_RIGHTS;
        rights->cmsg_len = CMSG_LEN(length);
        memcpy(CMSG_DATA(rights), files, length);
    }
    ssize_t sent;
    do {
        sent = sendmsg(socket, &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent == (ssize_t)bytes;
}

ssize_t glint_packet_receive(int socket, void *packet, size_t bytes, int *files)
{
    rights_room control;
    struct iovec one = {packet, bytes};
    struct msghdr message = {.msg_iov = &one,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             // No room for more than can be handed on.
                             .msg_controllen = CMSG_LEN(GLINT_PACKET_FILES_MAX * sizeof(int))};
    ssize_t length;
    do {
        length = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
    } while (length < 0 && errno == EINTR);
    for (size_t i = 0; i < GLINT_PACKET_FILES_MAX; i++) {
        files[i] = -1;
    }
    const struct cmsghdr *rights = length >= 0 ? CMSG_FIRSTHDR(&message) : NULL;
    if (rights != NULL && rights->cmsg_level == SOL_SOCKET && rights->cmsg_type == SCM_RIGHTS) {
        const size_t given = rights->cmsg_len - CMSG_LEN(0);
        const size_t most = GLINT_PACKET_FILES_MAX * sizeof(int);
        memcpy(files, CMSG_DATA(rights), given < most ? given : most);
    }
    return length;
}
