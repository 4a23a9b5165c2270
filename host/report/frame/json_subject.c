// Writes device, plan, tree, environment and scene as JSON. See json.h.
#include "render/general.h"
#include "render/settings_table.h"
#include "report/json.h"

#include <stdio.h>

static json_t *triple(double x, double y, double z)
{
    const double values[3] = {x, y, z};
    json_t *list = json_array();
    for (int i = 0; i < 3; i++) {
        (void)json_array_append_new(list, json_real(values[i]));
    }
    return list;
}

static json_t *color(const float rgb[3])
{
    return triple((double)rgb[0], (double)rgb[1], (double)rgb[2]);
}

static json_t *vector(glint_vec3 v)
{
    return triple(v.x, v.y, v.z);
}

json_t *glint_json_device(const glint_capabilities *device)
{
    json_t *object = json_object();
    glint_json_put(object, "index", json_integer(device->index));
    glint_json_put_text(object, "name", device->name);
    glint_json_put_text(object, "platform", device->platform);
    glint_json_put_text(object, "driver", device->driver);
    glint_json_put_text(object, "opencl", device->opencl_version);
    glint_json_put_text(object, "type", device->is_gpu ? "gpu" : device->is_cpu ? "cpu" : "other");
    glint_json_put_count(object, "float_width", (uint64_t)device->native_float_width);
    glint_json_put_count(object, "compute_units", device->compute_units);
    glint_json_put_count(object, "memory_bytes", device->memory_bytes);
    glint_json_put_count(object, "largest_allocation_bytes", device->largest_allocation_bytes);
    glint_json_put_flag(object, "fp64", device->has_double);
    return object;
}

json_t *glint_json_bvh(const glint_bvh_report *bvh)
{
    json_t *object = json_object();
    glint_json_put_count(object, "triangles", bvh->triangle_count);
    glint_json_put_count(object, "nodes", bvh->node_count);
    glint_json_put_count(object, "clusters", bvh->cluster_count);
    glint_json_put(object, "depth", json_integer(bvh->depth));
    glint_json_put_real(object, "sah_cost", bvh->sah_cost);
    glint_json_put_real(object, "fill", bvh->fill);
    glint_json_put_count(object, "bytes", bvh->bytes);
    glint_json_put_real(object, "bytes_per_triangle", bvh->bytes_per_triangle);
    return object;
}

static json_t *features_object(const glint_plan *plan)
{
    json_t *features = json_object();
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        const glint_feature_choice *choice = &plan->features[i];
        json_t *feature = json_object();
        glint_json_put_flag(feature, "compiled", choice->compiled);
        glint_json_put_text(feature, "reason", choice->reason);
        glint_json_put(features, glint_feature_name((glint_feature)i), feature);
    }
    return features;
}

json_t *glint_json_plan(const glint_plan *plan)
{
    char text[512];
    char options[GLINT_BUILD_OPTIONS_BYTES];
    glint_plan_describe(plan, text, sizeof text);
    glint_plan_build_options(plan, options);
    bool is_double = plan->precision == GLINT_PRECISION_DOUBLE;
    json_t *object = json_object();
    glint_json_put_text(object, "text", text);
    glint_json_put_text(object, "precision", is_double ? "double" : "float");
    glint_json_put(object, "kernel_width", json_integer(plan->kernel_width));
    glint_json_put_text(object, "kernel_width_reason", plan->width_reason);
    glint_json_put(object, "tile_packets", json_integer(plan->tiles ? 16 : 1));
    glint_json_put_text(object, "tile_packets_reason", plan->tiles_reason);
    glint_json_put_text(object, "secondary_rays", plan->secondary);
    glint_json_put_text(object, "texels", plan->half_texels ? "half" : "float");
    glint_json_put_text(object, "texels_reason", plan->texels_reason);
    glint_json_put_real(object, "texels_relative_rmse", plan->texels_rmse);
    glint_json_put(object, "bvh_width", json_integer(plan->bvh_width));
    glint_json_put(object, "depth", json_integer(plan->depth));
    glint_json_put_flag(object, "depth_is_auto", plan->depth_is_auto);
    glint_json_put_flag(object, "depth_is_exact", plan->depth_is_exact);
    glint_json_put_text(object, "depth_reason",
                        plan->sight.depth > 0 && !plan->depth_is_exact
                            ? "proved for eyes outside of the scene's bounds alone"
                        : plan->sight.reason[0] != '\0' ? plan->sight.reason
                                                        : NULL);
    glint_json_put(object, "stack_capacity", json_integer(plan->stack_capacity));
    glint_json_put_text(object, "stack_reason", plan->stack_reason);
    glint_json_put(object, "media_count", json_integer(plan->media_count));
    glint_json_put(object, "features_compiled", json_integer(glint_plan_feature_count(plan)));
    glint_json_put(object, "features_known", json_integer(GLINT_FEATURE_COUNT));
    glint_json_put(object, "features", features_object(plan));
    glint_json_put_text(object, "build_options", options);
    const glint_kernel_kind general = glint_general_kernel_of(plan);
    glint_json_put_text(object, "general_kernels",
                        general != GLINT_KERNEL_SPECIAL ? glint_kernel_kind_name(general) : NULL);
    return object;
}

