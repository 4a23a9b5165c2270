// Tests environment files: the direction of every layout, file names, bad shapes and bad values,
// and the studio. The oracle is colour that encodes direction
// (support/direction_maps.h) and the table of OpenGL's specification (section "Cube Map Texture
// Selection").
#include "environment/environment.h"
#include "image/image_io.h"
#include "support/direction_maps.h"
#include "support/image_bytes.h"
#include "support/scratch.h"

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

// ---- Files --------------------------------------------------------------------------------------

static void write_image(const char *name, const glint_image *image, glint_envmap envmap)
{
    glint_write_options options = {.exr_float = true, .envmap = envmap};
    glint_error error = {0};
    if (glint_image_write(scratch_path(name), image, &options, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
}

static void refuse(const char *path, glint_layout layout, const char *said)
{
    glint_environment environment;
    glint_error error = {0};
    const glint_layout_request request = {.layout = layout};
    assert_int_equal(glint_environment_load(path, &request, &environment, NULL, &error),
                     GLINT_BAD_INPUT);
    assert_null(environment.name);
    assert_null(environment.radiance.texels);
    if (strstr(error.message, said) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, said);
    }
}

static void latlong_files_face_the_right_way(void **state)
{
    (void)state;
    for (int on_edges = 0; on_edges < 2; on_edges++) {
        glint_image image = direction_latlong(64, on_edges);
        write_image("map.exr", &image, on_edges ? GLINT_ENVMAP_LATLONG : GLINT_ENVMAP_NONE);
        glint_image_free(&image);
        glint_environment environment =
            load_environment(scratch_path("map.exr"), GLINT_LAYOUT_UNKNOWN, NULL);
        assert_int_equal(environment.layout, GLINT_LAYOUT_LATLONG);
        assert_string_equal(environment.reason, on_edges ? "envmap attribute" : "shape 2:1");
        assert_int_equal(environment.source_width, 128);
        assert_int_equal(environment.mended_texels, 0);
        assert_true(worst_error(&environment.radiance) <=
                    latlong_bound(64, on_edges) + seam_bound(256));
        glint_environment_free(&environment);
    }
}

// OpenEXR's 1 × 6 strip: with the attribute texels lie on the edges, without it at (i + ½)/N.
static void openexr_cube_files_face_the_right_way(void **state)
{
    (void)state;
    enum { EDGE = 32 };
    for (int on_edges = 0; on_edges < 2; on_edges++) {
        glint_image image;
        assert_int_equal(glint_image_create(EDGE, 6 * EDGE, 3, &image, NULL), GLINT_OK);
        for (int p = 0; p < 6 * EDGE * EDGE; p++) {
            int x = p % EDGE, y = p / EDGE % EDGE;
            double u = on_edges ? x / (EDGE - 1.0) : (x + 0.5) / EDGE;
            double v = on_edges ? y / (EDGE - 1.0) : (y + 0.5) / EDGE;
            double rgb[3];
            color_of(openexr_cube_direction(p / EDGE / EDGE, u, v), rgb);
            for (int c = 0; c < 3; c++) {
                image.pixels[3 * p + c] = (float)rgb[c];
            }
        }
        write_image("cube.exr", &image, on_edges ? GLINT_ENVMAP_CUBE : GLINT_ENVMAP_NONE);
        glint_image_free(&image);
        const char *path = scratch_path("cube.exr");
        if (!on_edges) {
            refuse(path, GLINT_LAYOUT_UNKNOWN, "--env-layout cube");
        }
        glint_environment environment =
            load_environment(path, on_edges ? GLINT_LAYOUT_UNKNOWN : GLINT_LAYOUT_CUBE, NULL);
        assert_int_equal(environment.layout, GLINT_LAYOUT_CUBE);
        assert_int_equal(environment.radiance.edge, EDGE);
        double once_more = 0.65 / ((EDGE - 1.0) * (EDGE - 1.0));
        assert_true(worst_error(&environment.radiance) <= seam_bound(EDGE) + once_more);
        glint_environment_free(&environment);
    }
}

static void write_face(const char *name, int face, int width, int height)
{
    glint_image image;
    assert_int_equal(glint_image_create(width, height, 3, &image, NULL), GLINT_OK);
    for (int p = 0; p < width * height; p++) {
        int column = p % width, row = p / width;
        glint_vec3 r = opengl_direction(face, (column + 0.5) / width, (row + 0.5) / height);
        double rgb[3];
        // World direction (x, y, z) looks up (x, y, −z).
        color_of((glint_vec3){r.x, r.y, -r.z}, rgb);
        for (int c = 0; c < 3; c++) {
            image.pixels[3 * p + c] = (float)rgb[c];
        }
    }
    write_image(name, &image, GLINT_ENVMAP_NONE);
    glint_image_free(&image);
}

// Writes six faces, named before + name + ".exr".
static void write_faces(const char *before, const char *const names[6], int edge)
{
    for (int face = 0; face < 6; face++) {
        char name[128];
        snprintf(name, sizeof name, "%s%s.exr", before, names[face]);
        write_face(name, face, edge, edge);
    }
}

static const char *const posx[6] = {"posx", "negx", "posy", "negy", "posz", "negz"};
static const char *const right[6] = {"right", "left", "top", "bottom", "front", "back"};

static void assert_faces_load(const char *path)
{
    glint_environment environment = load_environment(path, GLINT_LAYOUT_UNKNOWN, NULL);
    assert_int_equal(environment.layout, GLINT_LAYOUT_FACES);
    assert_int_equal(environment.radiance.edge, 16);
    assert_true(worst_error(&environment.radiance) <= seam_bound(16));
    // The default camera looks along −Z. The first face ahead of it is posz, unmirrored: the right
    // half of the face is towards +X.
    double ahead[3], to_the_right[3];
    glint_cube_sample(&environment.radiance, (glint_vec3){0.0, 0.0, -1.0}, ahead);
    glint_cube_sample(&environment.radiance, (glint_vec3){0.5, 0.0, -1.0}, to_the_right);
    assert_true(ahead[2] < 0.01 && to_the_right[0] > 0.7);
    glint_environment_free(&environment);
}

static void six_faces_face_the_right_way_under_all_names(void **state)
{
    (void)state;
    static const struct {
        const char *folder, *before, *names[6];
    } sets[] = {
        {"a", "", {"posx", "negx", "posy", "negy", "posz", "negz"}},
        {"b", "xmas_", {"posx", "negx", "posy", "negy", "posz", "negz"}},
        {"c", "", {"px", "nx", "py", "ny", "pz", "nz"}},
        {"d", "sky-", {"PX", "NX", "PY", "NY", "PZ", "NZ"}},
        {"e", "", {"right", "left", "top", "bottom", "front", "back"}},
        {"f", "Sky.", {"Right", "Left", "Top", "Bottom", "Front", "Back"}},
        {"g", "sky ", {"right", "left", "up", "down", "front", "back"}},
        {"h", "", {"+x", "-x", "+y", "-y", "+z", "-z"}},
        {"i", "env", {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}},
        {"j", "a_", {"posX", "negX", "posY", "negY", "posZ", "negZ"}},
    };
    for (size_t k = 0; k < sizeof sets / sizeof sets[0]; k++) {
        char before[64], pattern[80];
        assert_int_equal(mkdir(scratch_path(sets[k].folder), 0777), 0);
        snprintf(before, sizeof before, "%s/%s", sets[k].folder, sets[k].before);
        write_faces(before, sets[k].names, 16);
        assert_faces_load(scratch_path(sets[k].folder));
        snprintf(pattern, sizeof pattern, "%s%%s.exr", before);
        assert_faces_load(scratch_path(pattern));
    }
    refuse(scratch_path("a"), GLINT_LAYOUT_LATLONG, "six faces");
}

static void faces_that_are_missing_or_doubtful_are_named(void **state)
{
    (void)state;
    assert_int_equal(mkdir(scratch_path("none"), 0777), 0);
    refuse(scratch_path("none"), GLINT_LAYOUT_UNKNOWN, "no faces there");
    refuse(scratch_path("none/%s.exr"), GLINT_LAYOUT_UNKNOWN, "no faces there");
    refuse(scratch_path("none/%s_%s.exr"), GLINT_LAYOUT_UNKNOWN, "once");

    assert_int_equal(mkdir(scratch_path("five"), 0777), 0);
    write_faces("five/", posx, 8);
    unlink(scratch_path("five/negy.exr"));
    refuse(scratch_path("five"), GLINT_LAYOUT_UNKNOWN, "missing is negy");
    refuse(scratch_path("five/%s.exr"), GLINT_LAYOUT_UNKNOWN, "missing is negy");

    assert_int_equal(mkdir(scratch_path("two"), 0777), 0);
    write_faces("two/day_", posx, 8);
    write_faces("two/night_", right, 8);
    refuse(scratch_path("two"), GLINT_LAYOUT_UNKNOWN, "more than one set");
    glint_environment environment =
        load_environment(scratch_path("two/day_%s.exr"), GLINT_LAYOUT_UNKNOWN, NULL);
    glint_environment_free(&environment);

    assert_int_equal(mkdir(scratch_path("odd"), 0777), 0);
    write_faces("odd/", posx, 8);
    write_face("odd/posy.exr", 2, 8, 9);
    refuse(scratch_path("odd"), GLINT_LAYOUT_UNKNOWN, "posy.exr: 8 × 9");
    write_face("odd/posy.exr", 2, 16, 16);
    refuse(scratch_path("odd"), GLINT_LAYOUT_UNKNOWN, "posy.exr: 16 pixels");
    scratch_write("odd/posy.exr", "no picture at all", -1);
    refuse(scratch_path("odd"), GLINT_LAYOUT_UNKNOWN, "posy.exr");
}

static void shapes_that_say_too_little_are_refused_with_choices(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        glint_layout layout;
        const char *said;
    } shapes[] = {
        {4, 24, GLINT_LAYOUT_UNKNOWN, "--env-layout cube for the first, vstrip for the other"},
        {8, 8, GLINT_LAYOUT_UNKNOWN, "--env-layout ball or angular"},
        {17, 8, GLINT_LAYOUT_UNKNOWN, "shape of no layout"},
        {14, 7, GLINT_LAYOUT_CUBE, "not 1 × 6 squares"},
        {16, 8, GLINT_LAYOUT_VSTRIP, "not 1 × 6 squares"},
        {16, 8, GLINT_LAYOUT_HSTRIP, "not 6 × 1 squares"},
        {16, 8, GLINT_LAYOUT_HCROSS, "not 4 × 3 squares"},
        {12, 9, GLINT_LAYOUT_VCROSS, "not 3 × 4 squares"},
        {16, 8, GLINT_LAYOUT_FACES, "takes six"},
    };
    for (size_t k = 0; k < sizeof shapes / sizeof shapes[0]; k++) {
        glint_image image;
        assert_int_equal(glint_image_create(shapes[k].width, shapes[k].height, 3, &image, NULL),
                         GLINT_OK);
        write_image("map.exr", &image, GLINT_ENVMAP_NONE);
        glint_image_free(&image);
        refuse(scratch_path("map.exr"), shapes[k].layout, shapes[k].said);
    }
    refuse(scratch_path("missing.hdr"), GLINT_LAYOUT_UNKNOWN, "No such file");
}

