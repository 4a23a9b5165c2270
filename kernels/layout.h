// Defines the data that the host and the kernels share. A C compiler and OpenCL C both read this
// file. Structs hold 32-bit scalars only, so both compilers give them the same layout. The host
// asserts their sizes (host/render/upload.c). A test asks the device for its sizes
// (tests/test_kernels.c).
#ifndef GLINT_KERNELS_LAYOUT_H
#define GLINT_KERNELS_LAYOUT_H

// A vector as an unevaluated sum of two floats. Float precision uses only the first.
typedef struct glint_split_vector {
    float high[4], low[4];
} glint_split_vector;

// ---- Cube map ----------------------------------------------------------------------------------
// The faces have the order +X −X +Y −Y +Z −Z. They are oriented as in OpenEXR's ImfEnvmap.h: seen
// from inside, unmirrored. On a face, s runs to the right and t runs downwards, each in [−1, 1].
// The direction is the face's axis plus s along one axis plus t along another axis:
//   face   +X  −X  +Y  −Y  +Z  −Z
//   s is   +z  −z  +x  +x  −x  +x
//   t is   −y  −y  −z  +z  −y  −y
// Texel (column i, row j) of a face of edge N has its centre at s = (2i + 1)/N − 1 and
// t = (2j + 1)/N − 1. Each face has a border of one texel: [6][N + 2][N + 2][4] floats (R, G, B,
// unused). The environment has halfs if the kernels are compiled with GLINT_HALF_TEXELS or, with
// GLINT_GENERAL, if the frame says so.
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
// With GLINT_MIP_LEVELS or GLINT_FACETS, coarser maps follow in the same buffer, down to edge 1.
// The edge of each map is half of the previous edge, rounded down. The largest number of levels,
// with the first:
#define GLINT_LEVELS_MAX 14

// ---- Lobes -------------------------------------------------------------------------------------
// The buffer that rough surfaces (GLINT_ROUGH) read, in floats. It begins with a table of albedos:
// the light that a lobe reflects of a white environment, without and with Fresnel's (1 − v·h)⁵. The
// two values are ∫ D V (1 − m) n·l dl and ∫ D V m n·l dl. The table is indexed by [roughness ρ from
// 0 to 1][x from 0 to 1], in equal steps, with x = (t + t (1 + ρ)/(t + ρ))/2 and t = √(n·v). The
// first half of x resolves what happens where n·v is about α, the second half the rest. A table of
// the same shape follows for sheen: the share of a white environment that it reflects, and 0. Its
// roughness runs from NARROW to 1, and its columns are equal steps of t. Without GLINT_SHEEN it
// holds zeros.
#define GLINT_ALBEDO_ROUGHNESSES 64
#define GLINT_ALBEDO_COSINES 32
#define GLINT_ALBEDO_VALUES (2 * GLINT_ALBEDO_ROUGHNESSES * GLINT_ALBEDO_COSINES)
// The next float is the brightness of the environment, R + G + B: the square of the mean of
// √(R + G + B), in which suns weigh little. Seven unused floats follow.
#define GLINT_LOBES_BRIGHTNESS (2 * GLINT_ALBEDO_VALUES)
// The environment as cells follows. Level 0 has GLINT_CELLS_ROOT cells along a face's edge, and
// each further level has twice as many as the previous level. A level is [6][edge²] cells. The
// cells of a face stand in Morton order: the even bits of a cell's place are its column, the odd
// bits its row. So the four parts of a cell stand together, from four times the cell's place on. A
// cell has these values:
//   - its centroid, a unit vector, weighted by the brightness of its parts
//   - its approximate width w, as an angle. Its solid angle is about w² u (1 + w² (9 − 15 u²)/24),
//     where u is the largest component of its middle's direction
//   - ∫ E dω of R, G, B
//   - the variance of the position of its light along one axis, in squared radians
#define GLINT_LOBES_CELLS (GLINT_LOBES_BRIGHTNESS + GLINT_CELL_VALUES)
#define GLINT_CELL_VALUES 8
#define GLINT_CELLS_ROOT 2
#define GLINT_CELLS_LEVELS 9 // at most
// The number of cells before a level.
#define GLINT_CELLS_FIRST(level)                                                                   \
    ((size_t)(GLINT_CUBE_FACES * GLINT_CELLS_ROOT * GLINT_CELLS_ROOT / 3) *                        \
     (((size_t)1 << (2 * (level))) - 1))
