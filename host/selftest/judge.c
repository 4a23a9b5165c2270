// Gives scenes to the oracle. See judge.h.
#include "selftest/judge.h"

#include "render/wavelengths.h"

#include <stdlib.h>
#include <string.h>

// ---- Scenes -------------------------------------------------------------------------------------

static void copy_triangle(const glint_scene *scene, size_t i, oracle_triangle *t)
{
    const double origin[3] = {scene->origin.x, scene->origin.y, scene->origin.z};
    for (size_t v = 0; v < 3; v++) {
        const glint_vec3 corner = glint_scene_corner(scene, i, v);
        const double at[3] = {corner.x, corner.y, corner.z};
        for (size_t k = 0; k < 3; k++) {
            t->position[v][k] = origin[k] + scene->unit * at[k];
            t->normal[v][k] =
                scene->normals != NULL ? (double)glint_scene_normal(scene, i, v)[k] : 0;
        }
    }
    t->material = (int)scene->material_of[i];
}

static const float *copy_numbers(const float *from, size_t count, double *to)
{
    for (size_t i = 0; i < count; i++) {
        to[i] = (double)from[i];
    }
    return from + count;
}

static void copy_corner(const glint_attributes *set, const float *from, oracle_corner *corner)
{
    *corner = (oracle_corner){.color = {1, 1, 1, 1}};
    from = copy_numbers(from, set->texcoords ? 2 : 0, corner->texcoord[0]);
    from = copy_numbers(from, set->second_texcoords ? 2 : 0, corner->texcoord[1]);
    from = copy_numbers(from, set->colors ? 4 : 0, corner->color);
    copy_numbers(from, set->tangents ? 4 : 0, corner->tangent);
}

static bool copy_image(const glint_textures *textures, size_t number, oracle_image *image)
{
    const glint_texture *t = &textures->textures[number];
    if (!oracle_image_create(t->width, t->height, image)) {
        return false;
    }
    for (int level = 0; level < t->levels; level++) { // a level that glint could not read stays 0
        const int width = oracle_image_side(t->width, level);
        const int height = oracle_image_side(t->height, level);
        for (int i = 0; i < width * height; i++) {
            const size_t texel = t->first[level] +
                                 (size_t)(i / width) * glint_texture_pitch(width) +
                                 (size_t)(i % width);
            for (int c = 0; c < 4; c++) {
                image->texels[level][i][c] = textures->texels[texel][c] / 65535.0;
            }
        }
    }
    return true;
}

static oracle_texture texture_of(const glint_texture_use *use, const oracle_image *images)
{
    static const oracle_wrap wraps[] = {[GLINT_WRAP_REPEAT] = ORACLE_REPEAT,
                                        [GLINT_WRAP_CLAMP] = ORACLE_CLAMP,
                                        [GLINT_WRAP_MIRROR] = ORACLE_MIRROR};
    static const oracle_mips mips[] = {[GLINT_MIP_LINEAR] = ORACLE_MIPS_LINEAR,
                                       [GLINT_MIP_NEAREST] = ORACLE_MIPS_NEAREST,
                                       [GLINT_MIP_NONE] = ORACLE_MIPS_NONE};
    oracle_texture t = {.image = use->image != 0 ? &images[use->image - 1] : NULL,
                        .set = use->texcoord,
                        .wrap = {wraps[use->wrap_s], wraps[use->wrap_t]},
                        .magnified_nearest = use->magnified_nearest,
                        .minified_nearest = use->minified_nearest,
                        .mips = mips[use->mips]};
    bool moves = false;
    for (int i = 0; i < 6; i++) {
        t.transform[i / 3][i % 3] = (double)use->transform[i];
        moves = moves || use->transform[i] != 0;
    }
    if (!moves) {
        t.transform[0][0] = t.transform[1][1] = 1;
    }
    return t;
}