static void an_odd_latlong_is_taken_when_asked_and_warned_of(void **state)
{
    (void)state;
    glint_image image;
    assert_int_equal(glint_image_create(17, 8, 3, &image, NULL), GLINT_OK);
    write_image("map.exr", &image, GLINT_ENVMAP_NONE);
    glint_image_free(&image);
    glint_warnings warnings = {0};
    glint_environment environment =
        load_environment(scratch_path("map.exr"), GLINT_LAYOUT_LATLONG, &warnings);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.texts[0], "17 × 8"));
    glint_warnings_free(&warnings);
    glint_environment_free(&environment);
}

static void layout_names_are_known_both_ways(void **state)
{
    (void)state;
    static const char *const names[] = {"cube",   "faces",   "hcross", "vcross",  "vstrip",
                                        "hstrip", "latlong", "ball",   "angular", "studio"};
    for (int k = 0; k < 10; k++) {
        glint_layout layout = glint_layout_from_name(names[k]);
        assert_int_not_equal(layout, GLINT_LAYOUT_UNKNOWN);
        assert_string_equal(glint_layout_name(layout), names[k]);
    }
    assert_int_equal(glint_layout_from_name("cross"), GLINT_LAYOUT_UNKNOWN);
    assert_null(glint_layout_name(GLINT_LAYOUT_UNKNOWN));
}

