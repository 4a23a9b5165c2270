// Writes a scene as glTF 2.0. See write_gltf.h.
//
// The binary file holds for each geometry: positions, normals if it is not flat, indices (16 bits
// if they suffice, padded to four bytes), flesh and coat. A glTF mesh is a pair of geometry and
// material, so nodes with the same shape share its bytes.
#include "write_gltf.h"
#include "write_material.h"
#include "write_png.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    COMPONENT_UINT8 = 5121,
    COMPONENT_UINT16 = 5123,
    COMPONENT_UINT32 = 5125,
    COMPONENT_FLOAT = 5126
};
enum { TARGET_VERTICES = 34962, TARGET_INDICES = 34963 };

typedef struct gltf_writer {
    const model *scene;
    FILE *binary;
    size_t offset; // bytes written so far
    json_t *views, *accessors, *meshes, *channels, *samplers;
    // Accessors of each geometry; −1: none.
    int position[MODEL_CAPACITY], normal[MODEL_CAPACITY], index[MODEL_CAPACITY];
    // Accessors of its flesh; −1: none.
    struct {
        int bulge, normal_bulge, joints, weights, inverse_bind, skin;
    } flesh[MODEL_CAPACITY];
    int skin_count;
    // Accessors of its coat; −1: none.
    struct {
        int texcoords, colors;
    } coat[MODEL_CAPACITY];
    int mesh_of[MODEL_CAPACITY][MODEL_CAPACITY]; // [geometry][material]: mesh; −1: not yet written
} gltf_writer;

// Nine digits keep every bit of a float, so that an accessor's bounds equal the data.
static json_t *vector(glint_vec3 v)
{
    json_t *array = json_array();
    json_array_append_new(array, gltf_exact(v.x));
    json_array_append_new(array, gltf_exact(v.y));
    json_array_append_new(array, gltf_exact(v.z));
    return array;
}

// ---- Binary ------------------------------------------------------------------------------------

static void put_bytes(gltf_writer *w, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        putc((int)(value >> 8 * i & 0xff), w->binary);
    }
    w->offset += (size_t)bytes;
}

static void put_float(gltf_writer *w, double value)
{
    float rounded = (float)value;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    put_bytes(w, bits, 4);
}

static void put_vectors(gltf_writer *w, const glint_vec3 *vectors, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        put_float(w, vectors[i].x);
        put_float(w, vectors[i].y);
        put_float(w, vectors[i].z);
    }
}

// Describes the bytes from `start` to the end as one accessor and returns its index. `target` 0:
// not a buffer for a graphics card.
static int add_accessor(gltf_writer *w, size_t start, json_t *accessor, int target)
{
    json_t *view = json_object();
    json_object_set_new(view, "buffer", json_integer(0));
    json_object_set_new(view, "byteOffset", json_integer((json_int_t)start));
    json_object_set_new(view, "byteLength", json_integer((json_int_t)(w->offset - start)));
    if (target != 0) {
        json_object_set_new(view, "target", json_integer(target));
    }
    json_object_set_new(accessor, "bufferView",
                        json_integer((json_int_t)json_array_size(w->views)));
    json_array_append_new(w->views, view);
    json_array_append_new(w->accessors, accessor);
    return (int)json_array_size(w->accessors) - 1;
}

static json_t *accessor(int component_type, size_t count, const char *type)
{
    json_t *object = json_object();
    json_object_set_new(object, "componentType", json_integer(component_type));
    json_object_set_new(object, "count", json_integer((json_int_t)count));
    json_object_set_new(object, "type", json_string(type));
    return object;
}

