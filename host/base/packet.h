// Sends packets with descriptors beside them over a socket (AF_UNIX, SOCK_SEQPACKET).
#ifndef GLINT_BASE_PACKET_H
#define GLINT_BASE_PACKET_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { GLINT_PACKET_FILES_MAX = 3 };

// Sends a packet with `count` descriptors, which stay the caller's. False if the other end is gone.
bool glint_packet_send(int socket, const void *packet, size_t bytes, const int *files,
                       size_t count);

// Receives a packet of at most `bytes`. files[GLINT_PACKET_FILES_MAX] gets its descriptors, which
// the caller owns, and −1 where there is none. Returns the packet's bytes; 0 or less if the other
// end is gone.
ssize_t glint_packet_receive(int socket, void *packet, size_t bytes, int *files);

#ifdef __cplusplus
}
#endif

#endif
