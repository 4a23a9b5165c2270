// Reads images. See images.h.
#include "scene/gltf/images.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "image/image_io.h"
#include "scene/gltf/find_file.h"
#include "scene/texture/texture_read.h"

#include <stdlib.h>
#include <string.h>

uint32_t glint_images_number(glint_images *images, const glint_document *document, uint32_t image,
                             bool is_color, bool is_coverage)
{
    if (images->numbers == NULL) {
        images->numbers = glint_allocate(document->images_count, sizeof *images->numbers);
    }
    if (images->numbers == NULL) {
        return 0;
    }
    uint32_t *number = &images->numbers[image][(is_color ? 2 : 0) + (is_coverage ? 1 : 0)];
    if (*number == 0) {
        if (!glint_make_room((void **)&images->uses, images->count, &images->capacity,
                             sizeof *images->uses)) {
            return 0;
        }
        images->uses[images->count++] = (glint_image_use){image, is_color, is_coverage, NULL};
        *number = (uint32_t)images->count;
    }
    return *number;
}

typedef struct image_work {
    const glint_document *document;
    const char *folder;
    glint_images *images;
    int largest, threads;         // threads per image
    glint_texture_levels *levels; // [use]
    bool *is_short;               // [use]: memory is short
} image_work;

// Finds the image's file, or its bytes. *path is malloc'd, or NULL for bytes.
static glint_status find_source(const image_work *work, const glint_document_image *image,
                                char **path, glint_image_source *source, glint_error *error)
{
    *path = NULL;
    if (image->fault != 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s",
                          glint_document_text(work->document, image->fault));
    }
    if (image->uri == 0) {
        return glint_image_find_source_in_memory("image", work->document->block + image->offset,
                                                 image->bytes, source, error);
    }
    TRY(glint_find_file(work->folder, glint_document_text(work->document, image->uri), path,
                        error));
    return glint_image_find_source(*path, source, error);
}

// Returns a message without the name at its beginning.
static const char *cause_in(const char *message, const char *name)
{
    const size_t length = strlen(name);
    return strncmp(message, name, length) == 0 && strncmp(message + length, ": ", 2) == 0
               ? message + length + 2
               : message;
}

static void read_image(size_t i, void *context)
{
    image_work *work = context;
    glint_image_use *use = &work->images->uses[i];
    const glint_document_image *image = &work->document->images[use->image];
    glint_texture_request request = {
        .is_color = use->is_color, .is_coverage = use->is_coverage, .threads = work->threads};
    glint_error error = {0};
    char *path;
    glint_status status = find_source(work, image, &path, &request.source, &error);
    if (status == GLINT_OK) {
        status = glint_texture_read(&request, work->largest, &work->levels[i], &error);
    }
    const char *fault = NULL;
    if (status != GLINT_OK) {
        fault = cause_in(error.message, path != NULL ? path : "image");
    } else if (work->levels[i].texel_count == 0) {
        fault = "has no pixels";
    }
    use->fault = fault == NULL ? NULL : strdup(fault);
    work->is_short[i] = status == GLINT_OUT_OF_MEMORY || (fault != NULL && use->fault == NULL);
    free(path);
    glint_error_free(&error);
}

glint_status glint_images_read(glint_images *images, const glint_document *document,
                               const char *folder, int largest, glint_error *error)
{
    if (images->count == 0) {
        return GLINT_OK;
    }
    const int each = glint_usable_cores() / (int)images->count;
    image_work work = {.document = document,
                       .folder = folder,
                       .images = images,
                       .largest = largest,
                       .threads = each > 1 ? each : 1,
                       .levels = glint_allocate(images->count, sizeof(glint_texture_levels)),
                       .is_short = glint_allocate(images->count, sizeof(bool))};
    bool is_short = work.levels == NULL || work.is_short == NULL;
    if (!is_short) {
        glint_parallel_for(images->count, read_image, &work);
    }
    for (size_t i = 0; !is_short && i < images->count; i++) {
        is_short = work.is_short[i];
    }
    is_short = is_short ||
               glint_textures_join(work.levels, images->count, &images->textures, NULL) != GLINT_OK;
    for (size_t i = 0; work.levels != NULL && i < images->count; i++) {
        free(work.levels[i].texels);
    }
    free(work.levels);
    free(work.is_short);
    return is_short ? glint_fail(error, GLINT_OUT_OF_MEMORY,
                                 "not enough memory for its textures (give --texture-size)")
                    : GLINT_OK;
}

void glint_images_free(glint_images *images)
{
    for (size_t i = 0; i < images->count; i++) {
        free(images->uses[i].fault);
    }
    free(images->uses);
    free(images->numbers);
    glint_textures_release(images->textures);
    *images = (glint_images){0};
}
