// Lists the features that a kernel can be compiled with. The kernel compiler gets every feature as
// -DGLINT_<NAME>=0 or 1. host/render/plan_features.c decides and gives the reason, which `glint
// info` prints. The columns:
//   name
//   meaning   what the feature adds to the kernel
//   needs     a condition: the kernel compiles with the feature only if it is true; 1: always
//   excludes  a condition: the kernel compiles with the feature only if it is false; 0: none
//   unneeded  the effect of the feature if no scene or setting needs it. IDLE: it changes no bit of
//             a frame; general kernels may ask HAS(NAME) to save time. SWITCHED: in a general
//             kernel the code asks HAS(NAME) before it uses the feature. ACTIVE: it changes the
//             frame, or accesses buffers that do not exist then
//   general   the smallest general kernel that contains the feature; each contains all features of
//             the smaller ones. NONE: no general kernel has the feature
// A special kernel contains the features that one scene needs. A general kernel, compiled with
// -DGLINT_GENERAL=1, serves every scene that needs no other feature than it has, with the same
// bits (host/render/general.h).
// render.cl checks needs and excludes. tests/lint_kernels compiles every two features off
// and on, together with their needs. Tests compare frames of general and special kernels.
#ifndef GLINT_KERNELS_FEATURES_H
#define GLINT_KERNELS_FEATURES_H

// The general kernels, by size, with the names that users see. MIRRORS: paths end at their first
// surface, a mirror (mirrors.cl). PATHS: paths over smooth and matte surfaces. EVERYTHING: all that
// glTF files describe.
#define GLINT_GENERAL_KERNELS(KERNEL)                                                              \
    KERNEL(MIRRORS, "mirrors") KERNEL(PATHS, "paths") KERNEL(EVERYTHING, "everything")

