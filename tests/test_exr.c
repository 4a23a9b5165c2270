// Tests which of an EXR's parts and layers is the picture, and the conversion of its colours. The
// oracle is files built byte by byte (support/exr_bytes.c), and published matrices.
#include "image/image_io.h"
#include "support/image_bytes.h"
#include "support/image_files.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { PARTS = 4, CHANNELS = 12, WIDTH = 4, HEIGHT = 4 };

// A file as a text: the parts' names, each with its channels in alphabetical order:
// "depth: Z; rgba: A B G R". A file without a part's name has one part.
typedef struct wanted_file {
    char text[256];
    const char *names[PARTS][CHANNELS];
    exr_recipe parts[PARTS];
    int count;
    bool has_parts;
} wanted_file;

// Part p, channel c: 100 p + c + x / 8 + y / 64.
static float value_of_channel(int channel, int x, int y, void *context)
{
    return 100.0f * *(const float *)context + (float)channel + (float)x / 8 + (float)y / 64;
}

static void parse(const char *text, wanted_file *file)
{
    static const float numbers[PARTS] = {0, 1, 2, 3};
    char *rest = file->text, *part;
    snprintf(file->text, sizeof file->text, "%s", text);
    for (file->count = 0; (part = strsep(&rest, ";")) != NULL; file->count++) {
        exr_recipe *recipe = &file->parts[file->count];
        char *colon = strchr(part, ':');
        *recipe = (exr_recipe){.names = file->names[file->count],
                               .data = {0, 0, WIDTH - 1, HEIGHT - 1},
                               .display = {0, 0, WIDTH - 1, HEIGHT - 1},
                               .envmap = -1,
                               .value = value_of_channel,
                               .context = (void *)&numbers[file->count]};
        if (colon != NULL) {
            *colon = '\0';
            recipe->part = part + strspn(part, " ");
            part = colon + 1;
            file->has_parts = true;
        }
        for (char *name; (name = strsep(&part, " ")) != NULL;) {
            if (name[0] != '\0') {
                file->names[file->count][recipe->channels++] = name;
            }
        }
    }
}

static void write_file(const char *text)
{
    wanted_file wanted = {0};
    parse(text, &wanted);
    image_bytes file =
        wanted.has_parts ? exr_parts_bytes(wanted.parts, wanted.count) : exr_bytes(wanted.parts);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
}

static void expect_refusal(const char *said)
{
    glint_image image;
    glint_error error = {0};
    if (glint_image_read(scratch_path("a.exr"), &image, NULL, &error) != GLINT_BAD_INPUT) {
        fail_msg("read, where '%s' is expected", said);
    }
    if (strncmp(error.message, scratch_path("a.exr"), strlen(scratch_path("a.exr"))) != 0 ||
        strstr(error.message, said) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, said);
    }
}

// ---- Which picture ------------------------------------------------------------------------------

