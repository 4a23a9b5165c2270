// Computes reflection, refraction, Fresnel's term and absorption.
#include "oracle/film.h"
#include "oracle/surface.h"
#include "oracle/vector.h"

void oracle_reflect(const double normal[3], const double viewer[3], double reflected[3])
{
    vector n = vector_of(normal), v = vector_of(viewer);
    vector_store(minus(scaled(n, 2.0 * dot(n, v)), v), reflected);
}

bool oracle_refract(const double normal[3], const double viewer[3], double eta, double refracted[3])
{
    vector n = vector_of(normal), v = vector_of(viewer);
    double cos_incident = fmin(dot(n, v), 1.0);
    // Snell: sin θt = η sin θi, so cos²θt = 1 − η²(1 − cos²θi). Negative: total reflection.
    double cos_squared = 1.0 - eta * eta * (1.0 - cos_incident * cos_incident);
    if (!(cos_squared >= 0.0))
        return false;
    double along_normal = eta * cos_incident - sqrt(cos_squared);
    vector_store(plus(scaled(v, -eta), scaled(n, along_normal)), refracted);
    return true;
}

double oracle_fresnel(double cos_incident, double ior_incident, double ior_transmitted)
{
    if (ior_incident == ior_transmitted)
        return 0.0; // no interface, also at 90°, where the quotients would be 0/0
    double c = fmin(fmax(cos_incident, 0.0), 1.0);
    double eta = ior_incident / ior_transmitted;
    double cos_squared = 1.0 - eta * eta * (1.0 - c * c);
    if (!(cos_squared >= 0.0))
        return 1.0;
    double ct = sqrt(cos_squared);
    // Amplitudes for light polarised perpendicular (s) and parallel (p) to the plane of incidence.
    double rs =
        (ior_incident * c - ior_transmitted * ct) / (ior_incident * c + ior_transmitted * ct);
    double rp =
        (ior_transmitted * c - ior_incident * ct) / (ior_transmitted * c + ior_incident * ct);
    return 0.5 * (rs * rs + rp * rp);
}

double oracle_transmittance(double colour, double colour_distance, double length_inside)
{
    if (!(length_inside > 0.0) || colour >= 1.0)
        return 1.0;
    if (colour <= 0.0)
        return 0.0; // σ is infinite
    return exp(log(colour) / colour_distance * length_inside);
}

vector oracle_tinted(const surface *s, double f0)
{
    vector f = {{0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++)
        f.at[i] = fmin(1.0, f0 * s->specular_color.at[i]);
    return f;
}

// The reflectance of a dielectric with its film, for light from the medium `here`. It is the same
// from both sides. The base that a colour tints is the inner one: the stack is seen from outside.
static vector filmed(const surface *s, double here, double there, bool leaves)
{
    double outer = leaves ? there : here, inner = leaves ? here : there;
    double sine = here / outer * sqrt(fmax(0.0, 1.0 - s->cosine * s->cosine));
    double cosine = leaves ? sqrt(fmax(0.0, 1.0 - sine * sine)) : s->cosine;
    film_stack stack = {
        .above = outer, .film = s->material->film_ior, .thickness = s->film_thickness};
    double f0 = (outer - inner) * (outer - inner) / ((outer + inner) * (outer + inner));
    vector tinted = oracle_tinted(s, f0);
    for (int i = 0; i < 3; i++) {
        double index = oracle_index_of(tinted.at[i]);
        stack.base[i] = tinted.at[i] == f0 ? inner : inner > outer ? outer * index : outer / index;
    }
    return scaled(oracle_film(&stack, cosine), s->specular);
}

// A dielectric whose reflectance is the share `schlick` of Schlick's term and the rest of
// Fresnel's. `leaves`: the light leaves the solid.
static vector mixed_dielectric(const surface *s, double here, double there, double schlick,
                               bool leaves)
{
    double f0 = oracle_fresnel(1.0, here, there);
    double exact = (oracle_fresnel(s->cosine, here, there) - f0) / (1.0 - f0);
    double way = schlick * pow(1.0 - s->cosine, 5.0);
    if (schlick < 1.0) // else 1 − F0 may have few digits
        way += (1.0 - schlick) * exact;
    vector reflected = {{0.0, 0.0, 0.0}}, from = oracle_tinted(s, f0);
    for (int i = 0; i < 3; i++)
        reflected.at[i] = s->specular * (way < 0.0 ? from.at[i] * (f0 + (1.0 - f0) * way) / f0
                                                   : from.at[i] + (1.0 - from.at[i]) * way);
    double sine = sqrt(fmax(0.0, 1.0 - s->cosine * s->cosine));
    bool total = here * sine >= there || here * sine >= s->material->film_ior;
    if (s->film == 0.0 || total)
        return reflected;
    return plus(scaled(reflected, 1.0 - s->film), scaled(filmed(s, here, there, leaves), s->film));
}

vector oracle_dielectric(const surface *s, double here, double there, bool leaves)
{
    return mixed_dielectric(s, here, there, 0.0, leaves);
}

vector oracle_coat(const surface *s, double ior)
{
    double exact_up_to = 2.0 + sqrt(3.0), schlick_from = 6.0;
    double way = (1.0 / exact_up_to - 1.0 / ior) / (1.0 / exact_up_to - 1.0 / schlick_from);
    return mixed_dielectric(s, 1.0, ior, fmin(fmax(way, 0.0), 1.0), false);
}