json_t *glint_json_environment(const glint_environment *environment)
{
    json_t *object = json_object();
    glint_json_put_text(object, "name", environment->name);
    glint_json_put_text(object, "layout", glint_layout_name(environment->layout));
    glint_json_put_text(object, "reason", environment->reason);
    glint_json_put(object, "width", json_integer(environment->source_width));
    glint_json_put(object, "height", json_integer(environment->source_height));
    glint_json_put(object, "cube_edge", json_integer(environment->radiance.edge));
    glint_json_put_count(object, "cube_bytes",
                         glint_cube_size(&environment->radiance) * sizeof(float));
    glint_json_put_count(object, "mended_texels", environment->mended_texels);
    const glint_proxy *proxy = &environment->proxy;
    if (proxy->kind != GLINT_PROXY_NONE) {
        glint_json_put_text(object, "proxy", proxy->kind == GLINT_PROXY_BOX ? "box" : "sphere");
        glint_json_put(object, "proxy_center", vector(proxy->center));
        glint_json_put(object, "proxy_middle", vector(proxy->middle));
        glint_json_put(object, "proxy_half_extent", vector(proxy->half_extent));
    }
    return object;
}

json_t *glint_json_camera(const glint_camera *camera)
{
    json_t *object = json_object();
    glint_json_put_text(object, "name", camera->name);
    glint_json_put_text(object, "type", camera->orthographic ? "orthographic" : "perspective");
    if (camera->orthographic) {
        glint_json_put_real(object, "ymag", camera->ymag);
    } else {
        glint_json_put_real(object, "yfov_degrees", camera->yfov * 180 / GLINT_PI);
    }
    glint_json_put(object, "eye", vector(camera->eye));
    glint_json_put(object, "right", vector(camera->right));
    glint_json_put(object, "up", vector(camera->up));
    glint_json_put(object, "back", vector(camera->back));
    return object;
}

// The value of a setting: a number if it is one, else the word that the option takes.
static json_t *setting_value(const glint_setting *setting, const glint_settings *settings)
{
    char text[GLINT_SETTING_TEXT];
    long long number;
    glint_setting_print(setting, settings, text);
    if (setting->option.kind == GLINT_OPTION_REAL) {
        return json_real(glint_setting_number(setting, settings, 0));
    }
    return glint_parse_int(text, &number) ? json_integer(number) : json_string(text);
}

json_t *glint_json_settings(const glint_settings *settings)
{
    json_t *object = json_object();
    glint_json_put(object, "width", json_integer(settings->width));
    glint_json_put(object, "height", json_integer(settings->height));
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if (setting->key != NULL) {
            glint_json_put(object, setting->key, setting_value(setting, settings));
        }
    }
    return object;
}

static json_t *textures_array(const glint_material *material)
{
    json_t *array = json_array();
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        if (material->textures[slot].image != 0) {
            json_array_append_new(array,
                                  json_string(glint_texture_slot_name((glint_texture_slot)slot)));
        }
    }
    return array;
}

