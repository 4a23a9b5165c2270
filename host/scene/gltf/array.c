// Arrays of numbers as glTF's accessors describe them. See array.h.
#include "scene/gltf/array.h"

#include <math.h>
#include <string.h>

// An element of any type, 4 × 4 floats at most.
static const unsigned char zeros[64];

// Files align elements, but not to the addresses at which they are loaded: copy.
#define LOAD(type, bytes, i)                                                                       \
    ({                                                                                             \
        type loaded;                                                                               \
        memcpy(&loaded, (bytes) + (i) * sizeof loaded, sizeof loaded);                             \
        loaded;                                                                                    \
    })

static uint32_t load_index(glint_component_type type, const unsigned char *bytes, size_t i)
{
    switch (type) {
    case GLINT_COMPONENT_UINT8:
        return bytes[i];
    case GLINT_COMPONENT_UINT16:
        return LOAD(uint16_t, bytes, i);
    default:
        return LOAD(uint32_t, bytes, i);
    }
}

static uint32_t sparse_index(const glint_sparse *sparse, size_t k)
{
    return load_index(sparse->index_type, sparse->indices, k);
}

// Returns the sparse element at index i; NULL: there is none.
static const unsigned char *sparse_element(const glint_array *array, size_t i)
{
    size_t low = 0, high = array->sparse.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sparse_index(&array->sparse, middle) < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    const bool is_there = low < array->sparse.count && sparse_index(&array->sparse, low) == i;
    return is_there ? array->sparse.elements + low * array->element_size : NULL;
}

static const unsigned char *element(const glint_array *array, size_t i)
{
    const unsigned char *replaced = array->sparse.count == 0 ? NULL : sparse_element(array, i);
    return replaced != NULL       ? replaced
           : array->bytes != NULL ? array->bytes + i * array->stride
                                  : zeros;
}

glint_array glint_array_open(const glint_document *document, int32_t index)
{
    glint_array array = {0};
    if (index < 0) {
        return array;
    }
    const glint_document_array *row = &document->arrays[index];
    array.type = (glint_component_type)row->type;
    array.normalized = row->is_normalized != 0;
    array.count = row->count;
    array.element_size = glint_component_bytes(row->type) * (size_t)row->components;
    array.bytes = row->offset == 0 ? NULL : document->block + row->offset;
    array.stride = row->stride;
    if (row->sparse_count > 0) {
        array.sparse = (glint_sparse){row->sparse_count, (glint_component_type)row->sparse_type,
                                      document->block + row->sparse_indices,
                                      document->block + row->sparse_elements};
    }
    return array;
}

uint32_t glint_array_index(const glint_array *array, size_t i)
{
    return load_index(array->type, element(array, i), 0);
}

uint32_t glint_component_largest(glint_component_type type)
{
    return type == GLINT_COMPONENT_UINT8    ? UINT8_MAX
           : type == GLINT_COMPONENT_UINT16 ? UINT16_MAX
                                            : UINT32_MAX;
}

static double number(const glint_array *array, const unsigned char *bytes, size_t i)
{
    const bool is_share = array->normalized;
    switch (array->type) {
    case GLINT_COMPONENT_FLOAT:
        return (double)LOAD(float, bytes, i);
    case GLINT_COMPONENT_INT8: {
        const double value = LOAD(int8_t, bytes, i);
        return is_share ? fmax(value / INT8_MAX, -1.0) : value;
    }
    case GLINT_COMPONENT_UINT8:
        return is_share ? bytes[i] / (double)UINT8_MAX : bytes[i];
    case GLINT_COMPONENT_INT16: {
        const double value = LOAD(int16_t, bytes, i);
        return is_share ? fmax(value / INT16_MAX, -1.0) : value;
    }
    case GLINT_COMPONENT_UINT16: {
        const double value = LOAD(uint16_t, bytes, i);
        return is_share ? value / UINT16_MAX : value;
    }
    default:
        return LOAD(uint32_t, bytes, i);
    }
}

void glint_array_numbers(const glint_array *array, size_t i, size_t n, double *numbers)
{
    const unsigned char *bytes = element(array, i);
    if (array->type == GLINT_COMPONENT_FLOAT) { // nearly all arrays
        for (size_t c = 0; c < n; c++) {
            numbers[c] = (double)LOAD(float, bytes, c);
        }
        return;
    }
    for (size_t c = 0; c < n; c++) {
        numbers[c] = number(array, bytes, c);
    }
}
