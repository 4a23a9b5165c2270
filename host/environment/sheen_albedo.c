// Computes the share of a white environment that sheen reflects. See lobe_albedo.h and rule 17 of
// docs/light_transport.md.
#include "base/parallel.h"
#include "base/vector.h"
#include "environment/lobe_albedo.h"
#include "kernels/layout.h"

#include <math.h>
#include <string.h>

enum { RINGS = 48, SECTORS = 24 };

// Constants of fibres of one roughness.
typedef struct fibres {
    double power; // 1/α
    double a, b, c, d, e;
} fibres;

static fibres fibres_of(double roughness)
{
    const double alpha = roughness * roughness, rest = (1 - alpha) * (1 - alpha);
    return (fibres){.power = 1 / alpha,
                    .a = 21.5473 + rest * (25.3245 - 21.5473),
                    .b = 3.82987 + rest * (3.32435 - 3.82987),
                    .c = 0.19823 + rest * (0.16801 - 0.19823),
                    .d = -1.97760 + rest * (-1.27393 + 1.97760),
                    .e = -4.32054 + rest * (-4.85967 + 4.32054)};
}

static double fit(const fibres *f, double x)
{
    return f->a / (1 + f->b * pow(x, f->c)) + f->d * x + f->e;
}

// Λ of the fibres' shadowing.
static double hidden(const fibres *f, double cosine)
{
    return exp(cosine < 0.5 ? fit(f, cosine) : 2 * fit(f, 0.5) - fit(f, 1 - cosine));
}

// ∫ D V n·l dl, by rings of directions. The cosine of a ring is the square of its place, so rings
// are dense near grazing angles.
static double albedo_of(const fibres *f, double cosine, const double hidden_at[RINGS])
{
    const double sine = sqrt(1 - cosine * cosine);
    double sum = 0;
    for (int ring = 0; ring < RINGS; ring++) {
        const double place = (ring + 0.5) / RINGS, up = place * place;
        const double beside = sqrt(1 - up * up);
        double spread = 0;
        for (int sector = 0; sector < SECTORS; sector++) {
            const double turn = (sector + 0.5) / SECTORS * GLINT_PI; // half: it is symmetric
            const double first = sine + beside * cos(turn), second = beside * sin(turn);
            const double across = first * first + second * second, along = up + cosine;
            spread += pow(across / (across + along * along), 0.5 * f->power);
        }
        sum += spread * 2 * place / (1 + hidden(f, cosine) + hidden_at[ring]);
    }
    return sum * (2 + f->power) / (4 * cosine) / (RINGS * SECTORS);
}

static void fill_row(size_t row, void *context)
{
    float *table = context;
    const double narrow = (double)GLINT_ROUGHNESS_NARROW;
    const fibres f =
        fibres_of(narrow + (1 - narrow) * (double)row / (GLINT_ALBEDO_ROUGHNESSES - 1.0));
    double hidden_at[RINGS];
    for (int ring = 0; ring < RINGS; ring++) {
        const double place = (ring + 0.5) / RINGS;
        hidden_at[ring] = hidden(&f, place * place);
    }
    for (size_t i = 0; i < GLINT_ALBEDO_COSINES; i++) {
        const double root = fmax((double)i / (GLINT_ALBEDO_COSINES - 1.0), 0.01);
        table[2 * (row * GLINT_ALBEDO_COSINES + i)] = (float)albedo_of(&f, root * root, hidden_at);
    }
}

void glint_sheen_albedo_fill(bool wanted, float *table)
{
    memset(table, 0, GLINT_ALBEDO_VALUES * sizeof *table);
    if (wanted) {
        glint_parallel_for(GLINT_ALBEDO_ROUGHNESSES, fill_row, table);
    }
}