// Checks that the picture is of part `part`, and consists of these of its channels.
static void expect_picture(const char *text, int part, int count, const int *channels)
{
    write_file(text);
    glint_image image;
    glint_error error = {0};
    if (glint_image_read(scratch_path("a.exr"), &image, NULL, &error) != GLINT_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    assert_int_equal(image.channels, count);
    const float number = (float)part;
    for (int i = 0; i < WIDTH * HEIGHT * count; i++) {
        const int c = channels[i % count], x = i / count % WIDTH, y = i / count / WIDTH;
        if (image.pixels[i] != value_of_channel(c, x, y, (void *)&number)) {
            fail_msg("%s: %g at %d,%d, not part %d's channel %d", text, (double)image.pixels[i], x,
                     y, part, c);
        }
    }
    glint_image_free(&image);
}

static void the_picture_is_the_colour_or_has_its_name(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int part, count, channels[4];
    } files[] = {
        // The only one with R, G and B, wherever it stands.
        {"depth: Z; rgba: B G R", 1, 3, {2, 1, 0}},
        {"rgba: A B G R; depth: Z", 0, 4, {3, 2, 1, 0}},
        {"depth: Z; id: id; light: B G R", 2, 3, {2, 1, 0}},
        {"left: Z; mask: Y; right: B G R", 2, 3, {2, 1, 0}},
        {"Z: Z; N: N.X N.Y N.Z; x: x.B x.G x.R", 2, 3, {2, 1, 0}},
        {"depth: Z; one: light.A light.B light.G light.R", 1, 4, {3, 2, 1, 0}},
        // Of several, a name decides. rgba comes before the others.
        {"albedo: albedo.B albedo.G albedo.R; beauty: B G R", 1, 3, {2, 1, 0}},
        {"albedo: B G R; C: B G R", 1, 3, {2, 1, 0}},
        {"beauty: B G R; rgba: B G R", 1, 3, {2, 1, 0}},
        {"Layer.Albedo: B G R; Layer.Combined: A B G R", 1, 4, {3, 2, 1, 0}},
        {"x: x.B x.G x.R; y: BEAUTY.B BEAUTY.G BEAUTY.R", 1, 3, {2, 1, 0}},
        {"x: albedo.B albedo.G albedo.R beauty.B beauty.G beauty.R", 0, 3, {5, 4, 3}},
        // An unnamed layer is its part's picture.
        {"main: B G R albedo.B albedo.G albedo.R; depth: Z", 0, 3, {2, 1, 0}},
        {"B G R beauty.B beauty.G beauty.R", 0, 3, {2, 1, 0}},
        // The same for layers of one part.
        {"albedo.B albedo.G albedo.R beauty.B beauty.G beauty.R", 0, 3, {5, 4, 3}},
        {"C.B C.G C.R D.B D.G D.R", 0, 3, {2, 1, 0}},
        {"View.Combined.A View.Combined.B View.Combined.G View.Combined.R View.Mist.Z View.id.b "
         "View.id.g View.id.r",
         0,
         4,
         {3, 2, 1, 0}},
        // Grey: Y, or a file's only channel.
        {"Y", 0, 1, {0}},
        {"A Y", 0, 2, {1, 0}},
        {"depth: Z; grey: Y", 1, 1, {0}},
        {"depth", 0, 1, {0}},
        {"depth: Z", 0, 1, {0}},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        expect_picture(files[i].text, files[i].part, files[i].count, files[i].channels);
    }
}

static void what_is_not_clear_is_refused_with_the_choices_named(void **state)
{
    (void)state;
    static const char *const files[][2] = {
        {"a.B a.G a.R b.B b.G b.R", "several pictures: a, b ("},
        {"light1: B G R; light2: B G R; depth: Z", "several pictures: light1, light2 ("},
        {"left: rgba.B rgba.G rgba.R; right: rgba.B rgba.G rgba.R", "left.rgba, right.rgba ("},
        {"a: Y; b: Y", "several pictures: a, b ("},
        {"depth: Z; id: id", "no channels R, G, B or Y among its Z, id ("},
        {"depth: Z; N: N.X N.Y N.Z", "among its Z, N.X, N.Y, N.Z ("},
        {"N.x N.y depth.Z", "depth.Z"},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        write_file(files[i][0]);
        expect_refusal(files[i][1]);
    }
}

// ---- Luminance and chroma -----------------------------------------------------------------------

static void luminance_with_chroma_is_not_grey(void **state)
{
    (void)state;
    static const int whole[] = {1, 1, 1}, half[] = {2, 2, 1};
    for (int k = 0; k < 2; k++) {
        wanted_file wanted = {0};
        parse("BY RY Y", &wanted);
        wanted.parts[0].steps = k == 0 ? whole : half;
        image_bytes file = exr_bytes(wanted.parts);
        scratch_write("a.exr", file.bytes, (long)file.length);
        image_bytes_free(&file);
        expect_refusal("luminance and chroma");
        expect_refusal("(save it as R, G, B)");
    }
    // Where there is colour too, the luminance does not count.
    expect_picture("a: BY RY Y; b: B G R", 1, 3, (const int[]){2, 1, 0});
}

// ---- Chromaticities -----------------------------------------------------------------------------

static float color_of(int channel, int x, int y, void *context)
{
    (void)y;
    return ((const float *)context)[4 * x + channel];
}