// A distance that is infinite becomes null: no attenuation at any distance.
static void put_value(json_t *object, const glint_material_value *value,
                      const glint_material *material)
{
    const float *numbers = (const float *)((const char *)material + value->offset);
    if (value->count == 3) {
        glint_json_put(object, value->name, color(numbers));
    } else if (value->count == 2) {
        char name[64];
        snprintf(name, sizeof name, "%s_minimum", value->name);
        glint_json_put_real(object, name, (double)numbers[0]);
        snprintf(name, sizeof name, "%s_maximum", value->name);
        glint_json_put_real(object, name, (double)numbers[1]);
    } else {
        glint_json_put_real(object, value->name, (double)numbers[0]);
    }
}

static json_t *material_object(const glint_material *material)
{
    json_t *object = json_object();
    glint_json_put_text(object, "name", material->name);
    glint_json_put(object, "index", json_integer(material->index));
    glint_json_put_text(object, "kind", glint_material_kind(material));
    for (size_t i = 0; i < glint_material_value_count; i++) {
        put_value(object, &glint_material_values[i], material);
    }
    glint_json_put_flag(object, "unlit", material->unlit);
    static const char *const modes[] = {"opaque", "mask", "blend"};
    glint_json_put_text(object, "alpha_mode", modes[material->alpha_mode]);
    glint_json_put(object, "textures", textures_array(material));
    glint_json_put_flag(object, "vertex_colors", material->has_vertex_colors);
    if (material->mirror < 0) {
        glint_json_put(object, "mirror", json_null());
    }
    return object;
}

static json_t *topology_object(const glint_topology *topology)
{
    size_t closed = 0;
    size_t convex = 0;
    for (size_t i = 0; i < topology->component_count; i++) {
        closed += topology->components[i].closed;
        convex += topology->components[i].convex;
    }
    json_t *object = json_object();
    glint_json_put_count(object, "components", topology->component_count);
    glint_json_put_count(object, "closed", closed);
    glint_json_put_count(object, "convex", convex);
    glint_json_put_count(object, "boundary_edges", topology->boundary_edges);
    return object;
}

// Pairs of touching or overlapping solids, by the indices of their instances. "there" is the solid
// that fills their common space.
static json_t *contacts_list(const glint_solids *solids)
{
    json_t *list = json_array();
    for (size_t i = 0; i < solids->contact_count; i++) {
        const glint_contact *contact = &solids->contacts[i];
        json_t *object = json_object();
        glint_json_put_count(object, "there", contact->instances[contact->there]);
        glint_json_put_count(object, "gives_way", contact->instances[1 - contact->there]);
        glint_json_put_text(object, "kind", contact->overlap ? "overlap" : "touch");
        glint_json_put_flag(object, "is_guess", contact->is_guess);
        json_array_append_new(list, object);
    }
    return list;
}

static json_t *instance_object(const glint_instance *instance)
{
    json_t *object = json_object();
    glint_json_put_text(object, "node", instance->node);
    glint_json_put(object, "node_index", json_integer(instance->node_index));
    glint_json_put_count(object, "triangles", instance->triangle_count);
    glint_json_put_count(object, "material", instance->material);
    return object;
}

static json_t *light_object(const glint_punctual_light *light)
{
    json_t *object = json_object();
    glint_json_put_text(object, "name", light->name);
    glint_json_put(object, "node_index", json_integer(light->node_index));
    glint_json_put_text(object, "type", glint_punctual_kind_name(light->kind));
    glint_json_put(object, "position", vector(light->position));
    glint_json_put(object, "direction", vector(light->direction));
    // In candela; in lux for a directional light.
    glint_json_put(object, "intensity", triple(light->color[0], light->color[1], light->color[2]));
    glint_json_put_real(object, "range", light->range); // null: unlimited
    if (light->kind == GLINT_PUNCTUAL_SPOT) {
        glint_json_put_real(object, "inner_cone_degrees", light->inner_angle * 180 / GLINT_PI);
        glint_json_put_real(object, "outer_cone_degrees", light->outer_angle * 180 / GLINT_PI);
    }
    return object;
}

