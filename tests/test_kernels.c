// Tests single kernel functions that the self-test does not cover, on the device at every width and
// precision, against closed forms. u is the largest relative rounding error, 2⁻²⁴ or 2⁻⁵³.
#include "base/half.h"
#include "device/buffer.h"
#include "environment/half_texels.h"
#include "kernels/layout.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define ELEMENTS 4096

typedef struct probe {
    int width;
    bool is_double;
    bool half_texels;
    double u;
    double in[ELEMENTS][4], out[ELEMENTS][4];
} probe;

static cl_kernel build(const probe *p, const char *name)
{
    static const char *source = "#include \"probe.cl\"\n";
    const struct glint_device *device = test_device();
    char options[8192];
    snprintf(options, sizeof options,
             "-cl-std=CL1.2 -I %s/kernels -I %s/tests/kernels -DGLINT_WIDTH=%d -DGLINT_DOUBLE=%d "
             "-DGLINT_HALF_TEXELS=%d",
             GLINT_SOURCE_DIR, GLINT_SOURCE_DIR, p->width, p->is_double, p->half_texels);
    cl_int code;
    cl_program program = clCreateProgramWithSource(device->context, 1, &source, NULL, &code);
    assert_int_equal(code, CL_SUCCESS);
    code = clBuildProgram(program, 1, &device->id, options, NULL, NULL);
    if (code != CL_SUCCESS) {
        static char log[65536];
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log, NULL);
        print_error("%s\n", log);
    }
    assert_int_equal(code, CL_SUCCESS);
    cl_kernel kernel = clCreateKernel(program, name, &code);
    assert_int_equal(code, CL_SUCCESS);
    clReleaseProgram(program);
    return kernel;
}

static cl_mem buffer_of(const void *data, size_t bytes)
{
    cl_mem buffer;
    const glint_content content = {"a test", bytes, data};
    assert_int_equal(glint_buffer_create(test_device(), &content, &buffer, NULL), GLINT_OK);
    return buffer;
}

static cl_mem texels_of(const glint_cube *cube, bool as_half)
{
    size_t count = cube != NULL ? glint_cube_size(cube) : 0;
    if (!as_half || cube == NULL) {
        return buffer_of(cube != NULL ? cube->texels : NULL, count * sizeof(float));
    }
    uint16_t *halfs = calloc(count + 1, sizeof *halfs);
    assert_non_null(halfs);
    glint_cube_to_half(cube, halfs);
    cl_mem buffer = buffer_of(halfs, count * sizeof *halfs);
    free(halfs);
    return buffer;
}

// Runs a kernel of probe.cl over p->in; `cube` may be NULL.
static void run(probe *p, const char *name, const glint_cube *cube)
{
    static float narrow[ELEMENTS][4];
    for (size_t i = 0; i < ELEMENTS; i++) {
        for (size_t k = 0; k < 4; k++) {
            narrow[i][k] = (float)p->in[i][k];
            p->in[i][k] = p->is_double ? p->in[i][k] : (double)narrow[i][k];
        }
    }
    // Create the buffers and the kernel.
    size_t bytes = p->is_double ? sizeof p->in : sizeof narrow;
    cl_mem in = buffer_of(p->is_double ? (void *)p->in : narrow, bytes),
           out = buffer_of(NULL, bytes);
    cl_mem texels = texels_of(cube, p->half_texels);
    cl_int edge = cube != NULL ? cube->edge : 0;
    cl_kernel kernel = build(p, name);
    clSetKernelArg(kernel, 0, sizeof in, &in);
    clSetKernelArg(kernel, 1, sizeof out, &out);
    clSetKernelArg(kernel, 2, sizeof texels, &texels);
    clSetKernelArg(kernel, 3, sizeof edge, &edge);
    const size_t global = ELEMENTS / (size_t)p->width, local = 1;
    cl_command_queue queue = test_device()->queue;
    assert_int_equal(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &global, &local, 0, NULL, NULL),
                     CL_SUCCESS);
    // Read the results back as double.
    void *result = p->is_double ? (void *)p->out : narrow;
    assert_int_equal(clEnqueueReadBuffer(queue, out, CL_TRUE, 0, bytes, result, 0, NULL, NULL),
                     CL_SUCCESS);
    for (size_t i = 0; !p->is_double && i < ELEMENTS; i++) {
        for (size_t k = 0; k < 4; k++) {
            p->out[i][k] = (double)narrow[i][k];
        }
    }
    clReleaseKernel(kernel);
    clReleaseMemObject(in);
    clReleaseMemObject(out);
    clReleaseMemObject(texels);
}

