// Tracks how much of the environment and of textures a pixel sees: its footprint. Each ray carries
// a cone: its width at the ray's start, and how fast it widens. Surfaces change the cone as lenses
// do in paraxial optics (Akenine-Möller et al., Improved Shader and Texture Level of Detail Using
// Ray Cones, 2021). Both numbers keep their sign past a focus. At the end of the cone, the
// environment is read from the levels whose texels are as wide as the cone. Behind rough glass rays
// carry a second cone: the part of the glass's lobe that one direction of the pixel stands for.
#define CARRIES_CONES GLINT_HAS_CONES(IS_COMPILED)
#define HEEDS_CURVATURE (CARRIES_CONES || GLINT_FACETS)
#define READS_LEVELS (GLINT_MIP_LEVELS || GLINT_FACETS) // of the environment
#if HEEDS_CURVATURE

typedef struct cone {
    real width;  // across, stored units
    real spread; // growth of the width per unit of length
} cone;

static inline cone make_cone(real width, real spread)
{
    cone made;
    made.width = width;
    made.spread = spread;
    return made;
}

// The cone of a primary ray whose direction has the length 1/inverse. Its width is the distance to
// the neighbouring ray, averaged over both axes.
static inline cone primary_cone(const glint_frame_record *frame, real inverse)
{
    const scalar share = R(0.5) / (scalar)frame->samples_per_axis;
    scalar width = 0, spread = 0;
#pragma unroll
    for (int way = 0; way < 2; way++) {
        const glint_split_vector *o = way == 0 ? &frame->origin_x : &frame->origin_y;
        const glint_split_vector *d = way == 0 ? &frame->direction_x : &frame->direction_y;
        scalar o2 = 0, d2 = 0;
#pragma unroll
        for (int k = 0; k < 3; k++) {
            const scalar ok = JOIN(o->high[k], o->low[k]), dk = JOIN(d->high[k], d->low[k]);
            o2 = fused(ok, ok, o2);
            d2 = fused(dk, dk, d2);
        }
        width += share * sqrt(o2);
        spread += share * sqrt(d2);
    }
    cone c;
    c.width = real_of(width);
    c.spread = spread * inverse;
    return c;
}

// The cone's width after the distance t.
static inline real width_after(const cone *c, real t) { return fused(c->spread, t, c->width); }

// How fast the normals of a triangle turn per unit of length: the root mean square over its edges.
// It is positive where the normals diverge.
static inline real curvature_of(const real3 vertices[3], const real3 normals[3])
{
    real turned = real_of(0), parted = real_of(0), length = real_of(0);
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const real3 edge = subtract(vertices[(k + 1) % 3], vertices[k]);
        const real3 turn = subtract(normals[(k + 1) % 3], normals[k]);
        turned += dot3(turn, turn);
        parted += dot3(turn, edge);
        length += dot3(edge, edge);
    }
    real magnitude = sqrt(turned / SELECT(length > R(0.0), length, real_of(1)));
    return SELECT(parted < R(0.0), -magnitude, magnitude);
}

// The cone that leaves a surface. `scaled` is the factor of the spread (1, or η for refracted
// light). `bend` is the turn of the ray per turn of the normal.
static inline cone leave_surface(real width, real spread, real scaled, real bend, real curvature)
{
    cone c;
    c.width = width;
    c.spread = fused(bend * curvature, width, scaled * spread);
    return c;
}

// The joint width of two independent widths; it is above 0, except if both are 0.
static inline real joined_width(real one, real other)
{
    return sqrt(fused(one, one, other * other));
}

// Reads levels finer than the cone's width by this factor; they look sharper and hardly alias.
#define LEVEL_BIAS R(0.7071067811865476)

// The level whose texels are about as wide as a cone, and how far towards the next one to go.
typedef struct level_choice {
    lanes_int level;
    real blend; // [0, 1)
} level_choice;

// Chooses the level for a unit vector `direction`. A texel is 2/edge wide at a distance of 1/(its
// largest component). Between powers of two, log2 is approximated as linear.
static inline level_choice choose_level(real spread, real3 direction, int edge, int last)
{
    const scalar texels_at_1 = R(0.5) * (scalar)edge * LEVEL_BIAS;
    real texels = fabs(spread) * texels_at_1 / largest_magnitude3(direction);
    const real most = real_of((scalar)(1 << last));
    texels = SELECT(texels > R(1.0), SMALLER(texels, most), real_of(1)); // NaN becomes 1
    level_choice choice;
    choice.level = exponent_of(texels);
    choice.blend = texels * inverse_exponent(texels) - R(1.0);
    return choice;
}

#endif
