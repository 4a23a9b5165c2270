// Prepares primitives for drawing. See primitives.h.
#include "scene/gltf/primitives.h"

#include "base/memory.h"

#include <stdlib.h>

// The largest index of each array, found once: many primitives may share an array. Otherwise a
// small file could take a long time.
typedef struct largest_indices {
    const glint_document *document;
    int64_t *of; // [array]; −1: not known
} largest_indices;

static uint32_t largest_index(largest_indices *largest, int32_t index, const glint_array *array)
{
    if (largest->of[index] < 0) {
        uint32_t found = 0;
        for (size_t k = 0; k < array->count; k++) {
            const uint32_t value = glint_array_index(array, k);
            found = value > found ? value : found;
        }
        largest->of[index] = found;
    }
    return (uint32_t)largest->of[index];
}

static glint_status refuse_index(const glint_primitive *primitive, int accessor, uint32_t largest,
                                 glint_error *error)
{
    char place[GLINT_PRIMITIVE_PLACE];
    size_t k = 0;
    while (glint_array_index(&primitive->indices, k) != largest) {
        k++;
    }
    const size_t vertices = primitive->positions.count;
    (void)glint_primitive_place(primitive, place);
    if (largest >= vertices) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s.indices: accessors[%d], element %zu: there is no vertex %u (POSITION "
                          "has %zu element%s)",
                          place, accessor, k, largest, vertices, vertices == 1 ? "" : "s");
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s.indices: accessors[%d], element %zu: %u restarts a primitive, which glTF "
                      "2.0 does not allow (split the primitive)",
                      place, accessor, k, largest);
}

static glint_status open_indices(const glint_document_primitive *source, largest_indices *largest,
                                 glint_primitive *primitive, glint_error *error)
{
    if (source->indices < 0) {
        return GLINT_OK;
    }
    primitive->indices = glint_array_open(largest->document, source->indices);
    const uint32_t value = largest_index(largest, source->indices, &primitive->indices);
    if (value >= primitive->positions.count ||
        value == glint_component_largest(primitive->indices.type)) {
        return refuse_index(primitive, largest->document->arrays[source->indices].accessor, value,
                            error);
    }
    return GLINT_OK;
}

static void open_attributes(const glint_document *document, const glint_document_primitive *source,
                            glint_primitive *primitive)
{
    primitive->positions = glint_array_open(document, source->positions);
    primitive->normals = glint_array_open(document, source->normals);
    primitive->tangents = glint_array_open(document, source->tangents);
    primitive->colors = glint_array_open(document, source->colors);
    for (int set = 0; set < 2; set++) {
        primitive->texcoords[set] = glint_array_open(document, source->texcoords[set]);
    }
    if (source->colors >= 0) {
        primitive->color_components = document->arrays[source->colors].components > 3 ? 4 : 3;
    }
}

static void count_triangles(glint_primitive *primitive)
{
    const size_t corners =
        primitive->indices.count > 0 ? primitive->indices.count : primitive->positions.count;
    const size_t of_strip = corners < 3 ? 0 : corners - 2;
    primitive->triangles = primitive->mode == GLINT_MODE_TRIANGLES ? corners / 3 : of_strip;
    primitive->left_over = primitive->mode == GLINT_MODE_TRIANGLES ? corners % 3
                           : corners < 3                           ? corners
                                                                   : 0;
}

static int32_t material_of(const glint_document *document, const glint_document_primitive *source,
                           int variant)
{
    for (uint32_t i = 0; i < source->mappings.count; i++) {
        const glint_document_mapping *mapping = &document->mappings[source->mappings.first + i];
        if (mapping->variant == variant) {
            return mapping->material;
        }
    }
    return source->material;
}

static void open_deltas(const glint_document *document, glint_primitives *primitives)
{
    for (size_t i = 0; i < document->targets_count; i++) {
        primitives->targets[i].of[GLINT_MORPH_POSITION] =
            glint_array_open(document, document->targets[i].positions);
        primitives->targets[i].of[GLINT_MORPH_NORMAL] =
            glint_array_open(document, document->targets[i].normals);
    }
    for (size_t i = 0; i < document->influences_count; i++) {
        primitives->influences[i].joints =
            glint_array_open(document, document->influences[i].joints);
        primitives->influences[i].weights =
            glint_array_open(document, document->influences[i].weights);
    }
}

static glint_status open_primitive(largest_indices *largest, size_t index, int variant,
                                   glint_primitives *primitives, glint_error *error)
{
    const glint_document_primitive *source = &largest->document->primitives[index];
    glint_primitive *primitive = &primitives->all[index];
    primitive->mode = source->mode;
    primitive->material = material_of(largest->document, source, variant);
    if (source->mode < GLINT_MODE_TRIANGLES || source->positions < 0) {
        return GLINT_OK;
    }
    open_attributes(largest->document, source, primitive);
    TRY(open_indices(source, largest, primitive, error));
    primitive->targets = primitives->targets + source->targets.first;
    primitive->target_count = source->targets.count;
    primitive->influences = (glint_influence_sets){
        primitives->influences + source->influences.first, source->influences.count};
    count_triangles(primitive);
    return GLINT_OK;
}

glint_status glint_primitives_open(const glint_document *document, int variant,
                                   glint_primitives *primitives, glint_error *error)
{
    largest_indices largest = {document, glint_allocate(document->arrays_count, sizeof(int64_t))};
    primitives->all = glint_allocate(document->primitives_count, sizeof *primitives->all);
    primitives->targets = glint_allocate(document->targets_count, sizeof *primitives->targets);
    primitives->influences =
        glint_allocate(document->influences_count, sizeof *primitives->influences);
    glint_status status = GLINT_OK;
    if (largest.of == NULL || primitives->all == NULL || primitives->targets == NULL ||
        primitives->influences == NULL) {
        status = glint_fail_memory(error, "the scene");
        goto done;
    }
    for (size_t i = 0; i < document->arrays_count; i++) {
        largest.of[i] = -1;
    }
    open_deltas(document, primitives);
    for (size_t m = 0; m < document->meshes_count; m++) {
        const glint_run run = document->meshes[m].primitives;
        for (uint32_t p = 0; status == GLINT_OK && p < run.count; p++) {
            primitives->all[run.first + p].mesh = m;
            primitives->all[run.first + p].number = p;
            status = open_primitive(&largest, run.first + p, variant, primitives, error);
        }
    }
done:
    free(largest.of);
    return status;
}

void glint_primitives_free(glint_primitives *primitives)
{
    free(primitives->all);
    free(primitives->targets);
    free(primitives->influences);
    *primitives = (glint_primitives){0};
}