// Puts bad values among grey pixels, so that every look-up has a known result.
static void expect_warning(const char *name, const char *said)
{
    glint_warnings warnings = {0};
    glint_environment environment =
        load_environment(scratch_path(name), GLINT_LAYOUT_UNKNOWN, &warnings);
    assert_int_equal(warnings.count, said != NULL ? 1 : 0);
    if (said != NULL && (strstr(warnings.texts[0], said) == NULL ||
                         strstr(warnings.texts[0], "no highlights above white") == NULL)) {
        fail_msg("'%s' does not say '%s'", warnings.texts[0], said);
    }
    glint_warnings_free(&warnings);
    glint_environment_free(&environment);
}

// One warning for a file, and one for six.
static void integers_are_warned_of(void **state)
{
    (void)state;
    static const char *const files[] = {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"};
    static const char *const faces[6] = {"posx", "negx", "posy", "negy", "posz", "negz"};
    glint_image image;
    assert_int_equal(glint_image_create(16, 8, 3, &image, NULL), GLINT_OK);
    for (int k = 0; k < 5; k++) {
        write_image(files[k], &image, GLINT_ENVMAP_NONE);
        expect_warning(files[k], k < 3 ? "8-bit integers" : NULL);
    }
    glint_image_free(&image);
    const uint16_t codes[8 * 4] = {65535};
    image_bytes file = tiff_bytes(&(tiff_recipe){8, 4, 1, 16, 0, 1, codes});
    scratch_write("a.tif", file.bytes, (long)file.length);
    image_bytes_free(&file);
    expect_warning("a.tif", "16-bit integers");
    // The six faces of a cube: all of floats, then one of integers.
    assert_int_equal(glint_image_create(8, 8, 3, &image, NULL), GLINT_OK);
    assert_int_equal(mkdir(scratch_path("faces"), 0777), 0);
    for (int face = 0; face < 6; face++) {
        char name[32];
        snprintf(name, sizeof name, "faces/%s.exr", faces[face]);
        write_image(name, &image, GLINT_ENVMAP_NONE);
    }
    expect_warning("faces", NULL);
    write_image("a.png", &image, GLINT_ENVMAP_NONE);
    char png[PATH_MAX];
    snprintf(png, sizeof png, "%s", scratch_path("a.png"));
    assert_int_equal(rename(png, scratch_path("faces/negy.exr")), 0); // the content decides
    expect_warning("faces", "8-bit integers");
    glint_image_free(&image);
}

static void values_that_are_no_radiance_are_mended_and_counted(void **state)
{
    (void)state;
    glint_image image;
    assert_int_equal(glint_image_create(512, 256, 3, &image, NULL), GLINT_OK);
    for (int i = 0; i < 512 * 256 * 3; i++) {
        image.pixels[i] = 0.5f;
    }
    image.pixels[3 * (100 * 512 + 100)] = NAN;
    image.pixels[3 * (100 * 512 + 101) + 1] = -3.0f;
    image.pixels[3 * (100 * 512 + 102) + 2] = -INFINITY;
    image.pixels[3 * (200 * 512 + 300)] = INFINITY;
    image.pixels[3 * (200 * 512 + 300) + 1] = NAN; // the same texel counts once
    image.pixels[3 * (50 * 512 + 7)] = 1e30f;      // large and finite: stays
    write_image("map.exr", &image, GLINT_ENVMAP_NONE);
    glint_warnings warnings = {0};
    glint_environment environment =
        load_environment(scratch_path("map.exr"), GLINT_LAYOUT_UNKNOWN, &warnings);
    assert_int_equal(environment.mended_texels, 4);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.texts[0], "4 texels"));
    double largest = 0.0;
    for (size_t i = 0; i < glint_cube_size(&environment.radiance); i++) {
        float value = environment.radiance.texels[i];
        assert_true(isfinite(value) && value >= 0.0f);
        largest = fmax(largest, (double)value);
    }
    assert_true(largest > 1e29 && largest <= 1e30 * 1.000001);
    // Far from the footprints nothing changed.
    double rgb[3];
    glint_cube_sample(&environment.radiance, (glint_vec3){0.0, 0.1, 1.0}, rgb);
    assert_true(rgb[0] == 0.5 && rgb[1] == 0.5 && rgb[2] == 0.5);
    glint_warnings_free(&warnings);
    glint_environment_free(&environment);
    glint_image_free(&image);
}