// Decides if a cell is too large for a lobe. The measure is the ratio of the cell's size to the
// width over which the lobe varies. That width is an angle of h, √(α² + sin² θ_h), but at most
// √(WIDEST (1 + TAIL/α²)): beyond, n·l separates light and shadow. The error of a cell is about its
// contribution times the fourth power of the ratio. A cell is too large if its error exceeds the
// frame's tolerance of the brightness, or if the squared ratio exceeds LARGEST. By measurement, all
// roughnesses then have about the same error. If the pixel sees the share w of the lobe, the cell
// contributes only the share w, and LARGEST grows by the factor 1 + α (1/√w − 1).
#define GLINT_LOBE_WIDEST 0.1f
#define GLINT_LOBE_TAIL 0.1f
#define GLINT_CELL_LARGEST 6.25f
// Roughness below LEAST counts as 0. Lobes below NARROW are narrower than a cell of the finest
// level. Sheen has at least the roughness NARROW.
#define GLINT_ROUGHNESS_LEAST 0.01f
#define GLINT_ROUGHNESS_NARROW 0.07f
// A coat of paint with a roughness of MATTE or more sees only the environment, as the paint beneath
// it does. Below SHARP the coat sees surfaces. In between it sees a share of them.
#define GLINT_COAT_SHARP 0.3f
#define GLINT_COAT_MATTE 0.6f

// ---- Tree --------------------------------------------------------------------------------------
// A node of width B is 7 × B 32-bit values: the children's low x, low y, low z, high x, high y,
// high z (floats, B of each), then B ints that name the children. An int of 0 or more is the index
// of a node. A negative int is a leaf: the complement of a cluster's index. A missing child has the
// name 0, and both corners of its box are (GLINT_FAR, GLINT_FAR, GLINT_FAR), where no ray arrives.
#define GLINT_NODE_VALUES 7
#define GLINT_FAR 1e30f // farther than any hit; finite, as ∞ would give NaN when multiplied by 0

// A leaf is one cluster: up to 16 triangles of one material, and the vertices that they share, at
// most 16. A cluster has 64 32-bit values, 256 bytes aligned to 64:
//   x[16], y[16], z[16]     floats: the vertices' positions, relative to the anchor
//   3 × 16 bytes            the triangles' first, second and third corner, each a vertex's lane
//   count + 32 × material   an int: the number of triangles, 1 to 16, and their material
//   anchor x, y, z          floats: to add to the positions for stored coordinates, with
//                           GLINT_LOCAL_ORIGINS; else 0
// Lanes past the last vertex repeat the first vertex. Triangles past the last have corners 0, 0, 0.
// Clusters stand in the order of the leaves, left to right, for every width of nodes. The place of
// a triangle is cluster × 16 + its lane. Two more buffers belong to the clusters:
//   the shading normals     floats, per cluster x[16], y[16], z[16] by vertex; (0, 0, 0): no normal
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
// The largest number of triangles that places can name, even if each triangle has its own cluster.
#define GLINT_TRIANGLES_MAX ((1u << 27) - 1)

