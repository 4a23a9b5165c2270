// Computes the share of a white environment that lobes reflect. See lobe_albedo.h.
#include "environment/lobe_albedo.h"

#include "base/parallel.h"
#include "base/vector.h"
#include "kernels/layout.h"

#include <math.h>

enum { RINGS = 48, SECTORS = 10 };

// Λ of Smith's shadowing function.
static double lambda(double cosine, double alpha)
{
    const double squared = cosine * cosine;
    return squared > 0 ? 0.5 * (sqrt(1 + alpha * alpha * (1 - squared) / squared) - 1) : INFINITY;
}

// v lies in the plane of x and z; `stretched` is v stretched by the roughness. Sines and cosines
// are the same for all surfaces.
typedef struct visible {
    glint_vec3 v, stretched;
    double alpha;
    double cosines[SECTORS], sines[SECTORS];
} visible;

// The half vector at a place of the disk onto which visible normals are projected (Heitz, Sampling
// the GGX Distribution of Visible Normals, 2018). `depth` is √(1 − radius²).
static glint_vec3 visible_normal(const visible *a, double depth, int sector)
{
    const double radius = sqrt(1 - depth * depth), lean = 0.5 * (1 + a->stretched.z);
    const double first = radius * a->cosines[sector];
    const double second = (1 - lean) * sqrt(1 - first * first) + lean * radius * a->sines[sector];
    const double third = sqrt(fmax(0, 1 - first * first - second * second));
    // The axes across v are y, and v turned up.
    return glint_vec3_normalize(
        (glint_vec3){a->alpha * (third * a->stretched.x - second * a->stretched.z),
                     a->alpha * first, fmax(0, third * a->stretched.z + second * a->stretched.x)});
}

static void integrate(const visible *a, float out[2])
{
    const double of_v = lambda(a->v.z, a->alpha);
    double base = 0, edge = 0;
    for (int i = 0; i < RINGS * SECTORS; i++) {
        // Rings are dense near the disk's edge, which holds the normals of the lobe's wide skirts.
        const int ring = i / SECTORS;
        const double depth = (ring + 0.5) / RINGS;
        const glint_vec3 h = visible_normal(a, depth, i % SECTORS);
        const double vh = glint_vec3_dot(a->v, h), up = 2 * vh * h.z - a->v.z;
        if (up > 0) {
            const double left = 2 * depth * (1 + of_v) / (1 + of_v + lambda(up, a->alpha));
            const double m = (1 - vh) * (1 - vh) * (1 - vh) * (1 - vh) * (1 - vh);
            base += left * (1 - m);
            edge += left * m;
        }
    }
    out[0] = (float)(base / (RINGS * SECTORS));
    out[1] = (float)(edge / (RINGS * SECTORS));
}

// t at a column x of the table: the root of t² + (1 + 2ρ − 2x) t − 2xρ, written without
// cancellation.
static double root_at(double x, double roughness)
{
    const double half = x - roughness - 0.5, product = 2 * x * roughness;
    const double root = sqrt(half * half + product);
    return fmin(half > 0 ? half + root : product / (root - half), 1);
}

static void fill_row(size_t row, void *context)
{
    float *table = context;
    const double roughness = fmax((double)row / (GLINT_ALBEDO_ROUGHNESSES - 1.0), 1e-3);
    visible a = {.alpha = roughness * roughness};
    for (int i = 0; i < SECTORS; i++) {
        const double angle = ((i + 0.5) / SECTORS - 0.5) * GLINT_PI; // half: it is symmetric
        a.cosines[i] = cos(angle);
        a.sines[i] = sin(angle);
    }
    for (int i = 0; i < GLINT_ALBEDO_COSINES; i++) {
        const double root = fmax(root_at(i / (GLINT_ALBEDO_COSINES - 1.0), roughness), 1e-6);
        const double cosine = root * root;
        a.v = (glint_vec3){sqrt(1 - cosine * cosine), 0, cosine};
        a.stretched = glint_vec3_normalize((glint_vec3){a.alpha * a.v.x, 0, a.v.z});
        integrate(&a, table + 2 * (row * GLINT_ALBEDO_COSINES + (size_t)i));
    }
}

void glint_lobe_albedo_fill(float *table)
{
    glint_parallel_for(GLINT_ALBEDO_ROUGHNESSES, fill_row, table);
}
