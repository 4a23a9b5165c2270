// Tests the parts of lobes: cells, the table of albedos, and the oracle's own quadrature.
#include "environment/cells.h"
#include "environment/lobe_albedo.h"
#include "kernels/layout.h"
#include "oracle/rough.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static vector white(const void *context, vector direction)
{
    (void)context;
    (void)direction;
    return (vector){{1, 1, 1}};
}

static surface seen_at(double roughness, double cosine)
{
    return (surface){.normal = {{0, 0, 1}},
                     .viewer = {{sqrt(1 - cosine * cosine), 0, cosine}},
                     .cosine = cosine,
                     .roughness = roughness};
}

// Albedo of a lobe in a white environment.
static lobe_integrals white_lobe(double roughness, double cosine, int strata)
{
    const surface s = seen_at(roughness, cosine);
    return oracle_lobe(&s, strata, white, NULL);
}

// At α = 1, D is 1/π and V is 0.5/(n·l + n·v), so a + b = ∫ μ/(μ + ν) dμ = 1 − ν ln((1 + ν)/ν).
static void the_oracle_knows_the_roughest_lobe(void **state)
{
    (void)state;
    for (int i = 1; i <= 8; i++) {
        const double v = i / 8.0, wanted = 1 - v * log((1 + v) / v);
        const lobe_integrals lobe = white_lobe(1, v, 400);
        assert_true(fabs(lobe.white_base + lobe.white_edge - wanted) < 2e-4);
        assert_true(fabs(lobe.base.at[1] - lobe.white_base) < 1e-12);
    }
}

// Narrow lobes reflect all light: there is no masking, and the integral of D is 1.
static void the_oracle_knows_narrow_lobes(void **state)
{
    (void)state;
    for (int i = 2; i <= 8; i++) {
        const double v = i / 8.0;
        const lobe_integrals lobe = white_lobe(0.05, v, 400);
        assert_true(fabs(lobe.white_base + lobe.white_edge - 1) < 2e-3);
        assert_true(fabs(lobe.white_edge - pow(1 - v, 5)) < 2e-3);
    }
}

// t with (t + t (1 + ρ)/(t + ρ))/2 = x, by bisection (kernels/layout.h).
static double root_at(double x, double roughness)
{
    double low = 0, high = 1;
    for (int i = 0; i < 60; i++) {
        const double t = 0.5 * (low + high);
        *(0.5 * (t + t * (1 + roughness) / (t + roughness)) < x ? &low : &high) = t;
    }
    return low;
}

// What white_lobe finds, by the facets that the viewer sees. This serves narrow lobes that are seen
// at a slant, too.
static lobe_integrals lobe_by_facets(double roughness, double cosine, int count)
{
    const surface s = seen_at(roughness, cosine);
    lobe_integrals sum = {0};
    for (int i = 0; i < count; i++) {
        const surface facet = oracle_facet(&s, i, count, 1);
        const double up = 2 * facet.cosine * dot(s.normal, facet.normal) - cosine;
        const double weight = oracle_opening(&s, up) / count, m = pow(1 - facet.cosine, 5);
        sum.white_base += weight * (1 - m);
        sum.white_edge += weight * m;
    }
    return sum;
}

static void the_table_is_what_the_oracle_finds(void **state)
{
    (void)state;
    static float table[GLINT_ALBEDO_VALUES];
    glint_lobe_albedo_fill(table);
    double worst = 0;
    for (int i = 1; i < GLINT_ALBEDO_ROUGHNESSES; i += 3) {
        for (int k = 1; k < GLINT_ALBEDO_COSINES; k += 3) {
            const double roughness = i / (GLINT_ALBEDO_ROUGHNESSES - 1.0);
            const double root = root_at(k / (GLINT_ALBEDO_COSINES - 1.0), roughness);
            const lobe_integrals lobe = lobe_by_facets(roughness, root * root, 1 << 14);
            const float *found = table + 2 * (i * GLINT_ALBEDO_COSINES + k);
            worst = fmax(worst, fabs((double)found[0] - lobe.white_base));
            worst = fmax(worst, fabs((double)found[1] - lobe.white_edge));
        }
    }
    print_message("the table is off by %.4f at most\n", worst);
    assert_true(worst < 0.003);
}

