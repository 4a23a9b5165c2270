// Makes scenes by formula. See shapes.h.
#include "selftest/shapes.h"

#include "base/memory.h"
#include "scene/shape/icosphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_CAPACITY ((size_t)256)

shape shape_begin(void)
{
    return (shape){.scene = {.unit = 1}};
}

// Grows the array to this number of bytes. If memory is short, returns the old array.
static void *grow(shape *s, void *array, size_t bytes)
{
    void *grown = realloc(array, bytes);
    if (grown == NULL) {
        s->failed = true;
        return array;
    }
    return grown;
}

static bool make_room(shape *s)
{
    glint_scene *scene = &s->scene;
    if (!s->failed && scene->triangle_count == s->capacity) {
        s->capacity = s->capacity > 0 ? 2 * s->capacity : FIRST_CAPACITY;
        const size_t bytes = s->capacity * 9 * sizeof(float);
        scene->positions = grow(s, scene->positions, bytes);
        s->exact = grow(s, s->exact, s->capacity * 9 * sizeof(double));
        scene->normals = grow(s, scene->normals, bytes);
        scene->material_of = grow(s, scene->material_of, s->capacity * sizeof(uint32_t));
    }
    return !s->failed;
}

// Chooses the instance of the next triangle: a new one if the material changes.
static bool choose_instance(shape *s, shape_material material)
{
    glint_scene *scene = &s->scene;
    const size_t count = scene->instance_count;
    if (count > 0 && scene->instances[count - 1].material == (uint32_t)material) {
        return true;
    }
    scene->instances = grow(s, scene->instances, (count + 1) * sizeof *scene->instances);
    if (!s->failed) {
        scene->instances[scene->instance_count++] = (glint_instance){
            .first_triangle = scene->triangle_count, .material = (uint32_t)material};
    }
    return !s->failed;
}

void shape_add(shape *s, const double corners[3][3], const double normals[3][3],
               shape_material material)
{
    if (!make_room(s) || !choose_instance(s, material)) {
        return;
    }
    glint_scene *scene = &s->scene;
    for (size_t i = 0; i < 9; i++) {
        s->exact[9 * scene->triangle_count + i] = corners[i / 3][i % 3];
        scene->positions[9 * scene->triangle_count + i] = (float)corners[i / 3][i % 3];
        scene->normals[9 * scene->triangle_count + i] =
            normals != NULL ? (float)normals[i / 3][i % 3] : 0;
    }
    scene->material_of[scene->triangle_count++] = (uint32_t)material;
    scene->instances[scene->instance_count - 1].triangle_count++;
}

void shape_add_quad(shape *s, const double corners[4][3], shape_material material)
{
    static const int order[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int t = 0; t < 2; t++) {
        double triangle[3][3];
        for (int k = 0; k < 3; k++) {
            memcpy(triangle[k], corners[order[t][k]], sizeof triangle[k]);
        }
        shape_add(s, (const double(*)[3])triangle, NULL, material);
    }
}

// The corner of a face at (across, up), each in [0, 1].
static void face_corner(const shape_box *box, int face, const double at[2], double corner[3])
{
    const int axis = face / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
    corner[axis] = face % 2 == 0 ? box->high[axis] : box->low[axis];
    corner[first] = box->low[first] + at[0] * (box->high[first] - box->low[first]);
    corner[second] = box->low[second] + at[1] * (box->high[second] - box->low[second]);
}

void shape_add_box(shape *s, const shape_box *box)
{
    static const int around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const int parts = box->parts;
    for (int part = 0; part < 6 * parts * parts; part++) {
        const int face = part / (parts * parts), i = part / parts % parts, j = part % parts;
        // first × second points along +axis.
        const bool reversed = (face % 2 == 1) != box->inward;
        double corners[4][3];
        for (int k = 0; k < 4; k++) {
            const int *step = around[reversed ? 3 - k : k];
            const double at[2] = {(double)(i + step[0]) / parts, (double)(j + step[1]) / parts};
            face_corner(box, face, at, corners[k]);
        }
        shape_add_quad(s, (const double(*)[3])corners, box->material);
    }
}

typedef struct ball_in_shape {
    shape *s;
    const shape_ball *ball;
} ball_in_shape;

static void add_ball_triangle(void *context, const glint_vec3 corners[3])
{
    const ball_in_shape *of = context;
    const shape_ball *b = of->ball;
    double positions[3][3], normals[3][3];
    for (int k = 0; k < 3; k++) {
        const double u[3] = {corners[k].x, corners[k].y, corners[k].z};
        const double r = b->size * (b->radius != NULL ? b->radius(u) : 1);
        for (int axis = 0; axis < 3; axis++) {
            positions[k][axis] = b->centre[axis] + r * u[axis];
            normals[k][axis] = u[axis];
        }
    }
    shape_add(of->s, (const double(*)[3])positions, b->smooth ? (const double(*)[3])normals : NULL,
              b->material);
}