#define GLINT_FEATURES(FEATURE)                                                                    \
    FEATURE(GEOMETRY, "rays are traced against triangles", 1, 0, SWITCHED, MIRRORS)                \
    FEATURE(LOCAL_ORIGINS, "what is small beside the scene has an origin of its own",              \
            GLINT_GEOMETRY, GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)    \
    FEATURE(SMOOTH_NORMALS, "shading normals are interpolated from vertices", 1, 0, SWITCHED,      \
            MIRRORS)                                                                               \
    FEATURE(MANY_MATERIALS, "materials are looked up for each hit", GLINT_GEOMETRY, 0, IDLE,       \
            MIRRORS)                                                                               \
    FEATURE(FRESNEL, "reflectance rises towards grazing angles", GLINT_GEOMETRY, 0, SWITCHED,      \
            MIRRORS)                                                                               \
    FEATURE(MIRROR, "metal reflects", GLINT_GEOMETRY, 0, IDLE, MIRRORS)                            \
    FEATURE(TINT, "metal colours what it reflects", GLINT_MIRROR, 0, IDLE, MIRRORS)                \
    FEATURE(GLASS, "light passes through transmitting surfaces", GLINT_GEOMETRY, 0, IDLE, PATHS)   \
    FEATURE(ALPHA, "surfaces may be there in part: light passes straight through the rest",        \
            GLINT_INTERREFLECTION, GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION,     \
            SWITCHED, EVERYTHING)                                                                  \
    FEATURE(SPLIT, "a path may go on both ways: reflected and transmitted",                        \
            GLINT_GLASS || GLINT_ALPHA || GLINT_CLEARCOAT, 0, IDLE, PATHS)                         \
    FEATURE(SOLID, "light refracts into and out of solids by Snell's law", GLINT_GLASS, 0, IDLE,   \
            PATHS)                                                                                 \
    FEATURE(THIN_WALL, "light passes straight through walls without thickness", GLINT_GLASS, 0,    \
            IDLE, PATHS)                                                                           \
    FEATURE(NESTED_MEDIA, "a path keeps the stack of solids that it is inside", GLINT_SOLID, 0,    \
            IDLE, PATHS)                                                                           \
    FEATURE(OVERLAPS, "solids that touch or overlap have one medium in one place",                 \
            GLINT_NESTED_MEDIA &&GLINT_ALPHA,                                                      \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)      \
    FEATURE(INSIDE, "the eye may be inside solids: a path begins in those that it leaves first",   \
            GLINT_SOLID &&GLINT_INTERREFLECTION,                                                   \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)      \
    FEATURE(CONVEX_SOLID, "what leaves the one convex solid that there is meets nothing",          \
            GLINT_SOLID, 0, SWITCHED, PATHS)                                                       \
    FEATURE(ABSORPTION, "light is absorbed inside solids by Beer and Lambert's law", GLINT_SOLID,  \
            0, IDLE, PATHS)                                                                        \
    FEATURE(PAINT, "matte paint is lit by the environment's irradiance", GLINT_GEOMETRY, 0,        \
            SWITCHED, PATHS)                                                                       \
    FEATURE(DIFFUSE_TRANSMISSION, "matte paint is lit from behind, too", GLINT_PAINT,              \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS, SWITCHED,   \
            EVERYTHING)                                                                            \
    FEATURE(GLOSS, "smooth paint reflects under its Fresnel term", GLINT_PAINT, 0, SWITCHED,       \
            PATHS)                                                                                 \
    FEATURE(SPECULAR, "what paint and glass reflect is weighed and coloured", GLINT_FRESNEL, 0,    \
            SWITCHED, EVERYTHING)                                                                  \
    FEATURE(CLEARCOAT, "a clear coat reflects, and what is below gets the rest", GLINT_FRESNEL,    \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)      \
    FEATURE(IRIDESCENCE, "films on surfaces, as thin as waves, colour what they reflect",          \
            GLINT_FRESNEL, GLINT_HITS, SWITCHED, EVERYTHING)                                       \
    FEATURE(ROUGH, "rough surfaces reflect lobes of the environment",                              \
            GLINT_MIRROR || GLINT_PAINT || GLINT_CLEARCOAT,                                        \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            SWITCHED, PATHS)                                                                       \
    FEATURE(BRUSHED, "rough surfaces are rougher along a direction than across it",                \
            GLINT_ROUGH &&GLINT_NORMAL_MAPS,                                                       \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            SWITCHED, EVERYTHING)                                                                  \
    FEATURE(SHEEN, "fibres on metal and paint shine at grazing angles", GLINT_ROUGH,               \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            SWITCHED, EVERYTHING)                                                                  \
    FEATURE(FACETS, "paths go over the directions in which the facets of rough glass send light",  \
            GLINT_GLASS,                                                                           \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS ||           \
                GLINT_PROXY,                                                                       \
            SWITCHED, EVERYTHING)                                                                  \
    FEATURE(DISPERSION, "solids divide light into wavelengths, each with its index of refraction", \
            GLINT_SOLID,                                                                           \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION || GLINT_TERMS, SWITCHED,   \
            EVERYTHING)                                                                            \
    FEATURE(BLEND, "the lecture's blend of paint and mirror", GLINT_GEOMETRY, 0, SWITCHED, PATHS)  \
    FEATURE(LIGHTS, "punctual lights shine on paint and rough surfaces, and cast shadows",         \
            GLINT_PAINT || GLINT_BLEND || GLINT_ROUGH,                                             \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)      \
    FEATURE(UNLIT, "unlit surfaces end a path with their colour", GLINT_GEOMETRY, 0, IDLE, PATHS)  \
    FEATURE(EMISSION, "surfaces emit", GLINT_GEOMETRY, 0, IDLE, PATHS)                             \
    FEATURE(TEXTURES, "materials have textures", GLINT_GEOMETRY,                                   \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)      \
    FEATURE(ANISOTROPY, "textures are averaged along what a pixel sees at a slant",                \
            GLINT_TEXTURES, GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED,  \
            EVERYTHING)                                                                            \
    FEATURE(SECOND_TEXCOORDS, "some textures have texture coordinates of their own",               \
            GLINT_TEXTURES, GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED,  \
            EVERYTHING)                                                                            \
    FEATURE(NORMAL_MAPS, "textures bend normals", GLINT_TEXTURES,                                  \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)      \
    FEATURE(COLORED_VERTICES, "vertices have colours", GLINT_GEOMETRY,                             \
            GLINT_HITS || GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION, SWITCHED, EVERYTHING)      \
    FEATURE(INTERREFLECTION, "paths go on to the surfaces that they meet next", GLINT_GEOMETRY, 0, \
            IDLE, PATHS)                                                                           \
    FEATURE(SUPERSAMPLING, "several samples a pixel", 1, 0, IDLE, MIRRORS)                         \
    FEATURE(TRANSPARENT, "the background is left out and alpha kept", 1, 0, SWITCHED, PATHS)       \
    FEATURE(ENV_ROTATION, "the environment is turned about +Y", 1, 0, IDLE, MIRRORS)               \
    FEATURE(IRRADIANCE_HARMONICS, "the irradiance is a polynomial of the normal and no map",       \
            GLINT_PAINT || GLINT_BLEND, 0, SWITCHED, EVERYTHING)                                   \
    FEATURE(PROXY, "the environment is as far away as a box or a sphere around the scene", 1, 0,   \
            SWITCHED, EVERYTHING)                                                                  \
    FEATURE(MIP_LEVELS, "the environment is averaged over what a pixel sees of it", 1, 0,          \
            SWITCHED, EVERYTHING)                                                                  \
    FEATURE(VERTEX_COLOR, "colours are found at vertices and interpolated", GLINT_SMOOTH_NORMALS,  \
            GLINT_VERTEX_DIRECTION || GLINT_HITS, ACTIVE, NONE)                                    \
    FEATURE(VERTEX_DIRECTION, "directions are found at vertices and interpolated",                 \
            GLINT_SMOOTH_NORMALS, GLINT_VERTEX_COLOR || GLINT_HITS, ACTIVE, NONE)                  \
    FEATURE(PIXEL_LIST, "the pixels that are rendered stand in a list", 1, GLINT_TILES, SWITCHED,  \
            MIRRORS)                                                                               \
    FEATURE(HITS, "a pixel holds what its ray met instead of a colour", GLINT_GEOMETRY, 0, ACTIVE, \
            NONE)                                                                                  \
    FEATURE(TERMS, "what pixels are the sum of is stored, to light them anew", 1, 0, ACTIVE, NONE) \
    FEATURE(TRUNCATION_SQUARES, "how unevenly truncated light is spread over pixels is counted",   \
            1, 0, IDLE, MIRRORS)                                                                   \
    FEATURE(DIAGNOSTICS, "layers tell what became of each pixel's paths", 1, 0, SWITCHED,          \
            EVERYTHING)

