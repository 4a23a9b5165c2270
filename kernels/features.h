// Lists the features that a kernel can be compiled with. The kernel compiler gets every feature as
// -DGLINT_<NAME>=0 or 1. host/render/plan_features.c decides and gives the reason, which `glint
// info` prints. The columns:
//   name
//   meaning   what the feature adds to the kernel
//   needs     a condition: the kernel compiles with the feature only if it is true; 1: always
//   excludes  a condition: the kernel compiles with the feature only if it is false; 0: none
//   unneeded  the effect of the feature if no scene or setting needs it. IDLE: it changes no bit of
//             a frame. ACTIVE: it changes the frame, or accesses buffers that do not exist then
// render.cl checks needs and excludes. tests/lint_kernels compiles each feature off and on,
// together with its needs. Tests compile all idle features to show that they change nothing.
#ifndef GLINT_KERNELS_FEATURES_H
#define GLINT_KERNELS_FEATURES_H

#define GLINT_FEATURES(FEATURE)                                                                    \
    FEATURE(GEOMETRY, "rays are traced against triangles", 1, 0, ACTIVE)                           \
    FEATURE(LOCAL_ORIGINS, "what is small beside the scene has an origin of its own",              \
            GLINT_GEOMETRY, GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                  \
    FEATURE(SMOOTH_NORMALS, "shading normals are interpolated from vertices", 1, 0, ACTIVE)        \
    FEATURE(MANY_MATERIALS, "materials are looked up for each hit", GLINT_GEOMETRY, 0, IDLE)       \
    FEATURE(FRESNEL, "reflectance rises towards grazing angles", GLINT_GEOMETRY, 0, ACTIVE)        \
    FEATURE(MIRROR, "metal reflects", GLINT_GEOMETRY, 0, IDLE)                                     \
    FEATURE(TINT, "metal colours what it reflects", GLINT_MIRROR, 0, IDLE)                         \
    FEATURE(GLASS, "light passes through transmitting surfaces", GLINT_GEOMETRY, 0, IDLE)          \
    FEATURE(ALPHA, "surfaces may be there in part: light passes straight through the rest",        \
            GLINT_INTERREFLECTION, GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION,     \
            ACTIVE)                                                                                \
    FEATURE(SPLIT, "a path may go on both ways: reflected and transmitted",                        \
            GLINT_GLASS || GLINT_ALPHA || GLINT_CLEARCOAT, 0, IDLE)                                \
    FEATURE(SOLID, "light refracts into and out of solids by Snell's law", GLINT_GLASS, 0, IDLE)   \
    FEATURE(THIN_WALL, "light passes straight through walls without thickness", GLINT_GLASS, 0,    \
            IDLE)                                                                                  \
    FEATURE(NESTED_MEDIA, "a path keeps the stack of solids that it is inside", GLINT_SOLID, 0,    \
            IDLE)                                                                                  \
    FEATURE(OVERLAPS, "solids that touch or overlap have one medium in one place",                 \
            GLINT_NESTED_MEDIA &&GLINT_ALPHA,                                                      \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                    \
    FEATURE(INSIDE, "the eye may be inside solids: a path begins in those that it leaves first",   \
            GLINT_SOLID &&GLINT_INTERREFLECTION,                                                   \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                    \
    FEATURE(CONVEX_SOLID, "what leaves the one convex solid that there is meets nothing",          \
            GLINT_SOLID, 0, ACTIVE)                                                                \
    FEATURE(ABSORPTION, "light is absorbed inside solids by Beer and Lambert's law", GLINT_SOLID,  \
            0, IDLE)                                                                               \
    FEATURE(PAINT, "matte paint is lit by the environment's irradiance", GLINT_GEOMETRY, 0, IDLE)  \
    FEATURE(DIFFUSE_TRANSMISSION, "matte paint is lit from behind, too", GLINT_PAINT,              \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS, ACTIVE)     \
    FEATURE(GLOSS, "smooth paint reflects under its Fresnel term", GLINT_PAINT, 0, IDLE)           \
    FEATURE(SPECULAR, "what paint and glass reflect is weighed and coloured", GLINT_FRESNEL, 0,    \
            ACTIVE)                                                                                \
    FEATURE(CLEARCOAT, "a clear coat reflects, and what is below gets the rest", GLINT_FRESNEL,    \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                    \
    FEATURE(IRIDESCENCE, "films on surfaces, as thin as waves, colour what they reflect",          \
            GLINT_FRESNEL, GLINT_HITS, ACTIVE)                                                     \
    FEATURE(ROUGH, "rough surfaces reflect lobes of the environment",                              \
            GLINT_MIRROR || GLINT_PAINT || GLINT_CLEARCOAT,                                        \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            ACTIVE)                                                                                \
    FEATURE(BRUSHED, "rough surfaces are rougher along a direction than across it",                \
            GLINT_ROUGH &&GLINT_NORMAL_MAPS,                                                       \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            ACTIVE)                                                                                \
    FEATURE(SHEEN, "fibres on metal and paint shine at grazing angles", GLINT_ROUGH,               \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            ACTIVE)                                                                                \
    FEATURE(FACETS, "paths go over the directions in which the facets of rough glass send light",  \
            GLINT_GLASS,                                                                           \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            ACTIVE)                                                                                \
    FEATURE(DISPERSION, "solids divide light into wavelengths, each with its index of refraction", \
            GLINT_SOLID,                                                                           \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS, ACTIVE)     \
    FEATURE(BLEND, "the lecture's blend of paint and mirror", GLINT_GEOMETRY, 0, IDLE)             \
    FEATURE(LIGHTS, "punctual lights shine on matte paint, and cast shadows",                      \
            GLINT_PAINT || GLINT_BLEND,                                                            \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                    \
    FEATURE(UNLIT, "unlit surfaces end a path with their colour", GLINT_GEOMETRY, 0, IDLE)         \
    FEATURE(EMISSION, "surfaces emit", GLINT_GEOMETRY, 0, IDLE)                                    \
    FEATURE(TEXTURES, "materials have textures", GLINT_GEOMETRY,                                   \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                    \
    FEATURE(ANISOTROPY, "textures are averaged along what a pixel sees at a slant",                \
            GLINT_TEXTURES, GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)    \
    FEATURE(SECOND_TEXCOORDS, "some textures have texture coordinates of their own",               \
            GLINT_TEXTURES, GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)    \
    FEATURE(NORMAL_MAPS, "textures bend normals", GLINT_TEXTURES,                                  \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                    \
    FEATURE(COLORED_VERTICES, "vertices have colours", GLINT_GEOMETRY,                             \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, ACTIVE)                    \
    FEATURE(INTERREFLECTION, "paths go on to the surfaces that they meet next", GLINT_GEOMETRY, 0, \
            IDLE)                                                                                  \
    FEATURE(SUPERSAMPLING, "several samples a pixel", 1, 0, IDLE)                                  \
    FEATURE(TRANSPARENT, "the background is left out and alpha kept", 1, 0, ACTIVE)                \
    FEATURE(ENV_ROTATION, "the environment is turned about +Y", 1, 0, IDLE)                        \
    FEATURE(IRRADIANCE_HARMONICS, "the irradiance is a polynomial of the normal and no map",       \
            GLINT_PAINT || GLINT_BLEND, 0, ACTIVE)                                                 \
    FEATURE(PROXY, "the environment is as far away as a box or a sphere around the scene", 1, 0,   \
            ACTIVE)                                                                                \
    FEATURE(MIP_LEVELS, "the environment is averaged over what a pixel sees of it", 1, 0, ACTIVE)  \
    FEATURE(VERTEX_COLOR, "colours are found at vertices and interpolated", GLINT_SMOOTH_NORMALS,  \
            GLINT_VERTEX_DIRECTION || GLINT_HITS, ACTIVE)                                          \
    FEATURE(VERTEX_DIRECTION, "directions are found at vertices and interpolated",                 \
            GLINT_SMOOTH_NORMALS, GLINT_VERTEX_COLOR || GLINT_HITS, ACTIVE)                        \
    FEATURE(PIXEL_LIST, "the pixels that are rendered stand in a list", 1, GLINT_TILES, ACTIVE)    \
    FEATURE(HITS, "a pixel holds what its ray met instead of a colour", GLINT_GEOMETRY, 0, ACTIVE) \
    FEATURE(TERMS, "what pixels are the sum of is stored, to light them anew", 1, 0, ACTIVE)       \
    FEATURE(TRUNCATION_SQUARES, "how unevenly truncated light is spread over pixels is counted",   \
            1, 0, IDLE)                                                                            \
    FEATURE(DIAGNOSTICS, "layers tell what became of each pixel's paths", 1, 0, ACTIVE)

#endif
