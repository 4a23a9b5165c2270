// Lanes: what a packet of rays is made of, at each width and precision. Other files loop over
// GLINT_WIDTH lanes where they gather or scatter, and leave the rest to the types and functions here.
//
// `real` is one value per ray of the packet: a scalar for GLINT_WIDTH 1, a vector of 8 or 16
// otherwise; of float or, with GLINT_DOUBLE, of double. `mask` says yes or no for each ray and
// `lanes_int` holds a whole number for each; both have the size of real's elements, so that one may
// select the other. A comparison of scalars gives 1 and one of vectors gives −1, so masks are only
// combined with & and |, negated with !, and read through any_lane, lane_is_set and select_….
//
// The same source gives the same bits at every width: contraction is off, and where a fused
// multiply-add is wanted it is written fused().
#pragma OPENCL FP_CONTRACT OFF

#if GLINT_DOUBLE
#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
typedef double scalar;
typedef double4 scalar4;
typedef double8 scalar8;
#define TO_SCALAR8(floats) convert_double8(floats)
#define R(literal) literal
#define EPSILON 0x1p-53 // half the distance from 1 to the next value: the largest rounding error
#else
typedef float scalar;
typedef float4 scalar4;
typedef float8 scalar8;
#define TO_SCALAR8(floats) (floats)
#define R(literal) literal##f
#define EPSILON 0x1p-24f
#endif
#define HUGE ((scalar)GLINT_FAR)

#if GLINT_WIDTH == 1
#define LANES(type) type
#elif GLINT_WIDTH == 8
#define LANES(type) type##8
#elif GLINT_WIDTH == 16
#define LANES(type) type##16
#else
#error "GLINT_WIDTH must be 1, 8 or 16"
#endif

#if GLINT_DOUBLE
typedef LANES(double) real;
typedef LANES(long) lanes_int;
typedef long lane_int;
#if GLINT_WIDTH == 1
typedef int mask;
#else
typedef LANES(long) mask;
#endif
#else
typedef LANES(float) real;
typedef LANES(int) lanes_int;
typedef int lane_int;
typedef LANES(int) mask;
#endif

// The packet covers PACKET_WIDTH × PACKET_HEIGHT pixels, lanes row by row.
#define PACKET_WIDTH GLINT_PACKET_COLUMNS(GLINT_WIDTH)
#define PACKET_HEIGHT GLINT_PACKET_ROWS(GLINT_WIDTH)

// A number that the host passes as an unevaluated sum of two floats.
#if GLINT_DOUBLE
#define JOIN(high, low) ((scalar)(high) + (scalar)(low))
#else
#define JOIN(high, low) (high)
#endif

// The number whose bits are the integer's.
#if GLINT_DOUBLE
#define AS_REAL_(width) as_double##width
#else
#define AS_REAL_(width) as_float##width
#endif
#define AS_REAL(width) AS_REAL_(width)
#if GLINT_WIDTH == 1
#define real_from_bits(integers) AS_REAL()(integers)
#else
#define real_from_bits(integers) AS_REAL(GLINT_WIDTH)(integers)
#endif

// One lane of a value, to read or to write.
#define LANE(value, lane) (((scalar *)&(value))[lane])
#define LANE_INT(value, lane) (((lane_int *)&(value))[lane])

// yes ? a : b, lane by lane. A NaN in the value that is not chosen does no harm.
#define SELECT(yes, a, b) ((yes) ? (a) : (b))

// The smaller and the larger; a NaN in `a` gives b.
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))

// a × b + c, rounded once where the device does that in one instruction (FP_FAST_FMAF is OpenCL's way
// to say so; PoCL's compiler says __FMA__). Elsewhere fma() is a function of many.
#if defined(FP_FAST_FMAF) || defined(__FMA__)
#define fused(a, b, c) fma(a, b, c)
#else
#define fused(a, b, c) ((a) * (b) + (c))
#endif

// clang's reductions become one or two instructions; without them halves are folded. Interpreters
// such as Oclgrind accept them and cannot run them: -DGLINT_NO_REDUCTIONS takes the portable form.
#if defined(__has_builtin) && !defined(GLINT_NO_REDUCTIONS)
#if __has_builtin(__builtin_reduce_or)
#define REDUCE_OR(m) __builtin_reduce_or(m)
#endif
#endif