static void the_table_of_sheen_is_what_the_oracle_finds(void **state)
{
    (void)state;
    static float table[GLINT_ALBEDO_VALUES];
    glint_sheen_albedo_fill(true, table);
    double worst = 0;
    const double narrow = (double)GLINT_ROUGHNESS_NARROW;
    for (int i = 0; i < GLINT_ALBEDO_ROUGHNESSES; i++) {
        for (int k = 4; k < GLINT_ALBEDO_COSINES; k += 3) {
            const double root = k / (GLINT_ALBEDO_COSINES - 1.0), cosine = root * root;
            const surface s = {.normal = {{0, 0, 1}},
                               .viewer = {{sqrt(1 - cosine * cosine), 0, cosine}},
                               .cosine = cosine,
                               .sheen_roughness =
                                   narrow + (1 - narrow) * i / (GLINT_ALBEDO_ROUGHNESSES - 1.0)};
            const double wanted = oracle_sheen(&s, 200, white, NULL).white_base;
            worst = fmax(worst, fabs((double)table[2 * (i * GLINT_ALBEDO_COSINES + k)] - wanted));
        }
    }
    print_message("the table of sheen is off by %.4f at most\n", worst);
    assert_true(worst < 0.003);
}

// ---- Cells --------------------------------------------------------------------------------------

#define EDGE 32
#define LEVELS 5 // of edges 2 to 32
#define CELLS GLINT_CELLS_FIRST(LEVELS)

static float *cells_of(const glint_cube *cube, float *brightness)
{
    float *cells = calloc(CELLS * GLINT_CELL_VALUES, sizeof *cells);
    assert_non_null(cells);
    *brightness = glint_cells_fill(cube, EDGE, cells);
    return cells;
}

// Every texel is `light`.
static void make_cube(int edge, const float light[3], glint_cube *cube)
{
    assert_int_equal(glint_cube_create(edge, cube, NULL), GLINT_OK);
    for (size_t i = 0; i < glint_cube_size(cube); i++) {
        cube->texels[i] = i % 4 < 3 ? light[i % 4] : 0;
    }
}

// The solid angle of a cell (kernels/layout.h).
static double angle_of(const float *cell)
{
    const double u =
        fmax(fmax(fabs((double)cell[0]), fabs((double)cell[1])), fabs((double)cell[2]));
    const double squared = (double)cell[3] * (double)cell[3];
    return squared * u * (1 + squared * (9 - 15 * u * u) / 24);
}

static void cells_hold_all_of_the_light(void **state)
{
    (void)state;
    // Equal, larger, and not divisible; then smaller, so that the cells of a coarser level are
    // texels.
    static const int edges[] = {32, 128, 24, 45, 7, 16, 8};
    const float light[3] = {1, 0.5F, 0.25F};
    for (size_t e = 0; e < sizeof edges / sizeof *edges; e++) {
        glint_cube cube = {0};
        make_cube(edges[e], light, &cube);
        float brightness;
        float *cells = cells_of(&cube, &brightness);
        assert_true(fabsf(brightness - 1.75F) < 1e-4F);
        for (int level = 0; level < LEVELS; level++) {
            double sums[3] = {0}, angles = 0;
            for (size_t i = GLINT_CELLS_FIRST(level); i < GLINT_CELLS_FIRST(level + 1); i++) {
                const float *c = cells + i * GLINT_CELL_VALUES;
                const float length = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
                assert_true(fabsf(length - 1) < 1e-6F);
                assert_true(c[7] >= 0 && c[7] < c[3] * c[3]);
                assert_true(level == LEVELS - 1 || c[7] > 0.02F * c[3] * c[3]);
                angles += angle_of(c);
                for (int k = 0; k < 3; k++) {
                    sums[k] += (double)c[4 + k];
                }
            }
            assert_true(fabs(angles / (4 * GLINT_PI) - 1) < 0.06 * pow(4, -level) + 1e-4);
            for (int k = 0; k < 3; k++) {
                assert_true(fabs(sums[k] / (4 * GLINT_PI * (double)light[k]) - 1) < 1e-5);
            }
        }
        free(cells);
        glint_cube_free(&cube);
    }
}

