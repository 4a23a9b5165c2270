// The facts that the host and the kernels share: read by a C compiler and by OpenCL C alike.
// Structs hold 32-bit scalars only, so that both compilers lay them out alike: the host asserts
// their sizes (host/render/upload.c), and a test asks the device for its own
// (tests/test_kernels.c).
#ifndef GLINT_KERNELS_LAYOUT_H
#define GLINT_KERNELS_LAYOUT_H

// A vector as an unevaluated sum of two floats; float precision uses the first alone.
typedef struct glint_split_vector {
    float high[4], low[4];
} glint_split_vector;

// ---- Cube map ----------------------------------------------------------------------------------
// Faces in the order +X −X +Y −Y +Z −Z, oriented as in OpenEXR's ImfEnvmap.h: seen from inside,
// unmirrored. On a face, s runs to the right and t downwards, each in [−1, 1]; the direction is the
// face's axis plus s along one axis and t along another:
//   face   +X  −X  +Y  −Y  +Z  −Z
//   s is   +z  −z  +x  +x  −x  +x
//   t is   −y  −y  −z  +z  −y  −y
// Texel (column i, row j) of a face of edge N has its centre at s = (2i + 1)/N − 1, t likewise, and
// each face carries a border of one texel: [6][N + 2][N + 2][4] floats (R, G, B, unused), or halfs
// for the environment where the kernels are compiled with GLINT_HALF_TEXELS.
// (Keep the lists: both compilers initialise constant arrays from them.)
#define GLINT_CUBE_FACES 6
#define GLINT_CUBE_S_AXIS                                                                          \
    {                                                                                              \
        2, 2, 0, 0, 0, 0                                                                           \
    }
#define GLINT_CUBE_S_SIGN                                                                          \
    {                                                                                              \
        1, -1, 1, 1, -1, 1                                                                         \
    }
#define GLINT_CUBE_T_AXIS                                                                          \
    {                                                                                              \
        1, 1, 2, 2, 1, 1                                                                           \
    }
#define GLINT_CUBE_T_SIGN                                                                          \
    {                                                                                              \
        -1, -1, -1, 1, -1, -1                                                                      \
    }
#define GLINT_CUBE_BORDER 1
// With GLINT_MIP_LEVELS or GLINT_FACETS coarser maps follow in the same buffer, each with half of
// the last one's edge, rounded down, to the edge 1: at most so many with the first.
#define GLINT_LEVELS_MAX 14

// ---- Lobes -------------------------------------------------------------------------------------
// What rough surfaces (GLINT_ROUGH) read, floats. First a table of how much a lobe reflects of a
// white environment, without and with Fresnel's (1 − v·h)⁵: ∫ D V (1 − m) n·l dl and ∫ D V m n·l
// dl, by [roughness from 0 to 1][√(n·v) from 0 to 1], in equal steps. Then, alike, how much sheen
// of white reflects, and 0, by roughness from NARROW to 1; all 0 without GLINT_SHEEN.
#define GLINT_ALBEDO_ROUGHNESSES 32
#define GLINT_ALBEDO_COSINES 32
#define GLINT_ALBEDO_VALUES (2 * GLINT_ALBEDO_ROUGHNESSES * GLINT_ALBEDO_COSINES)
// Then how bright the environment is, R + G + B: the square of √(R + G + B)'s mean, on which suns
// weigh little; and seven floats that are not used.
#define GLINT_LOBES_BRIGHTNESS (2 * GLINT_ALBEDO_VALUES)
// Then the environment as cells. Level 0 has GLINT_CELLS_ROOT cells along a face's edge, each other
// level twice as many as the last. A level is [6][edge²] cells; those of a face stand in Morton
// order: the even bits of a cell's place are its column's, the odd ones its row's. So a cell's
// parts stand together at four times its place. A cell is its centroid, a unit vector, by how
// bright its parts are; about how wide it is, as an angle; ∫ E dω of R, G, B; and the variance of
// where its light comes from, along one axis, in squared radians.
#define GLINT_LOBES_CELLS (GLINT_LOBES_BRIGHTNESS + GLINT_CELL_VALUES)
#define GLINT_CELL_VALUES 8
#define GLINT_CELLS_ROOT 2
#define GLINT_CELLS_LEVELS 9 // at most
// The cells before a level.
#define GLINT_CELLS_FIRST(level)                                                                   \
    ((size_t)(GLINT_CUBE_FACES * GLINT_CELLS_ROOT * GLINT_CELLS_ROOT / 3) *                        \
     (((size_t)1 << (2 * (level))) - 1))
