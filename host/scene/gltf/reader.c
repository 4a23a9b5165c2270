// Reads glTF files in another process: glint's side. See reader.h and reader_messages.h.
#include "scene/gltf/reader.h"

#include "base/clock.h"
#include "base/free_memory.h"
#include "base/regular_file.h"
#include "scene/document.h"
#include "scene/gltf/find_file.h"
#include "scene/gltf/reader_messages.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define PROGRAM "glint-decoder"
#define GIB (UINT64_C(1) << 30)
#define MEMORY_EACH 1024 // the most bytes of a document for each byte of a file: empty materials

// A decoder at work.
typedef struct decoding_state {
    char *folder; // of the scene; owned
    pid_t process;
    int socket;      // −1: there is no decoder
    int memory;      // the memory file
    double deadline; // seconds of the clock, at the latest `last`
    double last;
    uint64_t bytes; // of all files that it got
    glint_reader_packet packet;
} decoding_state;

static double now(void)
{
    return glint_now_ms() / 1e3;
}

// ---- Files --------------------------------------------------------------------------------------

// Other work may keep the cores busy, so the clock allows much more than the CPU time.
static double seconds_for(uint64_t bytes)
{
    const double mib = (double)bytes / 0x1p20;
    return 20 * mib / 4;
}

// Opens the file that a URI names. The decoder may ask for anything.
static glint_status open_uri(const decoding_state *decoding, const char *uri, int *file,
                             uint64_t *bytes, glint_error *error)
{
    char *path;
    *file = -1;
    TRY(glint_find_file(decoding->folder, uri, &path, error));
    const glint_status status = glint_regular_file_descriptor(path, file, bytes, error);
    free(path);
    return status;
}

// ---- Packets ------------------------------------------------------------------------------------

static bool send_packet(const decoding_state *decoding, const int *files, size_t count)
{
    return glint_packet_send(decoding->socket, &decoding->packet, sizeof decoding->packet, files,
                             count);
}

static void begin_packet(decoding_state *decoding, glint_reader_kind kind)
{
    memset(&decoding->packet, 0, sizeof decoding->packet);
    (void)snprintf(decoding->packet.version, sizeof decoding->packet.version, "%s", GLINT_VERSION);
    decoding->packet.kind = kind;
}

// Receives a packet. False if the decoder is gone, or its time is over.
static bool receive_packet(decoding_state *decoding)
{
    int files[GLINT_PACKET_FILES_MAX];
    struct pollfd waited = {.fd = decoding->socket, .events = POLLIN};
    int ready;
    do {
        const double left = decoding->deadline - now();
        ready = poll(&waited, 1, left > 0 ? (int)fmin(left * 1e3, 1e9) : 0);
    } while (ready < 0 && errno == EINTR);
    const ssize_t length = ready > 0 ? glint_packet_receive(decoding->socket, &decoding->packet,
                                                            sizeof decoding->packet, files)
                                     : 0;
    for (size_t i = 0; ready > 0 && i < GLINT_PACKET_FILES_MAX; i++) {
        if (files[i] >= 0) {
            (void)close(files[i]);
        }
    }
    decoding->packet.version[sizeof decoding->packet.version - 1] = '\0';
    decoding->packet.text[sizeof decoding->packet.text - 1] = '\0';
    return length == (ssize_t)sizeof decoding->packet;
}

// Answers a request for a file.
static bool give(decoding_state *decoding)
{
    glint_error fault = {0};
    char uri[sizeof decoding->packet.text];
    int file;
    uint64_t bytes = 0;
    memcpy(uri, decoding->packet.text, sizeof uri);
    begin_packet(decoding, GLINT_READER_GIVE);
    decoding->packet.status = open_uri(decoding, uri, &file, &bytes, &fault);
    (void)snprintf(decoding->packet.text, sizeof decoding->packet.text, "%s", fault.message);
    decoding->bytes += bytes;
    decoding->deadline = fmin(decoding->deadline + seconds_for(bytes), decoding->last);
    const bool is_sent = send_packet(decoding, &file, file >= 0 ? 1 : 0);
    if (file >= 0) {
        (void)close(file);
    }
    return is_sent;
}

// ---- Ends ---------------------------------------------------------------------------------------

// Says how a decoder ended that did not answer. Its memory file may hold anything.
static glint_status fail_of_death(const decoding_state *decoding, int how, glint_error *error)
{
    glint_document_header header = {0};
    if (pread(decoding->memory, &header, sizeof header, 0) != (ssize_t)sizeof header) {
        header = (glint_document_header){0};
    }
    const glint_document_doing *doing = &header.doing;
    const int length = (int)strnlen(doing->name, sizeof doing->name);
    const char *colon = length > 0 ? ": " : "";
    const int number = WIFSIGNALED(how) ? WTERMSIG(how) : 0;
    if (number == SIGXCPU || now() >= decoding->deadline) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%.*s%stakes more than %u s to %s (it is damaged; or %s)", length,
                          doing->name, colon, doing->seconds, length > 0 ? "decode" : "read",
                          length > 0 ? "export it without Draco" : "split the scene");
    }
    if (WIFEXITED(how)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          PROGRAM ": it does not run (status %d) (install glint anew)",
                          WEXITSTATUS(how));
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%.*s%sthe decoder failed on it: it is damaged or unusual (make the file "
                      "anew%s)",
                      length, doing->name, colon,
                      length > 0 ? ", or export it without Draco" : "; if it is good, report it");
}

