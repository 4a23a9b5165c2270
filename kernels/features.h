// The one list of what a kernel can be compiled with. Each feature is passed to the kernel compiler
// as -DGLINT_<NAME>=0 or 1, always; host/render/plan.c decides and gives the reason, which
// `glint info` prints. The second column says what the feature adds to the kernel.
// To add one: a line here, its condition in plan.c, its code under #if in the kernels; the lint and
// the tests that compile every feature off and on find it by themselves.
#ifndef GLINT_KERNELS_FEATURES_H
#define GLINT_KERNELS_FEATURES_H

#define GLINT_FEATURES(FEATURE)                                                                    \
    FEATURE(GEOMETRY, "rays are traced against triangles")                                         \
    FEATURE(SMOOTH_NORMALS, "shading normals are interpolated from vertices")                      \
    FEATURE(MANY_MATERIALS, "materials are looked up for each hit")                                \
    FEATURE(FRESNEL, "reflectance rises towards grazing angles")                                   \
    FEATURE(MIRROR, "metal reflects")                                                              \
    FEATURE(TINT, "metal colours what it reflects")                                                \
    FEATURE(GLASS, "light passes through transmitting surfaces")                                   \
    FEATURE(SPLIT, "a path may go on both ways: reflected and transmitted")                        \
    FEATURE(SOLID, "light refracts into and out of solids by Snell's law")                         \
    FEATURE(THIN_WALL, "light passes straight through walls without thickness")                    \
    FEATURE(NESTED_MEDIA, "a path keeps the stack of solids that it is inside")                    \
    FEATURE(CONVEX_SOLID, "what leaves the one convex solid that there is meets nothing")          \
    FEATURE(ABSORPTION, "light is absorbed inside solids by Beer and Lambert's law")               \
    FEATURE(PAINT, "matte paint is lit by the environment's irradiance")                           \
    FEATURE(GLOSS, "smooth paint reflects under its Fresnel term")                                 \
    FEATURE(BLEND, "the lecture's blend of paint and mirror")                                      \
    FEATURE(UNLIT, "unlit surfaces end a path with their colour")                                  \
    FEATURE(EMISSION, "surfaces emit")                                                             \
    FEATURE(INTERREFLECTION, "paths go on to the surfaces that they meet next")                    \
    FEATURE(SUPERSAMPLING, "several samples a pixel")                                              \
    FEATURE(TRANSPARENT, "the background is left out and alpha kept")                              \
    FEATURE(ENV_ROTATION, "the environment is turned about +Y")                                    \
    FEATURE(IRRADIANCE_HARMONICS, "the irradiance is a polynomial of the normal and no map")       \
    FEATURE(PROXY, "the environment is as far away as a box or a sphere around the scene")         \
    FEATURE(MIP_LEVELS, "the environment is averaged over what a pixel sees of it")                \
    FEATURE(VERTEX_COLOR, "colours are found at vertices and interpolated")                        \
    FEATURE(VERTEX_DIRECTION, "directions are found at vertices and interpolated")                 \
    FEATURE(PIXEL_LIST, "the pixels that are rendered stand in a list")                            \
    FEATURE(HITS, "a pixel holds what its ray met instead of a colour")                            \
    FEATURE(TERMS, "what pixels are the sum of is stored, to light them anew")                     \
    FEATURE(TRUNCATION_SQUARES, "how unevenly truncated light is spread over pixels is counted")   \
    FEATURE(DIAGNOSTICS, "layers tell what became of each pixel's paths")

#endif