static int write_positions(gltf_writer *w, const mesh *m)
{
    glint_vec3 low = {INFINITY, INFINITY, INFINITY};
    glint_vec3 high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < m->vertex_count; i++) {
        glint_vec3 p = m->positions[i];
        low = (glint_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
        high = (glint_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
    }
    size_t start = w->offset;
    put_vectors(w, m->positions, m->vertex_count);
    json_t *positions = accessor(COMPONENT_FLOAT, m->vertex_count, "VEC3");
    json_object_set_new(positions, "min", vector(low));
    json_object_set_new(positions, "max", vector(high));
    return add_accessor(w, start, positions, TARGET_VERTICES);
}

static int write_vectors(gltf_writer *w, const glint_vec3 *vectors, size_t count)
{
    size_t start = w->offset;
    put_vectors(w, vectors, count);
    return add_accessor(w, start, accessor(COMPONENT_FLOAT, count, "VEC3"), TARGET_VERTICES);
}

static int write_indices(gltf_writer *w, const mesh *m)
{
    size_t start = w->offset;
    bool narrow = m->vertex_count < 65535; // 65535 itself is reserved
    for (size_t i = 0; i < 3 * m->triangle_count; i++) {
        put_bytes(w, m->triangles[i / 3][i % 3], narrow ? 2 : 4);
    }
    int added = add_accessor(
        w, start,
        accessor(narrow ? COMPONENT_UINT16 : COMPONENT_UINT32, 3 * m->triangle_count, "SCALAR"),
        TARGET_INDICES);
    put_bytes(w, 0, (int)(w->offset % 4)); // pad to four bytes; indices have an even length
    return added;
}

static void put_values(gltf_writer *w, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        put_float(w, values[i]);
    }
}

// Accessor types by the number of components.
static const char *const types[] = {NULL, "SCALAR", "VEC2", "VEC3", "VEC4"};

// Writes an attribute with `components` numbers a vertex.
static int write_attribute(gltf_writer *w, const double *values, size_t count, int components)
{
    size_t start = w->offset;
    put_values(w, values, count * (size_t)components);
    return add_accessor(w, start, accessor(COMPONENT_FLOAT, count, types[components]),
                        TARGET_VERTICES);
}

// Writes the joint indices; 0 for joints without weight.
static int write_joints(gltf_writer *w, const flesh *f, size_t count)
{
    size_t start = w->offset;
    for (size_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < FLESH_JOINTS; k++) {
            put_bytes(w, f->weights[i][k] > 0 ? k : 0, 1);
        }
    }
    return add_accessor(w, start, accessor(COMPONENT_UINT8, count, "VEC4"), TARGET_VERTICES);
}

// Writes the inverse bind matrices, column by column. At rest a joint is only translated.
static int write_inverse_bind(gltf_writer *w, const flesh *f)
{
    size_t start = w->offset;
    for (int joint = 0; joint < FLESH_JOINTS; joint++) {
        const glint_vec3 rest = f->rest[joint];
        const double back[4] = {0 - rest.x, 0 - rest.y, 0 - rest.z, 1}; // never −0
        for (int i = 0; i < 16; i++) {
            put_float(w, i >= 12 ? back[i - 12] : i % 5 == 0);
        }
    }
    return add_accessor(w, start, accessor(COMPONENT_FLOAT, FLESH_JOINTS, "MAT4"), 0);
}

static void write_flesh(gltf_writer *w, int geometry)
{
    const flesh *f = &w->scene->geometries[geometry].flesh;
    const size_t count = w->scene->geometries[geometry].mesh.vertex_count;
    const bool bulges = f->bulge != NULL, is_skinned = f->weights != NULL;
    w->flesh[geometry].bulge = bulges ? write_vectors(w, f->bulge, count) : -1;
    w->flesh[geometry].normal_bulge = bulges ? write_vectors(w, f->normal_bulge, count) : -1;
    w->flesh[geometry].joints = is_skinned ? write_joints(w, f, count) : -1;
    w->flesh[geometry].weights =
        is_skinned ? write_attribute(w, f->weights[0], count, FLESH_JOINTS) : -1;
    w->flesh[geometry].inverse_bind = is_skinned ? write_inverse_bind(w, f) : -1;
    w->flesh[geometry].skin = is_skinned ? w->skin_count++ : -1;
}

static void write_coat(gltf_writer *w, int geometry)
{
    const coat *c = &w->scene->geometries[geometry].coat;
    const size_t count = w->scene->geometries[geometry].mesh.vertex_count;
    w->coat[geometry].texcoords =
        c->texcoords != NULL ? write_attribute(w, c->texcoords[0], count, 2) : -1;
    w->coat[geometry].colors = c->colors != NULL ? write_attribute(w, c->colors[0], count, 3) : -1;
}

static void write_geometries(gltf_writer *w)
{
    for (int i = 0; i < w->scene->geometry_count; i++) {
        const mesh *m = &w->scene->geometries[i].mesh;
        w->position[i] = write_positions(w, m);
        w->normal[i] = m->flat ? -1 : write_vectors(w, m->normals, m->vertex_count);
        w->index[i] = write_indices(w, m);
        write_flesh(w, i);
        write_coat(w, i);
    }
}

