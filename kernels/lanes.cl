// Defines the lanes of a packet of rays at each width and precision. Other files loop over
// GLINT_WIDTH lanes only to gather or scatter. For everything else they use the types and functions
// here.
//
// `real` is one value per ray of the packet: a scalar for GLINT_WIDTH 1, else a vector of 8 or 16.
// Its elements are float or, with GLINT_DOUBLE, double. `mask` holds yes or no per ray, `lanes_int`
// a whole number per ray. Both have elements of the same size as real, so each can select between
// the others. A comparison gives 1 for scalars and −1 for vectors. So masks are only combined with
// & and |, negated with !, and read through any_lane, lane_is_set and select_….
//
// The same source gives the same bits at every width: contraction is off, and code that wants a
// fused multiply-add calls fused().
#pragma OPENCL FP_CONTRACT OFF

#if GLINT_DOUBLE
#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
typedef double scalar;
typedef double4 scalar4;
typedef double8 scalar8;
#define TO_SCALAR4(numbers) convert_double4(numbers)
#define TO_SCALAR8(numbers) convert_double8(numbers)
#define R(literal) literal
#define EPSILON 0x1p-53 // half the distance from 1 to the next value: the largest rounding error
#else
typedef float scalar;
typedef float4 scalar4;
typedef float8 scalar8;
#define TO_SCALAR4(numbers) convert_float4(numbers)
#define TO_SCALAR8(numbers) convert_float8(numbers)
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

// The packet covers PACKET_WIDTH × PACKET_HEIGHT pixels; its lanes run row by row.
#define PACKET_WIDTH GLINT_PACKET_COLUMNS(GLINT_WIDTH)
#define PACKET_HEIGHT GLINT_PACKET_ROWS(GLINT_WIDTH)

// A number that the host passes as an unevaluated sum of two floats.
#if GLINT_DOUBLE
#define JOIN(high, low) ((scalar)(high) + (scalar)(low))
#else
#define JOIN(high, low) (high)
#endif

// Reinterprets the bits of an integer as a number, and the bits of a number as an integer.
#if GLINT_DOUBLE
#define AS_REAL_(width) as_double##width
#define AS_INT_(width) as_long##width
#else
#define AS_REAL_(width) as_float##width
#define AS_INT_(width) as_int##width
#endif
#define AS_REAL(width) AS_REAL_(width)
#define AS_INT(width) AS_INT_(width)
#if GLINT_WIDTH == 1
#define real_from_bits(integers) AS_REAL()(integers)
#define bits_from_real(number) AS_INT()(number)
#else
#define real_from_bits(integers) AS_REAL(GLINT_WIDTH)(integers)
#define bits_from_real(number) AS_INT(GLINT_WIDTH)(number)
#endif

// One lane of a value, to read or to write.
#define LANE(value, lane) (((scalar *)&(value))[lane])
#define LANE_INT(value, lane) (((lane_int *)&(value))[lane])

// yes ? a : b, lane by lane. A NaN in the value that is not selected does no harm.
#define SELECT(yes, a, b) ((yes) ? (a) : (b))

// The smaller and the larger value. If `a` is NaN the result is b.
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define SMALLEST3(a, b, c) SMALLER(SMALLER(a, b), c)
#define LARGEST3(a, b, c) LARGER(LARGER(a, b), c)

// a × b + c, rounded once if the device has an instruction for it (OpenCL defines FP_FAST_FMAF,
// PoCL's compiler __FMA__). Elsewhere fma() would be a slow function of many instructions.
#if defined(FP_FAST_FMAF) || defined(__FMA__)
#define fused(a, b, c) fma(a, b, c)
#else
#define fused(a, b, c) ((a) * (b) + (c))
#endif

