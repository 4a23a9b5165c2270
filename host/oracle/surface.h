// Between the oracle's own files: a surface where a path meets it.
#ifndef GLINT_ORACLE_SURFACE_H
#define GLINT_ORACLE_SURFACE_H

#include "oracle/oracle.h"
#include "oracle/vector.h"

// What a pixel sees about a path: how wide it is, and how much wider it gets per unit of length.
// Both keep their sign past a focus.
typedef struct cone {
    double width, spread;
} cone;

// The cone of a primary ray: as wide, at every distance, as neighbouring samples are apart.
cone oracle_primary_cone(const oracle_view *view, vector direction);

typedef struct surface {
    const oracle_material *material; // its factors
    int triangle, index;             // of the triangle, of the material
    vector point;
    vector geometric;        // n_g on the viewer's side
    vector lit;              // n: what receives light
    vector normal;           // n, on the viewer's side: n·v ≥ 0
    vector viewer;           // v
    double cosine;           // n·v
    bool front;              // met from outside
    vector clearcoat_normal; // likewise
    double clearcoat_cosine;
    double curvature; // how fast normals turn along the triangle, > 0 where the viewer's side is
                      // convex; 0 where a vertex has none
    // The factors, as textures and the vertices' colours change them.
    vector base, emission;
    vector specular_color;
    double metallic, roughness, transmission, specular, occlusion, coverage;
    double clearcoat, clearcoat_roughness;
    double film, film_thickness; // nm
    double through;              // how much of what paint sends on comes from behind
    vector through_color;
    vector sheen_color;
    double sheen_roughness;
    double anisotropy; // 0 where there is no tangent
    vector along;      // in which direction it is rougher: unit, at right angles to n
    double jump;       // see oracle_report
} surface;

// How a path arrives: its direction, its cone where it meets the surface, its whole length, and
// what the view says of textures.
typedef struct arrival {
    vector direction;
    double width, travelled;
    int taps; // of a texture at most
} arrival;

surface oracle_surface_at(const oracle_scene *scene, const oracle_hit *hit, const arrival *by);

// Whether its mesh bounds a solid; whether it is a wall of glass without thickness. Textures do not
// count.
bool oracle_is_solid(const oracle_material *m);
bool oracle_is_thin(const oracle_material *m);

// F0 as KHR_materials_specular colours it, before the factor.
vector oracle_tinted(const surface *s, double f0);

// What a dielectric reflects of light in a medium of the index `here`, where `there` is the next
// one's, with its film. KHR_materials_specular keeps how far Fresnel's term is on its way from F0
// to 1.
vector oracle_dielectric(const surface *s, double here, double there);

#endif