// ---- Motions -----------------------------------------------------------------------------------

static int write_times(gltf_writer *w, const motion *m)
{
    size_t start = w->offset;
    for (int i = 0; i < m->key_count; i++) {
        put_float(w, m->times[i]);
    }
    json_t *times = accessor(COMPONENT_FLOAT, (size_t)m->key_count, "SCALAR");
    json_object_set_new(times, "min", json_pack("[o]", gltf_exact((double)(float)m->times[0])));
    json_object_set_new(times, "max",
                        json_pack("[o]", gltf_exact((double)(float)m->times[m->key_count - 1])));
    return add_accessor(w, start, times, 0);
}

static int write_values(gltf_writer *w, const motion *m)
{
    const bool is_spline = strcmp(m->interpolation, "CUBICSPLINE") == 0;
    const size_t count = (size_t)motion_components(m);
    size_t start = w->offset;
    for (int i = 0; i < m->key_count; i++) {
        if (is_spline) {
            put_values(w, m->tangents[i], count);
        }
        put_values(w, m->values[i], count);
        if (is_spline) {
            put_values(w, m->tangents[i], count);
        }
    }
    const size_t elements = (size_t)m->key_count * (is_spline ? 3 : 1);
    return add_accessor(w, start, accessor(COMPONENT_FLOAT, elements, types[count]), 0);
}

static void write_motions(gltf_writer *w)
{
    for (int i = 0; i < w->scene->motion_count; i++) {
        const motion *m = &w->scene->motions[i];
        const int input = write_times(w, m), output = write_values(w, m);
        json_array_append_new(w->samplers,
                              json_pack("{s:i, s:s, s:i}", "input", input, "interpolation",
                                        m->interpolation, "output", output));
        json_array_append_new(w->channels, json_pack("{s:i, s:{s:i, s:s}}", "sampler", i, "target",
                                                     "node", m->node, "path", m->path));
    }
}

// ---- Nodes and cameras -------------------------------------------------------------------------

static int find_or_add_mesh(gltf_writer *w, const node *n)
{
    int *found = &w->mesh_of[n->geometry][n->material];
    if (*found >= 0) {
        return *found;
    }
    json_t *attributes = json_pack("{s:i}", "POSITION", w->position[n->geometry]);
    if (w->normal[n->geometry] >= 0) {
        json_object_set_new(attributes, "NORMAL", json_integer(w->normal[n->geometry]));
    }
    if (w->coat[n->geometry].texcoords >= 0) {
        json_object_set_new(attributes, "TEXCOORD_0", json_integer(w->coat[n->geometry].texcoords));
    }
    if (w->coat[n->geometry].colors >= 0) {
        json_object_set_new(attributes, "COLOR_0", json_integer(w->coat[n->geometry].colors));
    }
    if (w->flesh[n->geometry].skin >= 0) {
        json_object_set_new(attributes, "JOINTS_0", json_integer(w->flesh[n->geometry].joints));
        json_object_set_new(attributes, "WEIGHTS_0", json_integer(w->flesh[n->geometry].weights));
    }
    json_t *primitive = json_pack("{s:o, s:i, s:i}", "attributes", attributes, "indices",
                                  w->index[n->geometry], "material", n->material);
    if (w->flesh[n->geometry].bulge >= 0) {
        json_object_set_new(primitive, "targets",
                            json_pack("[{s:i, s:i}]", "POSITION", w->flesh[n->geometry].bulge,
                                      "NORMAL", w->flesh[n->geometry].normal_bulge));
    }
    *found = (int)json_array_size(w->meshes);
    json_array_append_new(w->meshes,
                          json_pack("{s:s, s:[o]}", "name", w->scene->geometries[n->geometry].name,
                                    "primitives", primitive));
    return *found;
}

static json_t *children_of(const model *scene, int parent)
{
    json_t *children = json_array();
    for (int i = 0; i < scene->node_count; i++) {
        if (scene->nodes[i].parent == parent) {
            json_array_append_new(children, json_integer(i));
        }
    }
    return children;
}