// How large a cell is, is said beside the width over which the lobe varies: as an angle of h,
// √(α² + sin² θ_h), but no more than √(WIDEST (1 + TAIL/α²)), beyond which n·l turns light and
// shadow. It errs, about, by what it brings times the fourth power of that ratio, and is too large
// where that is more than the frame's tolerance of the brightness, or the ratio's square more than
// LARGEST. Measured: so all roughnesses err alike. Where the pixel sees w of the lobe, what a cell
// brings is w of that, and LARGEST is 1 + α (1/√w − 1) times as much.
#define GLINT_LOBE_WIDEST 0.1f
#define GLINT_LOBE_TAIL 0.1f
#define GLINT_CELL_LARGEST 6.25f
// Roughness below LEAST counts as none. Lobes below NARROW are narrower than a cell of the finest
// level; sheen is as if it had NARROW at least.
#define GLINT_ROUGHNESS_LEAST 0.01f
#define GLINT_ROUGHNESS_NARROW 0.07f
// The coat of paint from MATTE on sees the environment alone, as what is beneath it does; below
// SHARP it sees surfaces; and in between a share of them.
#define GLINT_COAT_SHARP 0.3f
#define GLINT_COAT_MATTE 0.6f

// ---- Tree --------------------------------------------------------------------------------------
// A node of width B is 7 × B 32-bit values: the children's low x, low y, low z, high x, high y,
// high z (floats, B of each), then B ints that name the children: 0 or more is a node's index;
// below 0 is a leaf, the complement of a cluster's index. A child that is not there has both
// corners of its box at (GLINT_FAR, GLINT_FAR, GLINT_FAR), where no ray arrives, and is named 0.
#define GLINT_NODE_VALUES 7
#define GLINT_FAR 1e30f // farther than any hit; finite, as ∞ would give NaN when multiplied by 0

// A leaf is one cluster: up to 16 triangles of one material and the vertices that they share, at
// most 16. It is 64 32-bit values, 256 bytes aligned to 64:
//   x[16], y[16], z[16]     floats: the vertices' positions in stored coordinates, from the anchor
//   3 × 16 bytes            the triangles' first, second and third corner, each a vertex's lane
//   count + 32 × material   an int: how many triangles there are, 1 to 16, and their material
//   anchor x, y, z          floats: what to add to the positions, with GLINT_LOCAL_ORIGINS; else 0
// Lanes past the last vertex repeat the first; triangles past the last have corners 0, 0, 0.
// Clusters stand in the order of the leaves, left to right, whatever the nodes' width. A triangle's
// place is cluster × 16 + its lane. Beside the clusters stand
//   the shading normals     floats, per cluster x[16], y[16], z[16] by vertex, (0, 0, 0) for none
//   the triangles' numbers  ints, by place: the triangle's number in the scene, which decides
//                           ties; −1 in lanes without a triangle
#define GLINT_CLUSTER_LANES 16
#define GLINT_CLUSTER_VALUES 64
#define GLINT_CLUSTER_CORNERS 48 // where the corners begin, in values
#define GLINT_CLUSTER_FACTS 60   // count and material
#define GLINT_CLUSTER_COUNT_BITS 5
#define GLINT_CLUSTER_COUNT_MASK 31
#define GLINT_CLUSTER_ANCHOR 61
#define GLINT_CLUSTER_NORMALS 48 // values of normals per cluster
// The largest number of triangles that a place can name even if each has a cluster of its own.
#define GLINT_TRIANGLES_MAX ((1u << 27) - 1)

// ---- Materials ---------------------------------------------------------------------------------
#define GLINT_MATERIAL_SOLID 1u        // transmits, and bounds a solid
#define GLINT_MATERIAL_THIN 2u         // transmits, without thickness
#define GLINT_MATERIAL_UNLIT 4u        // the base colour, and the path ends
#define GLINT_MATERIAL_BLEND 8u        // the lecture's blend: `blend` is the mirror's share
#define GLINT_MATERIAL_GLOSS 16u       // paint of roughness 0: reflects under its Fresnel term
#define GLINT_MATERIAL_MASK 32u        // is there where its alpha is alpha_cutoff or more
#define GLINT_MATERIAL_COVER 64u       // its alpha is how much of it is there
#define GLINT_MATERIAL_DISPERSIVE 128u // a solid whose index of refraction depends on wavelength

