// Tests small faults of materials and textures: glint draws the file, with the nearest value or
// without the texture, and says so in one line. The rule is in docs/formats.md.
#include "scene/scene.h"

#include "support/gltf_text.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

// The tetrahedron with a material, and other members of the top level.
#define FILE_FORMAT                                                                                \
    TETRAHEDRON_STORAGE ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE                    \
                        ",\"material\":0}]}],\"nodes\":[{\"mesh\":0}]," ONE_SCENE                  \
                        ",\"materials\":[{%s}]%s%s"

static glint_scene load_material(const char *folder, const char *material, const char *more,
                                 glint_warnings *warnings)
{
    char rest[8192];
    snprintf(rest, sizeof rest, FILE_FORMAT, material, *more != '\0' ? "," : "", more);
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, rest);
    glint_scene scene;
    glint_error error = {0};
    if (load_text(folder, text, &scene, warnings, &error) != GLINT_OK) {
        fail_msg("%s: refused: %s", material, error.message);
    }
    assert_int_equal(scene.triangle_count, 4);
    assert_int_equal(scene.material_count, 1);
    free(text);
    return scene;
}

// Asserts that the file says one line that has `said`, or nothing if it is NULL.
static void assert_said(const glint_warnings *warnings, const char *said, const char *of)
{
    const char *first = warnings->count > 0 ? warnings->texts[0] : "nothing";
    if (warnings->count != (said != NULL) || (said != NULL && strstr(first, said) == NULL)) {
        fail_msg("%s: said %zu lines, \"%s\", expected \"%s\"", of, warnings->count, first,
                 said != NULL ? said : "nothing");
    }
}

// ---- Numbers ------------------------------------------------------------------------------------

#define METAL(text) "\"pbrMetallicRoughness\":{" text "}"
#define EXTENSION(name, text) "\"extensions\":{\"KHR_materials_" name "\":{" text "}}"
#define NEAREST " is out of range (the nearest value within counts)"