// a b − c d within 1.5 units in the last place. The plain difference of rounded products may have
// no correct digit. (Kahan; Jeannerod, Louvet and Muller, Further analysis of Kahan's algorithm,
// 2013.)
#define DIFFERENCE_OF_PRODUCTS(a, b, c, d) (fma(a, b, -((c) * (d))) + fma(-(c), d, (c) * (d)))

// clang's reductions become one or two instructions; the portable form folds halves. Interpreters
// such as Oclgrind accept the reductions and cannot run them: -DGLINT_NO_REDUCTIONS selects the
// portable form. SPIR-V has no instruction for them, so drivers that compile to it (Mesa's rusticl)
// also take the portable form.
#if (defined(__SPIR) || defined(__SPIRV__)) && !defined(GLINT_NO_REDUCTIONS)
#define GLINT_NO_REDUCTIONS
#endif
#if defined(__has_builtin) && !defined(GLINT_NO_REDUCTIONS)
#if __has_builtin(__builtin_reduce_or)
#define REDUCE_OR(m) __builtin_reduce_or(m)
#endif
#endif

// The lanes of a mask as bits of a whole number: lane i is bit i. x86 has an instruction for it,
// which compilers do not find by themselves.
#if defined(__AVX512DQ__) && !GLINT_DOUBLE && !defined(GLINT_NO_REDUCTIONS)
#define HAS_MASK_REGISTERS 1
#else
#define HAS_MASK_REGISTERS 0
#endif
#define LANE_BITS_8 1, 2, 4, 8, 16, 32, 64, 128
#define LANE_BITS_16 LANE_BITS_8, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768
#if GLINT_DOUBLE
#define MASK_TYPE(width) long##width
#else
#define MASK_TYPE(width) int##width
#endif

static inline uint bits_of_16(MASK_TYPE(16) m)
{
#if HAS_MASK_REGISTERS
    return (uint)(ushort)__builtin_ia32_cvtd2mask512(m);
#else
    MASK_TYPE(16) bits = m & (MASK_TYPE(16))(LANE_BITS_16);
#ifdef REDUCE_OR
    return (uint)REDUCE_OR(bits);
#else
    MASK_TYPE(8) eight = bits.lo | bits.hi;
    MASK_TYPE(4) four = eight.lo | eight.hi;
    return (uint)(four.x | four.y | four.z | four.w);
#endif
#endif
}

// bits_of_16 for 32-bit numbers, at both precisions.
#if GLINT_DOUBLE
static inline uint bits_of_int16(int16 m) { return bits_of_16(convert_long16(m)); }
#else
static inline uint bits_of_int16(int16 m) { return bits_of_16(m); }
#endif

static inline uint bits_of_8(MASK_TYPE(8) m)
{
#if HAS_MASK_REGISTERS
    return (uint)(uchar)__builtin_ia32_cvtd2mask256(m);
#else
    MASK_TYPE(8) bits = m & (MASK_TYPE(8))(LANE_BITS_8);
#ifdef REDUCE_OR
    return (uint)REDUCE_OR(bits);
#else
    MASK_TYPE(4) four = bits.lo | bits.hi;
    return (uint)(four.x | four.y | four.z | four.w);
#endif
#endif
}

#if defined(__has_builtin) && !defined(GLINT_NO_REDUCTIONS)
#if __has_builtin(__builtin_ctz)
#define HAS_CTZ
#endif
#endif

static inline int lowest_bit(uint bits)
{
#ifdef HAS_CTZ
    return __builtin_ctz(bits);
#else
    return 31 - (int)clz(bits & -bits);
#endif
}

// Stores the numbers that `bits` selects side by side in `list`. It may also overwrite the rest of
// the list's first 16 entries with values without meaning.
static inline void store_chosen(int16 numbers, uint bits, int *list)
{
#if HAS_MASK_REGISTERS
    vstore16(__builtin_ia32_compresssi512_mask(numbers, (int16)0, (ushort)bits), 0, list);
#else
    for (; bits != 0; bits &= bits - 1) {
        *list++ = ((int *)&numbers)[lowest_bit(bits)];
    }
#endif
}