// ---- Materials ---------------------------------------------------------------------------------
#define GLINT_MATERIAL_SOLID 1u        // transmits, and bounds a solid
#define GLINT_MATERIAL_THIN 2u         // transmits, without thickness
#define GLINT_MATERIAL_UNLIT 4u        // shows the base colour; the path ends there
#define GLINT_MATERIAL_BLEND 8u        // the lecture's blend; `blend` is the mirror's share
#define GLINT_MATERIAL_GLOSS 16u       // paint of roughness 0: reflects under its Fresnel term
#define GLINT_MATERIAL_MASK 32u        // visible where its alpha is alpha_cutoff or more
#define GLINT_MATERIAL_COVER 64u       // its alpha is its coverage
#define GLINT_MATERIAL_DISPERSIVE 128u // a solid whose index of refraction depends on wavelength

// Slots of a material's textures: glint_texture_slot of host/scene/texture/texture.h.
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
    unsigned int medium; // place in the media, 1 or more; 0: not a solid
    float alpha_cutoff;  // see GLINT_MATERIAL_MASK
    float normal_scale;  // of the normal texture
    float occlusion_strength;
    float roughness;              // [0, 1]
    float specular;               // [0, 1], with GLINT_SPECULAR
    float specular_color[3];      // ≥ 0, with GLINT_SPECULAR
    float clearcoat;              // [0, 1], with GLINT_CLEARCOAT
    float clearcoat_roughness;    // [0, 1], with GLINT_CLEARCOAT
    float clearcoat_normal_scale; // of the coat's normal texture, with GLINT_CLEARCOAT
    float iridescence;            // [0, 1], with GLINT_IRIDESCENCE
    float iridescence_ior;        // of the film, ≥ 1, with GLINT_IRIDESCENCE
    // Thickness of the film in nm, where the texture is 0 and where it is 1. Without a texture the
    // second value counts. With GLINT_IRIDESCENCE.
    float iridescence_thickness[2];
    float anisotropy;                      // [0, 1], with GLINT_BRUSHED
    float brush_direction[2];              // unit, along tangent and bitangent, with GLINT_BRUSHED
    float sheen_color[3];                  // [0, 1], with GLINT_SHEEN; 0: no sheen
    float sheen_roughness;                 // [0, 1], with GLINT_SHEEN
    float diffuse_transmission;            // [0, 1], with GLINT_DIFFUSE_TRANSMISSION
    float diffuse_transmission_color[3];   // [0, 1], with GLINT_DIFFUSE_TRANSMISSION
    int textures[GLINT_MATERIAL_TEXTURES]; // places in the textures; −1: no texture
} glint_material_record;

// ---- Textures ----------------------------------------------------------------------------------
// All texels stand in one array: [4] 16-bit whole numbers, R, G, B, A, linear, in units of 1/65535.
// The levels of a texture follow each other. Each level is rows of texels from the top; level k has
// max(1, width >> k) by max(1, height >> k) texels. A border on the right and below holds what a
// repeated texture shows there: the first texel of each row, and the first row.
#define GLINT_TEXTURE_BORDER 1
#define GLINT_TEXTURE_LEVELS 16  // at most; so an image is at most 32768 wide and high
#define GLINT_TEXTURE_SECOND 1u  // uses the second texture coordinates
#define GLINT_TEXTURE_CLAMP_S 2u // else repeated or mirrored
#define GLINT_TEXTURE_CLAMP_T 4u
#define GLINT_TEXTURE_MIRROR_S 8u
#define GLINT_TEXTURE_MIRROR_T 16u
#define GLINT_TEXTURE_MAGNIFIED_NEAREST 32u // if a texel covers a pixel or more
#define GLINT_TEXTURE_MINIFIED_NEAREST 64u
#define GLINT_TEXTURE_MIPS_NEAREST 128u // reads one level, not a blend of two
#define GLINT_TEXTURE_TRILINEAR 256u    // minified: blends texels and levels

typedef struct glint_texture_record {
    unsigned int first[GLINT_TEXTURE_LEVELS]; // number of texels before each level
    int width, height;                        // of level 0
    int levels;                               // number of levels in use
    unsigned int flags;                       // GLINT_TEXTURE_…
    float transform[6];                       // of u and v, see glint_texture_use
    int alike;                                // textures of the same number differ only in texels
    unsigned int unused;
} glint_texture_record;