// Slots of a material's textures: glint_texture_slot of host/scene/texture.h.
#define GLINT_SLOT_BASE_COLOR 0
#define GLINT_SLOT_METALLIC_ROUGHNESS 1
#define GLINT_SLOT_OCCLUSION 2
#define GLINT_SLOT_NORMAL 3
#define GLINT_SLOT_EMISSION 4
#define GLINT_SLOT_TRANSMISSION 5
#define GLINT_SLOT_SPECULAR 6
#define GLINT_SLOT_SPECULAR_COLOR 7
#define GLINT_SLOT_CLEARCOAT 8
#define GLINT_SLOT_CLEARCOAT_ROUGHNESS 9
#define GLINT_SLOT_CLEARCOAT_NORMAL 10
#define GLINT_SLOT_IRIDESCENCE 11
#define GLINT_SLOT_IRIDESCENCE_THICKNESS 12
#define GLINT_SLOT_ANISOTROPY 13
#define GLINT_SLOT_SHEEN_COLOR 14
#define GLINT_SLOT_SHEEN_ROUGHNESS 15
#define GLINT_SLOT_DIFFUSE_TRANSMISSION 16
#define GLINT_SLOT_DIFFUSE_TRANSMISSION_COLOR 17
#define GLINT_MATERIAL_TEXTURES 18

typedef struct glint_material_record {
    float base_color[4]; // linear R, G, B; A
    float emission[4];   // radiance R, G, B; 0
    float metallic;      // [0, 1]
    float transmission;  // [0, 1]
    float ior;           // ≥ 1
    float blend;         // [0, 1], see GLINT_MATERIAL_BLEND
    unsigned int flags;  // GLINT_MATERIAL_…
    unsigned int medium; // of a solid: its place in the media, 1 or more; else 0
    float alpha_cutoff;  // see GLINT_MATERIAL_MASK
    float normal_scale;  // of the normal texture
    float occlusion_strength;
    float roughness;                       // [0, 1]
    float specular;                        // [0, 1], with GLINT_SPECULAR
    float specular_color[3];               // ≥ 0, likewise
    float clearcoat;                       // [0, 1], with GLINT_CLEARCOAT, as the next two
    float clearcoat_roughness;             // [0, 1]
    float clearcoat_normal_scale;          // of the clear coat's normal texture
    float iridescence;                     // [0, 1], with GLINT_IRIDESCENCE, as the next two
    float iridescence_ior;                 // of the film, ≥ 1
    float iridescence_thickness[2];        // nm: where the texture is 0 and 1; without one the last
    float anisotropy;                      // [0, 1], with GLINT_BRUSHED, as the next
    float brush_direction[2];              // unit, along tangent and bitangent
    float sheen_color[3];                  // [0, 1], with GLINT_SHEEN, as the next; 0: none
    float sheen_roughness;                 // [0, 1]
    float diffuse_transmission;            // [0, 1], with GLINT_DIFFUSE_TRANSMISSION, as the next
    float diffuse_transmission_color[3];   // [0, 1]
    int textures[GLINT_MATERIAL_TEXTURES]; // places in the textures; −1: none
} glint_material_record;

// ---- Textures ----------------------------------------------------------------------------------
// All texels stand in one array: [4] 16-bit whole numbers, R, G, B, A, linear, in 1/65535. A
// texture's levels follow each other; each is rows of texels from the top. Level k is
// max(1, width >> k) by max(1, height >> k). Right of each row and below all of them comes what a
// repeated texture shows there: the first texel again, and the first row.
#define GLINT_TEXTURE_BORDER 1
#define GLINT_TEXTURE_LEVELS 16  // at most, so that an image is 32768 wide and high at most
#define GLINT_TEXTURE_SECOND 1u  // looked up by the second texture coordinates
#define GLINT_TEXTURE_CLAMP_S 2u // else repeated, or mirrored
#define GLINT_TEXTURE_CLAMP_T 4u
#define GLINT_TEXTURE_MIRROR_S 8u
#define GLINT_TEXTURE_MIRROR_T 16u
#define GLINT_TEXTURE_MAGNIFIED_NEAREST 32u // where a texel covers a pixel or more
#define GLINT_TEXTURE_MINIFIED_NEAREST 64u
#define GLINT_TEXTURE_MIPS_NEAREST 128u // one level, not a blend of two
#define GLINT_TEXTURE_TRILINEAR 256u    // minified, a blend of texels and of levels

