// The oracle: a path tracer in double precision that judges the renderer. It is written from the
// rules in docs/light_transport.md alone. It shares no code with the kernels or the rest of host/.
//
// Limits: plain C, one thread, recursion over the Fresnel tree. Only oracle_tree_create and
// oracle_image_create allocate memory. Everything is in world space: right-handed, +Y up, metres.
// Colours are linear RGB.
#ifndef GLINT_ORACLE_ORACLE_H
#define GLINT_ORACLE_ORACLE_H

#include "oracle/texture.h"

#include <stdbool.h>

// The largest number of surfaces that a path may meet. A larger depth of a view is cut to it.
enum { ORACLE_DEPTH_LIMIT = 64 };

// The largest number of rays of one sample's tree. Beyond it every branch takes the environment,
// reported as `exhausted`. Without it, depth 64 with min_weight 0 would follow 2⁶⁴ branches.
enum { ORACLE_RAY_LIMIT = 1 << 20 };

// oracle_report.edge covers edges within this ratio: distance from the ray to the edge, divided by
// the length of the path up to there.
#define ORACLE_EDGE_REACH 1e-3

typedef struct oracle_triangle {
    double position[3][3]; // counter-clockwise seen from outside
    double normal[3][3];   // unit; (0, 0, 0): none
    int material;
} oracle_triangle;

// Attributes of a triangle's corner.
typedef struct oracle_corner {
    double texcoord[2][2]; // [set][u, v]
    double color[4];       // multiplies the base colour and its alpha
    // Unit vector, and a sign: the bitangent is the sign times normal × tangent. Sign 0: no
    // tangent.
    double tangent[4];
} oracle_corner;

// The uses of textures. Values multiply a factor, if not said otherwise.
typedef enum oracle_role {
    ORACLE_BASE,                       // R, G, B: the base colour; A: the alpha
    ORACLE_METALLIC,                   // B: metallic; G: the roughness
    ORACLE_NORMAL,                     // R, G, B: components along tangent, bitangent and normal
    ORACLE_OCCLUSION,                  // R: the share of the irradiance that is left
    ORACLE_EMISSION,                   // R, G, B
    ORACLE_TRANSMISSION,               // R
    ORACLE_SPECULAR,                   // A
    ORACLE_SPECULAR_COLOR,             // R, G, B
    ORACLE_CLEARCOAT,                  // R
    ORACLE_CLEARCOAT_ROUGHNESS,        // G
    ORACLE_CLEARCOAT_NORMAL,           // as ORACLE_NORMAL
    ORACLE_IRIDESCENCE,                // R
    ORACLE_IRIDESCENCE_THICKNESS,      // G: interpolates between both thicknesses
    ORACLE_ANISOTROPY,                 // R, G: a direction along tangent and bitangent; B: strength
    ORACLE_SHEEN_COLOR,                // R, G, B
    ORACLE_SHEEN_ROUGHNESS,            // A
    ORACLE_DIFFUSE_TRANSMISSION,       // A
    ORACLE_DIFFUSE_TRANSMISSION_COLOR, // R, G, B
    ORACLE_ROLES
} oracle_role;

// The meaning of the base colour's alpha.
typedef enum oracle_alpha { ORACLE_OPAQUE, ORACLE_MASK, ORACLE_BLEND } oracle_alpha;

typedef struct oracle_material {
    double base[3]; // base colour factor
    double metallic, roughness;
    double emission[3];          // radiance, strength included
    double transmission, ior;    // KHR_materials_transmission, _ior
    double specular;             // KHR_materials_specular: specularFactor
    double specular_color[3];    // KHR_materials_specular: specularColorFactor
    double thickness;            // KHR_materials_volume; > 0: bounds a solid; 0: a thin wall
    double attenuation[3];       // colour of white light after attenuation_distance
    double attenuation_distance; // metres; INFINITY: clear
    double priority;             // where solids overlap, the highest priority wins
    double dispersion;           // KHR_materials_dispersion: 20 over Abbe's number; only solids
    double clearcoat, clearcoat_roughness; // KHR_materials_clearcoat
    double film, film_ior;                 // KHR_materials_iridescence: its factor; its index
    double film_thickness[2]; // nm; from texture value 0 to 1; without a texture the last
    double anisotropy, anisotropy_rotation;                     // KHR_materials_anisotropy; radians
    double sheen_color[3], sheen_roughness;                     // KHR_materials_sheen
    double diffuse_transmission, diffuse_transmission_color[3]; // KHR_materials_diffuse_…
    bool unlit;
    double mirror; // the lecture's blend, in [0, 1]; < 0: none
    oracle_alpha alpha_mode;
    double alpha, alpha_cutoff; // alpha of the base colour; cutoff of ORACLE_MASK
    oracle_texture texture[ORACLE_ROLES];
    double normal_scale, occlusion_strength, clearcoat_normal_scale;
} oracle_material;