// Medium 0 is empty space. With GLINT_OVERLAPS, media stand in the order of their priority: where
// solids overlap, the medium with the highest number wins. Absorption is per stored unit of length.
// It is an unevaluated sum of two floats, so double precision keeps the host's value.
typedef struct glint_medium_record {
    float absorption_high[4]; // R, G, B; 0
    float absorption_low[4];
    float ior;
    // Added to ior for each ior_step of a wavelength, with GLINT_DISPERSION; see
    // glint_wavelength_record.
    float dispersion;
    int material; // media of one material do not differ
    float unused;
} glint_medium_record;

// With GLINT_OVERLAPS, by the triangles' numbers: the solid that a triangle belongs to.
#define GLINT_SOLID_TOUCHES 0x40000000u // may be in one place with a surface of another solid
typedef struct glint_solid_record {
    int component;       // same for all triangles of a solid; −1: no solid
    unsigned int medium; // medium of the solid, 0: no solid; and GLINT_SOLID_TOUCHES
} glint_solid_record;

// Two surfaces are in one place if they are nearer to each other than this share of their
// coordinates. Coordinates are rounded to 24 bits. Both precisions use the same share, because the
// limit comes from the digits in the file.
#define GLINT_TOUCHING 0x1p-21f

// One of the wavelengths into which dispersive solids divide light. At this wavelength a medium has
// the index ior + dispersion × ior_step, but at least 1. `share` is the wavelength's share of R, G
// and B: the shares of all wavelengths add up to 1.
#define GLINT_WAVELENGTHS_MAX 16
typedef struct glint_wavelength_record {
    float ior_step;
    float share[3];
} glint_wavelength_record;

// ---- Lights ------------------------------------------------------------------------------------
// The scene's punctual lights. A light of the kind NONE ends the list.
#define GLINT_LIGHT_NONE 0u
#define GLINT_LIGHT_POINT 1u
#define GLINT_LIGHT_SPOT 2u
#define GLINT_LIGHT_DIRECTIONAL 3u

typedef struct glint_light_record {
    unsigned int kind;       // GLINT_LIGHT_…
    float position[3];       // stored coordinates; not for directional lights
    glint_split_vector axis; // unit; the direction in which the light shines
    // R, G, B: irradiance over π, on a surface at right angles to the light. For points and spots,
    // at a distance of 1 stored unit.
    glint_split_vector color;
    float inverse_range[2]; // 1/range², per stored unit squared: high, low; 0: no range
    float outer_cosine[2];  // of a spot: cosine of its half angle
    float cone_scale[2];    // of a spot: 1/(cos inner − cos outer)
    unsigned int unused[2];
} glint_light_record;

// ---- Packets -----------------------------------------------------------------------------------
// A packet of rays covers columns × rows of pixels. Its lanes run row by row.
#define GLINT_PACKET_COLUMNS(lanes) ((lanes) == 1 ? 1 : 4)
#define GLINT_PACKET_ROWS(lanes) ((lanes) / GLINT_PACKET_COLUMNS(lanes))
// A tile is the pixels that one work-item renders: one packet, or 4 × 4 neighbouring packets.
#define GLINT_TILE_SIDE(tiles) ((tiles) ? 4 : 1)

// ---- Frame -------------------------------------------------------------------------------------
// Values that may change from frame to frame without a new compilation.

#define GLINT_FEATURE_WORDS 2 // of 32 bits, one for each feature of features.h

