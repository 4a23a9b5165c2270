// Arrays of numbers as glTF's accessors describe them: elements of one or more components.
#ifndef GLINT_SCENE_GLTF_ARRAY_H
#define GLINT_SCENE_GLTF_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// glTF's codes of component types.
typedef enum glint_component {
    GLINT_COMPONENT_INT8 = 5120,
    GLINT_COMPONENT_UINT8 = 5121,
    GLINT_COMPONENT_INT16 = 5122,
    GLINT_COMPONENT_UINT16 = 5123,
    GLINT_COMPONENT_UINT32 = 5125,
    GLINT_COMPONENT_FLOAT = 5126,
} glint_component;

// Elements that stand in for some of an array's own.
typedef struct glint_sparse {
    size_t count;                  // 0: none
    glint_component index_type;    // unsigned
    const unsigned char *indices;  // [count], ascending
    const unsigned char *elements; // [count], packed tightly
} glint_sparse;

// An array. It borrows its bytes and reads them in place, in any order, so the file's size limits
// the memory, not its counts. Zero is valid: no elements.
typedef struct glint_array {
    glint_component type;
    bool normalized;            // integers stand for [−1, 1] or [0, 1]
    size_t count;               // elements
    size_t element_size;        // bytes
    const unsigned char *bytes; // the first element; NULL: all elements are zeros
    size_t stride;              // bytes from one element to the next
    glint_sparse sparse;
} glint_array;

// Returns an element of unsigned integers of one component.
uint32_t glint_array_index(const glint_array *array, size_t i);

// Returns the largest value that a type of unsigned integers holds.
uint32_t glint_component_largest(glint_component type);

// Reads `n` components of element i as numbers.
void glint_array_numbers(const glint_array *array, size_t i, size_t n, double *numbers);

// Returns the index at which sparse element k stands.
uint32_t glint_sparse_index(const glint_sparse *sparse, size_t k);

#ifdef __cplusplus
}
#endif

#endif