#if GLINT_WIDTH == 1

#define real_of(x) ((real)(x))
#define int_of(x) ((lanes_int)(x))
#define mask_none() 0
#define mask_all() 1
#define to_real(integers) ((real)(integers))
#define to_int_down(value) ((lanes_int)floor(value))
static inline bool any_lane(mask m) { return m != 0; }
static inline bool lane_is_set(mask m, int lane) { return m != 0; }
static inline scalar smallest_lane(real a) { return a; }
static inline scalar largest_lane(real a) { return a; }
static inline scalar sum_of_lanes(real a) { return a; }
static inline int count_lanes(mask m) { return m ? 1 : 0; }
static inline lanes_int lane_numbers(void) { return 0; }

#else

#define real_of(x) ((real)(scalar)(x))
#define int_of(x) ((lanes_int)(lane_int)(x))
#define mask_none() ((mask)0)
#define mask_all() ((mask)-1)
#if GLINT_DOUBLE
#define CONVERT_REAL_(width) convert_double##width
#define CONVERT_INT_(width) convert_long##width
#else
#define CONVERT_REAL_(width) convert_float##width
#define CONVERT_INT_(width) convert_int##width
#endif
#define CONVERT_REAL(width) CONVERT_REAL_(width)
#define CONVERT_INT(width) CONVERT_INT_(width)
#define to_real(integers) CONVERT_REAL(GLINT_WIDTH)(integers)
#define to_int_down(value) CONVERT_INT(GLINT_WIDTH)(floor(value))

#if GLINT_DOUBLE
typedef long4 lanes_int4;
typedef long2 lanes_int2;
typedef long8 lanes_int8;
typedef double8 real8;
typedef double4 real4;
typedef double2 real2;
#else
typedef int4 lanes_int4;
typedef int2 lanes_int2;
typedef int8 lanes_int8;
typedef float8 real8;
typedef float4 real4;
typedef float2 real2;
#endif

static inline bool any_lane(mask m)
{
#ifdef REDUCE_OR
    return REDUCE_OR(m) != 0;
#else
#if GLINT_WIDTH == 16
    lanes_int8 eight = m.lo | m.hi;
#else
    lanes_int8 eight = m;
#endif
    lanes_int4 four = eight.lo | eight.hi;
    lanes_int2 two = four.lo | four.hi;
    return (two.x | two.y) != 0;
#endif
}

static inline bool lane_is_set(mask m, int lane) { return LANE_INT(m, lane) != 0; }

static inline scalar smallest_lane(real a)
{
#if GLINT_WIDTH == 16
    real8 eight = SMALLER(a.lo, a.hi);
#else
    real8 eight = a;
#endif
    real4 four = SMALLER(eight.lo, eight.hi);
    real2 two = SMALLER(four.lo, four.hi);
    return SMALLER(two.x, two.y);
}

static inline scalar largest_lane(real a) { return -smallest_lane(-a); }

// In a fixed order, lane by lane, so that the sum is the same at every build.
static inline scalar sum_of_lanes(real a)
{
    scalar sum = 0;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        sum += LANE(a, lane);
    }
    return sum;
}

static inline int count_lanes(mask m)
{
    int count = 0;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        count += LANE_INT(m, lane) != 0;
    }
    return count;
}