static glint_status check_version(const decoding_state *decoding, glint_error *error)
{
    const char *version = decoding->packet.version;
    return strcmp(version, GLINT_VERSION) == 0
               ? GLINT_OK
               : glint_fail(error, GLINT_BAD_INPUT,
                            PROGRAM ": it is of glint %.15s, not of " GLINT_VERSION
                                    " (install glint anew)",
                            version);
}

// Serves the decoder until it is done or dead.
static glint_status serve(decoding_state *decoding, glint_error *error)
{
    while (receive_packet(decoding)) {
        TRY(check_version(decoding, error));
        const glint_reader_packet *packet = &decoding->packet;
        if (packet->kind == GLINT_READER_DONE && packet->status == GLINT_OK) {
            return GLINT_OK;
        }
        if (packet->kind == GLINT_READER_DONE) {
            return glint_fail(error,
                              packet->status == GLINT_OUT_OF_MEMORY ? GLINT_OUT_OF_MEMORY
                                                                    : GLINT_BAD_INPUT,
                              "%s", packet->text);
        }
        if (packet->kind != GLINT_READER_ASK || !give(decoding)) {
            break;
        }
    }
    // Only a dead decoder closes the socket. One that goes on is stopped.
    const int how = glint_spawn_stop(decoding->process);
    decoding->process = 0;
    return fail_of_death(decoding, how, error);
}

// ---- Starting -----------------------------------------------------------------------------------

static glint_status spawn(decoding_state *decoding, glint_error *error)
{
    char path[PATH_MAX];
    int ends[2];
    if (!glint_spawn_find(PROGRAM, path)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          PROGRAM ": the program that reads scenes is not there (install glint "
                                  "anew)");
    }
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT, PROGRAM ": no socket to it: %s (try again)",
                          strerror(errno));
    }
    char name[] = PROGRAM;
    char *const arguments[] = {name, NULL};
    const int fault = glint_spawn(path, arguments, ends[1], &decoding->process);
    (void)close(ends[1]);
    if (fault != 0) {
        (void)close(ends[0]);
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be started: %s (install glint anew)",
                          path, strerror(fault));
    }
    decoding->socket = ends[0];
    // A decoder that does not read must not hold up glint.
    const struct timeval patience = {.tv_sec = 60};
    (void)setsockopt(ends[0], SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    return GLINT_OK;
}

static glint_status start(decoding_state *decoding, const char *path, int scene, glint_error *error)
{
    decoding->memory = memfd_create("glint document", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    if (decoding->memory < 0) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY, "no memory file to read into: %s (try again)",
                          strerror(errno));
    }
    TRY(glint_find_folder(path, &decoding->folder, error));
    TRY(spawn(decoding, error));
    begin_packet(decoding, GLINT_READER_START);
    decoding->packet.free_bytes = glint_free_memory();
    (void)snprintf(decoding->packet.text, sizeof decoding->packet.text, "%s", path);
    const int files[] = {scene, decoding->memory};
    (void)send_packet(decoding, files, 2); // if it is gone, receiving says so
    return GLINT_OK;
}

// Ends the decoder. Then nobody else can change the memory file: makes sure of it.
static glint_status finish(decoding_state *decoding, glint_status status, glint_error *error)
{
    if (decoding->socket >= 0) {
        (void)close(decoding->socket);
    }
    if (decoding->process > 0) {
        (void)glint_spawn_stop(decoding->process);
    }
    struct stat facts;
    if (status == GLINT_OK && (fstat(decoding->memory, &facts) != 0 ||
                               (uint64_t)facts.st_size > GIB + MEMORY_EACH * decoding->bytes)) {
        status = glint_fail(error, GLINT_BAD_INPUT,
                            PROGRAM " gave a document of %lld bytes (please report the file)",
                            (long long)facts.st_size);
    }
    if (status == GLINT_OK &&
        fcntl(decoding->memory, F_ADD_SEALS,
              F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE) != 0) {
        status = glint_fail(error, GLINT_BAD_INPUT, "its contents cannot be sealed: %s (try again)",
                            strerror(errno));
    }
    return status;
}

glint_status glint_reader_run(const char *path, int *file, glint_error *error)
{
    static const double seconds_least = 20 * 60, seconds_most = 24 * 3600;
    glint_error cause = {0};
    int scene;
    uint64_t bytes;
    *file = -1;
    if (glint_regular_file_descriptor(path, &scene, &bytes, &cause) != GLINT_OK) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "cannot be opened: %s (give a .gltf or .glb file)", cause.message);
    }
    decoding_state *decoding = calloc(1, sizeof *decoding);
    if (decoding == NULL) {
        (void)close(scene);
        return glint_fail_memory(error, "the scene");
    }
    decoding->socket = decoding->memory = -1;
    decoding->bytes = bytes;
    decoding->deadline = now() + seconds_least + seconds_for(bytes);
    decoding->last = decoding->deadline + seconds_most;
    glint_status status = start(decoding, path, scene, error);
    if (status == GLINT_OK) {
        status = serve(decoding, error);
    }
    (void)close(scene);
    status = finish(decoding, status, error);
    if (status == GLINT_OK) {
        *file = decoding->memory;
    } else if (decoding->memory >= 0) {
        (void)close(decoding->memory);
    }
    free(decoding->folder);
    free(decoding);
    return status;
}