// The numbers of the features: a general kernel finds the features that a scene needs as bits of
// glint_frame_record.features.
typedef enum glint_feature {
#define GLINT_FEATURE_NAME(name, ...) GLINT_FEATURE_##name,
    GLINT_FEATURES(GLINT_FEATURE_NAME)
#undef GLINT_FEATURE_NAME
        GLINT_FEATURE_COUNT
} glint_feature;

// True if each sample takes one look-up (mirrors.cl): mirrors that see only the environment, and
// the environment alone. HAS takes a feature's name.
#define GLINT_TAKES_ONE_LOOKUP(HAS)                                                                \
    (!HAS(INTERREFLECTION) && !HAS(GLASS) && !HAS(MIP_LEVELS) && !HAS(PAINT) && !HAS(BLEND) &&     \
     !HAS(UNLIT) && !HAS(EMISSION) && !HAS(TRANSPARENT) && !HAS(ROUGH) && !HAS(VERTEX_COLOR) &&    \
     !HAS(HITS) && !HAS(TERMS) && !HAS(VERTEX_DIRECTION) && !HAS(PROXY) && !HAS(TEXTURES) &&       \
     !HAS(COLORED_VERTICES) && !HAS(CLEARCOAT) && !HAS(IRIDESCENCE) &&                             \
     (HAS(MIRROR) || !HAS(GEOMETRY)))

#endif
