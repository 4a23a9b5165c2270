// Follows paths through rough glass, whose microfacets follow GGX, α = roughness². A path continues
// as from one visible facet, which is smooth and tilted against the surface. The directions of a
// pixel are numbered. Each number chooses other facets. Together the chosen facets are spread
// evenly over the visible ones.
#if GLINT_FACETS

// A path takes the next of these choices at each surface, and then the first again.
#define FACET_CHOICES 4

// The facets that a direction of a pixel stands for, in all its paths.
typedef struct facet_choice {
    scalar cosine[FACET_CHOICES], sine[FACET_CHOICES]; // of the turn about the normal
    scalar down[FACET_CHOICES]; // distance from the cap's top, [0, 1]
    scalar part[FACET_CHOICES]; // the path meets surfaces with a coverage above this, [0, 1]
    scalar width;               // √(1/number of directions)
} facet_choice;

// Number i of a sequence that fills [0, 1] evenly: the fractional part of i × fraction/2³².
static inline scalar part_of_turn(uint i, uint fraction)
{
    return ((scalar)(i * fraction + 0x80000000u) + R(0.5)) * R(2.3283064365386963e-10);
}

// The choices of direction i of `count`. The fractions are powers of 1/x with x³ = x + 1, x⁵ = x +
// 1 and x⁹ = x + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018), and
// the golden section and roots of 2, 3 and 7.
static inline facet_choice choose_facets(int i, int count)
{
    const uint turns[FACET_CHOICES] = {0xc13fa9a9u, 0xa0f2ec75u, 0xc862b36fu, 0xaa324f91u};
    const uint downs[FACET_CHOICES] = {0x91e10da5u, 0x89e18285u, 0xb8acd90du, 0x908e3d2du};
    const uint parts[FACET_CHOICES] = {0x9e3779b9u, 0x6a09e667u, 0xbb67ae85u, 0xa54ff53bu};
    facet_choice c;
    for (int k = 0; k < FACET_CHOICES; k++) {
        const scalar turn = part_of_turn((uint)i, turns[k]) * R(6.283185307179586);
        c.cosine[k] = cos(turn);
        c.sine[k] = sin(turn);
        c.down[k] = part_of_turn((uint)i, downs[k]);
        c.part[k] = part_of_turn((uint)i, parts[k]);
    }
    c.width = R(1.0) / sqrt((scalar)count);
    return c;
}

// The look-ups of a direction are blurred by this factor beyond the width that it stands for
// (measured).
#define FACET_BLUR R(2.0)

// The value of the choice that rays take after `met` surfaces.
static inline real chosen_of(const scalar values[FACET_CHOICES], lanes_int met)
{
    real value = real_of(values[0]);
    for (int k = 1; k < FACET_CHOICES; k++) {
        value = SELECT(met % (lane_int)FACET_CHOICES == (lane_int)k, real_of(values[k]), value);
    }
    return value;
}

// Axes at right angles to the normals. The first is as near as possible to the image's right.
static inline void facet_axes(const glint_frame_record *frame, real3 normal, real3 *first,
                              real3 *second)
{
    mask valid, upright;
    const real3 right = normalized(join_vector(&frame->image_x), &valid);
    const real3 up = normalized(join_vector(&frame->image_y), &valid);
    const real3 across = scale_add(normal, -dot3(normal, right), right);
    const mask beside = dot3(across, across) > R(1e-4);
    const real3 upwards = scale_add(normal, -dot3(normal, up), up);
    *first = normalized(select3(beside, across, upwards), &upright);
    *second = cross3(normal, *first);
}

// The facets' normals. If the visible facets of GGX are stretched to a sphere, h = v + c is spread
// evenly when c is spread evenly over the cap that v sees (Dupuy and Benyoub, Sampling visible GGX
// normals with spherical caps, 2023).
static inline real3 facet_normals(const glint_frame_record *frame, const facet_choice *chosen,
                                  lanes_int met, const surface *s, real alpha, real3 v)
{
    real3 first, second;
    facet_axes(frame, s->normal, &first, &second);
    mask valid;
    const real3 stretched = normalized(
        real3_of(alpha * dot3(first, v), alpha * dot3(second, v), s->cosine), &valid);
    const real z = fused(-chosen_of(chosen->down, met), R(1.0) + stretched.z, real_of(1));
    const real ring = sqrt(LARGER((R(1.0) - z) * (R(1.0) + z), real_of(0)));
    const real x = alpha * fused(ring, chosen_of(chosen->cosine, met), stretched.x);
    const real y = alpha * fused(ring, chosen_of(chosen->sine, met), stretched.y);
    const real up = LARGER(z + stretched.z, real_of(0));
    const real3 h = normalized(
        scale_add(s->normal, up, scale_add(second, y, scale(first, x))), &valid);
    // Rounding must not show a facet from behind.
    return select3(valid & (dot3(h, v) > R(0.0)), h, s->normal);
}

// Replaces the surface by a facet for the rays in `faceted`, which meet rough glass. If the surface
// covers partly, a share of the directions passes it.
static inline void take_facet(const glint_frame_record *frame, const facet_choice *chosen,
                              const path *ray, mask faceted, surface *s)
{
    facet *f = &s->facet;
#if GLINT_ALPHA
    const mask partly = faceted & (s->coverage < R(1.0));
    const mask passes = partly & (s->coverage <= chosen_of(chosen->part, ray->met));
    s->coverage = SELECT(partly, SELECT(passes, real_of(0), real_of(1)), s->coverage);
    faceted = faceted & (s->coverage > R(0.0));
#endif
    f->there = faceted;
    if (!any_lane(faceted)) {
        return;
    }
    // Choose the facet's normal.
    const real3 v = negate(ray->direction);
    const real alpha = s->roughness * s->roughness;
    f->normal = s->normal;
    f->cosine = s->cosine;
    f->alpha_squared = alpha * alpha;
    f->root = smith_root(f->alpha_squared, f->cosine);
    const real3 h = facet_normals(frame, chosen, ray->met, s, alpha, v);
    const real toward = dot3(h, v);
    // Visible facets have the density 2 v·h D/(n·v + √…), D = α²/(π A²).
    const real up = dot3(h, f->normal);
    const real3 aside = cross3(h, f->normal);
    const real a = fused(f->alpha_squared * up, up, dot3(aside, aside));
    const real wide = R(1.5707963267948966) * a * a * (f->cosine + f->root);
    const real ratio = wide / LARGER(f->alpha_squared * toward, real_of(R(1e-30)));
    f->width = chosen->width * FACET_BLUR * SMALLER(sqrt(ratio), real_of(R(1e4)));
    s->normal = select3(faceted, h, s->normal);
    s->cosine = SELECT(faceted, SMALLER(toward, real_of(1)), s->cosine);
}

// The share of light leaving a facet, at this cosine to the surface's normal, that no other facet
// blocks. It is Smith's height-correlated G, divided by the G of the arriving light.
static inline real facet_openness(const facet *f, real cosine)
{
    const real root = smith_root(f->alpha_squared, cosine);
    const real open = cosine * (f->cosine + f->root) / fused(cosine, f->root, f->cosine * root);
    return SELECT(cosine > R(0.0), open, real_of(0));
}

#endif
