// Integrates over the lobes of rough surfaces, by plain quadrature over directions. See rough.h.
#include "oracle/rough.h"

#include <stddef.h>

static const double PI = 3.14159265358979323846;

// The length of a vector after scaling its components along and across the brush, and along n.
static double stretched(const surface *s, double along, double across, double up, vector a)
{
    double x = dot(s->along, a) * along, n = dot(s->normal, a), z = n * up;
    double squared = dot(a, a) - dot(s->along, a) * dot(s->along, a) - n * n;
    return sqrt(x * x + fmax(0.0, squared) * across * across + z * z);
}

// lobe_weight of an anisotropic surface: α + (1 − α) anisotropy² along the brush, α across it.
static double brushed_weight(const surface *s, double alpha, vector l, vector h)
{
    double nl = dot(s->normal, l), nv = s->cosine;
    double longer = alpha + (1.0 - alpha) * s->anisotropy * s->anisotropy;
    double q = stretched(s, 1.0 / longer, 1.0 / alpha, 1.0, h);
    double d = 1.0 / (PI * longer * alpha * q * q * q * q);
    double of_v = stretched(s, longer, alpha, 1.0, s->viewer);
    double of_l = stretched(s, longer, alpha, 1.0, l);
    return d * 0.5 / (nl * of_v + nv * of_l) * nl;
}

// D V n·l, with GGX's D and the height-correlated V of Smith's shadowing function.
static double lobe_weight(const surface *s, double alpha, vector l, vector h)
{
    double nl = dot(s->normal, l), nv = s->cosine;
    if (!(nl > 0.0))
        return 0.0;
    if (s->anisotropy > 0.0)
        return brushed_weight(s, alpha, l, h);
    double a2 = alpha * alpha;
    // Compute 1 − (n·h)² as |n × h|², which does not cancel near the lobe's middle.
    vector across = cross(s->normal, h);
    double cos_squared = dot(s->normal, h) * dot(s->normal, h);
    double q = a2 * cos_squared + dot(across, across);
    double d = a2 / (PI * q * q);
    double of_v = sqrt(a2 + (1.0 - a2) * nv * nv), of_l = sqrt(a2 + (1.0 - a2) * nl * nl);
    return d * 0.5 / (nl * of_v + nv * of_l) * nl;
}

lobe_integrals oracle_lobe_towards(const surface *s, double roughness, vector direction)
{
    vector h = unit(plus(direction, s->viewer));
    double weight = lobe_weight(s, roughness * roughness, direction, h);
    double m = pow(1.0 - dot(s->viewer, h), 5.0);
    return (lobe_integrals){.white_base = weight * (1.0 - m), .white_edge = weight * m};
}

// Interpolates a film's table. See rough.h.
static vector from_table(const vector *table, double cosine)
{
    double at = fmin(fmax(cosine, 0.0), 1.0) * ORACLE_FILM_STEPS;
    int below = at < ORACLE_FILM_STEPS ? (int)at : ORACLE_FILM_STEPS - 1;
    double far = at - below;
    return plus(scaled(table[below], 1.0 - far), scaled(table[below + 1], far));
}

static void add_direction(lobe_integrals *sum, const vector *table, double toward, vector seen,
                          double weight)
{
    if (table != NULL) {
        vector reflected = scaled(from_table(table, toward), weight);
        sum->base = plus(sum->base, times(reflected, seen));
        sum->edge = plus(sum->edge, reflected);
        return;
    }
    double m = pow(1.0 - toward, 5.0);
    sum->base = plus(sum->base, scaled(seen, weight * (1.0 - m)));
    sum->edge = plus(sum->edge, scaled(seen, weight * m));
    sum->white_base += weight * (1.0 - m);
    sum->white_edge += weight * m;
}