// Calls `check` at every width and precision.
static void at_every_width_and_precision(void (*check)(probe *p))
{
    static const int widths[] = {1, 8, 16};
    static probe p;
    for (size_t w = 0; w < 3; w++) {
        for (int precision = 0; precision < 2; precision++) {
            p.width = widths[w];
            p.is_double = precision == 1;
            p.u = p.is_double ? 0x1p-53 : 0x1p-24;
            check(&p);
        }
    }
}

static void check_layout(probe *p)
{
    run(p, "probe_layout", NULL);
    const size_t expected[3][4] = {
        {sizeof(glint_material_record), offsetof(glint_material_record, medium),
         sizeof(glint_medium_record), offsetof(glint_medium_record, ior)},
        {sizeof(glint_split_vector), sizeof(glint_frame_record),
         offsetof(glint_frame_record, min_weight), offsetof(glint_frame_record, first_band)},
        {sizeof(glint_layers_record), offsetof(glint_layers_record, truncated),
         offsetof(glint_layers_record, triangle), offsetof(glint_layers_record, face)},
    };
    for (size_t row = 0; row < 3; row++) {
        for (size_t k = 0; k < 4; k++) {
            assert_true(p->out[row][k] == (double)expected[row][k]);
        }
    }
}

static void host_and_device_lay_the_shared_structs_out_alike(void **state)
{
    (void)state;
    at_every_width_and_precision(check_layout);
}

static void check_exponential(probe *p)
{
    const double least = p->is_double ? -708 : -87;
    for (size_t i = 0; i < ELEMENTS; i++) {
        p->in[i][0] = -120 * (double)i / ELEMENTS;
    }
    p->in[0][0] = 0;
    p->in[1][0] = -0.0;
    p->in[2][0] = -1e-30;
    p->in[3][0] = -INFINITY;
    p->in[4][0] = -1e30;
    run(p, "probe_exponential", NULL);
    assert_true(p->out[0][0] == 1 && p->out[1][0] == 1 && p->out[2][0] == 1);
    assert_true(p->out[3][0] == 0 && p->out[4][0] == 0);
    for (size_t i = 5; i < ELEMENTS; i++) {
        double expected = p->in[i][0] > least ? exp(p->in[i][0]) : 0;
        assert_true(fabs(p->out[i][0] - expected) <= 4 * p->u * expected);
    }
}

static void the_exponential_is_within_four_rounding_errors(void **state)
{
    (void)state;
    at_every_width_and_precision(check_exponential);
}

// Checks the focal distance f of a beam of this width and spread, bent by `turn` for each unit of
// its width. |f| is right to the rounding of both parts of the new spread.
static void check_focus(const probe *p, double f, double width, double scaled, double turn)
{
    const double spread = scaled + turn * width;
    const double parts = fabs(scaled) + fabs(turn * width);
    assert_true(fabs(f + width / spread) <=
                64 * p->u * parts / fabs(spread) * fabs(width / spread));
}

// Checks the mirror equation and the lensmaker's equation. A concave mirror turns rays by 2/R for
// each unit of height, a surface by (1 − η)/R. Beams are parallel or converge by themselves.
static void check_cones(probe *p)
{
    for (size_t i = 0; i < ELEMENTS; i++) {
        p->in[i][0] = pow(10, -6 + 12 * (double)i / ELEMENTS);
        p->in[i][1] = i % 2 ? 1e-3 : -2;
        p->in[i][2] = 1 / (1.1 + (double)(i % 16) / 10);
        p->in[i][3] = i % 3 == 0 ? 0 : -0.1 * p->in[i][1];
    }
    run(p, "probe_cones", NULL);
    for (size_t i = 0; i < ELEMENTS; i++) {
        const double radius = p->in[i][0], eta = p->in[i][2], spread = p->in[i][3];
        const double width = p->in[i][1] + 3 * spread;
        // Normals are unit vectors to a rounding. Their differences are a third or more.
        assert_true(fabs(p->out[i][0] * radius - 1) <= 32 * p->u);
        check_focus(p, p->out[i][1], width, spread, -2 / radius);
        check_focus(p, p->out[i][2], width, eta * spread, (eta - 1) / radius);
        check_focus(p, p->out[i][3], width, eta * spread, (1 - eta) / radius);
    }
}

static void cones_are_focused_where_mirrors_and_lenses_focus(void **state)
{
    (void)state;
    at_every_width_and_precision(check_cones);
}