// A faulty material, and one without a fault that means the same.
static const struct {
    const char *faulty, *plain;
    const char *said; // NULL: there is no warning
} numbers[] = {
    {METAL("\"metallicFactor\":1.5"), METAL("\"metallicFactor\":1"),
     "materials[0]: metallicFactor" NEAREST},
    {METAL("\"metallicFactor\":1.0000001"), METAL("\"metallicFactor\":1"), NULL},
    {METAL("\"roughnessFactor\":-1"), METAL("\"roughnessFactor\":0"), "roughnessFactor" NEAREST},
    {METAL("\"baseColorFactor\":[1,0.5,2,1]"), METAL("\"baseColorFactor\":[1,0.5,1,1]"),
     "baseColorFactor" NEAREST},
    {METAL("\"baseColorFactor\":[0.5,0.25,0]"), METAL("\"baseColorFactor\":[0.5,0.25,0,1]"),
     "baseColorFactor has not 4 numbers"},
    {METAL("\"baseColorFactor\":null,\"metallicFactor\":null"), "", NULL},
    {"\"emissiveFactor\":[0,-1,0.5]", "\"emissiveFactor\":[0,0,0.5]", "emissiveFactor" NEAREST},
    // Lamps of older exporters are as bright as they say.
    {"\"emissiveFactor\":[3,2,1]",
     "\"emissiveFactor\":[1,0.66666666,0.33333333]," EXTENSION("emissive_strength",
                                                               "\"emissiveStrength\":3"),
     NULL},
    {"\"alphaMode\":\"GLASS\"", "", "alphaMode is none that there is (it counts as OPAQUE)"},
    {"\"alphaMode\":\"MASK\",\"alphaCutoff\":-1", "\"alphaMode\":\"MASK\",\"alphaCutoff\":0",
     "alphaCutoff" NEAREST},
    {"\"extras\":{\"glint\":{\"mirror\":2}}", "\"extras\":{\"glint\":{\"mirror\":1}}",
     "mirror" NEAREST},
    {"\"extras\":{\"glint\":{\"priority\":2000000}}",
     "\"extras\":{\"glint\":{\"priority\":1000000}}", "priority" NEAREST},
    {"\"extensions\":[]", "", NULL},
    {EXTENSION("transmission", "\"transmissionFactor\":2"),
     EXTENSION("transmission", "\"transmissionFactor\":1"), "transmissionFactor" NEAREST},
    {EXTENSION("ior", "\"ior\":0.9"), EXTENSION("ior", "\"ior\":1"), "ior" NEAREST},
    {EXTENSION("ior", "\"ior\":-1.5"), EXTENSION("ior", "\"ior\":1"), "ior" NEAREST},
    {EXTENSION("ior", "\"ior\":0.9999999"), EXTENSION("ior", "\"ior\":1"), NULL},
    {EXTENSION("ior", "\"ior\":0"), EXTENSION("ior", "\"ior\":1e5"), NULL},
    {EXTENSION("ior", "\"ior\":-0.0"), EXTENSION("ior", "\"ior\":1e5"), NULL},
    {EXTENSION("ior", "\"ior\":1e300"), EXTENSION("ior", "\"ior\":1e5"), NULL},
    {"\"extensions\":{\"KHR_materials_ior\":{\"ior\":0},\"KHR_materials_dispersion\":{"
     "\"dispersion\":1}}",
     EXTENSION("ior", "\"ior\":1e5"), NULL},
    {EXTENSION("volume", "\"attenuationDistance\":null"), "", NULL},
    {EXTENSION("volume", "\"attenuationDistance\":0"), "",
     "attenuationDistance is no distance (it counts as infinite)"},
    {EXTENSION("volume", "\"attenuationDistance\":-2"), "", "attenuationDistance is no distance"},
    {EXTENSION("volume", "\"attenuationDistance\":1e300"), "", NULL},
    {EXTENSION("volume", "\"attenuationColor\":[1,1,1.5]"), "", "attenuationColor" NEAREST},
    {EXTENSION("volume", "\"thicknessFactor\":-1"), "", "thicknessFactor" NEAREST},
    {EXTENSION("dispersion", "\"dispersion\":-1"), "", "dispersion" NEAREST},
    {EXTENSION("specular", "\"specularFactor\":1.5"), "", "specularFactor" NEAREST},
    {EXTENSION("specular", "\"specularColorFactor\":[1,1]"), "",
     "specularColorFactor has not 3 numbers"},
    {EXTENSION("specular", "\"specularColorFactor\":[2,1,-1]"),
     EXTENSION("specular", "\"specularColorFactor\":[2,1,0]"), "specularColorFactor" NEAREST},
    {EXTENSION("anisotropy", "\"anisotropyStrength\":1.5"),
     EXTENSION("anisotropy", "\"anisotropyStrength\":1"), "anisotropyStrength" NEAREST},
    {EXTENSION("sheen", "\"sheenColorFactor\":[0,0,1.5]"),
     EXTENSION("sheen", "\"sheenColorFactor\":[0,0,1]"), "sheenColorFactor" NEAREST},
    {EXTENSION("sheen", "\"sheenRoughnessFactor\":-1"), "", "sheenRoughnessFactor" NEAREST},
    {EXTENSION("diffuse_transmission", "\"diffuseTransmissionFactor\":1.5"),
     EXTENSION("diffuse_transmission", "\"diffuseTransmissionFactor\":1"),
     "diffuseTransmissionFactor" NEAREST},
    {EXTENSION("iridescence", "\"iridescenceFactor\":2"),
     EXTENSION("iridescence", "\"iridescenceFactor\":1"), "iridescenceFactor" NEAREST},
    {EXTENSION("iridescence", "\"iridescenceIor\":0.9"),
     EXTENSION("iridescence", "\"iridescenceIor\":1"), "iridescenceIor" NEAREST},
    {EXTENSION("iridescence", "\"iridescenceThicknessMinimum\":-1"),
     EXTENSION("iridescence", "\"iridescenceThicknessMinimum\":0"),
     "iridescenceThicknessMinimum" NEAREST},
    {EXTENSION("clearcoat", "\"clearcoatFactor\":1.5"),
     EXTENSION("clearcoat", "\"clearcoatFactor\":1"), "clearcoatFactor" NEAREST},
    {EXTENSION("emissive_strength", "\"emissiveStrength\":-1"),
     EXTENSION("emissive_strength", "\"emissiveStrength\":0"), "emissiveStrength" NEAREST},
};

static void assert_same_material(const glint_material *a, const glint_material *b)
{
    glint_material first = *a, second = *b;
    first.warnings = second.warnings = 0;
    for (int k = 0; k < 3; k++) { // products are rounded
        if (fabsf(first.emission[k] - second.emission[k]) < 1e-6F) {
            first.emission[k] = second.emission[k];
        }
    }
    assert_memory_equal(&first, &second, sizeof first);
}

