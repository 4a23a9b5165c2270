// The oracle: a tracer in double precision that judges the renderer. It is written from the light
// transport rules of ARCHITECTURE.md and from nothing else, and shares no code with the kernels or
// the rest of host/.
//
// Limits: plain C, one thread; the Fresnel tree is followed by recursion. No allocation, except
// in oracle_tree_create and oracle_image_create. Everything is in world space: right-handed, +Y up,
// metres; colours are linear RGB.
#ifndef GLINT_ORACLE_ORACLE_H
#define GLINT_ORACLE_ORACLE_H

#include "oracle/texture.h"

#include <stdbool.h>

// Most surfaces that a path may meet; a view's depth is cut to it.
enum { ORACLE_DEPTH_LIMIT = 64 };

// Rays of one sample's tree after which every further branch takes the environment, reported as
// `exhausted`. Without it depth 64 and min_weight 0 would follow 2⁶⁴ branches.
enum { ORACLE_RAY_LIMIT = 1 << 20 };

// Edges that pass a ray within this ratio (distance from the ray to the edge ÷ length of the path
// up to there) are measured for oracle_report.edge.
#define ORACLE_EDGE_REACH 1e-3

typedef struct oracle_triangle {
    double position[3][3]; // counter-clockwise seen from outside
    double normal[3][3];   // unit; (0, 0, 0) = none
    int material;
} oracle_triangle;

// What a corner of a triangle holds beside.
typedef struct oracle_corner {
    double texcoord[2][2]; // [set][u, v]
    double color[4];       // multiplies the base colour and its alpha
    double tangent[4];     // unit; and ±1: the bitangent is that times normal × tangent; 0: none
} oracle_corner;

// What textures are for: by which their values multiply a factor, if not said otherwise.
typedef enum oracle_role {
    ORACLE_BASE,           // R, G, B the base colour, A the alpha
    ORACLE_METALLIC,       // B; G: the roughness
    ORACLE_NORMAL,         // R, G, B are a normal's components along tangent, bitangent and normal
    ORACLE_OCCLUSION,      // R: what is left of the irradiance
    ORACLE_EMISSION,       // R, G, B
    ORACLE_TRANSMISSION,   // R
    ORACLE_SPECULAR,       // A
    ORACLE_SPECULAR_COLOR, // R, G, B
    ORACLE_CLEARCOAT,      // R
    ORACLE_CLEARCOAT_ROUGHNESS,        // G
    ORACLE_CLEARCOAT_NORMAL,           // as ORACLE_NORMAL
    ORACLE_IRIDESCENCE,                // R
    ORACLE_IRIDESCENCE_THICKNESS,      // G: how far between both thicknesses
    ORACLE_ANISOTROPY,                 // R, G: a direction along tangent and bitangent; B
    ORACLE_SHEEN_COLOR,                // R, G, B
    ORACLE_SHEEN_ROUGHNESS,            // A
    ORACLE_DIFFUSE_TRANSMISSION,       // A
    ORACLE_DIFFUSE_TRANSMISSION_COLOR, // R, G, B
    ORACLE_ROLES
} oracle_role;

// What the alpha of the base colour means.
typedef enum oracle_alpha { ORACLE_OPAQUE, ORACLE_MASK, ORACLE_BLEND } oracle_alpha;

typedef struct oracle_material {
    double base[3]; // base colour factor
    double metallic, roughness;
    double emission[3];          // radiance, strength included
    double transmission, ior;    // KHR_materials_transmission, _ior
    double specular;             // KHR_materials_specular: the factor
    double specular_color[3];    // and the colour's
    double thickness;            // KHR_materials_volume: > 0 bounds a solid, 0 is a thin wall
    double attenuation[3];       // colour that white light has after attenuation_distance
    double attenuation_distance; // metres; INFINITY: clear
    double priority;             // of solids where they overlap: the highest is there
    double dispersion;           // KHR_materials_dispersion: 20 over Abbe's number; of solids
    double clearcoat, clearcoat_roughness; // KHR_materials_clearcoat
    double film, film_ior;    // KHR_materials_iridescence: how much of a film there is; its index
    double film_thickness[2]; // nm; without a texture the last
    double anisotropy, anisotropy_rotation;                     // KHR_materials_anisotropy; radians
    double sheen_color[3], sheen_roughness;                     // KHR_materials_sheen
    double diffuse_transmission, diffuse_transmission_color[3]; // KHR_materials_diffuse_…
    bool unlit;
    double mirror; // the lecture's blend, in [0, 1]; < 0: not asked for
    oracle_alpha alpha_mode;
    double alpha, alpha_cutoff; // of the base colour; of ORACLE_MASK
    oracle_texture texture[ORACLE_ROLES];
    double normal_scale, occlusion_strength, clearcoat_normal_scale;
} oracle_material;

// White, rough 0, metallic 0, opaque, ior 1.5, clear, no blend, no textures: smooth white paint.
extern const oracle_material oracle_material_default;

// A light without a size (KHR_lights_punctual), in world space.
typedef struct oracle_punctual {
    bool directional, spot; // neither: a point
    double position[3];
    double direction[3]; // unit, the way that it shines
    double color[3];     // candela, of a directional light lux
    double range;        // metres; INFINITY: no end
    double inner, outer; // of a spot: half angles in radians
} oracle_punctual;

// Light by direction. `direction` is a unit vector in world space, away from the surface.
typedef void (*oracle_light)(const void *context, const double direction[3], double rgb[3]);

typedef struct oracle_tree oracle_tree;

