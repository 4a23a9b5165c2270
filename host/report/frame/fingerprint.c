// Computes fingerprints of frames. See fingerprint.h.
#include "report/frame/fingerprint.h"

#include "base/regular_file.h"
#include "device/kernel_sources.h"
#include "render/settings_table.h"

#include <ctype.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

// Bytes at the beginning and the end of a file that may hold its metadata. Headers come first,
// except TIFF's, which may come after the pixels.
#define SEARCHED 65536

// ---- What frames share -------------------------------------------------------------------------

// Adds numbers as texts, so that neither padding nor byte order matters.
static void add_text(XXH3_state_t *state, const char *text)
{
    XXH3_128bits_update(state, text, strlen(text) + 1);
}

static void add_numbers(XXH3_state_t *state, const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char text[32];
        snprintf(text, sizeof text, "%a", numbers[i]);
        add_text(state, text);
    }
}

static void add_vector(XXH3_state_t *state, glint_vec3 v)
{
    const double numbers[] = {v.x, v.y, v.z};
    add_numbers(state, numbers, 3);
}

// Adds an array of floats or integers as it lies in memory, after its length.
static void add_array(XXH3_state_t *state, const void *array, size_t size, size_t count)
{
    const double bytes = array != NULL ? (double)size * (double)count : -1;
    add_numbers(state, &bytes, 1);
    if (array != NULL) {
        XXH3_128bits_update(state, array, size * count);
    }
}

static void add_texture_use(XXH3_state_t *state, const glint_texture_use *use)
{
    const double numbers[] = {
        (double)use->image,  (double)use->texcoord,          (double)use->wrap_s,
        (double)use->wrap_t, (double)use->magnified_nearest, (double)use->minified_nearest,
        (double)use->mips};
    add_numbers(state, numbers, sizeof numbers / sizeof *numbers);
    add_array(state, use->transform, sizeof *use->transform, 6);
}

static void add_textures(XXH3_state_t *state, const glint_textures *textures)
{
    for (size_t i = 0; textures != NULL && i < textures->count; i++) {
        const double size[] = {textures->textures[i].width, textures->textures[i].height};
        add_numbers(state, size, 2);
    }
    add_array(state, textures != NULL ? textures->texels : NULL, sizeof *textures->texels,
              textures != NULL ? textures->texel_count : 0);
}

static void add_material(XXH3_state_t *state, const glint_material *m)
{
    for (size_t i = 0; i < glint_material_value_count; i++) {
        const glint_material_value *value = &glint_material_values[i];
        add_array(state, (const char *)m + value->offset, sizeof(float), (size_t)value->count);
    }
    const double choices[] = {m->unlit ? 1 : 0, (double)m->alpha_mode};
    add_numbers(state, choices, sizeof choices / sizeof *choices);
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        add_texture_use(state, &m->textures[slot]);
    }
}

// Adds what layers and manifests show of an instance: numbers and names.
static void add_instance(XXH3_state_t *state, const glint_scene *scene,
                         const glint_instance *instance)
{
    const glint_material *material = &scene->materials[instance->material];
    const double numbers[] = {instance->node_index, material->index};
    add_numbers(state, numbers, 2);
    add_text(state, instance->node != NULL ? instance->node : "");
    add_text(state, material->name != NULL ? material->name : "");
}

static void add_light(XXH3_state_t *state, const glint_punctual_light *light)
{
    const double numbers[] = {light->kind,  light->color[0],    light->color[1],   light->color[2],
                              light->range, light->inner_angle, light->outer_angle};
    add_numbers(state, numbers, sizeof numbers / sizeof *numbers);
    add_vector(state, light->position);
    add_vector(state, light->direction);
}

static void add_scene(XXH3_state_t *state, const glint_scene *scene)
{
    add_vector(state, scene->origin);
    add_numbers(state, &scene->unit, 1);
    const double moves = scene->moves ? 1 : 0; // the plan depends on it
    add_numbers(state, &moves, 1);
    const size_t vertices = glint_scene_vertex_count(scene);
    add_array(state, scene->indices, 3 * sizeof *scene->indices, scene->triangle_count);
    add_array(state, scene->positions, 3 * sizeof *scene->positions, vertices);
    if (scene->parts.count > 0) {
        add_array(state, scene->parts.anchors, sizeof *scene->parts.anchors, scene->parts.count);
        add_array(state, scene->parts.part_of, sizeof *scene->parts.part_of, scene->triangle_count);
        add_array(state, scene->parts.positions, 3 * sizeof *scene->parts.positions, vertices);
    }
    add_array(state, scene->normals, 3 * sizeof *scene->normals, vertices);
    add_array(state, scene->material_of, sizeof *scene->material_of, scene->triangle_count);
    add_array(state, scene->attributes,
              glint_attributes_stride(&scene->attribute_set) * sizeof *scene->attributes, vertices);
    add_textures(state, scene->textures);
    for (size_t i = 0; i < scene->material_count; i++) {
        add_material(state, &scene->materials[i]);
    }
    for (size_t i = 0; i < scene->instance_count; i++) {
        add_instance(state, scene, &scene->instances[i]);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        add_light(state, &scene->lights[i]);
    }
}

