// The nodes and leaves that wait in a traversal, the nearest on top.

// `entry` is the distance or depth at which the rays may enter, `rays` says which may, as bits.
typedef struct waiting {
    int child;
    scalar entry;
    uint rays;
} waiting;

// Puts a child of the node on the stack, in order of falling distance down to `base`, where the
// node's own children begin. Equal distances keep the order of the children, so that the order is
// always the same. Returns the new size.
static inline int push_waiting(waiting *stack, int base, int size, global const float *node,
                               int child, scalar entry, uint rays)
{
    global const int *children = (global const int *)(node + 6 * GLINT_BVH_WIDTH);
    int i = size++;
    for (; i > base && stack[i - 1].entry <= entry; i--) {
        stack[i] = stack[i - 1];
    }
    stack[i].child = children[child];
    stack[i].entry = entry;
    stack[i].rays = rays;
    return size;
}
