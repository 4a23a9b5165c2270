// Places with more digits than one float has (LOCAL_ORIGINS): a thing that is small beside the scene
// has an origin of its own, from which its vertices are told, and which floats hold exactly. In
// single precision a ray's origin is then the sum of two floats. A difference of two places is
// rounded once they are subtracted, and no sooner: it is as exact for a bead on a wide floor as for
// the bead alone.
#define LOCAL_RAYS (GLINT_LOCAL_ORIGINS && !GLINT_DOUBLE)

// A cluster's coordinate along axis k, told from its anchor or from the scene's origin.
#if GLINT_LOCAL_ORIGINS
#define FROM_ANCHOR(cluster, k, value) ((value) - (scalar)(cluster)[GLINT_CLUSTER_ANCHOR + (k)])
#define FROM_SCENE(cluster, k, value) ((value) + (scalar)(cluster)[GLINT_CLUSTER_ANCHOR + (k)])
#else
#define FROM_ANCHOR(cluster, k, value) (value)
#define FROM_SCENE(cluster, k, value) (value)
#endif

// How many triangles a cluster has, and which material.
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

// a b: exactly, where a multiply-add is fused.
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

// How many times `d` it is from a ray's origin to the plane of a triangle. A plane through distant
// corners has no digits left nearby: in pairs it has.
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

// Of a triangle so many times as far across as a hit is away, the plane is looked at again.
#define LARGE_TRIANGLE R(16.0)

#endif
