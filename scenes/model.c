// Holds a scene before it is written. See model.h.
#include "model.h"

#include <stdlib.h>
#include <string.h>

void model_free(model *scene)
{
    for (int i = 0; i < scene->geometry_count; i++) {
        mesh_free(&scene->geometries[i].mesh);
        flesh *f = &scene->geometries[i].flesh;
        free(f->bulge);
        free(f->normal_bulge);
        free(f->weights);
        free(scene->geometries[i].coat.texcoords);
        free(scene->geometries[i].coat.colors);
    }
    *scene = (model){0};
}

// Returns the index of a new element. If there is no room, sets `overflow` and returns the last
// index.
static int next_index(model *scene, int *count)
{
    if (*count == MODEL_CAPACITY) {
        scene->overflow = true;
        return MODEL_CAPACITY - 1;
    }
    return (*count)++;
}

mesh *model_add_geometry(model *scene, const char *name)
{
    int index = next_index(scene, &scene->geometry_count);
    scene->geometries[index].name = name;
    return &scene->geometries[index].mesh;
}

int model_add_material(model *scene, const material *m)
{
    int index = next_index(scene, &scene->material_count);
    scene->materials[index] = *m;
    return index;
}

const picture *model_add_picture(model *scene, const picture *p)
{
    picture *added = &scene->pictures[next_index(scene, &scene->picture_count)];
    *added = *p;
    return added;
}

static node *add_node(model *scene, const char *name)
{
    node *added = &scene->nodes[next_index(scene, &scene->node_count)];
    *added = (node){.name = name,
                    .geometry = -1,
                    .camera = -1,
                    .light = -1,
                    .rotation = {0, 0, 0, 1},
                    .parent = -1};
    return added;
}

static void move(node *n, glint_vec3 position)
{
    n->translation[0] = position.x;
    n->translation[1] = position.y;
    n->translation[2] = position.z;
}

node *model_add_joint(model *scene, const char *name, int parent, glint_vec3 position)
{
    node *added = add_node(scene, name);
    added->parent = parent;
    move(added, position);
    return added;
}

node *model_add_object(model *scene, const char *name, int material_index, glint_vec3 position)
{
    node *added = add_node(scene, name);
    added->geometry = scene->geometry_count - 1;
    added->material = material_index;
    move(added, position);
    return added;
}

void model_rest(model *scene, node *object, double height)
{
    const mesh *shown = &scene->geometries[object->geometry].mesh;
    double scale = object->scale > 0 ? object->scale : 1;
    object->translation[1] = height - scale * mesh_lowest(shown, object->rotation);
}

motion *model_add_motion(model *scene, const node *moved, const char *path,
                         const char *interpolation)
{
    motion *added = &scene->motions[next_index(scene, &scene->motion_count)];
    *added =
        (motion){.node = (int)(moved - scene->nodes), .path = path, .interpolation = interpolation};
    return added;
}

int motion_components(const motion *m)
{
    return strcmp(m->path, "rotation") == 0 ? 4 : strcmp(m->path, "weights") == 0 ? 1 : 3;
}

void motion_add_key(motion *m, double seconds, const double *value)
{
    const int last = m->key_count < MOTION_KEYS ? m->key_count++ : MOTION_KEYS - 1;
    m->times[last] = seconds;
    memcpy(m->values[last], value, (size_t)motion_components(m) * sizeof *value);
}

static void add_camera(model *scene, const camera *c, glint_vec3 eye, glint_vec3 target)
{
    int index = next_index(scene, &scene->camera_count);
    scene->cameras[index] = *c;
    node *added = add_node(scene, c->name);
    added->camera = index;
    move(added, eye);
    rotation_look_at(eye, target, added->rotation);
}

void model_add_perspective(model *scene, const char *name, double yfov, glint_vec3 eye,
                           glint_vec3 target)
{
    add_camera(scene, &(camera){.name = name, .yfov = yfov}, eye, target);
}

void model_add_orthographic(model *scene, const char *name, double ymag, glint_vec3 eye,
                            glint_vec3 target)
{
    add_camera(scene, &(camera){.name = name, .orthographic = true, .ymag = ymag}, eye, target);
}

node *model_add_light(model *scene, const light *l, glint_vec3 eye, glint_vec3 target)
{
    const int index = next_index(scene, &scene->light_count);
    scene->lights[index] = *l;
    node *added = add_node(scene, l->name);
    added->light = index;
    move(added, eye);
    rotation_look_at(eye, target, added->rotation);
    return added;
}

material material_metal(const char *name, double r, double g, double b)
{
    return (material){.name = name, .base_color = {r, g, b}, .metallic = 1};
}

material material_paint(const char *name, double r, double g, double b, double roughness)
{
    return (material){.name = name, .base_color = {r, g, b}, .roughness = roughness};
}

material material_thin(const char *name, double ior)
{
    return (material){.name = name, .base_color = {1, 1, 1}, .transmission = 1, .ior = ior};
}

material material_glass(const char *name, double ior)
{
    material glass = material_thin(name, ior);
    glass.thickness = 1;
    return glass;
}

size_t model_count_triangles(const model *scene)
{
    size_t count = 0;
    for (int i = 0; i < scene->node_count; i++) {
        int geometry = scene->nodes[i].geometry;
        count += geometry < 0 ? 0 : scene->geometries[geometry].mesh.triangle_count;
    }
    return count;
}

glint_status model_check(const model *scene, glint_error *error)
{
    if (scene->overflow) {
        return glint_fail(error, GLINT_MISMATCH, "%s: more than %d of a kind", scene->name,
                          MODEL_CAPACITY);
    }
    for (int i = 0; i < scene->geometry_count; i++) {
        const mesh *m = &scene->geometries[i].mesh;
        const char *name = scene->geometries[i].name;
        if (m->failed) {
            return glint_fail_memory(error, name);
        }
        size_t boundary = m->open ? 0 : mesh_count_boundary_edges(m);
        if (boundary > 0) {
            return glint_fail(error, GLINT_MISMATCH, "%s: %s: %zu boundary edges", scene->name,
                              name, boundary);
        }
        if (!m->open && !(mesh_signed_volume(m) > 0)) {
            return glint_fail(error, GLINT_MISMATCH, "%s: %s is inside out", scene->name, name);
        }
    }
    return GLINT_OK;
}