static void the_nearest_number_counts(void **state)
{
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        glint_warnings of_faulty = {0}, of_plain = {0};
        glint_scene faulty = load_material(*state, numbers[i].faulty, "", &of_faulty);
        glint_scene plain = load_material(*state, numbers[i].plain, "", &of_plain);
        assert_said(&of_faulty, numbers[i].said, numbers[i].faulty);
        assert_int_equal(of_plain.count, 0);
        assert_same_material(&faulty.materials[0], &plain.materials[0]);
        glint_warnings_free(&of_faulty);
        glint_warnings_free(&of_plain);
        glint_scene_free(&faulty);
        glint_scene_free(&plain);
    }
}

// ---- Textures -----------------------------------------------------------------------------------

#define COLORED METAL("\"baseColorTexture\":{\"index\":0}")
#define LEFT_OUT "; the maps that need it are left out"

static void a_texture_that_cannot_be_shown_is_left_out(void **state)
{
    static const struct {
        const char *material, *more, *said;
    } cases[] = {
        {COLORED, "\"textures\":[{\"source\":0}],\"images\":[]",
         "textures[0].source: 0: there is no such image (the file has none"},
        {COLORED, "\"textures\":[{}]",
         "textures[0]: no image of a kind that is read (PNG, JPEG, WebP, DDS)" LEFT_OUT},
        {COLORED, "\"textures\":[]",
         "materials[0].pbrMetallicRoughness.baseColorTexture.index: 0: there is no such texture"},
        {METAL("\"baseColorTexture\":{}"), "",
         "materials[0].pbrMetallicRoughness.baseColorTexture: no index of a texture" LEFT_OUT},
        {METAL("\"baseColorTexture\":7"), "", "baseColorTexture: 7 stands where an object"},
        {METAL("\"baseColorTexture\":null"), "", NULL},
        {METAL("\"baseColorTexture\":{\"index\":0,\"texCoord\":2}"),
         "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"x.png\"}]",
         "TEXCOORD_2 is not read (use set 0 or 1)" LEFT_OUT},
        {METAL("\"baseColorTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{"
               "\"scale\":[1e300,1]}}}"),
         "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"x.png\"}]",
         "does not fit into floats"},
        {COLORED, "\"textures\":[{\"source\":0}],\"images\":[{}]",
         "images[0]: neither a uri nor a bufferView" LEFT_OUT},
        {COLORED, "\"textures\":[{\"source\":0}],\"images\":[{\"bufferView\":9}]",
         "images[0]: 9: there is no such bufferView"},
        {COLORED, "\"textures\":[{\"source\":0}],\"images\":[{\"bufferView\":0}]",
         "images[0]: "}, // no image
        {COLORED,
         "\"textures\":[{\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}}}],\"images\":[{"
         "\"uri\":\"a.ktx2\"}],\"extensionsRequired\":[\"KHR_texture_basisu\"]",
         "textures[0]: no image of a kind that is read"},
        // Nothing uses them.
        {"", "\"textures\":[{\"source\":7}],\"images\":[{\"uri\":5},{\"bufferView\":-1}]", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_warnings warnings = {0};
        glint_scene scene = load_material(*state, cases[i].material, cases[i].more, &warnings);
        assert_said(&warnings, cases[i].said, cases[i].more);
        assert_int_equal(scene.materials[0].textures[GLINT_TEXTURE_BASE_COLOR].image, 0);
        glint_warnings_free(&warnings);
        glint_scene_free(&scene);
    }
}

// A URI that glint must not open, or that names no file, costs the texture alone.
static void no_uri_of_an_image_refuses_the_file(void **state)
{
    assert_int_equal(mkdir(folder_path(*state, "sub"), 0700), 0);
    assert_int_equal(mkfifo(folder_path(*state, "fifo"), 0600), 0);
    static const char *const uris[][2] = {
        {"missing.png", "\"missing.png\": cannot be opened: No such file or directory"},
        {"no/such/folder.png", "cannot be opened: No such file"},
        {"", "\"\": names no file"},
        {"a%00.png", "names no file"},
        {".", "it is a folder"},
        {"sub", "it is a folder"},
        {"fifo", "it is no regular file"},
        {"/dev/zero", "lies outside the scene's folder"},
        {"/etc/hostname", "lies outside the scene's folder"},
        {"../..", "lies outside the scene's folder"},
        {"..\\\\..", "lies outside the scene's folder"},
        {"file:///etc/hostname", "file: is not read"},
        {"https://example.org/a.png", "https: is not read"},
        {"C:\\\\textures\\\\a.png", "C: is not read"},
        {"data:image/png;base64,AA*A", "is no base64 digit"},
        {"data:image/png", "a data URI without a comma"},
    };
    for (size_t i = 0; i < sizeof uris / sizeof *uris; i++) {
        char more[512];
        snprintf(more, sizeof more, "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}]",
                 uris[i][0]);
        glint_warnings warnings = {0};
        glint_scene scene = load_material(*state, COLORED, more, &warnings);
        assert_said(&warnings, uris[i][1], uris[i][0]);
        assert_true(any_warning_has(&warnings, ": images[0]") &&
                    any_warning_has(&warnings, LEFT_OUT));
        glint_warnings_free(&warnings);
        glint_scene_free(&scene);
    }
}

// A picture of one grey texel, as a data URI and as bytes.
static const char *const texel_uri =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaGgAAAMEAYFL0"
    "9IQAAAAAElFTkSuQmCC";
static const unsigned char texel[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
    0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9c, 0x63, 0x68, 0x68, 0x68, 0x00, 0x00, 0x03, 0x04, 0x01, 0x81, 0x4b, 0xd3, 0xd2,
    0x10, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

// An index may be written as 1.0. Only the image needs its buffer.
static void an_image_may_lie_in_a_buffer_of_its_own(void **state)
{
    static const char *const views[] = {"1", "1.0"};
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        char text[2048];
        snprintf(
            text, sizeof text,
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;"
            "base64,"
            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"},{\"byteLength\":%zu,\"uri\":\""
            "texel.bin\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":1,"
            "\"byteLength\":%zu}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
            "\"count\":3,"
            "\"type\":\"VEC3\"}],\"images\":[{\"bufferView\":%s,\"mimeType\":\"image/png\"}],"
            "\"textures\":[{\"source\":0}],\"materials\":[{" COLORED
            "}],\"meshes\":[{\"primitives\":"
            "[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"nodes\":[{\"mesh\":0}]"
            "," ONE_SCENE "}",
            sizeof texel, sizeof texel, views[i]);
        write_bytes(*state, "texel.bin", texel, sizeof texel);
        glint_scene scene;
        glint_warnings warnings = {0};
        assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
        assert_said(&warnings, NULL, views[i]);
        assert_int_equal(scene.textures->count, 1);
        assert_int_equal(scene.textures->textures[0].width, 1);
        glint_scene_free(&scene);
    }
}

static void backslashes_are_tried_as_slashes(void **state)
{
    mkdir(folder_path(*state, "sub"), 0700);
    write_bytes(*state, "sub/a.png", texel, sizeof texel);
    write_bytes(*state, "sub\\b.png", texel, sizeof texel); // a backslash in the file's name
    static const char *const uris[] = {"sub\\\\a.png", "sub%5Ca.png", "sub/a.png", "sub\\\\b.png"};
    for (size_t i = 0; i < sizeof uris / sizeof *uris; i++) {
        char more[512];
        snprintf(more, sizeof more, "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}]",
                 uris[i]);
        glint_warnings warnings = {0};
        glint_scene scene = load_material(*state, COLORED, more, &warnings);
        assert_said(&warnings, NULL, uris[i]);
        assert_int_equal(scene.textures->count, 1);
        glint_scene_free(&scene);
    }
}

// Many missing images are one kind, and one line.
static void one_line_tells_of_all_missing_images(void **state)
{
    char more[4096] = "\"images\":[", *to = more + strlen(more);
    for (int i = 0; i < 5; i++) {
        to += sprintf(to, "%s{\"uri\":\"%c.png\"}", i > 0 ? "," : "", 'a' + i);
    }
    to += sprintf(to, "],\"textures\":[");
    for (int i = 0; i < 5; i++) {
        to += sprintf(to, "%s{\"source\":%d}", i > 0 ? "," : "", i);
    }
    sprintf(to, "]");
    glint_warnings warnings = {0};
    // The first image is used twice.
    glint_scene scene = load_material(
        *state,
        METAL("\"baseColorTexture\":{\"index\":0},\"metallicRoughnessTexture\":{"
              "\"index\":1}") ",\"normalTexture\":{\"index\":2},\"emissiveFactor\":["
                              "1,1,1],\"occlusionTexture\":"
                              "{\"index\":3},\"emissiveTexture\":{"
                              "\"index\":0},\"extensions\":{\"KHR_materials_sheen\":{"
                              "\"sheenColorFactor\":[1,1,1],\"sheenColorTexture\":{\"index\":4}}}",
        more, &warnings);
    assert_said(&warnings,
                "images[0] \"a.png\" and 4 more: cannot be opened: No such file or directory (put "
                "the file beside the scene)" LEFT_OUT,
                "five images");
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
}

// A map that cannot be shown leaves its factor, and all other maps. Only emission ends.
static void other_maps_stay(void **state)
{
    static const char *const more =
        "\"textures\":[{\"source\":0},{\"source\":1}],\"images\":[{\"uri\":\"%s\"},{\"uri\":"
        "\"none.png\"}]";
    char filled[1024];
    snprintf(filled, sizeof filled, more, texel_uri);
#define MANY(color, metal, emission, coat)                                                         \
    "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,1,1],\"metallicFactor\":0.75,"        \
    "\"roughnessFactor\":0.5,\"baseColorTexture\":{\"index\":" color                               \
    "},\"metallicRoughnessTexture\":{\"index\":" metal "}},\"emissiveFactor\":[1,1,1],"            \
    "\"emissiveTexture\":{\"index\":" emission                                                     \
    "},\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1,\"clearcoatTexture\":{"  \
    "\"index\":" coat "}},\"KHR_materials_transmission\":{\"transmissionFactor\":0.5}}"
    static const struct {
        const char *material;
        glint_texture_slot missing;
    } cases[] = {
        {MANY("1", "0", "0", "0"), GLINT_TEXTURE_BASE_COLOR},
        {MANY("0", "1", "0", "0"), GLINT_TEXTURE_METALLIC_ROUGHNESS},
        {MANY("0", "0", "1", "0"), GLINT_TEXTURE_EMISSION},
        {MANY("0", "0", "0", "1"), GLINT_TEXTURE_CLEARCOAT},
    };
    static const glint_texture_slot used[] = {GLINT_TEXTURE_BASE_COLOR,
                                              GLINT_TEXTURE_METALLIC_ROUGHNESS,
                                              GLINT_TEXTURE_EMISSION, GLINT_TEXTURE_CLEARCOAT};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_warnings warnings = {0};
        glint_scene scene = load_material(*state, cases[i].material, filled, &warnings);
        assert_said(&warnings, "images[1] \"none.png\": cannot be opened", "one of four maps");
        const glint_material *m = &scene.materials[0];
        for (size_t k = 0; k < sizeof used / sizeof *used; k++) {
            assert_int_equal(m->textures[used[k]].image != 0, used[k] != cases[i].missing);
        }
        assert_true(m->base_color[0] == 0.5F && m->base_color[1] == 0.25F && m->alpha == 1);
        assert_true(m->metallic == 0.75F && m->roughness == 0.5F && m->clearcoat == 1);
        assert_true(m->transmission == 0.5F);
        const float emission = cases[i].missing == GLINT_TEXTURE_EMISSION ? 0 : 1;
        assert_true(m->emission[0] == emission && m->emission[2] == emission);
        glint_warnings_free(&warnings);
        glint_scene_free(&scene);
    }
}