static void grey_is_repeated_and_alpha_is_not_used(void **state)
{
    (void)state;
    for (int channels = 1; channels <= 4; channels++) {
        glint_image image;
        assert_int_equal(glint_image_create(8, 4, channels, &image, NULL), GLINT_OK);
        for (int p = 0; p < 32; p++) {
            for (int c = 0; c < channels; c++) {
                image.pixels[p * channels + c] =
                    channels >= 3 && c < 3 ? 0.25f * (float)(c + 1) : 0.25f;
            }
            if (channels % 2 == 0) {
                image.pixels[p * channels + channels - 1] = 0.75f;
            }
        }
        write_image("map.exr", &image, GLINT_ENVMAP_NONE);
        glint_image_free(&image);
        glint_environment environment =
            load_environment(scratch_path("map.exr"), GLINT_LAYOUT_UNKNOWN, NULL);
        double rgb[3];
        glint_cube_sample(&environment.radiance, random_direction(), rgb);
        for (int c = 0; c < 3; c++) {
            assert_true(fabs(rgb[c] - (channels >= 3 ? 0.25 * (c + 1) : 0.25)) < 1e-6);
        }
        glint_environment_free(&environment);
    }
}

// The place of texel (i, j) of +X −X +Y −Y +Z −Z in a picture of faces: column and row of the face,
// by the pictures that docs/environments.md describes. The last face of a vertical cross is upside
// down.
static void code_place(glint_layout layout, int face, int at[2], int edge)
{
    static const int hcross[6][2] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {3, 1}, {1, 1}};
    static const int vcross[6][2] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 3}, {1, 1}};
    static const int strip[6] = {0, 1, 2, 3, 5, 4};
    if (layout == GLINT_LAYOUT_VCROSS && face == 4) {
        at[0] = edge - 1 - at[0];
        at[1] = edge - 1 - at[1];
    }
    const int column = layout == GLINT_LAYOUT_HCROSS   ? hcross[face][0]
                       : layout == GLINT_LAYOUT_VCROSS ? vcross[face][0]
                       : layout == GLINT_LAYOUT_HSTRIP ? strip[face]
                                                       : 0;
    const int row = layout == GLINT_LAYOUT_HCROSS   ? hcross[face][1]
                    : layout == GLINT_LAYOUT_VCROSS ? vcross[face][1]
                    : layout == GLINT_LAYOUT_HSTRIP ? 0
                                                    : strip[face];
    at[0] += column * edge;
    at[1] += row * edge;
}