// The default: smooth white paint, opaque, ior 1.5. (Roughness 0, metallic 0, clear, no blend, no
// textures.)
extern const oracle_material oracle_material_default;

// A light without size (KHR_lights_punctual), in world space.
typedef struct oracle_punctual {
    bool directional, spot; // neither: a point light
    double position[3];
    double direction[3]; // unit, the direction in which it shines
    double color[3];     // candela; for a directional light lux
    double range;        // metres; INFINITY: no end
    double inner, outer; // half angles of a spot's cone, in radians
} oracle_punctual;

// A function that gives light by direction. `direction` is a unit vector in world space, away from
// the surface.
typedef void (*oracle_light)(const void *context, const double direction[3], double rgb[3]);

// Where the environment's light comes from: the inside of a box or a sphere around the scene.
// World space, metres.
typedef struct oracle_proxy {
    bool sphere;
    double center[3]; // where the environment was seen from
    double middle[3]; // of the box or sphere
    double half[3];   // half of the box's edges; a sphere has its radius in all three
} oracle_proxy;

typedef struct oracle_tree oracle_tree;

typedef struct oracle_scene {
    const oracle_triangle *triangles; // borrowed, as are all pointers here
    int triangle_count;
    const oracle_corner (*corners)[3]; // of each triangle; NULL: white, texture coordinates 0
    const oracle_material *materials;
    oracle_light radiance;       // E(d)
    oracle_light irradiance;     // E(n)/π: cosine-weighted mean of the radiance about n
    const void *context;         // passed to `radiance` and `irradiance`
    const oracle_proxy *proxy;   // for the radiance; NULL: the environment is infinitely far away
    double environment_rotation; // degrees about +Y, counter-clockwise seen from above
    const oracle_punctual *lights;
    int light_count;
    bool overlaps; // solids may touch or overlap: media are found at points, not by stacks
    const oracle_tree *tree; // NULL: every ray tries every triangle
} oracle_scene;

// A wavelength that solids disperse light into.
typedef struct oracle_wavelength {
    double nm;
    double share[3]; // shares of R, G and B
} oracle_wavelength;

enum { ORACLE_WAVELENGTHS = 16 };

typedef struct oracle_view {
    double eye[3];
    double right[3], up[3], back[3]; // orthonormal; the camera looks along −back
    double yfov;                     // whole vertical angle in radians; 0 = orthographic
    double ymag;                     // orthographic: half the vertical extent
    int width, height;
    int samples;       // k: k × k samples a pixel; 0 means 1
    int depth;         // N: the surfaces that a path may meet; 0 means ORACLE_DEPTH_LIMIT
    double min_weight; // a branch whose largest component is below it takes E at once
    // Metal reflects its base colour, glass reflects only beyond the critical angle, paint reflects
    // nothing.
    bool no_fresnel;
    int anisotropy;      // most taps of a texture along its longer axis; 0 means 1
    bool all_scattering; // lobes include light that microfacets reflect several times
    // Directions along each axis of a lobe's quadrature. 0: rough metal is smooth, and rough paint
    // reflects nothing.
    int roughness;
    int wavelengths; // 0: no solid disperses light
    oracle_wavelength wavelength[ORACLE_WAVELENGTHS];
    // Light past all surfaces is left out, and lowers alpha.
    bool transparent;
    bool edges; // measure oracle_report.edge; takes about twice the time
    // Rays that leave surfaces start beside them, as if the place's coordinates had been rounded by
    // this share. It shows how much rounding changes a pixel. 0: they start on the surface.
    double start;
} oracle_view;