void shape_add_ball(shape *s, const shape_ball *ball)
{
    ball_in_shape of = {s, ball};
    glint_icosphere(ball->level, add_ball_triangle, &of);
}

static bool add_materials(shape *s)
{
    static const glint_material clear = {.base_color = {1, 1, 1},
                                         .ior = (float)SHAPE_GLASS_IOR,
                                         GLINT_MATERIAL_SPECULAR,
                                         .attenuation_distance = INFINITY,
                                         .attenuation_color = {1, 1, 1},
                                         .mirror = -1};
    glint_scene *scene = &s->scene;
    scene->materials = calloc(MATERIAL_COUNT, sizeof *scene->materials);
    if (scene->materials == NULL) {
        return false;
    }
    scene->material_count = MATERIAL_COUNT;
    for (int i = 0; i < MATERIAL_COUNT; i++) {
        scene->materials[i] = clear;
    }
    scene->materials[MATERIAL_MIRROR].metallic = 1;
    scene->materials[MATERIAL_TINTED].metallic = 1;
    scene->materials[MATERIAL_TINTED].base_color[0] = 0.5F;
    scene->materials[MATERIAL_TINTED].base_color[1] = 0.75F;
    scene->materials[MATERIAL_PAINT].roughness = 1;
    for (int i = MATERIAL_GLASS; i <= MATERIAL_CORE; i++) {
        scene->materials[i].transmission = 1;
        scene->materials[i].thickness = 1;
    }
    scene->materials[MATERIAL_CORE].ior = (float)SHAPE_CORE_IOR;
    return true;
}

glint_status shape_end_with_unit(shape *s, double unit, glint_scene *scene, glint_error *error)
{
    free(s->exact);
    s->scene.unit = unit;
    const bool complete = !s->failed && add_materials(s);
    glint_scene_find_bounds(&s->scene);
    *scene = s->scene;
    if (!complete) {
        glint_scene_free(scene);
        return glint_fail_memory(error, "a scene");
    }
    return GLINT_OK;
}

static glint_status find_parts(const double *exact, glint_scene *scene, glint_error *error)
{
    const size_t corners = 3 * scene->triangle_count;
    const glint_exact_triangles triangles = {exact, corners, NULL, scene->triangle_count};
    glint_parts *parts = &scene->parts;
    TRY(glint_parts_find(&triangles, parts, error));
    if (parts->count == 0) {
        return GLINT_OK;
    }
    parts->positions = glint_allocate_unset(corners, 3 * sizeof *parts->positions);
    if (parts->positions == NULL) {
        return glint_fail_memory(error, "a scene");
    }
    for (size_t i = 0; i < corners; i++) {
        float *told = parts->positions + 3 * i;
        glint_parts_tell(parts, parts->part_of[i / 3], exact + 3 * i, told);
        glint_parts_round(parts, parts->part_of[i / 3], told, scene->positions + 3 * i);
    }
    return GLINT_OK;
}

glint_status shape_end_with_parts(shape *s, double unit, glint_scene *scene, double **exact,
                                  glint_error *error)
{
    double *own = s->exact;
    s->exact = NULL;
    glint_status status = shape_end_with_unit(s, unit, scene, error);
    if (status == GLINT_OK) {
        status = find_parts(own, scene, error);
    }
    if (status != GLINT_OK) {
        glint_scene_free(scene);
    }
    if (exact != NULL) {
        *exact = own;
    } else {
        free(own);
    }
    return status;
}

glint_status shape_end(shape *s, glint_scene *scene, glint_error *error)
{
    return shape_end_with_unit(s, 1, scene, error);
}

glint_status shape_set_lights(const glint_punctual_light *lights, size_t count, glint_scene *scene,
                              glint_error *error)
{
    scene->lights = glint_allocate(count, sizeof *lights);
    if (scene->lights == NULL) {
        return glint_fail_memory(error, "lights");
    }
    memcpy(scene->lights, lights, count * sizeof *lights);
    scene->light_count = count;
    return GLINT_OK;
}

glint_camera shape_camera(const double eye[3], const double target[3], double yfov, double ymag)
{
    const glint_vec3 at = {eye[0], eye[1], eye[2]};
    const glint_vec3 back = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]};
    // A camera that looks straight down or up has −Z above it.
    const bool upright = back.x != 0 || back.z != 0;
    const glint_vec3 up = upright ? (glint_vec3){0, 1, 0} : (glint_vec3){0, 0, -1};
    const glint_mat4 to_world = {
        {{0, up.x, back.x, at.x}, {0, up.y, back.y, at.y}, {0, up.z, back.z, at.z}, {0, 0, 0, 1}}};
    glint_mat4 complete = to_world;
    const glint_vec3 right = glint_vec3_cross(up, back);
    complete.m[0][0] = right.x;
    complete.m[1][0] = right.y;
    complete.m[2][0] = right.z;
    glint_camera camera = {.orthographic = yfov == 0, .yfov = yfov, .ymag = ymag};
    (void)glint_camera_from_matrix(&complete, &camera);
    return camera;
}
