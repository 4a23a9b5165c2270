// Writes materials and textures in glTF's form. See write_material.h.
#include "write_material.h"

#include <math.h>
#include <stdio.h>

#define TRANSFORM "KHR_texture_transform"

// ---- Numbers -----------------------------------------------------------------------------------

json_t *gltf_exact(double x)
{
    return x == floor(x) && fabs(x) < 1e9 ? json_integer((json_int_t)x) : json_real(x);
}

json_t *gltf_number(double x)
{
    return gltf_exact(floor(x * 1e9 + 0.5) / 1e9);
}

json_t *gltf_numbers(const double *values, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++) {
        json_array_append_new(array, gltf_number(values[i]));
    }
    return array;
}

// ---- Textures ----------------------------------------------------------------------------------

typedef struct texture_list {
    const model *scene;
    json_t *used;
} texture_list;

static void set_texture(const texture_list *list, json_t *object, const char *key,
                        const texture *map)
{
    if (map->shown == NULL) {
        return;
    }
    json_t *info = json_pack("{s:i}", "index", (int)(map->shown - list->scene->pictures));
    if (map->repeats[0] > 0) {
        json_object_set_new(
            info, "extensions",
            json_pack("{s:{s:o}}", TRANSFORM, "scale", gltf_numbers(map->repeats, 2)));
        json_object_set_new(list->used, TRANSFORM, json_true());
    }
    json_object_set_new(object, key, info);
}

// Adds a texture for each picture. Sharp pictures use sampler 0; the others use glTF's default
// sampler.
void gltf_add_textures(const model *scene, json_t *file)
{
    enum { NEAREST = 9728, LINEAR_MIPMAP_LINEAR = 9987 };
    if (scene->picture_count == 0) {
        return;
    }
    json_t *images = json_array(), *textures = json_array();
    bool has_sharp = false;
    for (int i = 0; i < scene->picture_count; i++) {
        char file_name[128];
        snprintf(file_name, sizeof file_name, "%s_%s.png", scene->name, scene->pictures[i].name);
        json_array_append_new(images, json_pack("{s:s}", "uri", file_name));
        json_t *shown = json_pack("{s:i}", "source", i);
        if (scene->pictures[i].sharp) {
            json_object_set_new(shown, "sampler", json_integer(0));
            has_sharp = true;
        }
        json_array_append_new(textures, shown);
    }
    json_object_set_new(file, "textures", textures);
    json_object_set_new(file, "images", images);
    if (has_sharp) {
        json_object_set_new(
            file, "samplers",
            json_pack("[{s:i, s:i}]", "magFilter", NEAREST, "minFilter", LINEAR_MIPMAP_LINEAR));
    }
}

// ---- Materials ---------------------------------------------------------------------------------

static json_t *material_extensions(const material *m, json_t *used)
{
    json_t *all = json_object();
    if (m->transmission > 0) {
        json_object_set_new(all, "KHR_materials_transmission",
                            json_pack("{s:o}", "transmissionFactor", gltf_number(m->transmission)));
    }
    if (m->ior > 0) {
        json_object_set_new(all, "KHR_materials_ior",
                            json_pack("{s:o}", "ior", gltf_number(m->ior)));
    }
    if (m->thickness > 0) {
        json_t *volume = json_pack("{s:o}", "thicknessFactor", gltf_number(m->thickness));
        if (m->attenuation_distance > 0) {
            json_object_set_new(volume, "attenuationDistance",
                                gltf_number(m->attenuation_distance));
            json_object_set_new(volume, "attenuationColor", gltf_numbers(m->attenuation_color, 3));
        }
        json_object_set_new(all, "KHR_materials_volume", volume);
    }
    if (m->emissive_strength > 0) {
        json_object_set_new(
            all, "KHR_materials_emissive_strength",
            json_pack("{s:o}", "emissiveStrength", gltf_number(m->emissive_strength)));
    }
    if (m->unlit) {
        json_object_set_new(all, "KHR_materials_unlit", json_object());
    }
    const char *name;
    json_t *value;
    json_object_foreach(all, name, value)
    {
        json_object_set_new(used, name, json_true());
    }
    return all;
}

// Sets a member, or drops it if the object is empty.
static void set_unless_empty(json_t *object, const char *key, json_t *value)
{
    if (json_object_size(value) > 0) {
        json_object_set(object, key, value);
    }
    json_decref(value);
}

json_t *gltf_material(const model *scene, const material *m, json_t *used)
{
    json_t *factors = json_object();
    double color[4] = {m->base_color[0], m->base_color[1], m->base_color[2], 1};
    json_object_set_new(factors, "baseColorFactor", gltf_numbers(color, 4));
    json_object_set_new(factors, "metallicFactor", gltf_number(m->metallic));
    json_object_set_new(factors, "roughnessFactor", gltf_number(m->roughness));
    const texture_list list = {scene, used};
    set_texture(&list, factors, "baseColorTexture", &m->base_color_map);
    set_texture(&list, factors, "metallicRoughnessTexture", &m->metallic_roughness_map);
    json_t *object = json_object();
    json_object_set_new(object, "name", json_string(m->name));
    json_object_set_new(object, "pbrMetallicRoughness", factors);
    if (m->emission[0] > 0 || m->emission[1] > 0 || m->emission[2] > 0) {
        json_object_set_new(object, "emissiveFactor", gltf_numbers(m->emission, 3));
    }
    set_texture(&list, object, "normalTexture", &m->normal_map);
    set_texture(&list, object, "emissiveTexture", &m->emission_map);
    if (m->alpha_mode != NULL) {
        json_object_set_new(object, "alphaMode", json_string(m->alpha_mode));
    }
    if (m->double_sided) {
        json_object_set_new(object, "doubleSided", json_true());
    }
    set_unless_empty(object, "extensions", material_extensions(m, used));
    if (m->blend) {
        json_object_set_new(object, "extras",
                            json_pack("{s:{s:o}}", "glint", "mirror", gltf_number(m->mirror)));
    }
    return object;
}
