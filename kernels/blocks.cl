// Defines vectors whose lanes are not rays. Blocks have 16 values, one per vertex or triangle of a
// cluster, or one per group of a tile. Boxes have one value per child of a node.

// ---- Blocks ------------------------------------------------------------------------------------

typedef scalar16 block;
typedef MASK_TYPE(16) block_mask;
#if GLINT_DOUBLE
#define load_block(p) convert_double16(vload16(0, p))
#define to_block(integers) convert_double16(integers)
#else
#define load_block(p) vload16(0, p)
#define to_block(integers) convert_float16(integers)
#endif
#define block_of(x) ((block)(scalar)(x))
#define block_bits(m) bits_of_16(m)
// The lanes' numbers, as whole numbers, and as values to compare with.
#define BLOCK_NUMBERS (block_mask)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define BLOCK_LANES to_block(BLOCK_NUMBERS)

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