static json_t *node_to_json(gltf_writer *w, const node *n)
{
    json_t *object = json_pack("{s:s}", "name", n->name);
    if (n->geometry >= 0) {
        json_object_set_new(object, "mesh", json_integer(find_or_add_mesh(w, n)));
        if (w->flesh[n->geometry].skin >= 0) {
            json_object_set_new(object, "skin", json_integer(w->flesh[n->geometry].skin));
        }
    }
    if (n->camera >= 0) {
        json_object_set_new(object, "camera", json_integer(n->camera));
    }
    if (n->light >= 0) {
        json_object_set_new(object, "extensions",
                            json_pack("{s:{s:i}}", "KHR_lights_punctual", "light", n->light));
    }
    json_object_set_new(object, "translation", gltf_numbers(n->translation, 3));
    if (n->rotation[3] != 1) {
        json_object_set_new(object, "rotation", gltf_numbers(n->rotation, 4));
    }
    if (n->scale > 0 && n->scale != 1) {
        json_object_set_new(object, "scale",
                            gltf_numbers((const double[3]){n->scale, n->scale, n->scale}, 3));
    }
    json_t *children = children_of(w->scene, (int)(n - w->scene->nodes));
    if (json_array_size(children) > 0) {
        json_object_set(object, "children", children);
    }
    json_decref(children);
    return object;
}

static json_t *skins_to_json(const gltf_writer *w)
{
    json_t *skins = json_array();
    for (int i = 0; i < w->scene->geometry_count; i++) {
        if (w->flesh[i].skin >= 0) {
            json_t *joints = json_array();
            for (int k = 0; k < FLESH_JOINTS; k++) {
                json_array_append_new(joints,
                                      json_integer(w->scene->geometries[i].flesh.joints[k]));
            }
            json_array_append_new(skins,
                                  json_pack("{s:o, s:i}", "joints", joints, "inverseBindMatrices",
                                            w->flesh[i].inverse_bind));
        }
    }
    return skins;
}

// glTF requires znear and zfar. They do not clip here.
static json_t *camera_to_json(const camera *c)
{
    if (c->orthographic) {
        return json_pack("{s:s, s:s, s:{s:o, s:o, s:o, s:i}}", "name", c->name, "type",
                         "orthographic", "orthographic", "xmag", gltf_number(c->ymag * 16 / 9),
                         "ymag", gltf_number(c->ymag), "znear", gltf_number(0.01), "zfar", 100);
    }
    return json_pack("{s:s, s:s, s:{s:o, s:o, s:o}}", "name", c->name, "type", "perspective",
                     "perspective", "aspectRatio", gltf_number(16.0 / 9), "yfov",
                     gltf_number(c->yfov * GLINT_PI / 180), "znear", gltf_number(0.01));
}

static json_t *light_to_json(const light *l)
{
    json_t *object = json_pack("{s:s, s:s, s:o, s:o}", "name", l->name, "type", l->type, "color",
                               gltf_numbers(l->color, 3), "intensity", gltf_number(l->intensity));
    if (l->range > 0) {
        json_object_set_new(object, "range", gltf_number(l->range));
    }
    if (l->outer > 0) {
        const double degree = GLINT_PI / 180;
        json_object_set_new(object, "spot",
                            json_pack("{s:o, s:o}", "innerConeAngle",
                                      gltf_number(l->inner * degree), "outerConeAngle",
                                      gltf_number(l->outer * degree)));
    }
    return object;
}

static void add_lights(const model *scene, json_t *file, json_t *used)
{
    json_t *lights = json_array();
    for (int i = 0; i < scene->light_count; i++) {
        json_array_append_new(lights, light_to_json(&scene->lights[i]));
    }
    if (scene->light_count > 0) {
        json_object_set_new(used, "KHR_lights_punctual", json_true());
        json_object_set_new(file, "extensions",
                            json_pack("{s:{s:O}}", "KHR_lights_punctual", "lights", lights));
    }
    json_decref(lights);
}

// ---- The file ----------------------------------------------------------------------------------

static json_t *asset(void)
{
    return json_pack("{s:s, s:s, s:s}", "version", "2.0", "generator", "glint scenes", "copyright",
                     "2026 the glint authors, Apache-2.0");
}