typedef struct glint_texture_record {
    unsigned int first[GLINT_TEXTURE_LEVELS]; // texels before each level
    int width, height;                        // of level 0
    int levels;                               // that are looked up
    unsigned int flags;                       // GLINT_TEXTURE_…
    float transform[6];                       // of u and v, see glint_texture_use
    int alike;                                // the same number: they differ in texels alone
    unsigned int unused;
} glint_texture_record;

// Medium 0 is empty space. With GLINT_OVERLAPS media stand in the order of their priority: where
// solids overlap, the one with the highest number is there. Absorption is per stored unit of
// length, as an unevaluated sum of two floats, so that double precision keeps what the host
// computed.
typedef struct glint_medium_record {
    float absorption_high[4]; // R, G, B; 0
    float absorption_low[4];
    float ior;
    float dispersion; // with GLINT_DISPERSION: what is added to that, see glint_wavelength_record
    int material;     // media of one material do not differ
    float unused;
} glint_medium_record;

// With GLINT_OVERLAPS, by the triangles' numbers: which solid a triangle is part of.
#define GLINT_SOLID_TOUCHES 0x40000000u // it may be in one place with another solid's
typedef struct glint_solid_record {
    int component;       // triangles of one solid have the same; −1: of none
    unsigned int medium; // its medium, 0: no solid; and GLINT_SOLID_TOUCHES
} glint_solid_record;

// Surfaces are in one place where they are nearer than this share of their coordinates, which are
// rounded to 24 bits. Both precisions have the same, as it is the file's digits that say so.
#define GLINT_TOUCHING 0x1p-21f

// One of the wavelengths that light is divided into by solids that disperse it. A medium has the
// index ior + dispersion × ior_step there, or 1 if that is more. `share` is how much of R, G and B
// it has: the shares of all wavelengths add up to 1.
#define GLINT_WAVELENGTHS_MAX 16
typedef struct glint_wavelength_record {
    float ior_step;
    float share[3];
} glint_wavelength_record;

// ---- Lights ------------------------------------------------------------------------------------
// The scene's punctual lights, behind the last of which stands one of the kind NONE.
#define GLINT_LIGHT_NONE 0u
#define GLINT_LIGHT_POINT 1u
#define GLINT_LIGHT_SPOT 2u
#define GLINT_LIGHT_DIRECTIONAL 3u

typedef struct glint_light_record {
    unsigned int kind;       // GLINT_LIGHT_…
    float position[3];       // stored coordinates; not of a directional light
    glint_split_vector axis; // unit, the way that the light shines
    // R, G, B: irradiance over π at right angles to the light; of a point or a spot 1 stored unit
    // away.
    glint_split_vector color;
    float inverse_range[2]; // 1/range², per stored unit squared: high, low; 0: no end
    float outer_cosine[2];  // of a spot: of its half angle
    float cone_scale[2];    // of a spot: 1/(cos inner − cos outer)
    unsigned int unused[2];
} glint_light_record;

// ---- Packets -----------------------------------------------------------------------------------
// A packet of rays covers columns × rows of pixels, lanes row by row.
#define GLINT_PACKET_COLUMNS(lanes) ((lanes) == 1 ? 1 : 4)
#define GLINT_PACKET_ROWS(lanes) ((lanes) / GLINT_PACKET_COLUMNS(lanes))
// A tile is what one work-item renders: one packet, or 4 × 4 packets beside each other.
#define GLINT_TILE_SIDE(tiles) ((tiles) ? 4 : 1)

// ---- Frame -------------------------------------------------------------------------------------
// Values that may change from frame to frame without compiling again.

