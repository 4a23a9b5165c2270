// Computes positions with more digits than one float has (LOCAL_ORIGINS). An object that is small
// compared with the scene has its own origin, the anchor, which floats hold exactly. Its vertices
// are relative to the anchor. In single precision a ray's origin is the sum of two floats. The
// difference of two positions is rounded only after the subtraction. So a bead on a wide floor is
// as exact as the bead alone.
#define LOCAL_RAYS GLINT_HAS_LOCAL_RAYS(IS_COMPILED, GLINT_DOUBLE)

// Converts a coordinate along axis k: relative to a cluster's anchor, or to the scene's origin.
#if GLINT_LOCAL_ORIGINS
#define FROM_ANCHOR(cluster, k, value) ((value) - (scalar)(cluster)[GLINT_CLUSTER_ANCHOR + (k)])
#define FROM_SCENE(cluster, k, value) ((value) + (scalar)(cluster)[GLINT_CLUSTER_ANCHOR + (k)])
#else
#define FROM_ANCHOR(cluster, k, value) (value)
#define FROM_SCENE(cluster, k, value) (value)
#endif

// The number of triangles of a cluster, and their material.
static inline int count_of_cluster(global const float *cluster)
{
    return ((global const int *)cluster)[GLINT_CLUSTER_FACTS] & GLINT_CLUSTER_COUNT_MASK;
}

static inline int material_of_cluster(global const float *cluster)
{
    return ((global const int *)cluster)[GLINT_CLUSTER_FACTS] >> GLINT_CLUSTER_COUNT_BITS;
}

#if LOCAL_RAYS

// The unevaluated sum of two numbers.
typedef struct pair {
    real high, low;
} pair;

// a + b, exactly (Knuth, The Art of Computer Programming, volume 2, 4.2.2).
static inline pair sum_of(real a, real b)
{
    pair s;
    s.high = a + b;
    const real of_b = s.high - a;
    s.low = (a - (s.high - of_b)) + (b - of_b);
    return s;
}

// a b, exactly if the multiply-add is fused.
static inline pair product_of(real a, real b)
{
    pair p;
    p.high = a * b;
    p.low = fused(a, b, -p.high);
    return p;
}

static inline pair product_of_pairs(pair a, pair b)
{
    pair p = product_of(a.high, b.high);
    p.low += fused(a.high, b.low, a.low * b.high);
    return p;
}

static inline pair sum_of_pairs(pair a, pair b)
{
    pair s = sum_of(a.high, b.high);
    s.low += a.low + b.low;
    return s;
}

static inline pair negated(pair a)
{
    a.high = -a.high;
    a.low = -a.low;
    return a;
}

// The distance from a ray's origin to a triangle's plane, as a multiple of `d`. A plane through
// distant corners has no digits left near the origin; with pairs it has.
static inline real depth_of_plane(const real corners[9], const real anchor[3], const real origin[3],
                                  const real origin_low[3], const real d[3])
{
    pair a[3], b[3], to_plane[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        a[k] = sum_of(corners[3 + k], -corners[k]);
        b[k] = sum_of(corners[6 + k], -corners[k]);
        to_plane[k] =
            sum_of_pairs(sum_of(anchor[k], -origin[k]), sum_of(corners[k], -origin_low[k]));
    }
    pair height;
    real fall = real_of(0);
    height.high = height.low = real_of(0);
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const pair normal = sum_of_pairs(product_of_pairs(a[i], b[j]),
                                         negated(product_of_pairs(a[j], b[i])));
        height = sum_of_pairs(height, product_of_pairs(normal, to_plane[k]));
        fall = fused(normal.high, d[k], fall);
    }
    return (height.high + height.low) / fall;
}

// The plane is measured again if the triangle is this many times larger than the distance to the
// hit.
#define LARGE_TRIANGLE R(16.0)

#endif