static json_t *scene_to_json(gltf_writer *w)
{
    const model *scene = w->scene;
    json_t *used = json_object();
    json_t *materials = json_array();
    json_t *nodes = json_array();
    json_t *cameras = json_array();
    json_t *roots = children_of(scene, -1);
    for (int i = 0; i < scene->material_count; i++) {
        json_array_append_new(materials, gltf_material(scene, &scene->materials[i], used));
    }
    for (int i = 0; i < scene->node_count; i++) {
        json_array_append_new(nodes, node_to_json(w, &scene->nodes[i]));
    }
    for (int i = 0; i < scene->camera_count; i++) {
        json_array_append_new(cameras, camera_to_json(&scene->cameras[i]));
    }
    json_t *file = json_pack("{s:o}", "asset", asset());
    add_lights(scene, file, used);
    // List the used extensions.
    json_t *extensions = json_array();
    const char *name;
    json_t *value;
    json_object_foreach(used, name, value)
    {
        json_array_append_new(extensions, json_string(name));
    }
    if (json_array_size(extensions) > 0) {
        json_object_set(file, "extensionsUsed", extensions);
    }
    json_decref(extensions);
    json_decref(used);
    json_object_set_new(file, "scene", json_integer(0));
    json_object_set_new(file, "scenes",
                        json_pack("[{s:s, s:o}]", "name", scene->name, "nodes", roots));
    json_object_set_new(file, "nodes", nodes);
    json_object_set_new(file, "cameras", cameras);
    json_object_set_new(file, "materials", materials);
    gltf_add_textures(scene, file);
    json_object_set(file, "meshes", w->meshes);
    json_object_set(file, "accessors", w->accessors);
    json_object_set(file, "bufferViews", w->views);
    if (w->skin_count > 0) {
        json_object_set_new(file, "skins", skins_to_json(w));
    }
    if (scene->motion_count > 0) {
        json_object_set_new(file, "animations",
                            json_pack("[{s:s, s:O, s:O}]", "name", scene->clip, "channels",
                                      w->channels, "samplers", w->samplers));
    }
    return file;
}

static glint_status write_pictures(const model *scene, const char *folder, glint_error *error)
{
    glint_status status = GLINT_OK;
    for (int i = 0; status == GLINT_OK && i < scene->picture_count; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s_%s.png", folder, scene->name, scene->pictures[i].name);
        status = write_png(&scene->pictures[i], path, error);
    }
    return status;
}

static glint_status write_json(gltf_writer *w, const char *path, glint_error *error)
{
    FILE *text = fopen(path, "wb");
    if (text == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: %s", path, strerror(errno));
    }
    json_t *file = scene_to_json(w);
    char binary_name[128];
    snprintf(binary_name, sizeof binary_name, "%s.bin", w->scene->name);
    json_object_set_new(
        file, "buffers",
        json_pack("[{s:s, s:I}]", "uri", binary_name, "byteLength", (json_int_t)w->offset));
    bool failed = json_dumpf(file, text, JSON_INDENT(1) | JSON_REAL_PRECISION(9)) != 0;
    json_decref(file);
    failed = putc('\n', text) == EOF || failed;
    failed = fclose(text) != 0 || failed;
    return failed ? glint_fail(error, GLINT_OUTPUT_FAILED, "%s: cannot be written", path)
                  : GLINT_OK;
}

glint_status write_gltf(const model *scene, const char *folder, glint_error *error)
{
    glint_status status = model_check(scene, error);
    if (status != GLINT_OK) {
        return status;
    }
    gltf_writer w = {.scene = scene};
    memset(w.mesh_of, -1, sizeof w.mesh_of);
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.bin", folder, scene->name);
    w.binary = fopen(path, "wb");
    if (w.binary == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: %s", path, strerror(errno));
    }
    w.views = json_array();
    w.accessors = json_array();
    w.meshes = json_array();
    w.channels = json_array();
    w.samplers = json_array();
    write_geometries(&w);
    write_motions(&w);
    bool failed = ferror(w.binary) != 0;
    failed = fclose(w.binary) != 0 || failed;
    if (failed) {
        status = glint_fail(error, GLINT_OUTPUT_FAILED, "%s: cannot be written", path);
    } else {
        snprintf(path, sizeof path, "%s/%s.gltf", folder, scene->name);
        status = write_json(&w, path, error);
    }
    if (status == GLINT_OK) {
        status = write_pictures(scene, folder, error);
    }
    json_decref(w.views);
    json_decref(w.accessors);
    json_decref(w.meshes);
    json_decref(w.channels);
    json_decref(w.samplers);
    return status;
}
