// Joins elements into sets. See union_find.h.
#include "base/union_find.h"

// Path halving keeps the paths short without a stack.
uint32_t glint_union_root(uint32_t *parent, uint32_t element)
{
    while (parent[element] != element) {
        parent[element] = parent[parent[element]];
        element = parent[element];
    }
    return element;
}

// With path halving, near-linear time needs no ranks.
void glint_union_join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = glint_union_root(parent, a);
    b = glint_union_root(parent, b);
    parent[a > b ? a : b] = a > b ? b : a;
}