// The primary ray through the point (px, py) of the image plane, in pixels from the top left. Let
// X = px − width/2 and Y = height/2 − py. The ray starts at origin + X origin_x + Y origin_y and
// runs along direction + X direction_x + Y direction_y (stored coordinates, not normalised). The
// start lies in front of the eye, where the scene begins: the eye plus `start` times the direction.
// So the differences between vertices and origin lose no digits when the camera is distant.
typedef struct glint_frame_record {
    glint_split_vector origin, origin_x, origin_y;
    glint_split_vector direction, direction_x, direction_y;
    // Image coordinates of a point p in stored coordinates: x = image_x·(p − origin),
    // y = image_y·(p − origin), z = image_z·(p − origin), h = image_offset + image_slope z. The ray
    // through (X, Y) consists of the points with x = X h and y = Y h. Their z is the depth, in
    // units of `direction`. The key of a depth is 1/h if key_is_inverse is 1, else −z/h.
    glint_split_vector image_x, image_y, image_z;
    float image_offset[2]; // high, low
    float image_slope;     // 1, or 0 for parallel rays
    int key_is_inverse;
    float start[2];        // distance from eye to start, in lengths of the direction: high, low
    float env_rotation[4]; // cosine high, low, sine high, low
    // With GLINT_PROXY: the point that the environment was seen from; and the middle and the half
    // extents of the box that the whole environment is taken to lie on. For a sphere, proxy_half
    // holds its radius three times.
    glint_split_vector proxy_center, proxy_middle, proxy_half;
    int proxy_is_sphere;
    float min_weight; // a branch with a smaller largest weight takes the environment
    // The number of rendered pixels: every `step`th pixel of every `step`th row of the image, from
    // `first_pixel` on. If step is 1, all pixels are rendered. With GLINT_PIXEL_LIST,
    // [height][width] uints name the pixels, row by row of the image.
    int width, height;
    int image_width, image_height;
    int step, first_pixel;
    // With GLINT_GENERAL: the features that the scene and the settings need, as bits, and the type
    // of the environment's texels.
    unsigned int features[GLINT_FEATURE_WORDS];
    int half_texels;
    // The stack of media (media.cl): bits of an entry, and the number of entries.
    int media_bits, media_capacity;
    int samples_per_axis; // k
    // With GLINT_FACETS: the number of rounds in which all samples are rendered. With
    // GLINT_DISPERSION each wavelength has these rounds. Only the first round renders all pixels.
    // The others render the pixels whose paths met rough glass or a dispersive solid.
    int facet_rounds;
    int wavelengths;
    glint_wavelength_record wavelength[GLINT_WAVELENGTHS_MAX];
    int depth;            // largest number of surfaces that a path meets, 1 or more
    int depth_counts;     // with GLINT_TRUNCATION_SQUARES: 1 if truncation by depth counts
    int environment_edge; // in texels, without border
    int irradiance_edge;  // in texels, without border
    // The order of rendering: band by band; within a band, column by column of tiles.
    int band;              // rows of tiles per band, 1 or more
    int first_band;        // first band of this launch
    float anisotropy;      // largest number of texture taps along an ellipse, 1 or more
    int cells_last;        // the finest level of cells, with GLINT_ROUGH
    float compensation;    // 1: lobes keep the light of multiple scattering; 0: they lose it
    float cells_tolerance; // tolerated error of a cell, see GLINT_CELL_LARGEST
    int terms;             // largest number of terms per pixel, with GLINT_TERMS
    float unit;            // metres per stored unit, a power of two, with GLINT_DIAGNOSTICS
} glint_frame_record;

// ---- Irradiance --------------------------------------------------------------------------------
// With GLINT_IRRADIANCE_HARMONICS the irradiance over π is a polynomial, not a map:
// [GLINT_HARMONICS][4] floats (R, G, B, unused), the coefficients of these terms of the unit
// normal:
#define GLINT_HARMONICS 9
#define GLINT_HARMONIC_TERMS(x, y, z)                                                              \
    {                                                                                              \
        1, x, y, z, (x) * (y), (y) * (z), (z) * (x), (x) * (x) - (y) * (y), 3 * (z) * (z)-1        \
    }

