// Reads the textures of a glTF file. See file_textures.h.
#include "support/file_textures.h"

#include "image/decoder.h"
#include "support/srgb.h"
#include "support/textured_plane.h"

#include <jansson.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct file_textures {
    json_t *root;
    const char *path;     // path of the file, borrowed
    oracle_image *images; // [material][role]
    size_t count;
};

static double number(const json_t *object, const char *key, double otherwise)
{
    const json_t *found = json_object_get(object, key);
    return found != NULL ? json_number_value(found) : otherwise;
}

// Item of a list in the file.
static const json_t *item(const file_textures *t, const char *list, double index)
{
    return json_array_get(json_object_get(t->root, list), (size_t)index);
}

// ---- Images -------------------------------------------------------------------------------------

static double code_at(const void *codes, int bits, size_t i)
{
    return bits == 16 ? ((const uint16_t *)codes)[i] / 65535.0
                      : ((const uint8_t *)codes)[i] / 255.0;
}

static void fill_first_level(const glint_stored *stored, bool is_color, oracle_image *image)
{
    const int channels = stored->facts.channels, bits = stored->facts.code_bits;
    void *codes = malloc(stored->value_bytes);
    assert_non_null(codes);
    assert_int_equal(glint_stored_read(stored, 0, codes, stored->value_bytes, NULL), GLINT_OK);
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++) {
        for (int c = 0; c < 4; c++) {
            const int from = channels >= 3 ? c : c == 3 ? 1 : 0; // grey with alpha
            double value =
                from < channels ? code_at(codes, bits, i * (size_t)channels + (size_t)from) : 1;
            image->texels[0][i][c] = c < 3 && is_color ? linear_from_srgb(value) : value;
        }
    }
    free(codes);
}

static void read_image(const file_textures *t, const json_t *image, bool is_color, bool is_coverage,
                       oracle_image *to)
{
    char path[4096];
    const char *slash = strrchr(t->path, '/');
    assert_non_null(slash);
    const char *uri = json_string_value(json_object_get(image, "uri"));
    assert_non_null(uri);
    snprintf(path, sizeof path, "%.*s/%s", (int)(slash - t->path), t->path, uri);
    glint_image_source source;
    glint_stored stored;
    assert_int_equal(glint_image_find_source(path, &source, NULL), GLINT_OK);
    assert_int_equal(glint_decoder_run(&source, false, &stored, NULL), GLINT_OK);
    assert_true(oracle_image_create(stored.facts.width, stored.facts.height, to));
    fill_first_level(&stored, is_color, to);
    glint_stored_free(&stored);
    oracle_image_average(to, is_coverage);
}

// ---- Samplers -----------------------------------------------------------------------------------

static oracle_wrap wrap_of(const json_t *sampler, const char *key)
{
    const double code = number(sampler, key, 10497);
    return code == 33071 ? ORACLE_CLAMP : code == 33648 ? ORACLE_MIRROR : ORACLE_REPEAT;
}

static void take_sampler(const json_t *sampler, oracle_texture *t)
{
    const int small = (int)number(sampler, "minFilter", 9987);
    t->wrap[0] = wrap_of(sampler, "wrapS");
    t->wrap[1] = wrap_of(sampler, "wrapT");
    t->magnified_nearest = number(sampler, "magFilter", 9729) == 9728;
    t->minified_nearest = small == 9728 || small == 9984 || small == 9986;
    t->mips = small <= 9729                    ? ORACLE_MIPS_NONE
              : small == 9984 || small == 9985 ? ORACLE_MIPS_NEAREST
                                               : ORACLE_MIPS_LINEAR;
}

// Applies scale, then rotation, then offset. A positive rotation turns the image clockwise; v runs
// down.
static void take_transform(const json_t *transform, oracle_texture *t)
{
    const double angle = number(transform, "rotation", 0), c = cos(angle), s = sin(angle);
    const double turn[2][2] = {{c, s}, {-s, c}};
    const json_t *scale = json_object_get(transform, "scale");
    const json_t *offset = json_object_get(transform, "offset");
    for (size_t row = 0; row < 2; row++) {
        for (size_t k = 0; k < 2; k++) {
            t->transform[row][k] =
                turn[row][k] * (scale != NULL ? json_number_value(json_array_get(scale, k)) : 1);
        }
        t->transform[row][2] = json_number_value(json_array_get(offset, row)); // 0 if missing
    }
}

// ---- Materials ----------------------------------------------------------------------------------