// Copies the layers above a surface and the light within it.
static void copy_layers(const glint_material *m, oracle_material *o)
{
    o->clearcoat = (double)m->clearcoat;
    o->clearcoat_roughness = (double)m->clearcoat_roughness;
    o->clearcoat_normal_scale = (double)m->clearcoat_normal_scale;
    o->anisotropy = (double)m->anisotropy;
    o->anisotropy_rotation = (double)m->anisotropy_rotation;
    o->diffuse_transmission = (double)m->diffuse_transmission;
    copy_numbers(m->diffuse_transmission_color, 3, o->diffuse_transmission_color);
    copy_numbers(m->sheen_color, 3, o->sheen_color);
    o->sheen_roughness = (double)m->sheen_roughness;
    o->film = (double)m->iridescence;
    o->film_ior = (double)m->iridescence_ior;
    copy_numbers(m->iridescence_thickness, 2, o->film_thickness);
    o->thickness = (double)m->thickness;
    o->attenuation_distance = (double)m->attenuation_distance;
    copy_numbers(m->attenuation_color, 3, o->attenuation);
    o->dispersion = (double)m->dispersion;
}

static oracle_material material_of(const glint_material *m, const oracle_image *images)
{
    static const glint_texture_slot slots[] = {
        [ORACLE_BASE] = GLINT_TEXTURE_BASE_COLOR,
        [ORACLE_METALLIC] = GLINT_TEXTURE_METALLIC_ROUGHNESS,
        [ORACLE_NORMAL] = GLINT_TEXTURE_NORMAL,
        [ORACLE_OCCLUSION] = GLINT_TEXTURE_OCCLUSION,
        [ORACLE_EMISSION] = GLINT_TEXTURE_EMISSION,
        [ORACLE_TRANSMISSION] = GLINT_TEXTURE_TRANSMISSION,
        [ORACLE_SPECULAR] = GLINT_TEXTURE_SPECULAR,
        [ORACLE_SPECULAR_COLOR] = GLINT_TEXTURE_SPECULAR_COLOR,
        [ORACLE_CLEARCOAT] = GLINT_TEXTURE_CLEARCOAT,
        [ORACLE_CLEARCOAT_ROUGHNESS] = GLINT_TEXTURE_CLEARCOAT_ROUGHNESS,
        [ORACLE_CLEARCOAT_NORMAL] = GLINT_TEXTURE_CLEARCOAT_NORMAL,
        [ORACLE_ANISOTROPY] = GLINT_TEXTURE_ANISOTROPY,
        [ORACLE_SHEEN_COLOR] = GLINT_TEXTURE_SHEEN_COLOR,
        [ORACLE_SHEEN_ROUGHNESS] = GLINT_TEXTURE_SHEEN_ROUGHNESS,
        [ORACLE_DIFFUSE_TRANSMISSION] = GLINT_TEXTURE_DIFFUSE_TRANSMISSION,
        [ORACLE_DIFFUSE_TRANSMISSION_COLOR] = GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR,
        [ORACLE_IRIDESCENCE] = GLINT_TEXTURE_IRIDESCENCE,
        [ORACLE_IRIDESCENCE_THICKNESS] = GLINT_TEXTURE_IRIDESCENCE_THICKNESS,
    };
    static const oracle_alpha modes[] = {[GLINT_ALPHA_OPAQUE] = ORACLE_OPAQUE,
                                         [GLINT_ALPHA_MASK] = ORACLE_MASK,
                                         [GLINT_ALPHA_BLEND] = ORACLE_BLEND};
    // Copy the numbers.
    oracle_material o = {
        .metallic = (double)m->metallic,
        .roughness = (double)m->roughness,
        .transmission = (double)m->transmission,
        .ior = (double)m->ior,
        .specular = (double)m->specular,
        .unlit = m->unlit,
        .mirror = (double)m->mirror,
        .priority = (double)m->priority,
        .alpha_mode = modes[m->alpha_mode],
        .alpha = (double)m->alpha,
        .alpha_cutoff = (double)m->alpha_cutoff,
        .normal_scale = (double)m->normal_scale,
        .occlusion_strength = (double)m->occlusion_strength,
    };
    // Copy colours, layers and textures.
    copy_numbers(m->base_color, 3, o.base);
    copy_numbers(m->emission, 3, o.emission);
    copy_numbers(m->specular_color, 3, o.specular_color);
    copy_layers(m, &o);
    for (int role = 0; role < ORACLE_ROLES; role++) {
        o.texture[role] = texture_of(&m->textures[slots[role]], images);
    }
    return o;
}