// A map of what is not there changes nothing.
static void missing_maps_that_nothing_shows_are_silent(void **state)
{
#define MISSING "{\"index\":0}"
    static const char *const materials[] = {
        "\"emissiveTexture\":" MISSING,
        "\"emissiveFactor\":[0,0,0],\"emissiveTexture\":" MISSING,
        EXTENSION("transmission", "\"transmissionTexture\":" MISSING),
        EXTENSION("clearcoat",
                  "\"clearcoatTexture\":" MISSING ",\"clearcoatNormalTexture\":" MISSING
                  ",\"clearcoatRoughnessTexture\":" MISSING),
        EXTENSION("sheen", "\"sheenColorTexture\":" MISSING ",\"sheenRoughnessTexture\":" MISSING),
        EXTENSION("iridescence", "\"iridescenceTexture\":" MISSING),
        EXTENSION("anisotropy", "\"anisotropyTexture\":" MISSING),
        EXTENSION("diffuse_transmission", "\"diffuseTransmissionColorTexture\":" MISSING),
        EXTENSION("unlit", "") ",\"normalTexture\":" MISSING,
    };
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++) {
        glint_warnings warnings = {0};
        glint_scene scene = load_material(
            *state, materials[i],
            "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"none.png\"}]", &warnings);
        assert_said(&warnings, NULL, materials[i]);
        glint_scene_free(&scene);
    }
}

