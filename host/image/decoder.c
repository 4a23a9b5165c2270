// Decodes image files in another process: glint's side. See decoder.h and decoding.h.
#include "image/decoder.h"

#include "image/image_io.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define PROGRAM "glint-decoder"
#define MIB (UINT64_C(1) << 20)

// ---- Limits -------------------------------------------------------------------------------------

// A small file may hold a picture of 512 MiB, which is 8192 × 4096 pixels of four floats. From
// 8 MiB on, a file may hold 64 bytes of picture for each of its own. Only nearly empty pictures are
// compressed more than that.
#define PICTURE_BYTES_LEAST (512 * MIB)
#define PICTURE_BYTES_EACH 64
// Decoders hold up to two copies of a picture (a progressive JPEG's coefficients, a TIFF's strip),
// and memory of their own.
#define PICTURE_COPIES 2
#define MEMORY_BYTES (128 * MIB)
// A decoder decodes at least 2 MiB of a file in a second.
#define CPU_SECONDS_LEAST 5
#define FILE_BYTES_A_SECOND (2 * MIB)
// Other work may keep the cores busy.
#define SECONDS_LEAST 60
#define SECONDS_EACH 20 // for each second of CPU time
#define PATIENCE_SECONDS 30

glint_decode_limits glint_decoder_limits(uint64_t file_bytes)
{
    const uint64_t by_size =
        file_bytes > UINT64_MAX / 1024 ? file_bytes : file_bytes * PICTURE_BYTES_EACH;
    const uint64_t picture = by_size > PICTURE_BYTES_LEAST ? by_size : PICTURE_BYTES_LEAST;
    const uint64_t seconds = CPU_SECONDS_LEAST + file_bytes / FILE_BYTES_A_SECOND;
    const uint32_t cpu = seconds > 86400 ? 86400 : (uint32_t)seconds;
    return (glint_decode_limits){
        .picture_bytes = picture,
        .memory_bytes = MEMORY_BYTES + PICTURE_COPIES * picture,
        .cpu_seconds = cpu,
        .seconds = SECONDS_LEAST + SECONDS_EACH * cpu,
    };
}

static atomic_int threads_each; // set by glint_decoder_use_threads

// ---- The decoder's process ----------------------------------------------------------------------

// `lock` guards the other members.
static struct {
    pthread_mutex_t lock;
    pid_t owner;   // the process that started the decoder; a fork of it must start its own
    pid_t process; // the decoder
    int socket;    // to the decoder; valid if owner is this process
    bool is_ready; // the decoder has reported that it is ready
} decoder = {.lock = PTHREAD_MUTEX_INITIALIZER};

// The decoder is installed beside the codec (CMakeLists.txt). In the build it is beside the
// program, or above it.
static bool find_program(char path[PATH_MAX])
{
    static const char *const places[] = {"/../" GLINT_LIBRARY_FOLDER "/", "/", "/../"};
    char own[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    if (length < 0) {
        return false;
    }
    own[length] = '\0';
    *strrchr(own, '/') = '\0';
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const int written = snprintf(path, PATH_MAX, "%s%s" PROGRAM, own, places[i]);
        if (written < PATH_MAX && access(path, X_OK) == 0) {
            return true;
        }
    }
    return false;
}

// Starts `path`. Its only descriptors are `socket` and /dev/null. Signals stay blocked there: glint
// handles the signals of a terminal or a batch system.
static int spawn(const char *path, int socket, pid_t *process)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t all, blocked;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&files, socket, GLINT_DECODER_SOCKET);
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; standard++) {
        posix_spawn_file_actions_addopen(&files, standard, "/dev/null", O_RDWR, 0);
    }
    posix_spawn_file_actions_addclosefrom_np(&files, GLINT_DECODER_SOCKET + 1);
    sigfillset(&all);
    sigemptyset(&blocked);
    const int ours[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    for (size_t i = 0; i < sizeof ours / sizeof ours[0]; i++) {
        sigaddset(&blocked, ours[i]);
    }
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setsigmask(&attributes, &blocked);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    char name[] = PROGRAM;
    char *const arguments[] = {name, NULL};
    const int fault = posix_spawn(process, path, &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return fault;
}

// Starts the decoder unless it runs. The caller holds the lock.
static glint_status start(glint_error *error)
{
    if (decoder.owner == getpid()) {
        return GLINT_OK;
    }
    char path[PATH_MAX];
    if (!find_program(path)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          PROGRAM ": the decoder is not there (install glint anew)");
    }
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT, PROGRAM ": no socket to it: %s (try again)",
                          strerror(errno));
    }
    const int fault = spawn(path, ends[1], &decoder.process);
    close(ends[1]);
    if (fault != 0) {
        close(ends[0]);
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be started: %s (install glint anew)",
                          path, strerror(fault));
    }
    decoder.owner = getpid();
    decoder.socket = ends[0];
    decoder.is_ready = false;
    return GLINT_OK;
}