// Places a light as the kernels have it: rounded as vertices are.
static oracle_punctual light_of(const glint_scene *scene, const glint_punctual_light *light)
{
    const double unit = scene->unit;
    const double position[3] = {light->position.x, light->position.y, light->position.z};
    const double origin[3] = {scene->origin.x, scene->origin.y, scene->origin.z};
    oracle_punctual o = {
        .directional = light->kind == GLINT_PUNCTUAL_DIRECTIONAL,
        .spot = light->kind == GLINT_PUNCTUAL_SPOT,
        .direction = {light->direction.x, light->direction.y, light->direction.z},
        .range = light->range,
        .inner = light->inner_angle,
        .outer = light->outer_angle,
    };
    for (int k = 0; k < 3; k++) {
        o.position[k] = origin[k] + unit * (double)(float)((position[k] - origin[k]) / unit);
        o.color[k] = light->color[k];
    }
    return o;
}

static bool make_room(const glint_scene *scene, judge *j)
{
    j->image_count = scene->textures != NULL ? scene->textures->count : 0;
    j->triangles = calloc(scene->triangle_count + 1, sizeof *j->triangles);
    j->materials = calloc(scene->material_count + 1, sizeof *j->materials);
    j->images = calloc(j->image_count + 1, sizeof *j->images);
    j->lights = calloc(scene->light_count + 1, sizeof *j->lights);
    if (scene->attributes != NULL) {
        j->corners = calloc(scene->triangle_count + 1, sizeof *j->corners);
    }
    bool complete = j->triangles != NULL && j->materials != NULL && j->images != NULL &&
                    j->lights != NULL && (j->corners != NULL || scene->attributes == NULL);
    for (size_t i = 0; complete && i < j->image_count; i++) {
        complete = copy_image(scene->textures, i, &j->images[i]);
    }
    return complete;
}

static void copy_scene(const glint_scene *scene, judge *j)
{
    const size_t stride = glint_attributes_stride(&scene->attribute_set);
    for (size_t i = 0; i < scene->triangle_count; i++) {
        copy_triangle(scene, i, &j->triangles[i]);
        for (size_t k = 0; scene->attributes != NULL && k < 3; k++) {
            copy_corner(&scene->attribute_set,
                        scene->attributes + stride * glint_scene_vertex(scene, i, k),
                        &j->corners[i][k]);
        }
    }
    for (size_t i = 0; i < scene->material_count; i++) {
        j->materials[i] = material_of(&scene->materials[i], j->images);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        j->lights[i] = light_of(scene, &scene->lights[i]);
    }
}

glint_status judge_begin(const glint_scene *scene, judge *j, glint_error *error)
{
    *j = (judge){0};
    if (!make_room(scene, j)) {
        judge_end(j);
        return glint_fail_memory(error, "a self-test");
    }
    copy_scene(scene, j);
    j->tree = oracle_tree_create(j->triangles, (int)scene->triangle_count);
    if (j->tree == NULL) {
        judge_end(j);
        return glint_fail_memory(error, "a self-test");
    }
    j->scene = (oracle_scene){.triangles = j->triangles,
                              .triangle_count = (int)scene->triangle_count,
                              .corners = (const oracle_corner(*)[3])j->corners,
                              .materials = j->materials,
                              .lights = j->lights,
                              .light_count = (int)scene->light_count,
                              .tree = j->tree};
    return GLINT_OK;
}

