// bench_split_sum [ENVIRONMENT…]: measures the error of the split sum for rough metal.
//
// Real-time engines use the split sum: an environment blurred once for each roughness, as if seen
// straight on, times the albedo of the lobe. The scene is white metal on a distant ball, at 11
// roughnesses, in the built-in studio or in the given files. The reference is the sum over all
// texels. Prints one line each, with tabs between: environment, roughness, relative RMSE.
#include "base/parallel.h"
#include "base/vector.h"
#include "environment/environment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { EDGE = 128, PLACES = 256 }; // texels along a face's edge; places on the ball

typedef struct texel {
    glint_vec3 direction;
    double light[3]; // radiance times solid angle
} texel;

typedef struct ball {
    const texel *texels;
    double roughness;
    double truth[PLACES][3], split[PLACES][3];
} ball;

static texel texel_at(const glint_cube *cube, int face, int column, int row)
{
    const double s = (2 * column + 1.0) / EDGE - 1, t = (2 * row + 1.0) / EDGE - 1;
    const double far = 1 + s * s + t * t, angle = 4.0 / EDGE / EDGE / (far * sqrt(far));
    texel result = {.direction = glint_vec3_normalize(glint_cube_direction(face, s, t))};
    const int first[2] = {column * cube->edge / EDGE, row * cube->edge / EDGE};
    const int last[2] = {(column + 1) * cube->edge / EDGE, (row + 1) * cube->edge / EDGE};
    const int count = (last[0] - first[0]) * (last[1] - first[1]);
    for (int i = first[0]; i < last[0]; i++) {
        for (int j = first[1]; j < last[1]; j++) {
            for (int k = 0; k < 3; k++) {
                const double radiance = (double)glint_cube_texel(cube, face, i, j)[k];
                result.light[k] += radiance * angle / count;
            }
        }
    }
    return result;
}

// Computes ∫ D V E n·l dl for each colour, with GGX's D and Smith's height-correlated V. Returns
// the integral for E = 1.
static double sum_lobe(const ball *b, glint_vec3 n, glint_vec3 v, double sum[3])
{
    const double a = b->roughness * b->roughness, a2 = a * a, nv = glint_vec3_dot(n, v);
    double white = 0;
    sum[0] = sum[1] = sum[2] = 0;
    for (int i = 0; i < 6 * EDGE * EDGE; i++) {
        const texel *t = &b->texels[i];
        const double nl = glint_vec3_dot(n, t->direction);
        if (!(nl > 0)) {
            continue;
        }
        const glint_vec3 h = glint_vec3_normalize(glint_vec3_add(t->direction, v));
        const double nh = glint_vec3_dot(n, h), q = 1 - (1 - a2) * nh * nh;
        const double roots =
            nl * sqrt(a2 + (1 - a2) * nv * nv) + nv * sqrt(a2 + (1 - a2) * nl * nl);
        const double weight = a2 / (GLINT_PI * q * q) * 0.5 / roots * nl;
        for (int k = 0; k < 3; k++) {
            sum[k] += weight * t->light[k];
        }
        const double far =
            fmax(fabs(t->direction.x), fmax(fabs(t->direction.y), fabs(t->direction.z)));
        white += weight * 4 / EDGE / EDGE * far * far * far;
    }
    return white;
}

// Compares one place on the visible half of the ball, seen along −z. The places cover its disk
// evenly.
static void look_at(size_t place, void *context)
{
    ball *b = context;
    const double radius = sqrt(((double)place + 0.5) / PLACES);
    const double turn = (double)place * GLINT_PI * (3 - sqrt(5));
    const glint_vec3 v = {0, 0, 1};
    const glint_vec3 n = {radius * cos(turn), radius * sin(turn), sqrt(1 - radius * radius)};
    const glint_vec3 r = glint_vec3_subtract(glint_vec3_scale(n, 2 * n.z), v);
    const double albedo = sum_lobe(b, n, v, b->truth[place]);
    const double straight = sum_lobe(b, r, r, b->split[place]);
    for (int k = 0; k < 3; k++) {
        b->split[place][k] *= albedo / straight;
    }
}

static double error_at(ball *b)
{
    double squares = 0, light = 0;
    glint_parallel_for(PLACES, look_at, b);
    for (int i = 0; i < PLACES; i++) {
        for (int k = 0; k < 3; k++) {
            squares += pow(b->split[i][k] - b->truth[i][k], 2);
            light += b->truth[i][k];
        }
    }
    return sqrt(squares * 3 * PLACES) / light;
}

static glint_status measure(const char *path, texel *texels, ball *b, glint_error *error)
{
    static const double roughnesses[] = {0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1};
    glint_environment environment = {0};
    TRY(path == NULL ? glint_environment_studio(&environment, error)
                     : glint_environment_load(path, NULL, &environment, NULL, error));
    if (environment.radiance.edge < EDGE) {
        glint_environment_free(&environment);
        return glint_fail(error, GLINT_BAD_INPUT, "%s: faces are less than %d texels wide", path,
                          EDGE);
    }
    for (int i = 0; i < 6 * EDGE * EDGE; i++) {
        texels[i] = texel_at(&environment.radiance, i / (EDGE * EDGE), i % EDGE, i / EDGE % EDGE);
    }
    for (size_t i = 0; i < sizeof roughnesses / sizeof *roughnesses; i++) {
        b->roughness = roughnesses[i];
        printf("%s\t%g\t%.4f\n", environment.name, b->roughness, error_at(b));
        fflush(stdout);
    }
    glint_environment_free(&environment);
    return GLINT_OK;
}

int main(int argc, char **argv)
{
    texel *texels = calloc((size_t)6 * EDGE * EDGE, sizeof *texels);
    ball *b = calloc(1, sizeof *b);
    glint_error error = {0};
    glint_status status =
        texels != NULL && b != NULL ? GLINT_OK : glint_fail_memory(&error, "the texels");
    if (status == GLINT_OK) {
        b->texels = texels;
        for (int i = argc > 1 ? 1 : 0; status == GLINT_OK && i < argc; i++) {
            status = measure(i == 0 ? NULL : argv[i], texels, b, &error);
        }
    }
    if (status != GLINT_OK) {
        fprintf(stderr, "bench_split_sum: %s\n", error.message);
    }
    free(texels);
    free(b);
    return status;
}