// Faces of codes go to the cube without an image between. The judge is the image.
static void faces_of_codes_are_the_pixels_of_the_image(void **state)
{
    (void)state;
    enum { EDGE = 19 };
    static const struct {
        glint_layout layout;
        int across, down, channels;
    } pictures[] = {{GLINT_LAYOUT_HCROSS, 4, 3, 3},
                    {GLINT_LAYOUT_VCROSS, 3, 4, 4},
                    {GLINT_LAYOUT_HSTRIP, 6, 1, 1},
                    {GLINT_LAYOUT_VSTRIP, 1, 6, 2},
                    {GLINT_LAYOUT_VSTRIP, 1, 6, 4}};
    for (size_t p = 0; p < sizeof pictures / sizeof pictures[0]; p++) {
        const int channels = pictures[p].channels;
        glint_image image;
        assert_int_equal(glint_image_create(pictures[p].across * EDGE, pictures[p].down * EDGE,
                                            channels, &image, NULL),
                         GLINT_OK);
        for (int k = 0; k < image.width * image.height * channels; k++) {
            image.pixels[k] = (float)fabs(next_random());
        }
        assert_int_equal(glint_image_write(scratch_path("codes.png"), &image, NULL, NULL),
                         GLINT_OK);
        glint_image_free(&image);
        assert_int_equal(glint_image_read(scratch_path("codes.png"), &image, NULL, NULL), GLINT_OK);
        glint_environment environment =
            load_environment(scratch_path("codes.png"), pictures[p].layout, NULL);
        assert_int_equal(environment.radiance.edge, EDGE);
        assert_int_equal(environment.mended_texels, 0);
        for (int k = 0; k < 6 * EDGE * EDGE; k++) {
            const int face = k / EDGE / EDGE, i = k % EDGE, j = k / EDGE % EDGE;
            int at[2] = {i, j};
            code_place(pictures[p].layout, face, at, EDGE);
            const float *texel = glint_cube_texel(&environment.radiance, face, i, j);
            const float *pixel = glint_image_pixel(&image, at[0], at[1]);
            for (int c = 0; c < 3; c++) {
                assert_true(texel[c] == pixel[image.channels >= 3 ? c : 0]);
            }
            assert_true(texel[3] == 1.0f);
        }
        glint_environment_free(&environment);
        glint_image_free(&image);
    }
}