#if GLINT_DOUBLE
typedef double16 scalar16;
typedef double2 scalar2;
#else
typedef float16 scalar16;
typedef float2 scalar2;
#endif

static inline scalar smallest_of_8(scalar8 a)
{
    scalar4 four = SMALLER(a.lo, a.hi);
    scalar2 two = SMALLER(four.lo, four.hi);
    return SMALLER(two.x, two.y);
}

static inline scalar smallest_of_16(scalar16 a) { return smallest_of_8(SMALLER(a.lo, a.hi)); }

static inline scalar largest_of_16(scalar16 a) { return -smallest_of_16(-a); }

static inline scalar sum_of_16(scalar16 a)
{
    scalar8 eight = a.lo + a.hi;
    scalar4 four = eight.lo + eight.hi;
    scalar2 two = four.lo + four.hi;
    return two.x + two.y;
}

static inline bool has_several_bits(uint bits) { return (bits & (bits - 1)) != 0; }

#if GLINT_WIDTH == 1

#define real_of(x) ((real)(x))
#define int_of(x) ((lanes_int)(x))
#define mask_none() 0
#define mask_all() 1
#define to_real(integers) ((real)(integers))
#define to_int_down(value) ((lanes_int)floor(value))
#define to_int_truncated(value) ((lanes_int)(value))
#define mask_bits(m) ((uint)(m))
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
#define to_int_truncated(value) CONVERT_INT(GLINT_WIDTH)(value)

#if GLINT_WIDTH == 16
#define mask_bits(m) bits_of_16(m)
#define smallest_lane(a) smallest_of_16(a)
#else
#define mask_bits(m) bits_of_8(m)
#define smallest_lane(a) smallest_of_8(a)
#endif
static inline bool any_lane(mask m) { return mask_bits(m) != 0; }
static inline int count_lanes(mask m) { return (int)popcount(mask_bits(m)); }
static inline bool lane_is_set(mask m, int lane) { return LANE_INT(m, lane) != 0; }

static inline scalar largest_lane(real a) { return -smallest_lane(-a); }

// Adds in a fixed order, lane by lane, so that every build gives the same sum.
static inline scalar sum_of_lanes(real a)
{
    scalar sum = 0;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        sum += LANE(a, lane);
    }
    return sum;
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

// Takes the lowest ray of `left` and all others with the same number out of `left`. Returns these
// rays and sets their number. Neighbouring rays tend to share what they hit, so shared data is
// fetched once.
static inline mask next_alike(lanes_int numbers, uint *left, int *number)
{
    *number = (int)LANE_INT(numbers, lowest_bit(*left));
    mask alike = numbers == (lane_int)*number;
    *left &= ~mask_bits(alike);
    return alike;
}

// Prefetches the cache line of 64 bytes at `p`, if the target has a cache and an instruction for
// it. The compiler's builtin wants a pointer to private memory.
#if defined(__x86_64__) && defined(__has_builtin) && !defined(GLINT_NO_REDUCTIONS)
#if __has_builtin(__builtin_prefetch)
#define prefetch_line(p) __builtin_prefetch((const void *)(uintptr_t)(p))
#endif
#endif
#ifndef prefetch_line
#define prefetch_line(p)
#endif

static inline void prefetch_values(global const float *values, int count)
{
#pragma unroll
    for (int i = 0; i < count; i += 16) {
        prefetch_line(values + i);
    }
}

// ---- Pixels, as memory holds them: [lane][R, G, B, alpha] --------------------------------------