// The name of a variant. null: the plain materials of the file; "": a variant without a name.
static json_t *variant_name(const glint_scene *scene, int variant)
{
    if (variant < 0) {
        return json_null();
    }
    const char *name = scene->variants[variant];
    return glint_json_text(name != NULL ? name : "");
}

static void put_lists(json_t *object, const glint_scene *scene)
{
    json_t *materials = json_array();
    for (size_t i = 0; i < scene->material_count; i++) {
        (void)json_array_append_new(materials, material_object(&scene->materials[i]));
    }
    glint_json_put(object, "materials", materials);
    json_t *variants = json_array();
    for (size_t i = 0; i < scene->variant_count; i++) {
        (void)json_array_append_new(variants, variant_name(scene, (int)i));
    }
    glint_json_put(object, "variants", variants);
    json_t *instances = json_array();
    for (size_t i = 0; i < scene->instance_count; i++) {
        (void)json_array_append_new(instances, instance_object(&scene->instances[i]));
    }
    glint_json_put(object, "instances", instances);
    json_t *cameras = json_array();
    for (size_t i = 0; i < scene->camera_count; i++) {
        (void)json_array_append_new(cameras, glint_json_camera(&scene->cameras[i]));
    }
    glint_json_put(object, "cameras", cameras);
    json_t *lights = json_array();
    for (size_t i = 0; i < scene->light_count; i++) {
        (void)json_array_append_new(lights, light_object(&scene->lights[i]));
    }
    glint_json_put(object, "lights", lights);
}

// The overrides of the materials, as written on the command line.
static json_t *overrides_list(const glint_material_overrides *overrides)
{
    json_t *list = json_array();
    for (size_t i = 0; overrides != NULL && i < overrides->count; i++) {
        (void)json_array_append_new(list, glint_json_text(overrides->list[i].text));
    }
    return list;
}

static json_t *usages_list(const glint_scene *scene)
{
    json_t *list = json_array();
    for (size_t i = 0; i < scene->usage_count; i++) {
        json_t *object = json_object();
        glint_json_put_text(object, "name", scene->usages[i].name);
        glint_json_put_text(object, "treatment", glint_treatment_name(scene->usages[i].treatment));
        (void)json_array_append_new(list, object);
    }
    return list;
}

json_t *glint_json_scene(const glint_subject *subject, bool everything)
{
    const glint_scene *scene = subject->scene;
    json_t *object = json_object();
    glint_json_put_text(object, "name", scene->path);
    glint_json_put_count(object, "triangle_count", scene->triangle_count);
    glint_json_put_count(object, "instance_count", scene->instance_count);
    glint_json_put_count(object, "material_count", scene->material_count);
    glint_json_put_count(object, "camera_count", scene->camera_count);
    glint_json_put_count(object, "light_count", scene->light_count);
    glint_json_put_count(object, "degenerate_triangles", scene->degenerate_triangles);
    glint_json_put_count(object, "texture_images",
                         scene->textures != NULL ? scene->textures->count : 0);
    glint_json_put_count(object, "texture_bytes", glint_textures_bytes(scene->textures));
    glint_json_put_count(object, "skipped_points", scene->skipped_points);
    glint_json_put_count(object, "skipped_lines", scene->skipped_lines);
    if (scene->triangle_count > 0) {
        glint_json_put(object, "low", vector(scene->low));
        glint_json_put(object, "high", vector(scene->high));
    }
    glint_json_put(object, "variant", variant_name(scene, scene->variant - 1));
    glint_json_put(object, "material_overrides", overrides_list(subject->overrides));
    if (everything) {
        glint_json_put(object, "uses", usages_list(scene));
    }
    if (everything && subject->topology != NULL) {
        glint_json_put(object, "topology", topology_object(subject->topology));
    }
    if (everything && subject->solids != NULL) {
        glint_json_put(object, "contacts", contacts_list(subject->solids));
    }
    if (everything) {
        put_lists(object, scene);
    }
    return object;
}