// ---- The studio ---------------------------------------------------------------------------------

static void studio_is_bright_and_dark_and_smooth(void **state)
{
    (void)state;
    glint_environment studio;
    assert_int_equal(glint_environment_studio(&studio, NULL), GLINT_OK);
    assert_string_equal(studio.name, "studio");
    assert_int_equal(studio.layout, GLINT_LAYOUT_STUDIO);
    double darkest = INFINITY, brightest = 0.0, steepest = 0.0;
    int edge = studio.radiance.edge;
    for (int k = 0; k < 6 * edge * edge; k++) {
        const float *texel =
            glint_cube_texel(&studio.radiance, k / edge / edge, k % edge, k / edge % edge);
        assert_true(texel[0] > 0.0f && texel[1] > 0.0f && texel[2] > 0.0f);
        darkest = fmin(darkest, (double)texel[1]);
        brightest = fmax(brightest, (double)texel[1]);
        steepest = fmax(steepest, fabs((double)texel[5] - (double)texel[1]));
    }
    assert_true(darkest < 0.06 && brightest > 8.0 && brightest <= 20.0);
    // Soft edges: no step between texels exceeds a tenth of the brightest light.
    assert_true(steepest < 2.0);
    glint_environment_free(&studio);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layout_names_are_known_both_ways),
        cmocka_unit_test(studio_is_bright_and_dark_and_smooth),
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(latlong_files_face_the_right_way),
        IN_FOLDER(openexr_cube_files_face_the_right_way),
        IN_FOLDER(six_faces_face_the_right_way_under_all_names),
        IN_FOLDER(faces_that_are_missing_or_doubtful_are_named),
        IN_FOLDER(shapes_that_say_too_little_are_refused_with_choices),
        IN_FOLDER(an_odd_latlong_is_taken_when_asked_and_warned_of),
        IN_FOLDER(integers_are_warned_of),
        IN_FOLDER(values_that_are_no_radiance_are_mended_and_counted),
        IN_FOLDER(faces_of_codes_are_the_pixels_of_the_image),
        IN_FOLDER(grey_is_repeated_and_alpha_is_not_used),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
