// Encodes image files in another process: glint's side. See encoder.h and encoding.h.
#include "image/encoder.h"

#include "base/memory.h"
#include "base/whole_io.h"
#include "image/codec.h"
#include "image/description.h"
#include "image/memory_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// The texts of a job, one after the other.
typedef struct texts {
    char *bytes;
    size_t size;
} texts;

// ---- The job ------------------------------------------------------------------------------------

static void print_text(const char *text, FILE *file)
{
    fputs(text != NULL ? text : "", file);
    fputc('\0', file);
}

static glint_status print_texts(const glint_file_values *values, FILE *file)
{
    const glint_write_options *options = values->options;
    if (values->format->kind == GLINT_WRITTEN_EXR) {
        for (size_t i = 0; i < options->channel_count; i++) {
            print_text(options->channels[i].name, file);
        }
        for (size_t i = 0; i < options->metadata_count; i++) {
            print_text(options->metadata[i].name, file);
            print_text(options->metadata[i].string, file);
        }
    }
    char *description = glint_description_make(options);
    print_text(description, file);
    free(description);
    return description != NULL ? GLINT_OK : GLINT_OUT_OF_MEMORY;
}

static glint_status make_texts(const glint_file_values *values, texts *made, glint_error *error)
{
    FILE *file = open_memstream(&made->bytes, &made->size);
    const bool is_made = file != NULL && print_texts(values, file) == GLINT_OK;
    if ((file != NULL && fclose(file) != 0) || !is_made) {
        free(made->bytes);
        *made = (texts){0};
        return glint_fail_memory(error, "an image's metadata");
    }
    return GLINT_OK;
}

static glint_encode_job make_job(const glint_file_values *values, size_t text_bytes)
{
    const glint_image *image = values->image;
    const glint_write_options *options = values->options;
    const bool is_exr = values->format->kind == GLINT_WRITTEN_EXR;
    glint_encode_job job = {
        .format = values->format->kind,
        .width = image->width,
        .height = image->height,
        .color = values->color,
        .channels = values->channels,
        .value_type = values->type,
        .envmap = options->envmap,
        .channel_count = is_exr ? (uint32_t)options->channel_count : 0,
        .attribute_count = is_exr ? (uint32_t)options->metadata_count : 0,
        .pixel_offset = (sizeof job + GLINT_ALIGNMENT - 1) / GLINT_ALIGNMENT * GLINT_ALIGNMENT,
    };
    if (options->compression != NULL) {
        snprintf(job.compression, sizeof job.compression, "%s", options->compression);
    }
    const uint64_t pixels = (uint64_t)image->width * (uint64_t)image->height;
    const uint64_t pixel_end = job.pixel_offset + pixels * values->pixel_bytes;
    job.attribute_offset = (pixel_end + GLINT_ALIGNMENT - 1) / GLINT_ALIGNMENT * GLINT_ALIGNMENT;
    job.text_offset = job.attribute_offset + job.attribute_count * sizeof(glint_encode_attribute);
    job.file_offset = job.text_offset + text_bytes;
    return job;
}

// ---- The memory file ----------------------------------------------------------------------------

static void fill_attributes(const glint_write_options *options, size_t count, unsigned char *to)
{
    for (size_t i = 0; i < count; i++) {
        const glint_metadata *entry = &options->metadata[i];
        glint_encode_attribute attribute = {
            .type = entry->type, .integer = entry->integer, .real = entry->real};
        memcpy(attribute.matrix, entry->matrix, sizeof attribute.matrix);
        memcpy(to + i * sizeof attribute, &attribute, sizeof attribute);
    }
}

// Writes the job into its memory file.
static void fill(const glint_memory_file *file, const glint_encode_job *job,
                 const glint_file_values *values, const texts *made)
{
    memcpy(file->at, job, sizeof *job);
    glint_file_values_fill(values, (size_t)glint_codec_threads(), file->at + job->pixel_offset);
    fill_attributes(values->options, job->attribute_count, file->at + job->attribute_offset);
    memcpy(file->at + job->text_offset, made->bytes, made->size);
}

// ---- The answer ---------------------------------------------------------------------------------

static glint_status fail_of_death(const char *path, glint_error *error)
{
    return glint_fail(error, GLINT_OUTPUT_FAILED,
                      "%s: could not be encoded: " GLINT_CODEC_PROGRAM
                      " died (free some memory, or run this again)",
                      path);
}

// The part of a memory file that is for the encoded file.
typedef struct room {
    int file;
    uint64_t offset;
} room;

// True if the room has as many bytes.
static bool holds(const room *from, uint64_t bytes)
{
    struct stat facts;
    return fstat(from->file, &facts) == 0 && (uint64_t)facts.st_size >= from->offset &&
           bytes <= (uint64_t)facts.st_size - from->offset;
}

static glint_status take(const char *path, const glint_codec_answer *answer, const room *from,
                         glint_encoded *encoded, glint_error *error)
{
    if (answer->kind == GLINT_CODEC_DONE && answer->status != GLINT_OK) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s", answer->message);
    }
    if (answer->kind != GLINT_CODEC_DONE || answer->value_bytes == 0 ||
        !holds(from, answer->value_bytes)) {
        return fail_of_death(path, error);
    }
    encoded->bytes = malloc(answer->value_bytes);
    if (encoded->bytes == NULL) {
        return glint_fail_memory(error, "an encoded image");
    }
    encoded->size = answer->value_bytes;
    if (!glint_read_all_at(from->file, from->offset, encoded->bytes, encoded->size)) {
        free(encoded->bytes);
        *encoded = (glint_encoded){0};
        return fail_of_death(path, error);
    }
    return GLINT_OK;
}

// Encodes the job, which lies before the room in the same file.
static glint_status encode_in(const room *results, const char *path,
                              const glint_written_format *format, glint_encoded *encoded,
                              glint_error *error)
{
    glint_codec_request *request = calloc(1, sizeof *request);
    glint_codec_answer *answer = calloc(1, sizeof *answer);
    glint_status status = GLINT_OK;
    if (request == NULL || answer == NULL) {
        status = glint_fail_memory(error, "an image to encode");
    } else {
        request->work = GLINT_ENCODE;
        request->threads = glint_codec_threads();
        snprintf(request->path, sizeof request->path, "%s", path);
        snprintf(request->plugin, sizeof request->plugin, "%s", format->plugin);
        status = glint_codec_ask(request, results->file, -1, answer, error);
    }
    if (status == GLINT_OK) {
        status = take(path, answer, results, encoded, error);
    }
    free(request);
    free(answer);
    return status;
}

glint_status glint_encoder_run(const char *path, const glint_file_values *values,
                               glint_encoded *encoded, glint_error *error)
{
    texts made = {0};
    glint_memory_file file;
    TRY(make_texts(values, &made, error));
    const glint_encode_job job = make_job(values, made.size);
    if (!glint_memory_file_take(job.file_offset, &file)) {
        free(made.bytes);
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "%s: no memory to encode it: %s (free some, or run this again)", path,
                          strerror(errno));
    }
    fill(&file, &job, values, &made);
    free(made.bytes);
    const glint_status status =
        encode_in(&(room){file.file, job.file_offset}, path, values->format, encoded, error);
    if (status == GLINT_OK) {
        glint_memory_file_give_back(&file);
    } else {
        glint_memory_file_free(&file);
    }
    return status;
}
