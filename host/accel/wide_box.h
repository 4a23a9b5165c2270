// Boxes as wide nodes hold them, and their areas.
#ifndef GLINT_ACCEL_WIDE_BOX_H
#define GLINT_ACCEL_WIDE_BOX_H

#include "accel/box.h"

#include <math.h>

// Returns half of the surface area, in double: sums over millions of boxes are compared.
static inline double glint_wide_area(glint_box b)
{
    glint_float4 size = b.high + b.low_negated;
    double x = (double)size[0], y = (double)size[1], z = (double)size[2];
    return x * y + y * z + z * x;
}

// Stores the box of a node's child, wider by a few roundings of its own size. The sheared vertices
// of a large triangle (see kernels/intersect.cl) have rounding errors of this order.
static inline void glint_wide_store_box(float *node, int width, int child, glint_box bounds)
{
    float margin = glint_box_extent(bounds) * 0x1p-21f;
    for (int k = 0; k < 3; k++) {
        node[k * width + child] = nextafterf(-bounds.low_negated[k] - margin, -INFINITY);
        node[(3 + k) * width + child] = nextafterf(bounds.high[k] + margin, INFINITY);
    }
}

#endif