static void a_faulty_sampler_is_the_default_one(void **state)
{
    static const char *const samplers[][2] = {
        {"{\"wrapS\":33071}", NULL},
        {"{\"wrapS\":33069}", "samplers[0].wrapS: no code of a filter or wrapping"},
        {"{\"wrapS\":33071,\"minFilter\":1}", "samplers[0].minFilter: no code"},
        {"{\"magFilter\":9987}", "samplers[0].magFilter: no code"},
        {"{\"magFilter\":\"x\"}", "magFilter: the text \"x\" is out of range"},
    };
    for (size_t i = 0; i < sizeof samplers / sizeof *samplers; i++) {
        char more[1024];
        snprintf(more, sizeof more,
                 "\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[%s],\"images\":[{"
                 "\"uri\":\"%s\"}]",
                 samplers[i][0], texel_uri);
        glint_warnings warnings = {0};
        glint_scene scene = load_material(*state, COLORED, more, &warnings);
        assert_said(&warnings, samplers[i][1], more);
        const glint_texture_use *use = &scene.materials[0].textures[GLINT_TEXTURE_BASE_COLOR];
        assert_int_equal(use->image, 1);
        assert_int_equal(use->wrap_s, i == 0 ? GLINT_WRAP_CLAMP : GLINT_WRAP_REPEAT);
        glint_warnings_free(&warnings);
        glint_scene_free(&scene);
    }
}