static const json_t *info_of(const json_t *material, oracle_role role)
{
    static const char *const keys[][3] = {
        [ORACLE_BASE] = {"pbrMetallicRoughness", "baseColorTexture"},
        [ORACLE_METALLIC] = {"pbrMetallicRoughness", "metallicRoughnessTexture"},
        [ORACLE_NORMAL] = {"normalTexture"},
        [ORACLE_OCCLUSION] = {"occlusionTexture"},
        [ORACLE_EMISSION] = {"emissiveTexture"},
        [ORACLE_TRANSMISSION] = {"extensions", "KHR_materials_transmission", "transmissionTexture"},
        [ORACLE_SPECULAR] = {"extensions", "KHR_materials_specular", "specularTexture"},
        [ORACLE_SPECULAR_COLOR] = {"extensions", "KHR_materials_specular", "specularColorTexture"},
        [ORACLE_CLEARCOAT] = {"extensions", "KHR_materials_clearcoat", "clearcoatTexture"},
        [ORACLE_CLEARCOAT_ROUGHNESS] = {"extensions", "KHR_materials_clearcoat",
                                        "clearcoatRoughnessTexture"},
        [ORACLE_ANISOTROPY] = {"extensions", "KHR_materials_anisotropy", "anisotropyTexture"},
        [ORACLE_SHEEN_COLOR] = {"extensions", "KHR_materials_sheen", "sheenColorTexture"},
        [ORACLE_SHEEN_ROUGHNESS] = {"extensions", "KHR_materials_sheen", "sheenRoughnessTexture"},
        [ORACLE_DIFFUSE_TRANSMISSION] = {"extensions", "KHR_materials_diffuse_transmission",
                                         "diffuseTransmissionTexture"},
        [ORACLE_DIFFUSE_TRANSMISSION_COLOR] = {"extensions", "KHR_materials_diffuse_transmission",
                                               "diffuseTransmissionColorTexture"},
        [ORACLE_IRIDESCENCE] = {"extensions", "KHR_materials_iridescence", "iridescenceTexture"},
        [ORACLE_IRIDESCENCE_THICKNESS] = {"extensions", "KHR_materials_iridescence",
                                          "iridescenceThicknessTexture"},
        [ORACLE_CLEARCOAT_NORMAL] = {"extensions", "KHR_materials_clearcoat",
                                     "clearcoatNormalTexture"},
    };
    for (size_t i = 0; i < 3 && keys[role][i] != NULL; i++) {
        material = json_object_get(material, keys[role][i]);
    }
    return material;
}

static void read_texture(const file_textures *t, const json_t *material, oracle_role role,
                         oracle_texture *texture, oracle_image *image)
{
    const json_t *info = info_of(material, role);
    *texture = (oracle_texture){0};
    if (info == NULL) {
        return;
    }
    const json_t *named = item(t, "textures", number(info, "index", -1));
    const json_t *sampler = json_object_get(named, "sampler");
    const json_t *transform =
        json_object_get(json_object_get(info, "extensions"), "KHR_texture_transform");
    const char *mode = json_string_value(json_object_get(material, "alphaMode"));
    const bool is_coverage = role == ORACLE_BASE && mode != NULL && strcmp(mode, "OPAQUE") != 0;
    texture->set = (int)number(transform, "texCoord", number(info, "texCoord", 0));
    take_sampler(sampler != NULL ? item(t, "samplers", json_number_value(sampler)) : NULL, texture);
    take_transform(transform, texture);
    read_image(t, item(t, "images", number(named, "source", -1)),
               role == ORACLE_BASE || role == ORACLE_EMISSION || role == ORACLE_SPECULAR_COLOR,
               is_coverage, image);
    texture->image = image;
}

file_textures *file_textures_read(const glint_scene *scene, oracle_material *materials)
{
    file_textures *t = calloc(1, sizeof *t);
    assert_non_null(t);
    t->path = scene->path;
    t->root = json_load_file(scene->path, 0, NULL);
    assert_non_null(t->root);
    t->count = ORACLE_ROLES * scene->material_count;
    t->images = calloc(t->count + 1, sizeof *t->images);
    assert_non_null(t->images);
    for (size_t i = 0; i < t->count; i++) {
        const size_t number_of = i / ORACLE_ROLES, role = i % ORACLE_ROLES;
        read_texture(t, item(t, "materials", scene->materials[number_of].index), (oracle_role)role,
                     &materials[number_of].texture[role], &t->images[i]);
    }
    return t;
}

void file_textures_free(file_textures *t)
{
    for (size_t i = 0; i < t->count; i++) {
        oracle_image_free(&t->images[i]);
    }
    json_decref(t->root);
    free(t->images);
    free(t);
}
