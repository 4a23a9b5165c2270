// Reads animations. See clips.h.
#include "scene/gltf/clips.h"

#include "base/free_memory.h"
#include "base/memory.h"
#include "scene/gltf/array.h"
#include "scene/gltf/names.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The input and output of reading clips.
typedef struct clip_reading {
    const glint_document *document;
    glint_clips *clips;
    glint_tally *tally;
    uint64_t left; // bytes of memory that further curves may take
} clip_reading;

static void free_curve(glint_curve *curve)
{
    free((void *)curve->times);
    free((void *)curve->values);
    *curve = (glint_curve){0};
}

// Returns what is wrong with the times; NULL: nothing.
static const char *read_times(const glint_array *array, double *times, bool *repeats)
{
    for (size_t i = 0; i < array->count; i++) {
        glint_array_numbers(array, i, 1, &times[i]);
        if (!isfinite(times[i]) || (i > 0 && times[i] < times[i - 1])) {
            return "the times of its keys must be finite and ascend";
        }
        *repeats = *repeats || (i > 0 && times[i] == times[i - 1]);
    }
    return NULL;
}

// Returns what is wrong with the values; NULL: nothing. `each` is their number per key.
static const char *read_values(const glint_array *array, size_t components, size_t each,
                               double *values)
{
    for (size_t i = 0; i < array->count; i++) {
        double *value = values + i * components, squares = 0;
        glint_array_numbers(array, i, components, value);
        for (size_t k = 0; k < components; k++) {
            squares += value[k] * value[k];
        }
        const bool is_tangent = each == 3 && i % 3 != 1;
        if (!isfinite(squares)) {
            return "a value is not finite";
        }
        if (components == 4 && !is_tangent && !(squares > 0)) {
            return "a value is no rotation (a quaternion is not 0)";
        }
    }
    return NULL;
}

// Returns the moves of a node, added if they are not there; NULL if memory is short.
static glint_moves *moves_of(glint_clips *clips, int32_t node)
{
    if (clips->moves_of[node] == 0) {
        if (!glint_make_room((void **)&clips->moves, clips->count, &clips->capacity,
                             sizeof *clips->moves)) {
            return NULL;
        }
        clips->moves[clips->count++] = (glint_moves){0};
        clips->moves_of[node] = (int32_t)clips->count;
    }
    return &clips->moves[clips->moves_of[node] - 1];
}

static size_t components_of(const glint_document *document, const glint_document_channel *channel)
{
    switch (channel->property) {
    case GLINT_PROPERTY_ROTATION:
        return 4;
    case GLINT_PROPERTY_WEIGHTS:
        return document->meshes[document->nodes[channel->node].mesh].target_count;
    default:
        return 3;
    }
}

// A channel's keys, and what was found in them.
typedef struct channel_keys {
    glint_array input, output;
    size_t components; // of an element of `output`
    bool repeats;      // several keys have one time
    const char *fault; // what is wrong; NULL: nothing
    const char *where; // "input" or "output"
} channel_keys;

// Fills the curve's arrays.
static void fill(channel_keys *keys, glint_curve *curve)
{
    keys->where = "input";
    keys->fault = read_times(&keys->input, (double *)curve->times, &keys->repeats);
    if (keys->fault == NULL) {
        const size_t each = curve->interpolation == GLINT_INTERPOLATION_CUBIC ? 3 : 1;
        keys->where = "output";
        keys->fault = read_values(&keys->output, keys->components, each, (double *)curve->values);
    }
}

static void tally_keys(clip_reading *reading, size_t animation,
                       const glint_document_channel *channel, const channel_keys *keys)
{
    char where[GLINT_WHERE], text[128];
    (void)snprintf(where, sizeof where, "animations[%zu].samplers[%d].%s", animation,
                   channel->sampler, keys->fault == NULL ? "input" : keys->where);
    if (keys->repeats) {
        glint_tally_add(reading->tally, "several keys have one time (the value jumps there)",
                        where);
    }
    if (keys->fault != NULL) {
        (void)snprintf(text, sizeof text, "%s; the channel is left out", keys->fault);
        glint_tally_add(reading->tally, text, where);
    }
}