// Stops the decoder. The caller holds the lock.
static int stop(void)
{
    int how = 0;
    close(decoder.socket);
    kill(decoder.process, SIGKILL);
    while (waitpid(decoder.process, &how, 0) < 0 && errno == EINTR) {
    }
    decoder.owner = 0;
    return how;
}

// Receives one answer. False if the other end is gone, or does not answer in time (−1: wait for
// ever).
static bool receive(int socket, int milliseconds, glint_decode_answer *answer)
{
    struct pollfd waited = {.fd = socket, .events = POLLIN};
    ssize_t length;
    do {
        const int ready = poll(&waited, 1, milliseconds);
        length = ready > 0 ? recv(socket, answer, sizeof *answer, 0) : ready;
    } while (length < 0 && errno == EINTR);
    answer->message[GLINT_MESSAGE_CAPACITY - 1] = '\0';
    return length == (ssize_t)sizeof *answer;
}

// Waits until the decoder has loaded its libraries. The caller holds the lock.
static glint_status await_ready(glint_error *error)
{
    glint_decode_answer *answer = malloc(sizeof *answer);
    if (answer == NULL) {
        return glint_fail_memory(error, "a file's decoder");
    }
    if (!decoder.is_ready) {
        decoder.is_ready = receive(decoder.socket, -1, answer) &&
                           answer->kind == GLINT_DECODER_IS_READY &&
                           strcmp(answer->message, GLINT_VERSION) == 0;
    }
    free(answer);
    if (decoder.is_ready) {
        return GLINT_OK;
    }
    const int how = stop();
    return glint_fail(error, GLINT_BAD_INPUT,
                      PROGRAM ": it does not run (status %d), or is not of glint " GLINT_VERSION
                              " (install glint anew)",
                      WIFEXITED(how) ? WEXITSTATUS(how) : -1);
}

// The descriptors of a request.
typedef struct descriptors {
    int files[GLINT_DECODE_DESCRIPTORS];
    size_t count;
} descriptors;