lobe_integrals oracle_film_lobe(const surface *s, int strata, const vector *table, seen_light light,
                                const void *context)
{
    double alpha = fmax(s->roughness, 0.01) * fmax(s->roughness, 0.01);
    vector axis = {{0.0, 0.0, 0.0}};
    oracle_reflect(s->normal.at, s->viewer.at, axis.at);
    axis = unit(axis);
    // The axes across the plane of incidence and in it.
    vector across = cross(s->normal, s->viewer);
    if (!(largest_magnitude(across) > 1e-6))
        across = cross(axis, fabs(axis.at[0]) < 0.6 ? (vector){{1, 0, 0}} : (vector){{0, 1, 0}});
    across = unit(across);
    vector within = cross(across, axis);
    // Rings about the axis, at angles γ = π sinh(kt)/sinh(k), dense where the lobe is narrow.
    double k = asinh(PI / (0.5 * alpha * fmax(s->cosine, 0.05)));
    lobe_integrals sum = {{{0.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}}, 0.0, 0.0};
    for (int ring = 0; ring < strata; ring++) {
        double t = (ring + 0.5) / strata, angle = PI * sinh(k * t) / sinh(k);
        double ring_width = PI * k * cosh(k * t) / sinh(k) / strata;
        double share = sin(angle) * ring_width * 2.0 * PI / strata;
        for (int sector = 0; sector < strata; sector++) {
            double turn = 2.0 * PI * (sector + 0.5) / strata;
            vector aside = plus(scaled(within, cos(turn)), scaled(across, sin(turn)));
            vector l = plus(scaled(axis, cos(angle)), scaled(aside, sin(angle)));
            vector h = unit(plus(l, s->viewer));
            double weight = share * lobe_weight(s, alpha, l, h);
            if (!(weight > 0.0))
                continue;
            add_direction(&sum, table, dot(s->viewer, h), light(context, l), weight);
        }
    }
    return sum;
}

lobe_integrals oracle_lobe(const surface *s, int strata, seen_light light, const void *context)
{
    return oracle_film_lobe(s, strata, NULL, light, context);
}

// The place of a path's `met`th facet among `count` facets. It is a permutation that differs from
// surface to surface.
static int place_at(int number, int count, int met)
{
    // An odd multiplier permutes the numbers below a power of two. `size` is the next one that
    // holds count.
    unsigned size = 1, at = (unsigned)number;
    while (size < (unsigned)count)
        size *= 2;
    for (int turn = 1; met > 1 && turn <= 3;) {
        at = (at * (2654435769u + 2u * (unsigned)met) + (unsigned)(turn * 40503 * met)) % size;
        at ^= at / 32;
        turn += at < (unsigned)count; // repeat until it is below count
    }
    return (int)at;
}

surface oracle_facet(const surface *s, int number, int count, int met)
{
    // The points form a spiral that fills a disk evenly.
    int at = place_at(number, count, met);
    double radius = sqrt((at + 0.5) / count), turn = at * PI * (3.0 - sqrt(5.0));
    // Heitz, Sampling the GGX distribution of visible normals, 2018: stretched to a hemisphere, v
    // sees half a disk and half an ellipse, across v.
    double alpha = s->roughness * s->roughness;
    vector n = s->normal, v = s->viewer, least = {{0.0, 0.0, 0.0}};
    vector stretched = unit(plus(scaled(v, alpha), scaled(n, (1.0 - alpha) * s->cosine)));
    vector level = cross(n, stretched);
    least.at[fabs(n.at[0]) < 0.6 ? 0 : 1] = 1.0;
    level = unit(dot(level, level) > 1e-20 ? level : cross(n, least));
    double x = radius * cos(turn), y = radius * sin(turn), half = 0.5 * (1.0 + dot(n, stretched));
    y = (1.0 - half) * sqrt(1.0 - x * x) + half * y;
    vector h = plus(scaled(level, x), scaled(cross(stretched, level), y));
    h = plus(h, scaled(stretched, sqrt(fmax(0.0, 1.0 - x * x - y * y))));
    double up = fmax(0.0, dot(n, h));
    h = unit(plus(scaled(minus(h, scaled(n, dot(n, h))), alpha), scaled(n, up)));
    surface facet = *s;
    facet.normal = h;
    facet.cosine = fmin(1.0, fmax(0.0, dot(h, v)));
    return facet;
}

static double smith_root(double alpha, double cosine)
{
    return sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
}

double oracle_opening(const surface *s, double cosine)
{
    double alpha = s->roughness * s->roughness;
    if (!(cosine > 0.0))
        return 0.0;
    double of_v = smith_root(alpha, s->cosine), of_l = smith_root(alpha, cosine);
    return cosine * (s->cosine + of_v) / (cosine * of_v + s->cosine * of_l);
}