// A packet's pixels are rows of PACKET_WIDTH.
#define PIXEL_VALUES (4 * GLINT_WIDTH)
#if GLINT_WIDTH == 1
typedef scalar4 pixel_row;
#define load_pixel_row(row, pixels) vload4(row, pixels)
#define store_pixel_row(values, row, pixels) vstore4(values, row, pixels)
#else
#if GLINT_DOUBLE
typedef double16 pixel_row;
#else
typedef float16 pixel_row;
#endif
#define load_pixel_row(row, pixels) vload16(row, pixels)
#define store_pixel_row(values, row, pixels) vstore16(values, row, pixels)
#endif

// The same colours with alpha set to 0 or 1.
#if GLINT_WIDTH == 1
#define IS_COLOR (MASK_TYPE(4))(-1, -1, -1, 0)
#else
#define IS_COLOR (MASK_TYPE(16))(-1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0)
#endif
#define without_alpha(row) (IS_COLOR ? (row) : (pixel_row)0)
#define opaque(row) (IS_COLOR ? (row) : (pixel_row)1)

// Stores a row of pixels past the caches if the target can, because no code here reads it again.
// `pixels` is aligned to the row's size.
#if GLINT_WIDTH > 1 && defined(__has_builtin) && !defined(GLINT_NO_REDUCTIONS)
#if __has_builtin(__builtin_nontemporal_store)
#define stream_pixel_row(values, pixels)                                                           \
    __builtin_nontemporal_store(values, (global pixel_row *)(pixels))
#endif
#endif
#ifndef stream_pixel_row
#define stream_pixel_row(values, pixels) store_pixel_row(values, 0, pixels)
#endif

#if GLINT_WIDTH > 1 && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define HAS_SHUFFLES
#endif
#endif

#ifdef HAS_SHUFFLES
#if GLINT_WIDTH == 16
#define PAIRS(x, y, i)                                                                             \
    __builtin_shufflevector(x, y, i, 16 + i, i + 1, 17 + i, i + 2, 18 + i, i + 3, 19 + i, i + 4,   \
                            20 + i, i + 5, 21 + i, i + 6, 22 + i, i + 7, 23 + i)
#else
#define PAIRS(x, y, i)                                                                             \
    __builtin_shufflevector(x, y, i, 8 + i, i + 1, 9 + i, i + 2, 10 + i, i + 3, 11 + i, i + 4,     \
                            12 + i, i + 5, 13 + i, i + 6, 14 + i, i + 7, 15 + i)
#endif

// Stores eight pixels from their pairs (R, G) and (B, alpha).
static inline void store_eight_pixels(pixel_row rg, pixel_row ba, scalar *pixels)
{
    vstore16(
        __builtin_shufflevector(rg, ba, 0, 1, 16, 17, 2, 3, 18, 19, 4, 5, 20, 21, 6, 7, 22, 23), 0,
        pixels);
    vstore16(__builtin_shufflevector(rg, ba, 8, 9, 24, 25, 10, 11, 26, 27, 12, 13, 28, 29, 14, 15,
                                     30, 31),
             1, pixels);
}