// Sends the request and its descriptors as one packet.
static bool send_request(int socket, const glint_decode_request *request, const descriptors *given)
{
    const size_t length = given->count * sizeof(int);
    union {
        struct cmsghdr header;
        char bytes[CMSG_SPACE(GLINT_DECODE_DESCRIPTORS * sizeof(int))];
    } control = {0};
    struct iovec packet = {(void *)request, sizeof *request};
    struct msghdr message = {.msg_iov = &packet,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             .msg_controllen = CMSG_SPACE(length)};
    struct cmsghdr *rights = CMSG_FIRSTHDR(&message);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(length);
    memcpy(CMSG_DATA(rights), given->files, length);
    ssize_t sent;
    do {
        sent = sendmsg(socket, &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent == (ssize_t)sizeof *request;
}

// Submits a request. If the decoder is gone, starts it once more. The caller holds the lock.
static glint_status submit(const glint_decode_request *request, const descriptors *given,
                           glint_error *error)
{
    for (int attempt = 0; attempt < 2; attempt++) {
        TRY(start(error));
        TRY(await_ready(error));
        if (send_request(decoder.socket, request, given)) {
            return GLINT_OK;
        }
        (void)stop();
    }
    return glint_fail(error, GLINT_BAD_INPUT, "%s: " PROGRAM " does not listen (try again)",
                      request->path);
}

// ---- Answers ------------------------------------------------------------------------------------

// Advice for a file that exceeds its limits.
static const char *way_out(const glint_decode_request *request)
{
    return request->is_mesh ? "export it without Draco" : "give --allow-large-images";
}

static glint_status fail_of_death(const glint_decode_request *request, int how, glint_error *error)
{
    const int number = WIFSIGNALED(how) ? WTERMSIG(how) : 0;
    if (number == SIGXCPU || number == SIGALRM) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: takes more than %" PRIu32 " s to decode (it is damaged; or %s)",
                          request->path,
                          number == SIGXCPU ? request->limits.cpu_seconds : request->limits.seconds,
                          way_out(request));
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: the decoder failed on it: it is damaged or unusual (make the file "
                      "anew, or %s)",
                      request->path, request->is_mesh ? way_out(request) : "convert it to EXR");
}

static bool is_credible(const glint_decode_request *request, const glint_decode_answer *answer)
{
    const glint_stored_facts *facts = &answer->facts;
    const int32_t channels_max = request->all_channels ? GLINT_PICTURE_CHANNELS_MAX : 4;
    if (facts->width < 1 || facts->height < 1 || facts->channels < 1 ||
        facts->channels > channels_max ||
        (facts->code_bits != 0 && facts->code_bits != 8 && facts->code_bits != 16) ||
        facts->envmap < GLINT_ENVMAP_NONE || facts->envmap > GLINT_ENVMAP_CUBE) {
        return false;
    }
    const uint64_t pixels = (uint64_t)facts->width * (uint64_t)facts->height;
    const uint64_t bytes = facts->code_bits != 0 ? (uint64_t)facts->code_bits / 8
                           : facts->is_half != 0 ? sizeof(uint16_t)
                                                 : sizeof(float);
    const uint64_t most = SIZE_MAX / 4 / bytes / (uint64_t)facts->channels;
    return pixels <= most && answer->value_bytes == pixels * (uint64_t)facts->channels * bytes &&
           answer->name_bytes <= GLINT_DECODE_NAMES_MAX;
}

static const char *what_is_decoded(const glint_decode_request *request)
{
    return request->is_mesh ? "a mesh" : "an image";
}

static glint_status take(const glint_decode_request *request, const glint_decode_answer *answer,
                         glint_stored *stored, glint_error *error)
{
    if (answer->kind == GLINT_DECODED && answer->status == GLINT_OUT_OF_MEMORY) {
        if (request->limits.memory_bytes == 0) {
            return glint_fail_memory(error, what_is_decoded(request));
        }
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: takes more than %" PRIu64 " MiB to decode (it is damaged; or %s)",
                          request->path, request->limits.memory_bytes / MIB, way_out(request));
    }
    if (answer->kind == GLINT_DECODED && answer->status != GLINT_OK) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s", answer->message);
    }
    if (answer->kind != GLINT_DECODED) {
        return fail_of_death(request, answer->status, error);
    }
    if (!request->is_mesh && !is_credible(request, answer)) {
        return fail_of_death(request, 0, error);
    }
    stored->facts = answer->facts;
    stored->value_bytes = answer->value_bytes;
    stored->name_bytes = answer->name_bytes;
    return GLINT_OK;
}

// Asks the decoder. `image` is a file with the image's bytes; −1: the decoder opens the path.
static glint_status ask(const glint_decode_request *request, int image, glint_stored *stored,
                        glint_error *error)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: no socket to its decoder: %s (try again)",
                          request->path, strerror(errno));
    }
    pthread_mutex_lock(&decoder.lock);
    const descriptors given = {{ends[1], stored->file, image}, image < 0 ? 2 : 3};
    glint_status status = submit(request, &given, error);
    pthread_mutex_unlock(&decoder.lock);
    close(ends[1]);
    glint_decode_answer *answer = malloc(sizeof *answer);
    if (status == GLINT_OK && answer == NULL) {
        status = glint_fail_memory(error, what_is_decoded(request));
    } else if (status == GLINT_OK) {
        const uint32_t seconds = request->limits.seconds;
        const int patience = seconds > 0 ? (int)(seconds + PATIENCE_SECONDS) * 1000 : -1;
        status = receive(ends[0], patience, answer) ? take(request, answer, stored, error)
                                                    : fail_of_death(request, 0, error);
    }
    free(answer);
    close(ends[0]);
    return status;
}

// ---- For callers --------------------------------------------------------------------------------

static bool write_all(int file, const char *bytes, size_t count)
{
    while (count > 0) {
        const ssize_t written = write(file, bytes, count);
        if (written < 0 && errno != EINTR) {
            return false;
        }
        bytes += written > 0 ? written : 0;
        count -= written > 0 ? (size_t)written : 0;
    }
    return true;
}