glint_status judge_move(judge *j, const glint_scene *scene, const double *exact, glint_error *error)
{
    const double origin[3] = {scene->origin.x, scene->origin.y, scene->origin.z};
    for (size_t v = 0; v < 9 * scene->triangle_count; v++) {
        j->triangles[v / 9].position[v / 3 % 3][v % 3] = origin[v % 3] + scene->unit * exact[v];
    }
    oracle_tree_free(j->tree);
    j->scene.tree = j->tree = oracle_tree_create(j->triangles, j->scene.triangle_count);
    return j->tree != NULL ? GLINT_OK : glint_fail_memory(error, "a self-test");
}

void judge_end(judge *j)
{
    for (size_t i = 0; j->images != NULL && i < j->image_count; i++) {
        oracle_image_free(&j->images[i]);
    }
    oracle_tree_free(j->tree);
    free(j->triangles);
    free(j->corners);
    free(j->materials);
    free(j->images);
    free(j->lights);
    *j = (judge){0};
}

// ---- Light --------------------------------------------------------------------------------------

static void linear_light(const void *context, const double direction[3], double rgb[3])
{
    (void)context;
    for (int k = 0; k < 3; k++) {
        rgb[k] = 0.5 + 0.5 * direction[k];
    }
}

// The cosine-weighted mean of E about n: the mean of d is ⅔ n.
static void linear_irradiance(const void *context, const double normal[3], double rgb[3])
{
    (void)context;
    for (int k = 0; k < 3; k++) {
        rgb[k] = 0.5 + normal[k] / 3;
    }
}

void judge_use_linear_light(judge *j)
{
    j->scene.radiance = linear_light;
    j->scene.irradiance = linear_irradiance;
}

// ---- Rays ---------------------------------------------------------------------------------------

oracle_hit judge_ray(const oracle_scene *scene, const glint_probe_ray *ray)
{
    oracle_ray r;
    memcpy(r.origin, ray->origin, sizeof r.origin);
    memcpy(r.direction, ray->direction, sizeof r.direction);
    return oracle_closest_hit(scene, &r, -1);
}

int judge_pixel(const oracle_scene *scene, const oracle_view *view, int column, int row)
{
    const double at[2] = {column + 0.5, row + 0.5};
    const oracle_ray ray = oracle_primary_ray(view, at);
    return oracle_closest_hit(scene, &ray, -1).triangle;
}

static void copy_vector(glint_vec3 from, double to[3])
{
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

// With twice as many strata, the oracle's view of the studio changes by less than 0.001.
#define LOBE_STRATA 96

oracle_view judge_view(const glint_camera *camera, const glint_settings *settings)
{
    oracle_view view = {.yfov = camera->orthographic ? 0 : camera->yfov,
                        .ymag = camera->ymag,
                        .width = settings->width,
                        .height = settings->height,
                        .samples = settings->samples_per_axis,
                        .anisotropy = settings->anisotropy,
                        .roughness = glint_settings_heed_roughness(settings) ? LOBE_STRATA : 0,
                        .all_scattering = settings->scattering == GLINT_SCATTERING_MULTIPLE,
                        .depth = 1};
    if (glint_settings_heed_dispersion(settings)) {
        view.wavelengths = settings->wavelengths;
        glint_wavelength chosen[GLINT_WAVELENGTHS_MAX];
        glint_wavelengths_choose(settings->wavelengths, chosen);
        for (int i = 0; i < settings->wavelengths; i++) {
            view.wavelength[i].nm = chosen[i].nm;
            memcpy(view.wavelength[i].share, chosen[i].share, sizeof chosen[i].share);
        }
    }
    copy_vector(camera->eye, view.eye);
    copy_vector(camera->right, view.right);
    copy_vector(camera->up, view.up);
    copy_vector(camera->back, view.back);
    return view;
}