// One bright texel: only the cells that contain it may see its light, on all levels.
static void cells_look_where_the_light_is(void **state)
{
    (void)state;
    const float dark[3] = {0, 0, 0};
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        glint_cube cube = {0};
        make_cube(EDGE, dark, &cube);
        const int column = 5 + face, row = 30 - 3 * face;
        glint_cube_texel(&cube, face, column, row)[1] = 1000;
        glint_cube_fill_border(&cube);
        const double s = (2 * column + 1.0) / EDGE - 1, t = (2 * row + 1.0) / EDGE - 1;
        const glint_vec3 d = glint_vec3_normalize(glint_cube_direction(face, s, t));
        float brightness;
        float *cells = cells_of(&cube, &brightness);
        for (int level = 0; level < LEVELS; level++) {
            size_t lit = 0;
            for (size_t i = GLINT_CELLS_FIRST(level); i < GLINT_CELLS_FIRST(level + 1); i++) {
                const float *c = cells + i * GLINT_CELL_VALUES;
                if (c[5] > 0) {
                    const double cosine =
                        d.x * (double)c[0] + d.y * (double)c[1] + d.z * (double)c[2];
                    lit++;
                    assert_true(cosine > 1 - 1e-6);
                    assert_true(c[7] < 1e-6F);
                    assert_true(c[4] == 0 && c[6] == 0);
                }
            }
            assert_int_equal(lit, 1);
        }
        free(cells);
        glint_cube_free(&cube);
    }
}

// The parts of a cell are contiguous and add up to the cell.
static void parts_make_the_whole(void **state)
{
    (void)state;
    glint_cube cube = {0};
    const float light[3] = {1, 1, 1};
    make_cube(EDGE, light, &cube);
    for (size_t i = 0; i < glint_cube_size(&cube); i++) {
        cube.texels[i] = (float)(i * 2654435761U % 1000) / 100;
    }
    float brightness;
    float *cells = cells_of(&cube, &brightness);
    for (int level = 0; level + 1 < LEVELS; level++) {
        const size_t first = GLINT_CELLS_FIRST(level), next = GLINT_CELLS_FIRST(level + 1);
        for (size_t i = 0; first + i < next; i++) {
            const float *c = cells + (first + i) * GLINT_CELL_VALUES;
            const float *parts = cells + (next + 4 * i) * GLINT_CELL_VALUES;
            float sum = 0;
            for (int k = 0; k < 4; k++) {
                const float *part = parts + k * GLINT_CELL_VALUES;
                const float cosine = c[0] * part[0] + c[1] * part[1] + c[2] * part[2];
                sum += part[4];
                assert_true(cosine > cosf(1.5F * c[3]));
            }
            assert_true(fabsf(sum / c[4] - 1) < 1e-5F);
        }
    }
    free(cells);
    glint_cube_free(&cube);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_oracle_knows_the_roughest_lobe),
        cmocka_unit_test(the_oracle_knows_narrow_lobes),
        cmocka_unit_test(the_table_of_sheen_is_what_the_oracle_finds),
        cmocka_unit_test(the_table_is_what_the_oracle_finds),
        cmocka_unit_test(cells_hold_all_of_the_light),
        cmocka_unit_test(cells_look_where_the_light_is),
        cmocka_unit_test(parts_make_the_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