static void check_levels(probe *p)
{
    static const double odd[] = {0, -0.0, NAN, INFINITY, -INFINITY, 1e-40, 1e38, -1e38};
    const size_t odd_count = sizeof odd / sizeof *odd;
    for (size_t i = 0; i < ELEMENTS; i++) {
        p->in[i][0] = (i % 2 ? 1 : -1) * pow(2, -8 + 12 * (double)i / ELEMENTS);
        p->in[i][1] = 0.5773503 + 0.4226497 * (double)(i % 7) / 6;
    }
    for (size_t i = 0; i < odd_count; i++) {
        p->in[i][0] = odd[i];
    }
    run(p, "probe_levels", NULL);
    for (size_t i = 0; i < ELEMENTS; i++) {
        const double level = p->out[i][0], blend = p->out[i][1];
        // The cone's width in texels of the first level, with 64 texels to 2 units at the distance
        // 1 / component; the level is half a level finer than the cone.
        const double texels = fabs(p->in[i][0]) * 32 / p->in[i][1] * sqrt(0.5);
        const double wanted = texels > 1 ? fmin(texels, 64) : 1; // NaN: 1
        assert_true(level >= 0 && level <= 6 && level == floor(level));
        assert_true(blend >= 0 && (level < 6 ? blend < 1 : blend == 0));
        assert_true(fabs(exp2(level) * (1 + blend) - wanted) <= 8 * p->u * wanted);
    }
}

static void levels_are_as_coarse_as_the_cone_is_wide(void **state)
{
    (void)state;
    at_every_width_and_precision(check_levels);
}

static double random_share(void)
{
    static uint64_t random = 7;
    random = random * 6364136223846793005u + 1442695040888963407u;
    return (double)(random >> 11) * 0x1p-53;
}

// A cube of values that half can hold, so that both kinds of texels give the same results.
static void random_cube(int edge, glint_cube *cube)
{
    assert_int_equal(glint_cube_create(edge, cube, NULL), GLINT_OK);
    for (size_t i = 0; i < glint_cube_size(cube); i++) {
        cube->texels[i] = glint_half_to_float(glint_half_from_float((float)random_share()));
    }
}

// Every packet must give the result of a packet of one ray, with both kinds of texels.
static void check_interpolation(probe *p)
{
    enum { EDGE = 13 };
    static glint_cube cube;
    static double directions[ELEMENTS][4], found[2][ELEMENTS][4];
    if (cube.texels == NULL) {
        random_cube(EDGE, &cube);
        for (size_t i = 0; i < 3 * ELEMENTS; i++) {
            directions[i / 3][i % 3] = (double)(float)(2 * random_share() - 1);
        }
    }
    for (int half = 0; half < 2; half++) {
        p->half_texels = half == 1;
        memcpy(p->in, directions, sizeof directions);
        run(p, "probe_cube", &cube);
        if (p->width == 1 && half == 0) {
            memcpy(found[p->is_double], p->out, sizeof p->out);
        }
        assert_memory_equal(found[p->is_double], p->out, sizeof p->out);
    }
    p->half_texels = false;
    for (size_t i = 0; i < ELEMENTS; i++) {
        const double *d = p->in[i];
        double rgb[3];
        glint_cube_sample(&cube, (glint_vec3){d[0], d[1], d[2]}, rgb);
        for (size_t k = 0; k < 3; k++) {
            // The place is right to 4 rounding errors of EDGE texels, and values change by up to 1
            // a texel along each axis. The interpolation adds 4 roundings.
            assert_true(fabs(p->out[i][k] - rgb[k]) <= (2 * 4 * EDGE + 4) * p->u);
        }
    }
}

static void the_cube_is_interpolated_alike_at_every_width(void **state)
{
    (void)state;
    at_every_width_and_precision(check_interpolation);
}

static void check_uniform_halfs(probe *p)
{
    static const float values[] = {0x1p-24f, 1023 * 0x1p-24f, 0x1p-14f, -2.5f, GLINT_HALF_MAX};
    p->half_texels = true;
    for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
        glint_cube cube;
        random_cube(3, &cube);
        for (size_t i = 0; i < glint_cube_size(&cube); i++) {
            cube.texels[i] = values[v];
        }
        for (size_t i = 0; i < 3 * ELEMENTS; i++) {
            p->in[i / 3][i % 3] = 2 * random_share() - 1;
        }
        run(p, "probe_cube", &cube);
        for (size_t i = 0; i < 3 * ELEMENTS; i++) {
            assert_true(p->out[i / 3][i % 3] == (double)values[v]);
        }
        glint_cube_free(&cube);
    }
    p->half_texels = false;
}

static void half_texels_are_read_exactly_denormal_ones_too(void **state)
{
    (void)state;
    at_every_width_and_precision(check_uniform_halfs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(host_and_device_lay_the_shared_structs_out_alike),
        cmocka_unit_test(the_exponential_is_within_four_rounding_errors),
        cmocka_unit_test(cones_are_focused_where_mirrors_and_lenses_focus),
        cmocka_unit_test(levels_are_as_coarse_as_the_cone_is_wide),
        cmocka_unit_test(the_cube_is_interpolated_alike_at_every_width),
        cmocka_unit_test(half_texels_are_read_exactly_denormal_ones_too),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
