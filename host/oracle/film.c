// Computes interference in thin films, by Airy's formula at many wave numbers. See film.h.
#include "oracle/film.h"

#include <complex.h>
#include <math.h>

static const double PI = 3.14159265358979323846;

// The standard observer's response to wave numbers (1/m), as Belcour and Barla fit it (2017): bells
// given by height, middle and half their variance. Two bells are X's, the others are Y's and Z's.
static const struct bell {
    double height, middle, spread;
    int of; // X, Y or Z
} bells[] = {
    {5.4856e-13, 1.6810e6, 4.3278e9, 0},
    {9.7470e-14, 2.2399e6, 4.5282e9, 0},
    {4.4201e-13, 1.7953e6, 9.3046e9, 1},
    {5.2481e-13, 2.2084e6, 6.6121e9, 2},
};
enum { BELLS = 4, STEPS = 60 };

static const double rec709[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                    {-0.9692660, 1.8760108, 0.0415560},
                                    {0.0556434, -0.2040259, 1.0572252}};

// The cosine in a medium, from n sin θ, which Snell's law keeps.
static double cosine_in(double index, double kept)
{
    return sqrt(fmax(0.0, 1.0 - kept * kept / (index * index)));
}

// Airy's reflectance at a phase of the film, for one polarisation.
static double airy(double r12, double r23, double phase)
{
    double complex wave = cexp(I * phase);
    double complex r = (r12 + r23 * wave) / (1.0 + r12 * r23 * wave);
    return creal(r) * creal(r) + cimag(r) * cimag(r);
}

// The unpolarised reflectance, with both amplitudes by Fresnel.
static double reflectance(const film_stack *f, double base, double cosine, double wave_number)
{
    double kept = f->above * sqrt(fmax(0.0, 1.0 - cosine * cosine));
    double within = cosine_in(f->film, kept), below = cosine_in(base, kept);
    double phase = 2.0 * PI * wave_number * 2.0 * f->film * f->thickness * 1e-9 * within;
    double s12 = (f->above * cosine - f->film * within) / (f->above * cosine + f->film * within);
    double s23 = (f->film * within - base * below) / (f->film * within + base * below);
    double p12 = (f->film * cosine - f->above * within) / (f->film * cosine + f->above * within);
    double p23 = (base * within - f->film * below) / (base * within + f->film * below);
    return 0.5 * (airy(s12, s23, phase) + airy(p12, p23, phase));
}

vector oracle_film(const film_stack *stack, double cosine)
{
    double c = fmin(fmax(cosine, 1e-9), 1.0);
    vector sum = {{0.0, 0.0, 0.0}};
    for (int k = 0; k < 3; k++) {
        double weights = 0.0;
        for (int b = 0; b < BELLS; b++) {
            const struct bell *bell = &bells[b];
            double width = sqrt(2.0 * bell->spread), mean = 0.0, all = 0.0;
            for (int i = 0; i < STEPS; i++) {
                double u = -6.0 + 12.0 * (i + 0.5) / STEPS, share = exp(-0.5 * u * u);
                mean += share * reflectance(stack, stack->base[k], c, bell->middle + width * u);
                all += share;
            }
            double weight = rec709[k][bell->of] * bell->height * sqrt(bell->spread);
            sum.at[k] += weight * mean / all;
            weights += weight;
        }
        sum.at[k] = fmin(1.0, fmax(0.0, sum.at[k] / weights)); // white light stays white
    }
    return sum;
}

double oracle_index_of(double f0)
{
    double root = fmin(sqrt(f0), 0.9999);
    return (1.0 + root) / (1.0 - root);
}