typedef struct oracle_ray {
    double origin[3], direction[3]; // `direction` is a unit vector
} oracle_ray;

typedef struct oracle_hit {
    int triangle;          // −1: no hit
    double distance;       // along the unit direction
    double barycentric[3]; // weights of the triangle's vertices, ≥ 0, sum 1
} oracle_hit;

// What happened on the way to a pixel. Weights are the largest of R, G and B, summed over branches.
// For a pixel, weights are the mean over its samples, counts the sum and margins the least.
typedef struct oracle_report {
    double truncated_by_depth, truncated_by_weight;
    long rays;              // traced rays, primary rays included
    long surfaces;          // surfaces met
    long total_reflections; // glass surfaces met beyond the critical angle
    int deepest;            // surfaces met by the longest path
    bool exhausted;         // ORACLE_RAY_LIMIT reached

    // Margins: the distance to a change of the pixel. If a margin is within some multiple of u, a
    // renderer of precision u may rightly differ: this is a flip, not an error.
    // Least (distance from the ray to a triangle's edge)/(path length), at most ORACLE_EDGE_REACH.
    double edge;
    double critical; // least |1 − η²(1 − cos²θi)| over glass surfaces
    // Least |weight/min_weight − 1| over the branches that min_weight judged.
    double threshold;
    // Least (distance from the ray to a jump of a texture or of ALPHA_MASK)/(path length). Or the
    // least relative change of a cone's width that selects another filter.
    double jump;
} oracle_report;

// Renders pixel (i, j), counted from the top left: premultiplied RGB and alpha. `report` may be
// NULL.
void oracle_pixel(const oracle_scene *scene, const oracle_view *view, const int pixel[2],
                  double rgba[4], oracle_report *report);

// Renders one sample at (x, y), in pixels from the top left corner. Pixel (i, j) has its centre at
// (i + ½, j + ½).
void oracle_sample(const oracle_scene *scene, const oracle_view *view, const double position[2],
                   double rgba[4], oracle_report *report);

// The primary ray through (x, y) in pixels.
oracle_ray oracle_primary_ray(const oracle_view *view, const double position[2]);

// Computes the radiance that arrives along a ray, with the view's depth and min_weight. Returns
// true if the ray met a surface that is there. With a transparent view, light past all surfaces is
// left out. The cone is that of the view's pixels. The direction is normalised. `report` may be
// NULL.
bool oracle_radiance(const oracle_scene *scene, const oracle_view *view, const oracle_ray *ray,
                     double rgb[3], oracle_report *report);

// Finds the nearest triangle at distance > 0. At equal distances the lowest index wins. `left` is
// the triangle on which the ray starts, or −1. It is never hit again: a straight ray cannot meet
// its own plane twice.
oracle_hit oracle_closest_hit(const oracle_scene *scene, const oracle_ray *ray, int left);

// Builds a binary tree over the scene's triangles, for scenes too large for brute force. It finds
// the same hits. Returns NULL if memory ran out. The triangles must outlive the tree, unchanged.
oracle_tree *oracle_tree_create(const oracle_triangle *triangles, int triangle_count);
void oracle_tree_free(oracle_tree *tree); // NULL is allowed

// Optics, as the rules state them. All vectors are unit vectors. `normal` is on the viewer's side.

// r = 2n(n·v) − v.
void oracle_reflect(const double normal[3], const double viewer[3], double reflected[3]);

// t = ηd + (η cos θi − cos θt)n with η = n_i/n_t and d = −v. Returns false beyond the critical
// angle.
bool oracle_refract(const double normal[3], const double viewer[3], double eta,
                    double refracted[3]);

// The share of unpolarised light that an interface reflects, for cos θi in [0, 1]. It is 1 beyond
// the critical angle and 0 if both indices are equal.
double oracle_fresnel(double cos_incident, double ior_incident, double ior_transmitted);

// exp(−σs), σ = −ln(colour)/distance, for one channel.
double oracle_transmittance(double colour, double colour_distance, double length);

#endif
