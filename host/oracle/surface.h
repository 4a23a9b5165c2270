// Describes a surface where a path meets it. Internal to the oracle.
#ifndef GLINT_ORACLE_SURFACE_H
#define GLINT_ORACLE_SURFACE_H

#include "oracle/oracle.h"
#include "oracle/vector.h"

// The width of a pixel's cone, and its growth per unit of length. Both keep their sign past a
// focus.
typedef struct cone {
    double width, spread;
} cone;

// The cone of a primary ray. At every distance it is as wide as neighbouring samples are apart.
cone oracle_primary_cone(const oracle_view *view, vector direction);

typedef struct surface {
    const oracle_material *material; // unmodified factors
    // Index of the triangle; index of the material.
    int triangle, index;
    vector point;
    vector geometric;        // n_g on the viewer's side
    vector lit;              // n that receives light
    vector normal;           // n, on the viewer's side: n·v ≥ 0
    vector viewer;           // v
    double cosine;           // n·v
    bool front;              // met from outside
    vector clearcoat_normal; // n of the clear coat, on the viewer's side
    double clearcoat_cosine;
    // Change of the normal per length along the triangle. It is > 0 if the viewer's side is convex,
    // and 0 if a vertex has no normal.
    double curvature;
    // The factors after textures and the vertices' colours.
    vector base, emission;
    vector specular_color;
    double metallic, roughness, transmission, specular, occlusion, coverage;
    double clearcoat, clearcoat_roughness;
    double film, film_thickness; // nm
    double through;              // share of the paint's light that comes from behind
    vector through_color;
    vector sheen_color;
    double sheen_roughness;
    double anisotropy; // 0 without tangents
    vector along;      // direction of greater roughness: unit, at right angles to n
    double jump;       // see oracle_report
} surface;

// How a path arrives at a surface: its direction, the width of its cone there, its length so far,
// and the view's limit of taps.
typedef struct arrival {
    vector direction;
    double width, travelled;
    int taps;   // most taps of a texture
    bool lobes; // lobes, sheen and facets spread light
} arrival;

surface oracle_surface_at(const oracle_scene *scene, const oracle_hit *hit, const arrival *by);

// True if the material's mesh bounds a solid (is_solid), or is a wall of glass without thickness
// (is_thin). Textures do not count.
bool oracle_is_solid(const oracle_material *m);
bool oracle_is_thin(const oracle_material *m);

// F0 with the colour of KHR_materials_specular, before its factor.
vector oracle_tinted(const surface *s, double f0);

// The reflectance of a dielectric, with its film, for light in a medium of index `here` on a medium
// of index `there`. KHR_materials_specular changes F0, but keeps the weight of Fresnel's term
// between F0 and 1. `leaves`: the light leaves a solid, whose film is on the other side.
vector oracle_dielectric(const surface *s, double here, double there, bool leaves);

// The same of smooth paint in empty space. With high indices it has Schlick's edge (rule 6).
vector oracle_coat(const surface *s, double ior);

#endif