// The primary ray through the point (px, py) of the image plane, in pixels from the top left, with
// X = px − width/2 and Y = height/2 − py, starts at origin + X origin_x + Y origin_y and runs along
// direction + X direction_x + Y direction_y (stored coordinates, not normalised). The start has
// been moved forwards from the eye to where the scene begins, by `start` times the direction: a
// distant camera then loses no digits in the differences between vertices and origin.
typedef struct glint_frame_record {
    glint_split_vector origin, origin_x, origin_y;
    glint_split_vector direction, direction_x, direction_y;
    // Image coordinates of a point p in stored ones: x = image_x·(p − origin), y and z likewise,
    // h = image_offset + image_slope z; the rays through (X, Y) are the points with x = X h and
    // y = Y h, and z is their depth, in units of `direction`. A depth's key is 1/h where
    // key_is_inverse is 1, else −z/h.
    glint_split_vector image_x, image_y, image_z;
    float image_offset[2]; // high, low
    float image_slope;     // 1, or 0 for parallel rays
    int key_is_inverse;
    float start[2];        // how far the start was moved, in lengths of the direction: high, low
    float env_rotation[4]; // cosine high, low, sine high, low
    // With GLINT_PROXY: where the environment was seen from, and the box, its middle and its half
    // extent along each axis, on which all of it is taken to lie; of a sphere the radius thrice.
    glint_split_vector proxy_center, proxy_middle, proxy_half;
    int proxy_is_sphere;
    float min_weight;  // a branch whose largest weight is below takes the environment
    int width, height; // pixels that are rendered: of the image's every `step`th of every
                       // `step`th row, from `first_pixel` on; all of them where step is 1. With
                       // GLINT_PIXEL_LIST [height][width] uints name them, row by row of the image
    int image_width, image_height;
    int step, first_pixel;
    int samples_per_axis; // k
    // All samples are rendered so often, with GLINT_FACETS and with GLINT_DISPERSION (then so often
    // for each wavelength); after the first time, of pixels alone whose paths met rough glass, or
    // what disperses light.
    int facet_rounds;
    int wavelengths;
    glint_wavelength_record wavelength[GLINT_WAVELENGTHS_MAX];
    int depth;            // surfaces that a path meets at most, 1 or more
    int depth_counts;     // with GLINT_TRUNCATION_SQUARES: what that cuts short counts, too
    int environment_edge; // texels, without border
    int irradiance_edge;
    // Tiles are rendered band by band, and within one column by column.
    int band;              // how many rows of tiles, 1 or more
    int first_band;        // where this launch begins
    float anisotropy;      // taps of a texture along an ellipse at most, 1 or more
    int cells_last;        // the finest level of cells, with GLINT_ROUGH
    float compensation;    // 1: lobes have what microfacets reflect more than once; 0: they lose it
    float cells_tolerance; // how far off one may be, see GLINT_CELL_LARGEST
    int terms;             // that a pixel keeps at most, with GLINT_TERMS
    float unit;            // metres per stored unit, a power of two; with GLINT_DIAGNOSTICS
} glint_frame_record;

// ---- Irradiance --------------------------------------------------------------------------------
// With GLINT_IRRADIANCE_HARMONICS the irradiance over π is no map but [GLINT_HARMONICS][4] floats,
// R, G, B and one unused, the coefficients of these polynomials of the unit normal:
#define GLINT_HARMONICS 9
#define GLINT_HARMONIC_TERMS(x, y, z)                                                              \
    {                                                                                              \
        1, x, y, z, (x) * (y), (y) * (z), (z) * (x), (x) * (x) - (y) * (y), 3 * (z) * (z)-1        \
    }

// ---- Branches ----------------------------------------------------------------------------------
// What a branch that waits takes (branches.cl, with GLINT_SPLIT), in bytes, where a number of the
// precision takes `number`: eleven of these, two more where rays carry cones, three ints, and one
// more each with GLINT_ALPHA and GLINT_DISPERSION; with GLINT_ROUGH four more numbers, with
// GLINT_FACETS two, where origins are sums of two floats three; rounded up to whole numbers.
#define GLINT_BRANCH_BYTES(number, cones, alpha, rough, facets, dispersion, sums)                  \
    (((number) * (11u + ((cones) ? 2u : 0u) + ((rough) ? 4u : 0u) + ((facets) ? 2u : 0u) +         \
                  ((sums) ? 3u : 0u)) +                                                            \
      12u + ((alpha) ? 4u : 0u) + ((dispersion) ? 4u : 0u) + (number)-1) /                         \
     (number) * (number))