// Makes a file with the bytes of an image in memory; −1 if that fails.
static int open_bytes(const glint_image_source *source)
{
    const int file = memfd_create("glint image", MFD_CLOEXEC);
    if (file >= 0 && !write_all(file, source->bytes, (size_t)source->size)) {
        close(file);
        return -1;
    }
    return file;
}

static glint_status run(glint_decode_request *request, const glint_image_source *source,
                        glint_stored *stored, glint_error *error)
{
    if (strlen(source->path) >= sizeof request->path) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: the name is too long", source->path);
    }
    snprintf(request->path, sizeof request->path, "%s", source->path);
    snprintf(request->plugin, sizeof request->plugin, "%s", source->plugin);
    request->file_bytes = source->size;
    request->threads = atomic_load(&threads_each);
    stored->file = memfd_create("glint picture", MFD_CLOEXEC);
    const int image = source->bytes != NULL ? open_bytes(source) : -1;
    glint_status status;
    if (stored->file < 0 || (source->bytes != NULL && image < 0)) {
        status = glint_fail(error, GLINT_BAD_INPUT,
                            "%s: no memory file to decode it with: %s (try again)", source->path,
                            strerror(errno));
    } else {
        status = ask(request, image, stored, error);
    }
    if (image >= 0) {
        close(image);
    }
    return status;
}

glint_status glint_decoder_run_within(const glint_image_source *source, bool all_channels,
                                      const glint_decode_limits *limits, glint_stored *stored,
                                      glint_error *error)
{
    *stored = (glint_stored){.path = source->path, .file = -1};
    glint_decode_request *request = calloc(1, sizeof *request);
    if (request == NULL) {
        return glint_fail_memory(error, "an image");
    }
    request->all_channels = all_channels;
    request->limits = *limits;
    const glint_status status = run(request, source, stored, error);
    free(request);
    if (status != GLINT_OK) {
        glint_stored_free(stored);
    }
    return status;
}

glint_status glint_decoder_run_mesh(const char *name, const glint_decode_limits *limits, int file,
                                    uint64_t *index_bytes, glint_error *error)
{
    glint_stored stored = {.path = name, .file = file};
    glint_decode_request *request = calloc(1, sizeof *request);
    if (request == NULL) {
        return glint_fail_memory(error, "a mesh");
    }
    snprintf(request->path, sizeof request->path, "%s", name);
    request->is_mesh = 1;
    request->limits = *limits;
    request->threads = 1;
    const glint_status status = ask(request, -1, &stored, error);
    *index_bytes = stored.value_bytes;
    free(request);
    return status;
}

static bool large_is_allowed;

glint_status glint_decoder_run(const glint_image_source *source, bool all_channels,
                               glint_stored *stored, glint_error *error)
{
    const glint_decode_limits none = {0}, usual = glint_decoder_limits(source->size);
    return glint_decoder_run_within(source, all_channels, large_is_allowed ? &none : &usual, stored,
                                    error);
}

void glint_stored_free(glint_stored *stored)
{
    if (stored->file >= 0) {
        close(stored->file);
    }
    *stored = (glint_stored){.file = -1};
}

glint_status glint_stored_fail_of_cut(const glint_stored *stored, glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT, "%s: its values were cut off (try again)",
                      stored->path);
}

glint_status glint_stored_read(const glint_stored *stored, size_t offset, void *to, size_t bytes,
                               glint_error *error)
{
    for (char *at = to; bytes > 0;) {
        const ssize_t length = pread(stored->file, at, bytes, (off_t)offset);
        if (length == 0 || (length < 0 && errno != EINTR)) {
            return glint_stored_fail_of_cut(stored, error);
        }
        if (length > 0) {
            at += length;
            offset += (size_t)length;
            bytes -= (size_t)length;
        }
    }
    return GLINT_OK;
}

void glint_decoder_start(void)
{
    pthread_mutex_lock(&decoder.lock);
    (void)start(NULL);
    pthread_mutex_unlock(&decoder.lock);
}

void glint_decoder_use_threads(int count)
{
    atomic_store(&threads_each, count);
}

void glint_decoder_allow_large(void)
{
    large_is_allowed = true;
}

bool glint_decoder_allows_large(void)
{
    return large_is_allowed;
}
