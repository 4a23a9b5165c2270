// Decodes image files in another process: glint's side. See decoder.h and codec.h.
#include "image/decoder.h"

#include "base/whole_io.h"
#include "image/codec.h"
#include "image/image_io.h"

#include <errno.h>
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

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

// ---- Answers ------------------------------------------------------------------------------------

// Advice for a file that exceeds its limits.
#define WAY_OUT "give --allow-large-images"

static glint_status fail_of_death(const glint_codec_request *request, int how, glint_error *error)
{
    const int number = WIFSIGNALED(how) ? WTERMSIG(how) : 0;
    if (number == SIGXCPU || number == SIGALRM) {
        return glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: takes more than %" PRIu32 " s to decode (it is damaged; or " WAY_OUT ")",
            request->path,
            number == SIGXCPU ? request->limits.cpu_seconds : request->limits.seconds);
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: the decoder failed on it: it is damaged or unusual (make the file "
                      "anew, or convert it to EXR)",
                      request->path);
}

static bool is_credible(const glint_codec_request *request, const glint_codec_answer *answer)
{
    const glint_stored_facts *facts = &answer->facts;
    const bool is_channels = request->work == GLINT_DECODE_CHANNELS; // they are floats
    const int32_t channels_max = is_channels ? GLINT_PICTURE_CHANNELS_MAX : 4;
    if ((is_channels && (facts->code_bits != 0 || facts->is_half != 0)) || facts->width < 1 ||
        facts->height < 1 || facts->channels < 1 || facts->channels > channels_max ||
        (facts->code_bits != 0 && facts->code_bits != 8 && facts->code_bits != 16) ||
        facts->envmap < GLINT_ENVMAP_NONE || facts->envmap > GLINT_ENVMAP_CUBE) {
        return false;
    }
    const uint64_t pixels = (uint64_t)facts->width * (uint64_t)facts->height;
    const uint64_t bytes = glint_stored_value_bytes(facts);
    const uint64_t most = SIZE_MAX / 4 / bytes / (uint64_t)facts->channels;
    return pixels <= most && answer->value_bytes == pixels * (uint64_t)facts->channels * bytes &&
           answer->name_bytes <= GLINT_DECODE_NAMES_MAX;
}

static glint_status take(const glint_codec_request *request, const glint_codec_answer *answer,
                         glint_stored *stored, glint_error *error)
{
    if (answer->kind == GLINT_CODEC_DONE && answer->status == GLINT_OUT_OF_MEMORY) {
        if (request->limits.memory_bytes == 0) {
            return glint_fail_memory(error, "an image");
        }
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: takes more than %" PRIu64
                          " MiB to decode (it is damaged; or " WAY_OUT ")",
                          request->path, request->limits.memory_bytes / MIB);
    }
    if (answer->kind == GLINT_CODEC_DONE && answer->status != GLINT_OK) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s", answer->message);
    }
    if (answer->kind != GLINT_CODEC_DONE) {
        return fail_of_death(request, answer->status, error);
    }
    if (!is_credible(request, answer)) {
        return fail_of_death(request, 0, error);
    }
    stored->facts = answer->facts;
    stored->value_bytes = answer->value_bytes;
    stored->name_bytes = answer->name_bytes;
    return GLINT_OK;
}

// Asks the codec. `image` is a file with the image's bytes; −1: the codec opens the path.
static glint_status ask(const glint_codec_request *request, int image, glint_stored *stored,
                        glint_error *error)
{
    glint_codec_answer *answer = calloc(1, sizeof *answer);
    if (answer == NULL) {
        return glint_fail_memory(error, "an image");
    }
    glint_status status = glint_codec_ask(request, stored->file, image, answer, error);
    if (status == GLINT_OK) {
        status = take(request, answer, stored, error);
    }
    free(answer);
    return status;
}

// ---- For callers --------------------------------------------------------------------------------

// Makes a file with the bytes of an image in memory; −1 if that fails.
static int open_bytes(const glint_image_source *source)
{
    const int file = memfd_create("glint image", MFD_CLOEXEC);
    if (file >= 0 && !glint_write_all(file, source->bytes, (size_t)source->size)) {
        close(file);
        return -1;
    }
    return file;
}

static glint_status run(glint_codec_request *request, const glint_image_source *source,
                        glint_stored *stored, glint_error *error)
{
    if (strlen(source->path) >= sizeof request->path) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: the name is too long", source->path);
    }
    snprintf(request->path, sizeof request->path, "%s", source->path);
    snprintf(request->plugin, sizeof request->plugin, "%s", source->plugin);
    request->file_bytes = source->size;
    request->threads = glint_codec_threads();
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
    glint_codec_request *request = calloc(1, sizeof *request);
    if (request == NULL) {
        return glint_fail_memory(error, "an image");
    }
    request->work = all_channels ? GLINT_DECODE_CHANNELS : GLINT_DECODE_PICTURE;
    request->limits = *limits;
    const glint_status status = run(request, source, stored, error);
    free(request);
    if (status != GLINT_OK) {
        glint_stored_free(stored);
    }
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
    if (stored->path != NULL && stored->file >= 0) {
        close(stored->file);
    }
    *stored = (glint_stored){0};
}

glint_status glint_stored_fail_of_cut(const glint_stored *stored, glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT, "%s: its values were cut off (try again)",
                      stored->path);
}

glint_status glint_stored_read(const glint_stored *stored, size_t offset, void *to, size_t bytes,
                               glint_error *error)
{
    if (!glint_read_all_at(stored->file, offset, to, bytes)) {
        return glint_stored_fail_of_cut(stored, error);
    }
    return GLINT_OK;
}

void glint_decoder_allow_large(void)
{
    large_is_allowed = true;
}

bool glint_decoder_allows_large(void)
{
    return large_is_allowed;
}