// Reads a channel; leaves it out, with a warning, if its keys cannot be used.
static glint_status read_channel(clip_reading *reading, size_t animation,
                                 const glint_document_channel *channel, glint_error *error)
{
    glint_curve curve = {.interpolation = (glint_interpolation)channel->interpolation,
                         .is_rotation = channel->property == GLINT_PROPERTY_ROTATION,
                         .components = components_of(reading->document, channel)};
    channel_keys keys = {
        .input = glint_array_open(reading->document, channel->input),
        .output = glint_array_open(reading->document, channel->output),
        .components = channel->property == GLINT_PROPERTY_WEIGHTS ? 1 : curve.components,
    };
    curve.key_count = keys.input.count;
    // Many channels may share a sampler, but each has its own curve.
    const size_t values = keys.output.count * keys.components;
    const uint64_t bytes = (keys.input.count + values) * sizeof(double);
    if (bytes > reading->left) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY,
                          "its animations take more memory than is free (leave some out: "
                          "--animation)");
    }
    reading->left -= bytes;
    curve.times = glint_allocate_unset(keys.input.count, sizeof(double));
    curve.values = glint_allocate_unset(values, sizeof(double));
    if (curve.times == NULL || curve.values == NULL) {
        free_curve(&curve);
        return glint_fail_memory(error, "the scene");
    }
    fill(&keys, &curve);
    tally_keys(reading, animation, channel, &keys);
    if (keys.fault != NULL) {
        free_curve(&curve);
        return GLINT_OK;
    }
    glint_moves *moves = moves_of(reading->clips, channel->node);
    if (moves == NULL) {
        free_curve(&curve);
        return glint_fail_memory(error, "the scene");
    }
    const double last = curve.times[curve.key_count - 1];
    reading->clips->duration = fmax(reading->clips->duration, last);
    free_curve(&moves->of[channel->property]);
    moves->of[channel->property] = curve;
    return GLINT_OK;
}

static glint_status read_clip(clip_reading *reading, size_t index, glint_error *error)
{
    const glint_document *document = reading->document;
    const glint_document_animation *animation = &document->animations[index];
    for (uint32_t i = 0; i < animation->notes.count; i++) {
        const glint_document_note *note = &document->notes[animation->notes.first + i];
        glint_tally_add(reading->tally, glint_document_text(document, note->text),
                        glint_document_text(document, note->where));
    }
    for (uint32_t i = 0; i < animation->channels.count; i++) {
        TRY(read_channel(reading, index, &document->channels[animation->channels.first + i],
                         error));
    }
    if (reading->clips->name == NULL && animation->name != 0) {
        reading->clips->name = glint_document_text(document, animation->name);
    }
    return GLINT_OK;
}

glint_status glint_clips_read(const glint_document *document, const char *name, glint_clips *clips,
                              glint_tally *tally, glint_error *error)
{
    const size_t count = document->animations_count;
    clips->moves_of = glint_allocate(document->nodes_count, sizeof *clips->moves_of);
    if (clips->moves_of == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    clip_reading reading = {document, clips, tally, glint_free_memory()};
    if (name != NULL && strcmp(name, "none") == 0) {
        return GLINT_OK;
    }
    if (name != NULL && strcmp(name, "all") == 0) {
        for (size_t i = 0; i < count; i++) {
            TRY(read_clip(&reading, i, error));
        }
        return GLINT_OK;
    }
    if (name == NULL && count == 0) {
        return GLINT_OK;
    }
    size_t chosen = 0;
    if (name != NULL) {
        const glint_named_rows rows = GLINT_NAMED_ROWS(document, animations, "animation");
        TRY(glint_name_find(&rows, name, &chosen, error));
    } else if (count > 1) {
        char text[128], where[GLINT_WHERE];
        (void)snprintf(text, sizeof text,
                       "the first of %zu animations is shown (--animation names another, or all)",
                       count);
        const char *first = glint_document_text(document, document->animations[0].name);
        glint_tally_add(tally, text, glint_name_place("animations", 0, first, where));
    }
    return read_clip(&reading, chosen, error);
}

const glint_curve *glint_clips_curve(const glint_clips *clips, int node, glint_property property)
{
    const int32_t moves = clips->moves_of[node];
    const glint_curve *curve = moves == 0 ? NULL : &clips->moves[moves - 1].of[property];
    return curve == NULL || curve->key_count == 0 ? NULL : curve;
}

void glint_clips_free(glint_clips *clips)
{
    for (size_t i = 0; i < clips->count; i++) {
        for (int property = 0; property < GLINT_PROPERTIES; property++) {
            free_curve(&clips->moves[i].of[property]);
        }
    }
    free(clips->moves);
    free(clips->moves_of);
    *clips = (glint_clips){0};
}
