// Vectors whose lanes are not rays: blocks of 16 values, one for each vertex or triangle of a cluster
// or group of a tile; boxes, one value for each child of a node. And masks of any kind as bits.

// A mask's lanes as bits of a whole number, lane i bit i. Compilers for x86 have an instruction for
// it, which they do not find by themselves.
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

static inline int lowest_bit(uint bits) { return 31 - (int)clz(bits & -bits); }

// Of the packet's rays.
static inline uint mask_bits(mask m)
{
#if GLINT_WIDTH == 16
    return bits_of_16(m);
#elif GLINT_WIDTH == 8
    return bits_of_8(m);
#else
    return m ? 1 : 0;
#endif
}

// ---- Blocks ------------------------------------------------------------------------------------

#if GLINT_DOUBLE
typedef double16 block;
#define load_block(p) convert_double16(vload16(0, p))
#else
typedef float16 block;
#define load_block(p) vload16(0, p)
#endif
typedef MASK_TYPE(16) block_mask;
#define block_of(x) ((block)(scalar)(x))
#define block_bits(m) bits_of_16(m)
#define BLOCK_LANES (block)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)

// Lane i of the result is lane indices[i] of the values.
static inline block permute_block(block values, uchar16 indices)
{
#if HAS_MASK_REGISTERS
    return __builtin_ia32_permvarsf512(values, convert_int16(indices));
#else
    block result;
    for (int i = 0; i < GLINT_CLUSTER_LANES; i++) {
        ((scalar *)&result)[i] = ((scalar *)&values)[((uchar *)&indices)[i]];
    }
    return result;
#endif
}

// ---- Boxes -------------------------------------------------------------------------------------

#if GLINT_BVH_WIDTH == 16
#define BOXES(type) type##16
#define load_boxes_float(p) vload16(0, p)
#define box_bits(m) bits_of_16(m)
typedef MASK_TYPE(16) boxes_mask;
#elif GLINT_BVH_WIDTH == 8
#define BOXES(type) type##8
#define load_boxes_float(p) vload8(0, p)
#define box_bits(m) bits_of_8(m)
typedef MASK_TYPE(8) boxes_mask;
#else
#error "GLINT_BVH_WIDTH must be 8 or 16"
#endif
#if GLINT_DOUBLE
typedef BOXES(double) boxes;
#define load_boxes(p) BOXES(convert_double)(load_boxes_float(p))
#else
typedef BOXES(float) boxes;
#define load_boxes(p) load_boxes_float(p)
#endif
