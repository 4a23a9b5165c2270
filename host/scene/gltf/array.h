// Arrays of numbers as glTF's accessors describe them: elements of one or more components.
#ifndef GLINT_SCENE_GLTF_ARRAY_H
#define GLINT_SCENE_GLTF_ARRAY_H

#include "scene/document.h"

#include <stdbool.h>

// Elements that stand in for some of an array's own.
typedef struct glint_sparse {
    size_t count;                    // 0: none
    glint_component_type index_type; // unsigned
    const unsigned char *indices;    // [count], ascending
    const unsigned char *elements;   // [count], packed tightly
} glint_sparse;

// An array. It borrows its bytes and reads them in place, in any order, so the file's size limits
// the memory, not its counts. Zero is valid: no elements.
typedef struct glint_array {
    glint_component_type type;
    bool normalized;            // integers stand for [−1, 1] or [0, 1]
    size_t count;               // elements
    size_t element_size;        // bytes
    const unsigned char *bytes; // the first element; NULL: all elements are zeros
    size_t stride;              // bytes from one element to the next
    glint_sparse sparse;
} glint_array;

// Returns arrays[index] of a document; −1: an array without elements.
glint_array glint_array_open(const glint_document *document, int32_t index);

// Returns an element of unsigned integers of one component.
uint32_t glint_array_index(const glint_array *array, size_t i);

// Returns the largest value that a type of unsigned integers holds.
uint32_t glint_component_largest(glint_component_type type);

// Reads `n` components of element i as numbers.
void glint_array_numbers(const glint_array *array, size_t i, size_t n, double *numbers);

#endif
