// Stands in for glint-decoder. The variable OTHER_DECODER says what is wrong with it:
//   version  it is of another version (the default)
//   packet   its packet has another size
//   dies     it is ended by a signal, while it works on a part
//   hangs    it closes its socket and goes on
//   empty    it says that it is done, and wrote nothing
//   asks     it asks for files that it must not get, and says what it got
#include "scene/document.h"
#include "scene/gltf/reader_messages.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static glint_reader_packet packet;

static void say(glint_reader_kind kind, glint_status status, const char *version)
{
    packet.kind = kind;
    packet.status = status;
    snprintf(packet.version, sizeof packet.version, "%s", version);
    (void)glint_packet_send(GLINT_READER_SOCKET, &packet, sizeof packet, NULL, 0);
}

// Asks for files, and tells the reason of the last refusal; or that it got one.
static void ask(void)
{
    static const char *const uris[] = {"../in/secret", "/etc/passwd", "pipe", "folder",
                                       "%2e%2e/in/secret"};
    int files[GLINT_PACKET_FILES_MAX];
    char told[1000] = "";
    for (size_t i = 0; i < sizeof uris / sizeof uris[0]; i++) {
        memset(&packet, 0, sizeof packet);
        snprintf(packet.text, sizeof packet.text, "%s", uris[i]);
        say(GLINT_READER_ASK, GLINT_OK, GLINT_VERSION);
        if (glint_packet_receive(GLINT_READER_SOCKET, &packet, sizeof packet, files) <= 0) {
            _exit(0);
        }
        const size_t length = strlen(told);
        snprintf(told + length, sizeof told - length, "%d %.150s; ", files[0] >= 0, packet.text);
    }
    memcpy(packet.text, told, sizeof told);
    say(GLINT_READER_DONE, GLINT_BAD_INPUT, GLINT_VERSION);
}

int main(void)
{
    const char *fault = getenv("OTHER_DECODER");
    int files[GLINT_PACKET_FILES_MAX];
    (void)glint_packet_receive(GLINT_READER_SOCKET, &packet, sizeof packet, files);
    fault = fault != NULL ? fault : "version";
    memset(&packet, 0, sizeof packet);
    if (strcmp(fault, "dies") == 0) {
        static glint_document_header header;
        memset(header.doing.name, 'x', sizeof header.doing.name);
        (void)!write(files[1], &header, sizeof header);
        raise(SIGSEGV);
    } else if (strcmp(fault, "packet") == 0) {
        (void)glint_packet_send(GLINT_READER_SOCKET, &packet, 100, NULL, 0);
    } else if (strcmp(fault, "hangs") == 0) {
        close(GLINT_READER_SOCKET);
    } else if (strcmp(fault, "asks") == 0) {
        ask();
    } else {
        say(GLINT_READER_DONE, GLINT_OK, strcmp(fault, "empty") == 0 ? GLINT_VERSION : "0.0.0");
    }
    pause(); // until glint ends it
    return 0;
}