// A buffer that only images need may be missing, and one that nothing needs.
static void buffers_of_images_alone_may_be_missing(void **state)
{
    static const struct {
        const char *view, *image, *said;
    } cases[] = {
        {"{\"buffer\":1,\"byteLength\":12}", "{\"bufferView\":3}",
         "images[0]: buffers[1].uri: \"none.bin\": cannot be opened: No such file"},
        {"{\"buffer\":1,\"byteLength\":12}", "{\"uri\":\"x.png\"}",
         "images[0] \"x.png\": cannot be opened"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char rest[4096];
        snprintf(rest, sizeof rest, FILE_FORMAT ",\"textures\":[{\"source\":0}],\"images\":[%s]",
                 COLORED, "", "", cases[i].image);
        char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, rest);
        char changed[16384];
        const char *buffers = strstr(text, "}],\"bufferViews\":["),
                   *views = strstr(text, "],\"acc");
        assert_true(buffers != NULL && views != NULL);
        snprintf(changed, sizeof changed, "%.*s},{\"byteLength\":12,\"uri\":\"none.bin\"%.*s,%s%s",
                 (int)(buffers - text), text, (int)(views - buffers), buffers, cases[i].view,
                 views);
        glint_scene scene;
        glint_warnings warnings = {0};
        glint_error error = {0};
        if (load_text(*state, changed, &scene, &warnings, &error) != GLINT_OK) {
            fail_msg("%s", error.message);
        }
        assert_said(&warnings, cases[i].said, cases[i].image);
        assert_int_equal(scene.triangle_count, 4);
        glint_warnings_free(&warnings);
        glint_scene_free(&scene);
        // An accessor needs the buffer.
        char *accessor = strstr(changed, "\"accessors\":[{\"bufferView\":0");
        accessor[strlen("\"accessors\":[{\"bufferView\":")] = '3';
        memcpy(strstr(accessor, "\"count\":4"), "\"count\":1", 9);
        assert_refused(write_bytes(*state, "bad.gltf", changed, strlen(changed)), "buffers[1].uri");
        free(text);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_setup, scratch_teardown)
    const struct CMUnitTest tests[] = {
        TEST(the_nearest_number_counts),
        TEST(a_texture_that_cannot_be_shown_is_left_out),
        TEST(no_uri_of_an_image_refuses_the_file),
        TEST(an_image_may_lie_in_a_buffer_of_its_own),
        TEST(backslashes_are_tried_as_slashes),
        TEST(one_line_tells_of_all_missing_images),
        TEST(other_maps_stay),
        TEST(missing_maps_that_nothing_shows_are_silent),
        TEST(a_faulty_sampler_is_the_default_one),
        TEST(buffers_of_images_alone_may_be_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