// ---- Layers ------------------------------------------------------------------------------------
// With GLINT_DIAGNOSTICS: what became of a pixel's paths, [height][width]. The first three are of
// all its samples, the others of the one in the middle: of k × k, that in column and row k/2,
// rounded down: the nearest to the pixel's centre, for even k one of four. The last three are of
// the surface that its primary ray meets, with the directions of world space.
typedef struct glint_layers_record {
    int surfaces;          // that the longest path met
    int total_reflections; // their sum
    float truncated;       // sum of the weights that took the environment without being traced
    int triangle;          // number in the scene of what the primary ray met, −1: nothing
    int face;              // of the cube map, in which the heaviest look-up fell, −1: none
    float z;               // metres along the axis of view; ∞: nothing
    float normal[3];       // for shading, unit, towards the viewer; 0: nothing
    float albedo[3];       // base colour, linear R, G, B; 0: nothing
} glint_layers_record;

// ---- Terms -------------------------------------------------------------------------------------
// With GLINT_TERMS: [height][width][terms + 1][GLINT_TERM_VALUES] floats, what a pixel's R, G and B
// are the sum of. First what does not depend on the environment: R, G, B; the sum of the weights
// (largest of R, G, B) that found no room; how many terms follow. Then the terms, of which those
// are kept that weigh most: a vector in the world's axes, unit but for rounding; what it is; and
// the weight R, G, B.
#define GLINT_TERM_VALUES 8
#define GLINT_TERM_VECTOR 0
#define GLINT_TERM_KIND 3
#define GLINT_TERM_WEIGHT 4
#define GLINT_TERM_RADIANCE 0.0f   // the environment's radiance along the vector
#define GLINT_TERM_IRRADIANCE 1.0f // its irradiance over π of a surface with this normal

// ---- Vertices ----------------------------------------------------------------------------------
// With GLINT_VERTEX_COLOR and GLINT_VERTEX_DIRECTION, what was found of the clusters' vertices for
// this view: per cluster its vectors, each as x[16], y[16], z[16] by vertex, floats. Of a colour
// there is one, R, G, B; of directions there are more: what the surface emits; what it sends back
// of an irradiance over π of 1, and its unit normal; and the unit vectors along which it looks the
// environment up, with their weights.
#define GLINT_VERTEX_COLOR_VECTORS 1
#define GLINT_VERTEX_VECTORS 7
#define GLINT_VERTEX_EMITTED 0 // or the colour
#define GLINT_VERTEX_LIT 1
#define GLINT_VERTEX_NORMAL 2
#define GLINT_VERTEX_REFLECTED 3
#define GLINT_VERTEX_REFLECTED_WEIGHT 4
#define GLINT_VERTEX_TRANSMITTED 5
#define GLINT_VERTEX_TRANSMITTED_WEIGHT 6

// ---- Counters ----------------------------------------------------------------------------------
// Each counter is 64 bits in two 32-bit words (low, high). To keep work-items from waiting for each
// other there are GLINT_COUNTER_SLOTS sets; the host adds them up. Whole numbers, so that the sum
// does not depend on the order. Weights are in units of 2^−GLINT_WEIGHT_BITS, squares of them,
// which are counted pixel by pixel, of 2^−GLINT_SQUARE_BITS.
#define GLINT_COUNTER_SLOTS 64
#define GLINT_WEIGHT_BITS 32
#define GLINT_SQUARE_BITS 36
enum glint_counter {
    GLINT_COUNT_REFLECTED,
    GLINT_COUNT_REFRACTED_IN,
    GLINT_COUNT_REFRACTED_OUT,
    GLINT_COUNT_TRANSMITTED,
    GLINT_COUNT_TOTAL_REFLECTIONS,
    GLINT_COUNT_DEEPEST, // a maximum, not a sum
    GLINT_COUNT_MEDIA_OVERFLOWS,
    GLINT_COUNT_WEIGHT_BY_DEPTH,
    GLINT_COUNT_WEIGHT_BY_MIN_WEIGHT,
    GLINT_COUNT_WEIGHT_BY_STACK,
    GLINT_COUNT_TRUNCATION_SQUARES, // of each pixel's truncated weight, its samples' mean
    GLINT_COUNT_SHADOW_RAYS,
    GLINT_COUNTERS = 16 // room for more, and a round size
};

// ---- Probes ------------------------------------------------------------------------------------
// Numbers of an element of the arrays that kernels/probes.cl reads and writes.
#define GLINT_PROBE_RAY 12
#define GLINT_PROBE_HIT 4
#define GLINT_PROBE_BOUNCE 36
#define GLINT_PROBE_VALUES 4

#endif