// Writes four pixels A, B, G, R, and reads them.
static glint_image read_colors(const float chromaticities[8], float colors[4][4])
{
    static const char *const names[] = {"A", "B", "G", "R"};
    const exr_recipe recipe = {.names = names,
                               .channels = 4,
                               .data = {0, 0, 3, 0},
                               .display = {0, 0, 3, 0},
                               .envmap = -1,
                               .value = color_of,
                               .context = colors,
                               .chromaticities = chromaticities};
    image_bytes file = exr_bytes(&recipe);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    return image_file_read("a.exr", NULL);
}

// Red, green, blue and a grey with half of alpha.
static const float unit_colors[4][4] = {{1, 0, 0, 1}, {1, 0, 1, 0}, {1, 1, 0, 0}, {0.5f, 2, 2, 2}};

// Columns are red, green and blue of the file; the last one is their sum.
static void expect_colors(const float chromaticities[8], const double columns[3][3],
                          const double grey[3], double digits)
{
    float colors[4][4];
    memcpy(colors, unit_colors, sizeof colors);
    glint_image image = read_colors(chromaticities, colors);
    assert_int_equal(image.channels, 4);
    for (int p = 0; p < 4; p++) {
        for (int c = 0; c < 3; c++) {
            const double wanted = p < 3 ? columns[p][c] : 2 * grey[c];
            const double got = (double)image.pixels[4 * p + c];
            if (fabs(got - wanted) > (p < 3 ? digits : 6 * digits)) {
                fail_msg("pixel %d, component %d: %.6f, not %.6f", p, c, got, wanted);
            }
        }
        assert_true(image.pixels[4 * p + 3] == unit_colors[p][0]);
    }
    glint_image_free(&image);
}