static inline lanes_int lane_numbers(void)
{
#if GLINT_WIDTH == 16
    return (lanes_int)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#else
    return (lanes_int)(0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

#endif

// ---- Pixels, as memory holds them --------------------------------------------------------------

#if GLINT_WIDTH > 1 && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
// A row of the packet's pixels: R, G, B, alpha of four.
#if GLINT_DOUBLE
typedef double16 pixel_row;
#else
typedef float16 pixel_row;
#endif
#define HAS_PIXEL_ROWS
#define store_pixel_row(row, pixels) vstore16(row, 0, pixels)

// Lanes 4j … 4j + 3 become row j.
static inline void to_pixel_rows(real r, real g, real b, real a, pixel_row rows[PACKET_HEIGHT])
{
#if GLINT_WIDTH == 16
#define PAIRS(x, y, i)                                                                             \
    __builtin_shufflevector(x, y, i, 16 + i, i + 1, 17 + i, i + 2, 18 + i, i + 3, 19 + i, i + 4,   \
                            20 + i, i + 5, 21 + i, i + 6, 22 + i, i + 7, 23 + i)
    pixel_row rg[2] = {PAIRS(r, g, 0), PAIRS(r, g, 8)}, ba[2] = {PAIRS(b, a, 0), PAIRS(b, a, 8)};
#else
#define PAIRS(x, y, i)                                                                             \
    __builtin_shufflevector(x, y, i, 8 + i, i + 1, 9 + i, i + 2, 10 + i, i + 3, 11 + i, i + 4,     \
                            12 + i, i + 5, 13 + i, i + 6, 14 + i, i + 7, 15 + i)
    pixel_row rg[1] = {PAIRS(r, g, 0)}, ba[1] = {PAIRS(b, a, 0)};
#endif
#pragma unroll
    for (int pair = 0; pair < PACKET_HEIGHT / 2; pair++) {
        rows[2 * pair] = __builtin_shufflevector(rg[pair], ba[pair], 0, 1, 16, 17, 2, 3, 18, 19, 4,
                                                 5, 20, 21, 6, 7, 22, 23);
        rows[2 * pair + 1] = __builtin_shufflevector(rg[pair], ba[pair], 8, 9, 24, 25, 10, 11, 26,
                                                     27, 12, 13, 28, 29, 14, 15, 30, 31);
    }
#undef PAIRS
}
#endif
#endif

// ---- Vectors of three, one for each ray --------------------------------------------------------

typedef struct real3 {
    real x, y, z;
} real3;

static inline real3 real3_of(real x, real y, real z)
{
    real3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline real3 add(real3 a, real3 b) { return real3_of(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline real3 subtract(real3 a, real3 b)
{
    return real3_of(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline real3 negate(real3 a) { return real3_of(-a.x, -a.y, -a.z); }
static inline real3 scale(real3 a, real s) { return real3_of(a.x * s, a.y * s, a.z * s); }
static inline real3 multiply(real3 a, real3 b)
{
    return real3_of(a.x * b.x, a.y * b.y, a.z * b.z);
}

// a s + b
static inline real3 scale_add(real3 a, real s, real3 b)
{
    return real3_of(fused(a.x, s, b.x), fused(a.y, s, b.y), fused(a.z, s, b.z));
}

static inline real dot3(real3 a, real3 b) { return fused(a.x, b.x, fused(a.y, b.y, a.z * b.z)); }

static inline real3 cross3(real3 a, real3 b)
{
    return real3_of(fused(a.y, b.z, -(a.z * b.y)), fused(a.z, b.x, -(a.x * b.z)),
                    fused(a.x, b.y, -(a.y * b.x)));
}

static inline real3 select3(mask yes, real3 a, real3 b)
{
    return real3_of(SELECT(yes, a.x, b.x), SELECT(yes, a.y, b.y), SELECT(yes, a.z, b.z));
}

static inline real largest3(real3 a)
{
    real xy = LARGER(a.x, a.y);
    return LARGER(xy, a.z);
}

static inline real largest_magnitude3(real3 a)
{
    return largest3(real3_of(fabs(a.x), fabs(a.y), fabs(a.z)));
}

// The unit vector along `a`, and whether there is one: not for zero, infinite or NaN components.
// Dividing by the largest component first keeps the squares clear of overflow and underflow.
static inline real3 normalized(real3 a, mask *valid)
{
    real largest = largest_magnitude3(a);
    // Written so that NaN is not valid: each comparison is false for it.
    *valid = (largest > R(0.0)) & (fabs(a.x) < (scalar)INFINITY) &
             (fabs(a.y) < (scalar)INFINITY) & (fabs(a.z) < (scalar)INFINITY);
    largest = SELECT(*valid, largest, real_of(1));
    real3 b = real3_of(a.x / largest, a.y / largest, a.z / largest);
    real length = sqrt(dot3(b, b));
    return real3_of(b.x / length, b.y / length, b.z / length);
}

// A unit vector that has drifted by a few rounding errors, put right by one step of Newton's
// iteration for 1/√(v·v).
static inline real3 renormalized(real3 v)
{
    return scale(v, R(1.5) - R(0.5) * dot3(v, v));
}
