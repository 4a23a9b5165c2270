// The state of a path: a row for each member. Kernels expand this table to the struct, its start,
// its assignment, and the branches that wait (path.cl, branches.cl). The host computes a branch's
// size from it.
#ifndef GLINT_KERNELS_PATH_STATE_H
#define GLINT_KERNELS_PATH_STATE_H

// MEMBER(kind, name, needs, waits, start, meaning)
//   kind     REAL3, REAL, CONE (cones.cl): numbers. BITS: an integer as wide as a number. COUNT: an
//            int. Members of the kind COUNT come last, so that a branch has no gaps.
//   needs    a row of GLINT_PATH_NEEDS: without it there is no such member
//   waits    1: a branch that waits keeps the member. 0: the member has its start value when the
//            branch goes on, or branches.cl sets it.
//   start    the value where a path begins; a ray replaces origin, direction and the like
#define GLINT_PATH_STATE(MEMBER)                                                                   \
    MEMBER(REAL3, origin, ALWAYS, 1, 0, "of the ray")                                              \
    MEMBER(REAL3, origin_low, LOW_PARTS, 1, 0, "the low parts of the origin")                      \
    MEMBER(REAL3, direction, ALWAYS, 1, 0, "of the ray, a unit vector")                            \
    MEMBER(REAL3, weight, ALWAYS, 1, 1, "factor of arriving radiance in the pixel's value")        \
    MEMBER(REAL, travelled, ABSORPTION, 0, 0,                                                      \
           "length of the segment before the origin: primary rays start late")                     \
    MEMBER(CONE, cone, CONES, 1, 0, "what the pixel sees at the origin")                           \
    MEMBER(CONE, lobe, FACETS, 1, 0,                                                               \
           "part of rough glass's lobes that the direction stands for; 0 before any")              \
    MEMBER(REAL3, held, ROUGH, 1, 0, "a lobe's light: at its end the path takes it, and")          \
    MEMBER(REAL, shown, ROUGH, 1, 1, "this share of the environment's light")                      \
    MEMBER(BITS, from, ALWAYS, 1, -1, "place of the triangle that the ray starts on; -1: none")    \
    MEMBER(BITS, media, ALWAYS, 1, 0, "the solids that the path is inside, see media.cl")          \
    MEMBER(BITS, looked_up, ALWAYS, 0, 0,                                                          \
           "if it is not 0, the path takes the environment along its direction without tracing; "  \
           "1: the path is cut short; ESCAPES: it meets nothing")                                  \
    MEMBER(COUNT, met, ALWAYS, 1, 0, "surfaces met so far")                                        \
    MEMBER(COUNT, passed, ALPHA, 1, 0, "of these, those that were absent where the ray met them")  \
    MEMBER(COUNT, dispersed, DISPERSION, 1, 0, "1: its light is of one wavelength")

// True if origins are sums of two floats; doubles have enough digits. True if rays carry cones. HAS
// takes a feature's name.
#define GLINT_HAS_LOCAL_RAYS(HAS, IS_DOUBLE) (HAS(LOCAL_ORIGINS) && !(IS_DOUBLE))
#define GLINT_HAS_CONES(HAS) (HAS(MIP_LEVELS) || HAS(TEXTURES))

// NEED(name, condition)
#define GLINT_PATH_NEEDS(NEED, HAS, IS_DOUBLE)                                                     \
    NEED(ALWAYS, 1)                                                                                \
    NEED(LOW_PARTS, GLINT_HAS_LOCAL_RAYS(HAS, IS_DOUBLE))                                          \
    NEED(CONES, GLINT_HAS_CONES(HAS))                                                              \
    NEED(ABSORPTION, HAS(ABSORPTION))                                                              \
    NEED(ALPHA, HAS(ALPHA))                                                                        \
    NEED(ROUGH, HAS(ROUGH))                                                                        \
    NEED(FACETS, HAS(FACETS))                                                                      \
    NEED(DISPERSION, HAS(DISPERSION))

// Bytes of a member in a branch that waits; `number` is the size of a number in the precision.
#define GLINT_BYTES_REAL3(number) (3u * (number))
#define GLINT_BYTES_REAL(number) (number)
#define GLINT_BYTES_CONE(number) (2u * (number))
#define GLINT_BYTES_BITS(number) (number)
#define GLINT_BYTES_COUNT(number) 4u

// Bytes that a branch has besides: its pixel and its kind.
#define GLINT_BRANCH_OWN_BYTES 8u

#endif