// ---- Layers ------------------------------------------------------------------------------------
// With GLINT_DIAGNOSTICS: what happened to the paths of each pixel, [height][width]. The first
// three members describe all samples of the pixel. The others describe the middle sample: of k × k,
// the sample in column and row k/2, rounded down. It is the nearest to the pixel's centre; for even
// k, one of the four nearest. The last three members describe the surface that its primary ray
// meets, with directions in world space.
typedef struct glint_layers_record {
    int surfaces;          // number of surfaces that the longest path met
    int total_reflections; // their number, summed over all paths
    float truncated;       // sum of the weights that took the environment instead of tracing
    int triangle;    // number in the scene of the triangle that the primary ray met; −1: none
    int face;        // face of the cube map that the heaviest look-up read; −1: none
    float z;         // depth along the axis of view, metres; ∞: no hit
    float normal[3]; // shading normal, unit, towards the viewer; 0: no hit
    float albedo[3]; // base colour, linear R, G, B; 0: no hit
} glint_layers_record;

// ---- Terms -------------------------------------------------------------------------------------
// With GLINT_TERMS: [height][width][terms + 1][GLINT_TERM_VALUES] floats, the terms whose sum is a
// pixel's R, G and B. The first record holds the part that does not depend on the environment: R,
// G, B; the sum of the weights (largest of R, G, B) that found no room; and the number of terms.
// The terms follow; the heaviest are kept. A term is a vector in the world's axes, unit except for
// rounding; the kind of the term; and the weight R, G, B.
#define GLINT_TERM_VALUES 8
#define GLINT_TERM_VECTOR 0
#define GLINT_TERM_KIND 3
#define GLINT_TERM_WEIGHT 4
#define GLINT_TERM_RADIANCE 0.0f   // the environment's radiance along the vector
#define GLINT_TERM_IRRADIANCE 1.0f // the irradiance over π of a surface with this normal

// ---- Vertices ----------------------------------------------------------------------------------
// With GLINT_VERTEX_COLOR and GLINT_VERTEX_DIRECTION: the results of shading the clusters' vertices
// for this view. Each cluster has its vectors, each as x[16], y[16], z[16] by vertex, floats.
// VERTEX_COLOR has one vector: R, G, B. VERTEX_DIRECTION has more vectors: the emission of the
// surface; the light that it reflects of an irradiance over π of 1, and its unit normal; and the
// unit vectors along which it looks up the environment, with their weights.
#define GLINT_VERTEX_COLOR_VECTORS 1
#define GLINT_VERTEX_VECTORS 7
#define GLINT_VERTEX_EMITTED 0 // or the colour, with VERTEX_COLOR
#define GLINT_VERTEX_LIT 1
#define GLINT_VERTEX_NORMAL 2
#define GLINT_VERTEX_REFLECTED 3
#define GLINT_VERTEX_REFLECTED_WEIGHT 4
#define GLINT_VERTEX_TRANSMITTED 5
#define GLINT_VERTEX_TRANSMITTED_WEIGHT 6

// ---- Counters ----------------------------------------------------------------------------------
// Each counter is 64 bits in two 32-bit words (low, high). There are GLINT_COUNTER_SLOTS sets of
// counters, so that work-items do not wait for each other; the host adds them up. Counters are
// whole numbers, so the sum does not depend on the order. Weights are in units of
// 2^−GLINT_WEIGHT_BITS. Squares of weights are counted pixel by pixel, in units of
// 2^−GLINT_SQUARE_BITS.
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
    // Squares of each pixel's truncated weight, the mean of its samples.
    GLINT_COUNT_TRUNCATION_SQUARES,
    GLINT_COUNT_SHADOW_RAYS,
    GLINT_COUNTERS = 16 // leaves room for more, and is a round size
};

// ---- Probes ------------------------------------------------------------------------------------
// The number of values per element in the arrays that kernels/probes.cl reads and writes.
#define GLINT_PROBE_RAY 12
#define GLINT_PROBE_HIT 4
#define GLINT_PROBE_BOUNCE 36
#define GLINT_PROBE_VALUES 4

#endif