typedef struct oracle_scene {
    const oracle_triangle *triangles; // borrowed, as all pointers here
    int triangle_count;
    const oracle_corner (*corners)[3]; // of each triangle; NULL: white, and texture coordinates 0
    const oracle_material *materials;
    oracle_light radiance;       // E(d)
    oracle_light irradiance;     // E(n)/π: cosine-weighted mean of the radiance about n
    const void *context;         // handed to both
    double environment_rotation; // degrees about +Y, counter-clockwise seen from above
    const oracle_punctual *lights;
    int light_count;
    bool overlaps; // solids may touch or overlap: media are found by points, not by stacks
    const oracle_tree *tree; // NULL: every ray tries every triangle
} oracle_scene;

// One of the wavelengths that solids divide light into.
typedef struct oracle_wavelength {
    double nm;
    double share[3]; // of R, G and B
} oracle_wavelength;

enum { ORACLE_WAVELENGTHS = 16 };

typedef struct oracle_view {
    double eye[3];
    double right[3], up[3], back[3]; // orthonormal; the camera looks along −back
    double yfov;                     // whole vertical angle in radians; 0 = orthographic
    double ymag;                     // orthographic: half the vertical extent
    int width, height;
    int samples;         // k: k × k samples a pixel; 0 means 1
    int depth;           // N: surfaces that a path may meet; 0 means ORACLE_DEPTH_LIMIT
    double min_weight;   // a branch whose largest component is less takes E at once
    bool no_fresnel;     // metal reflects its base, glass only where it reflects all, paint nothing
    int anisotropy;      // taps of a texture along its longer axis at most; 0 means 1
    bool all_scattering; // lobes have what microfacets reflect more than once
    int roughness;       // directions along each axis of a lobe's quadrature; 0: rough metal is as
                         // smooth, and rough paint reflects nothing
    int wavelengths;     // 0: no solid disperses light
    oracle_wavelength wavelength[ORACLE_WAVELENGTHS];
    bool transparent; // what meets nothing is left out, and of alpha
    bool edges;       // measure oracle_report.edge, at about twice the time
} oracle_view;

typedef struct oracle_ray {
    double origin[3], direction[3]; // direction: unit
} oracle_ray;

typedef struct oracle_hit {
    int triangle;          // −1: none
    double distance;       // along the unit direction
    double barycentric[3]; // weights of the triangle's vertices, ≥ 0, sum 1
} oracle_hit;

// What happened on the way to a pixel. Weights are the largest of R, G and B, summed over
// branches; for a pixel they are the mean, counts the sum, and margins the least over samples.
typedef struct oracle_report {
    double truncated_by_depth, truncated_by_weight;
    long rays;              // traced, primaries included
    long surfaces;          // surfaces met
    long total_reflections; // glass surfaces met beyond the critical angle
    int deepest;            // surfaces met by the longest path
    bool exhausted;         // ORACLE_RAY_LIMIT reached

    // How near the pixel is to one that looks different. A renderer of precision u may differ
    // freely where a margin is within some multiple of u: that is a flip, not an error.
    double edge;     // least (distance from ray to a triangle's edge)/(path length), ≤ EDGE_REACH
    double critical; // least |1 − η²(1 − cos²θi)| over glass surfaces
    double threshold; // least |weight/min_weight − 1| over branches that were judged by it
    double jump; // least (distance from ray to where a texture jumps or ALPHA_MASK decides)/(path
                 // length), or relative change of a cone's width that takes another filter
} oracle_report;

// Renders pixel (i, j), counted from the top left: premultiplied RGB and alpha. `report` may be
// NULL.
void oracle_pixel(const oracle_scene *scene, const oracle_view *view, const int pixel[2],
                  double rgba[4], oracle_report *report);

// The same for one sample at (x, y) in pixels from the top left corner, so that pixel (i, j) has
// its centre at (i + ½, j + ½).
void oracle_sample(const oracle_scene *scene, const oracle_view *view, const double position[2],
                   double rgba[4], oracle_report *report);

// The primary ray through (x, y) in pixels.
oracle_ray oracle_primary_ray(const oracle_view *view, const double position[2]);

// Radiance that arrives along a ray, followed by the view's depth and min_weight; true if it met a
// surface that is there. With a transparent view it lacks what is seen past surfaces. The cone is
// that of the view's pixels. The direction is made unit. `report` may be NULL.
bool oracle_radiance(const oracle_scene *scene, const oracle_view *view, const oracle_ray *ray,
                     double rgb[3], oracle_report *report);

// The nearest triangle at distance > 0; of those that lie at one distance, the lowest index.
// `left` is the triangle on which the ray starts, which is never hit again (a straight ray cannot
// meet its own plane twice), or −1.
oracle_hit oracle_closest_hit(const oracle_scene *scene, const oracle_ray *ray, int left);

// A binary tree over the scene's triangles, for scenes too large for brute force. It finds the
// same hits. NULL if memory ran out. The triangles must outlive it, unchanged.
oracle_tree *oracle_tree_create(const oracle_triangle *triangles, int triangle_count);
void oracle_tree_free(oracle_tree *tree); // NULL is allowed

// Optics, as the rules state them. All vectors unit; `normal` on the viewer's side.

// r = 2n(n·v) − v.
void oracle_reflect(const double normal[3], const double viewer[3], double reflected[3]);

// t = ηd + (η cos θi − cos θt)n with η = n_i/n_t and d = −v; false beyond the critical angle.
bool oracle_refract(const double normal[3], const double viewer[3], double eta,
                    double refracted[3]);

// Share of unpolarised light that an interface reflects, for cos θi in [0, 1]; 1 beyond the
// critical angle, 0 where both indices are equal.
double oracle_fresnel(double cos_incident, double ior_incident, double ior_transmitted);

// exp(−σs), σ = −ln(colour)/distance, for one channel.
double oracle_transmittance(double colour, double colour_distance, double length);

#endif