static void add_settings(XXH3_state_t *state, const glint_settings *settings)
{
    double numbers[GLINT_FINGERPRINT_PLACES] = {0};
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        for (size_t k = 0; setting->fingerprint > 0 && k < glint_setting_number_count(setting);
             k++) {
            numbers[(size_t)setting->fingerprint - 1 + k] =
                glint_setting_number(setting, settings, k);
        }
    }
    add_numbers(state, numbers, GLINT_FINGERPRINT_PLACES);
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if (setting->fingerprint == GLINT_FINGERPRINT_BY_NAME &&
            glint_setting_differs(setting, settings, &glint_settings_default)) {
            char text[GLINT_SETTING_TEXT];
            glint_setting_print(setting, settings, text);
            add_text(state, setting->option.name);
            add_text(state, text);
        }
    }
}

// Adds --max-error, which chooses settings for each frame.
static void add_max_error(XXH3_state_t *state, double max_error)
{
    if (max_error > 0) {
        add_text(state, "at most");
        add_numbers(state, &max_error, 1);
    }
}

// Adds the kind of texels. Widths and tiles do not change any bits, so they are left out. Without a
// plan, the kind depends on the environment: adds the setting.
static void add_texels(XXH3_state_t *state, const glint_subject *subject)
{
    const double kind = subject->plan != NULL ? (subject->plan->half_texels ? 1 : 0)
                                              : 2 + (double)subject->settings->texels;
    add_numbers(state, &kind, 1);
}

static void add_encoding(XXH3_state_t *state, const char *path, const glint_write_options *options)
{
    const char *dot = strrchr(path, '.');
    add_text(state, dot != NULL ? dot : "");
    add_text(state, options->compression != NULL ? options->compression : "");
    const double numbers[] = {options->exr_float ? 1 : 0, (double)options->exposure};
    add_numbers(state, numbers, 2);
    // By name, so that fingerprints from before --tone stay valid
    if (options->tone != GLINT_TONE_NONE) {
        add_text(state, "tone");
        add_text(state, glint_tone_names[options->tone]);
    }
}

static glint_status begin(XXH3_state_t **state, glint_error *error)
{
    *state = XXH3_createState();
    if (*state == NULL) {
        return glint_fail_memory(error, "the fingerprint");
    }
    XXH3_128bits_reset(*state);
    return GLINT_OK;
}

static glint_fingerprint finish(XXH3_state_t *state)
{
    const XXH128_hash_t hash = XXH3_128bits_digest(state);
    XXH3_freeState(state);
    return (glint_fingerprint){hash.high64, hash.low64};
}

glint_status glint_fingerprint_run(const glint_subject *subject, const char *path,
                                   const glint_write_options *options,
                                   glint_fingerprint *fingerprint, glint_error *error)
{
    XXH3_state_t *state;
    TRY(begin(&state, error));
    add_text(state, "glint " GLINT_VERSION);
    add_text(state, glint_kernel_source);
    add_settings(state, subject->settings);
    add_max_error(state, subject->max_error);
    add_texels(state, subject);
    add_encoding(state, path, options);
    *fingerprint = finish(state);
    return GLINT_OK;
}

glint_status glint_fingerprint_environment(const glint_environment *environment,
                                           glint_fingerprint *fingerprint, glint_error *error)
{
    XXH3_state_t *state;
    TRY(begin(&state, error));
    const glint_cube *radiance = &environment->radiance;
    add_array(state, radiance->texels, sizeof *radiance->texels, glint_cube_size(radiance));
    const glint_proxy *p = &environment->proxy;
    const double proxy[] = {p->kind,          p->center.x,     p->center.y, p->center.z,
                            p->middle.x,      p->middle.y,     p->middle.z, p->half_extent.x,
                            p->half_extent.y, p->half_extent.z};
    if (p->kind != GLINT_PROXY_NONE) {
        add_numbers(state, proxy, sizeof proxy / sizeof *proxy);
    }
    *fingerprint = finish(state);
    return GLINT_OK;
}

