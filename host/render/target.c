// Manages the buffers that a frame is written to. See target.h.
#include "render/target.h"

#include "base/memory.h"
#include "device/opencl_error.h"
#include "kernels/layout.h"
#include "render/terms.h"

#include <stdlib.h>

static size_t pixel_count(const glint_settings *settings)
{
    int size[2];
    glint_settings_pixels(settings, size);
    return (size_t)size[0] * (size_t)size[1];
}

glint_status glint_target_measure(const glint_settings *settings, size_t scalar_bytes,
                                  glint_content contents[GLINT_TARGET_PARTS], glint_error *error)
{
    const size_t terms = settings->terms > 0 ? (size_t)settings->terms + 1 : 0;
    const struct {
        const char *what;
        size_t of_pixel; // bytes
        const void *data;
    } parts[GLINT_TARGET_PARTS] = {
        [GLINT_TARGET_PIXELS] = {"the frame", 4 * scalar_bytes, NULL},
        [GLINT_TARGET_COUNTERS] = {"the counters", 0, NULL},
        [GLINT_TARGET_LAYERS] = {"the layers",
                                 settings->aovs != 0 ? sizeof(glint_layers_record) : 0, NULL},
        [GLINT_TARGET_TERMS] = {"the directions", terms * GLINT_TERM_VALUES * sizeof(float), NULL},
        [GLINT_TARGET_LIST] = {"the list of pixels",
                               settings->list != NULL ? sizeof *settings->list : 0, settings->list},
    };
    const size_t pixels = pixel_count(settings);
    for (int i = 0; i < GLINT_TARGET_PARTS; i++) {
        contents[i] = (glint_content){.what = parts[i].what, .data = parts[i].data};
        if (!glint_multiply(pixels, parts[i].of_pixel, &contents[i].bytes)) {
            return glint_fail(error, GLINT_USAGE, "--size: %dx%d is too large", settings->width,
                              settings->height);
        }
    }
    contents[GLINT_TARGET_COUNTERS].bytes = GLINT_COUNTER_WORDS * sizeof(uint32_t);
    return GLINT_OK;
}

size_t glint_target_frame_bytes(const glint_settings *settings, size_t scalar_bytes)
{
    glint_content contents[GLINT_TARGET_PARTS];
    if (glint_target_measure(settings, scalar_bytes, contents, NULL) != GLINT_OK) {
        return 0;
    }
    return contents[GLINT_TARGET_PIXELS].bytes + contents[GLINT_TARGET_LAYERS].bytes +
           contents[GLINT_TARGET_TERMS].bytes;
}

glint_status glint_target_fit(glint_target *target, const glint_settings *settings,
                              size_t scalar_bytes, const glint_content contents[GLINT_TARGET_PARTS],
                              glint_error *error)
{
    const bool need_no_own = glint_pixels_are_written_into_images(target->device, scalar_bytes);
    for (int i = need_no_own ? GLINT_TARGET_PIXELS + 1 : 0; i < GLINT_TARGET_PARTS; i++) {
        TRY(glint_buffer_fit(target->device, &contents[i], &target->buffers[i], error));
    }
    int size[2];
    glint_settings_pixels(settings, size);
    target->pixels = (glint_pixels){.device = target->device,
                                    .width = size[0],
                                    .height = size[1],
                                    .scalar_bytes = scalar_bytes,
                                    .own = target->buffers[GLINT_TARGET_PIXELS]};
    return GLINT_OK;
}

glint_output_arguments glint_target_arguments(const glint_target *target)
{
    return (glint_output_arguments){.pixels = target->buffers[GLINT_TARGET_PIXELS],
                                    .counters = target->buffers[GLINT_TARGET_COUNTERS],
                                    .layers = target->buffers[GLINT_TARGET_LAYERS],
                                    .terms = target->buffers[GLINT_TARGET_TERMS]};
}

glint_status glint_target_clear_counters(const glint_target *target, glint_error *error)
{
    static const uint32_t zeros[GLINT_COUNTER_WORDS] = {0};
    return glint_check_opencl(error, target->device, "clearing the counters",
                              glint_buffer_write(target->device,
                                                 target->buffers[GLINT_TARGET_COUNTERS],
                                                 sizeof zeros, zeros));
}

glint_status glint_target_read_counters(const glint_target *target,
                                        uint32_t words[GLINT_COUNTER_WORDS], glint_error *error)
{
    return glint_check_opencl(error, target->device, "reading the counters",
                              glint_buffer_read(target->device,
                                                target->buffers[GLINT_TARGET_COUNTERS],
                                                GLINT_COUNTER_WORDS * sizeof *words, words));
}

// Reads a part of the target into *copy, which the caller frees; NULL on failure.
static glint_status read_part(const glint_target *target, glint_target_part part,
                              const glint_settings *settings, void **copy, glint_error *error)
{
    *copy = NULL;
    glint_content contents[GLINT_TARGET_PARTS];
    TRY(glint_target_measure(settings, target->pixels.scalar_bytes, contents, error));
    const glint_content *content = &contents[part];
    void *read = malloc(content->bytes);
    if (read == NULL) {
        return glint_fail_memory(error, content->what);
    }
    const cl_int code =
        glint_buffer_read(target->device, target->buffers[part], content->bytes, read);
    if (code != CL_SUCCESS) {
        free(read);
        return glint_fail_opencl(error, target->device, content->what, code);
    }
    *copy = read;
    return GLINT_OK;
}

glint_status glint_target_layers(const glint_target *target, const glint_settings *settings,
                                 const glint_owners *owners, glint_layers *layers,
                                 glint_error *error)
{
    const size_t pixels = pixel_count(settings);
    void *records = NULL, *terms = NULL;
    *layers = (glint_layers){0};
    glint_status status = GLINT_OK;
    if (settings->aovs != 0) {
        TRY_OR(cleanup, status, read_part(target, GLINT_TARGET_LAYERS, settings, &records, error));
        const glint_layers_inputs inputs = {records, pixels, owners, settings};
        TRY_OR(cleanup, status, glint_layers_make(&inputs, layers, error));
    }
    if (settings->terms > 0) {
        TRY_OR(cleanup, status, read_part(target, GLINT_TARGET_TERMS, settings, &terms, error));
        TRY_OR(cleanup, status,
               glint_terms_add_channels(terms, pixels, settings->terms, layers, error));
    }
cleanup:
    free(records);
    free(terms);
    if (status != GLINT_OK) {
        glint_layers_free(layers);
    }
    return status;
}

void glint_target_free(glint_target *target)
{
    for (int i = 0; i < GLINT_TARGET_PARTS; i++) {
        glint_buffer_release(&target->buffers[i]);
    }
    *target = (glint_target){0};
}
