// Tests texture look-ups in frames against the oracle's: a plane at a slant that glows with its
// texture. The oracle reads its textures from the file, and computes their levels in double
// precision (support/file_textures.h).
#include "support/bridge.h"
#include "support/render.h"
#include "support/scratch.h"
#include "support/textured_plane.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { LARGEST = 32 };

// Writes texels that differ from each other, but smoothly, so that an error of place becomes an
// error of value.
static void write_picture(const int size[2])
{
    unsigned char codes[LARGEST * LARGEST][4];
    for (int i = 0; i < size[0] * size[1]; i++) {
        for (int c = 0; c < 4; c++) {
            codes[i][c] = (unsigned char)(40 + (i * (37 + 20 * c) + 11 * c) % 200);
        }
    }
    write_codes("a.png", size, (const unsigned char(*)[4])codes);
}

typedef struct lookup_case {
    int size[2];
    const char *sampler;
    const char *info; // members of the textureInfo, each after a comma
    int anisotropy;   // 0: the default
} lookup_case;

#define SHEARED(scale)                                                                             \
    ",\"extensions\":{\"KHR_texture_transform\":{\"rotation\":0.6,\"scale\":[" scale "]}}"

static const lookup_case cases[] = {
    {{32, 32}, "{}", "", 0},
    {{31, 17}, "{\"wrapS\":33648,\"wrapT\":33071}", "", 0},
    {{1, 7}, "{\"wrapS\":33071,\"wrapT\":33648}", "", 0},
    {{32, 16}, "{\"minFilter\":9985}", "", 0},
    {{32, 32}, "{\"minFilter\":9729}", "", 0},
    {{8, 8}, "{\"magFilter\":9728,\"minFilter\":9728}", "", 0},
    {{16, 16}, "{\"minFilter\":9986}", "", 0},
    {{16, 16}, "{\"magFilter\":9728,\"minFilter\":9984}", "", 0},
    {{16, 8}, "{}", ",\"texCoord\":1", 0},
    {{32, 32},
     "{}",
     ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.25,0.5],\"rotation\":0.5,"
     "\"scale\":[1.5,0.75],\"texCoord\":0}},\"texCoord\":1",
     0},
    // Sheared ellipses that are longer than the taps reach.
    {{8, 8}, "{}", SHEARED("8,3"), 0},
    {{8, 8}, "{}", SHEARED("1,6"), 3},
    {{8, 8}, "{}", SHEARED("8,3"), 16},
    {{8, 8}, "{}", SHEARED("8,3"), 1},
    {{8, 8}, "{\"magFilter\":9728,\"wrapS\":33648}", SHEARED("2,1"), 0},
    {{8, 8}, "{\"minFilter\":9729}", SHEARED("8,3"), 0},
};

typedef struct comparison {
    double largest, squares;
    int pixels, left_out;
} comparison;

// With nearest filtering, a point near a texel's border may fall on the other side. These pixels
// are not compared.
static comparison compare(const glint_scene *scene, const glint_settings *settings)
{
    test_frame frame;
    test_render(scene, test_studio(), NULL, settings, &frame);
    bridge *b = bridge_create(scene, test_studio());
    bridge_read_textures(b, scene);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(scene, NULL, &camera, NULL), GLINT_OK);
    const oracle_view view = bridge_view(&camera, settings);
    comparison c = {0};
    for (int i = 0; i < settings->width * settings->height; i++) {
        meeting m;
        if (!textured_plane_meet(settings, i, &m)) {
            continue;
        }
        double rgba[4];
        oracle_report report;
        oracle_pixel(bridge_scene(b), &view,
                     (const int[]){i % settings->width, i / settings->width}, rgba, &report);
        if (fmin(report.edge, report.jump) < 1e-5) {
            c.left_out++;
            continue;
        }
        c.pixels++;
        for (int k = 0; k < 3; k++) {
            const double error = frame.exact[4 * i + k] - rgba[k];
            c.largest = fmax(c.largest, fabs(error));
            c.squares += error * error / 3;
        }
    }
    bridge_free(b);
    test_frame_free(&frame);
    return c;
}

// Each texel is rounded to 1/65535 once; its mean in single precision adds little. Neighbouring
// texels differ by at most 0.8. Single precision places a point within about 2⁻²² of a texture
// coordinate of 2. With 32 texels this is an error of 6e-6. A transform scales the error, by 8 with
// at most 8 texels. Transforms are stored as floats, so places err by 2⁻²⁴ of 22, also in double
// precision.
#define ROUNDING (0.5 / 65535 * 1.01)
#define PLACE 6e-6
#define TRANSFORM 8.5e-6

static double tolerance_of(const lookup_case *of, bool is_double)
{
    const bool is_moved = strstr(of->info, "scale") != NULL;
    return ROUNDING + (is_moved ? TRANSFORM : 0) + (is_double ? 0 : is_moved ? 2 * PLACE : PLACE);
}

static void textures_are_looked_up_as_the_samplers_say(void **state)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_picture(cases[i].size);
        glint_scene scene = textured_plane_load(
            *state,
            MESH("") ONE_TEXTURE("a.png") "\"samplers\":[%s],\"materials\":[{" UNLIT
                                          ",\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                                          "{\"index\":0%s}}}]",
            cases[i].sampler, cases[i].info);
        for (int precision = 0; precision < 2; precision++) {
            glint_settings settings = test_small_frame(1);
            if (cases[i].anisotropy > 0) {
                settings.anisotropy = cases[i].anisotropy;
            }
            settings.precision = precision ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
            const comparison c = compare(&scene, &settings);
            print_message("case %zu, %s: %d pixels, largest %.2g, RMS %.2g; %d left out\n", i,
                          precision ? "double" : "float", c.pixels, c.largest,
                          sqrt(c.squares / c.pixels), c.left_out);
            assert_true(c.largest <= tolerance_of(&cases[i], precision));
            assert_true(c.pixels > 1000 && c.left_out < 100);
        }
        glint_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(textures_are_looked_up_as_the_samplers_say, scratch_setup,
                                        scratch_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
