// Computes sheen, fibres that stand on a surface, by plain quadrature over directions. See rough.h.
#include "oracle/rough.h"

static const double PI = 3.14159265358979323846;

static double mixed(double at_0, double at_1, double share)
{
    return at_0 + (at_1 - at_0) * share;
}

// L(x) of KHR_materials_sheen; lambda below is its Λ.
static double helper(double x, double alpha)
{
    double share = pow(1.0 - alpha, 2.0);
    double a = mixed(21.5473, 25.3245, share), b = mixed(3.82987, 3.32435, share);
    double c = mixed(0.19823, 0.16801, share), d = mixed(-1.97760, -1.27393, share);
    double e = mixed(-4.32054, -4.85967, share);
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

static double lambda(double cosine, double alpha)
{
    if (cosine < 0.5)
        return exp(helper(cosine, alpha));
    return exp(2.0 * helper(0.5, alpha) - helper(1.0 - cosine, alpha));
}

double oracle_sheen_towards(const surface *s, vector direction)
{
    double alpha = pow(fmax(s->sheen_roughness, 0.07), 2.0);
    double nl = dot(s->normal, direction), nv = fmax(s->cosine, 1e-4);
    if (!(nl > 0.0))
        return 0.0;
    vector across = cross(s->normal, unit(plus(direction, s->viewer)));
    double sine = sqrt(dot(across, across));
    double d = (2.0 + 1.0 / alpha) * pow(sine, 1.0 / alpha) / (2.0 * PI);
    double v = 1.0 / ((1.0 + lambda(nv, alpha) + lambda(nl, alpha)) * 4.0 * nv * nl);
    return d * v * nl;
}

lobe_integrals oracle_sheen(const surface *s, int strata, seen_light light, const void *context)
{
    // Directions by angle about the normal and height above the surface. The height ~ t² is dense
    // at the horizon.
    vector first = cross(s->normal, s->viewer);
    if (!(largest_magnitude(first) > 1e-6))
        first = cross(s->normal,
                      fabs(s->normal.at[0]) < 0.6 ? (vector){{1, 0, 0}} : (vector){{0, 1, 0}});
    first = unit(first);
    vector second = cross(s->normal, first);
    lobe_integrals sum = {{{0.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}}, 0.0, 0.0};
    for (int ring = 0; ring < strata; ring++) {
        double t = (ring + 0.5) / strata, height = 0.5 * PI * t * t;
        double share = cos(height) * PI * t / strata * PI / strata;
        for (int sector = 0; sector < 2 * strata; sector++) {
            double turn = PI * (sector + 0.5) / strata;
            vector aside = plus(scaled(first, cos(turn)), scaled(second, sin(turn)));
            vector l = plus(scaled(s->normal, sin(height)), scaled(aside, cos(height)));
            double weight = share * oracle_sheen_towards(s, l);
            sum.base = plus(sum.base, scaled(light(context, l), weight));
            sum.white_base += weight;
        }
    }
    return sum;
}