glint_status glint_fingerprint_file(const char *path, glint_fingerprint *fingerprint,
                                    glint_error *error)
{
    XXH3_state_t *state;
    TRY(begin(&state, error));
    FILE *file;
    glint_status status = glint_regular_file_open(path, &file, NULL, error);
    char bytes[16384];
    size_t size = 0;
    while (file != NULL && (size = fread(bytes, 1, sizeof bytes, file)) > 0) {
        XXH3_128bits_update(state, bytes, size);
    }
    if (file != NULL && ferror(file) != 0) {
        status = glint_fail(error, GLINT_BAD_INPUT, "%s: %s", path, strerror(errno));
    }
    if (file != NULL) {
        fclose(file);
    }
    *fingerprint = finish(state);
    return status;
}

glint_status glint_fingerprint_scene(const glint_scene *scene, glint_fingerprint *fingerprint,
                                     glint_error *error)
{
    XXH3_state_t *state;
    TRY(begin(&state, error));
    add_scene(state, scene);
    *fingerprint = finish(state);
    return GLINT_OK;
}

// ---- A frame -----------------------------------------------------------------------------------

static void print(glint_fingerprint fingerprint, char text[GLINT_FINGERPRINT_TEXT])
{
    snprintf(text, GLINT_FINGERPRINT_TEXT, "%016llx%016llx", (unsigned long long)fingerprint.high,
             (unsigned long long)fingerprint.low);
}

glint_fingerprint glint_fingerprint_join(const glint_fingerprint *parts, size_t count,
                                         const char *text)
{
    enum { PARTS = 8 };
    char all[PARTS * GLINT_FINGERPRINT_TEXT + 512];
    size_t length = 0;
    for (size_t i = 0; i < count && i < PARTS; i++) {
        print(parts[i], all + length);
        length += GLINT_FINGERPRINT_TEXT - 1;
    }
    length += (size_t)snprintf(all + length, sizeof all - length, " %s", text);
    const XXH128_hash_t hash = XXH3_128bits(all, length < sizeof all ? length : sizeof all - 1);
    return (glint_fingerprint){hash.high64, hash.low64};
}

void glint_fingerprint_frame(const glint_fingerprint *parts, size_t count,
                             const glint_camera *camera, char text[GLINT_FINGERPRINT_TEXT])
{
    const glint_vec3 vectors[] = {camera->eye, camera->right, camera->up, camera->back};
    char all[512];
    size_t length = (size_t)snprintf(all, sizeof all, "%d %a", camera->orthographic,
                                     camera->orthographic ? camera->ymag : camera->yfov);
    for (int i = 0; i < 4; i++) {
        length += (size_t)snprintf(all + length, sizeof all - length, " %a %a %a", vectors[i].x,
                                   vectors[i].y, vectors[i].z);
    }
    print(glint_fingerprint_join(parts, count, all), text);
}

// ---- In files ----------------------------------------------------------------------------------

// Finds the fingerprint's digits after its name. Each format may put a few bytes of its own between
// them.
static bool find_in(const char *bytes, size_t size, char text[GLINT_FINGERPRINT_TEXT])
{
    enum { NAME = sizeof GLINT_FINGERPRINT_NAME - 1, BETWEEN = 16, DIGITS = 32 };
    const char *name = memmem(bytes, size, GLINT_FINGERPRINT_NAME, NAME);
    if (name == NULL) {
        return false;
    }
    const char *end = bytes + size;
    for (const char *at = name + NAME; at < name + NAME + BETWEEN && at + DIGITS <= end; at++) {
        int digits = 0;
        while (digits < DIGITS && isxdigit((unsigned char)at[digits])) {
            digits++;
        }
        if (digits == DIGITS) {
            memcpy(text, at, DIGITS);
            text[DIGITS] = '\0';
            return true;
        }
    }
    return false;
}

void glint_fingerprint_find(const char *path, char text[GLINT_FINGERPRINT_TEXT])
{
    text[0] = '\0';
    FILE *file;
    (void)glint_regular_file_open(path, &file, NULL, NULL);
    char *bytes = malloc(SEARCHED);
    if (file != NULL && bytes != NULL) {
        const size_t first = fread(bytes, 1, SEARCHED, file);
        if (!find_in(bytes, first, text) && first == SEARCHED &&
            fseek(file, -SEARCHED, SEEK_END) == 0) {
            find_in(bytes, fread(bytes, 1, SEARCHED, file), text);
        }
    }
    free(bytes);
    if (file != NULL) {
        fclose(file);
    }
}