static inline void to_pixels(real r, real g, real b, real a, scalar pixels[PIXEL_VALUES])
{
    store_eight_pixels(PAIRS(r, g, 0), PAIRS(b, a, 0), pixels);
#if GLINT_WIDTH == 16
    store_eight_pixels(PAIRS(r, g, 8), PAIRS(b, a, 8), pixels + 32);
#endif
}
#undef PAIRS
#else
static inline void to_pixels(real r, real g, real b, real a, scalar pixels[PIXEL_VALUES])
{
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        vstore4((scalar4)(LANE(r, lane), LANE(g, lane), LANE(b, lane), LANE(a, lane)), lane,
                pixels);
    }
}
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
static inline real3 subtract(real3 a, real3 b) { return real3_of(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline real3 negate(real3 a) { return real3_of(-a.x, -a.y, -a.z); }
static inline real3 scale(real3 a, real s) { return real3_of(a.x * s, a.y * s, a.z * s); }
static inline real3 multiply(real3 a, real3 b) { return real3_of(a.x * b.x, a.y * b.y, a.z * b.z); }

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

static inline real3 smaller3(real3 a, real3 b)
{
    return real3_of(SMALLER(a.x, b.x), SMALLER(a.y, b.y), SMALLER(a.z, b.z));
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

// Sets the masks of the rays whose largest component is x, and y; else it is z. On a tie the order
// x, y, z decides, as in ImfEnvmap.h.
static inline void find_major(real3 d, mask *x, mask *y)
{
    real ax = fabs(d.x), ay = fabs(d.y), az = fabs(d.z);
    *x = (ax >= ay) & (ax >= az);
    *y = !*x & (ay >= az);
}

// 1/√x for x in [2⁻⁶⁰, 2⁶⁰], within 2 units in the last place. Newton's iteration starts from an
// estimate by the exponent; the error is 0.2%, then 5e-6, then 4e-11 (Lomont, Fast Inverse Square
// Root, 2003). It gives the same on every device, in a third of the time of a root and a division.
static inline real inverse_root(real x)
{
#if GLINT_DOUBLE
    return R(1.0) / sqrt(x);
#else
    real y = real_from_bits(0x5f375a86 - (bits_from_real(x) >> 1));
    y = y * fused(x * y, R(-0.5) * y, real_of(1.5f));
    y = y * fused(x * y, R(-0.5) * y, real_of(1.5f));
    return y * fused(x * y, R(-0.5) * y, real_of(1.5f));
#endif
}

// 2⁻ᵉ for a in [2ᵉ, 2ᵉ⁺¹), and about 2⁻ᵉ for values near the ends of the range. A product of `a`
// with it is exact and safe from overflow and underflow.
static inline real inverse_exponent(real a)
{
#if GLINT_DOUBLE
    const lane_int mask_of_exponent = 0x7ff0000000000000L, most = 0x7fd0000000000000L;
    const lane_int twice_the_bias = 0x7fe0000000000000L;
#else
    const lane_int mask_of_exponent = 0x7f800000, most = 0x7e800000, twice_the_bias = 0x7f000000;
#endif
    lanes_int bits = bits_from_real(a) & mask_of_exponent;
    bits = bits < most ? bits : int_of(most);
    return real_from_bits(twice_the_bias - bits);
}

// The exponent e of a finite a in [2ᵉ, 2ᵉ⁺¹).
static inline lanes_int exponent_of(real a)
{
#if GLINT_DOUBLE
    return ((bits_from_real(a) >> 52) & 0x7ff) - 1023;
#else
    return ((bits_from_real(a) >> 23) & 0xff) - 127;
#endif
}

// A vector along `a` of a moderate length, whose square is safe from overflow and underflow.
// `valid` is false for zero, infinite and NaN components.
static inline real3 moderate(real3 a, mask *valid)
{
    real largest = largest_magnitude3(a);
    // Each comparison is false for NaN, so NaN is not valid.
    *valid = (largest > R(0.0)) & (fabs(a.x) < (scalar)INFINITY) & (fabs(a.y) < (scalar)INFINITY) &
             (fabs(a.z) < (scalar)INFINITY);
    return scale(a, inverse_exponent(SELECT(*valid, largest, real_of(1))));
}

// The unit vector along `a`; `valid` says if there is one.
static inline real3 normalized(real3 a, mask *valid)
{
    real3 b = moderate(a, valid);
    return scale(b, inverse_root(dot3(b, b)));
}

// True if all components are 0 or −0.
static inline mask is_zero3(real3 a)
{
    const lanes_int bits = bits_from_real(a.x) | bits_from_real(a.y) | bits_from_real(a.z);
    return (bits << 1) == (lane_int)0;
}

// Corrects a unit vector that has drifted by a few rounding errors, by one step of Newton's
// iteration for 1/√(v·v).
static inline real3 renormalized(real3 v) { return scale(v, R(1.5) - R(0.5) * dot3(v, v)); }
