// Joins elements into sets: union-find. A set is known by its root, its least element.
#ifndef GLINT_BASE_UNION_FIND_H
#define GLINT_BASE_UNION_FIND_H

#include <stdint.h>

// `parent` has an element for each: at first its own number, parent[i] = i. Both take nearly
// constant time.
uint32_t glint_union_root(uint32_t *parent, uint32_t element);
void glint_union_join(uint32_t *parent, uint32_t a, uint32_t b);

#endif