// IEC 61966-2-1's matrix, of four digits: tristimulus values are not adapted.
static void xyz_becomes_rec709(void **state)
{
    (void)state;
    static const float xyz[8] = {1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
    static const double columns[3][3] = {
        {3.2406, -0.9689, 0.0557}, {-1.5372, 1.8758, -0.2040}, {-0.4986, 0.0415, 1.0570}};
    static const double grey[3] = {1.2048, 0.9484, 0.9087};
    // The standard inverts a matrix of four digits: entries up to 3 move by up to 3e-4.
    expect_colors(xyz, columns, grey, 4e-4);
}

// ITU-R BT.2087 (2015): from Rec. 2020, of the same white.
static void rec2020_becomes_rec709(void **state)
{
    (void)state;
    static const float rec2020[8] = {0.708f, 0.292f, 0.170f,  0.797f,
                                     0.131f, 0.046f, 0.3127f, 0.3290f};
    static const double columns[3][3] = {
        {1.6605, -0.1246, -0.0182}, {-0.5876, 1.1329, -0.1006}, {-0.0728, -0.0083, 1.1187}};
    expect_colors(rec2020, columns, (const double[]){1, 1, 1}, 0.51e-4);
}

// The Academy's transform from AP1 to linear sRGB (aces-dev, 5 digits). The whites differ: with
// Bradford's adaptation, grey stays grey. The attribute's floats move the entries by under 5e-6.
static void acescg_becomes_rec709(void **state)
{
    (void)state;
    static const float ap1[8] = {0.713f, 0.293f, 0.165f,   0.830f,
                                 0.128f, 0.044f, 0.32168f, 0.33767f};
    static const double columns[3][3] = {{1.70505, -0.13026, -0.02400},
                                         {-0.62179, 1.14080, -0.12897},
                                         {-0.08326, -0.01055, 1.15297}};
    expect_colors(ap1, columns, (const double[]){1, 1, 1}, 1e-5);
}

// Rec. 709 as programs write it: the values stay, bit by bit.
static void rec709_stays(void **state)
{
    (void)state;
    static const float written[][8] = {
        {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f},
        {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.312727f, 0.329024f},
    };
    for (int k = 0; k < 2; k++) {
        float colors[4][4] = {{1, 0.1f, 0.2f, 0.3f}, {1, 1e-40f, -0.0f, 3e38f}, {0}, {0}};
        glint_image image = read_colors(written[k], colors);
        for (int p = 0; p < 4; p++) {
            for (int c = 0; c < 4; c++) {
                assert_memory_equal(&image.pixels[4 * p + c], &colors[p][3 - c], sizeof(float));
            }
        }
        glint_image_free(&image);
    }
}

// An infinity or a NaN stays in its component.
static void colors_that_are_not_finite_are_not_spread(void **state)
{
    (void)state;
    static const float xyz[8] = {1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
    float colors[4][4] = {
        {1, 2, 3, INFINITY}, {1, NAN, 3, 4}, {1, 2, -INFINITY, 4}, {INFINITY, 0, 0, 0}};
    glint_image image = read_colors(xyz, colors);
    assert_true(image.pixels[0] == INFINITY && image.pixels[1] == 3 && image.pixels[2] == 2);
    assert_true(image.pixels[4] == 4 && image.pixels[5] == 3 && isnan(image.pixels[6]));
    assert_true(image.pixels[8] == 4 && image.pixels[9] == -INFINITY && image.pixels[10] == 2);
    assert_true(image.pixels[12] == 0 && image.pixels[15] == INFINITY);
    glint_image_free(&image);
}

static void chromaticities_that_are_no_colours_are_refused(void **state)
{
    (void)state;
    static const float wrong[][8] = {
        {0, 0, 0, 0, 0, 0, 0, 0},
        {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0},
        {0.1f, 0.1f, 0.2f, 0.2f, 0.3f, 0.3f, 0.3127f, 0.329f},
        {NAN, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f},
        {0.64f, 0.33f, 0.3f, INFINITY, 0.15f, 0.06f, 0.3127f, 0.329f},
        {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, -0.329f},
        {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 1e38f, 1e-38f},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        wanted_file wanted = {0};
        parse("B G R", &wanted);
        wanted.parts[0].chromaticities = wrong[k];
        image_bytes file = exr_bytes(wanted.parts);
        scratch_write("a.exr", file.bytes, (long)file.length);
        image_bytes_free(&file);
        expect_refusal("chromaticities");
    }
    // Grey has no primaries.
    wanted_file wanted = {0};
    parse("Y", &wanted);
    wanted.parts[0].chromaticities = wrong[0];
    image_bytes file = exr_bytes(wanted.parts);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    glint_image image = image_file_read("a.exr", NULL);
    assert_int_equal(image.channels, 1);
    glint_image_free(&image);
}

// The data window is put into the display window, and both are converted.
static void windows_are_converted_too(void **state)
{
    (void)state;
    static const float xyz[8] = {1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
    wanted_file wanted = {0};
    parse("B G R", &wanted);
    wanted.parts[0].chromaticities = xyz;
    image_bytes file = exr_bytes(wanted.parts);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    glint_image whole = image_file_read("a.exr", NULL);
    wanted.parts[0].display[2] = 2 * WIDTH - 1;
    file = exr_bytes(wanted.parts);
    scratch_write("b.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    glint_image framed = image_file_read("b.exr", NULL);
    assert_int_equal(framed.width, 2 * WIDTH);
    assert_true(whole.pixels[0] > 4); // X and Y are 2 and 1
    for (int y = 0; y < HEIGHT; y++) {
        static const float nothing[3 * WIDTH];
        assert_memory_equal(glint_image_pixel(&framed, 0, y), glint_image_pixel(&whole, 0, y),
                            3 * WIDTH * sizeof(float));
        assert_memory_equal(glint_image_pixel(&framed, WIDTH, y), nothing, sizeof nothing);
    }
    glint_image_free(&whole);
    glint_image_free(&framed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(the_picture_is_the_colour_or_has_its_name),
        IN_FOLDER(what_is_not_clear_is_refused_with_the_choices_named),
        IN_FOLDER(luminance_with_chroma_is_not_grey),
        IN_FOLDER(xyz_becomes_rec709),
        IN_FOLDER(rec2020_becomes_rec709),
        IN_FOLDER(acescg_becomes_rec709),
        IN_FOLDER(rec709_stays),
        IN_FOLDER(colors_that_are_not_finite_are_not_spread),
        IN_FOLDER(chromaticities_that_are_no_colours_are_refused),
        IN_FOLDER(windows_are_converted_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
