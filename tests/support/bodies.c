// Makes scenes of a few boxes. See bodies.h.
#include "support/bodies.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct scene_builder {
    glint_scene scene;
    double turn; // rotation of all bodies, radians
} scene_builder;

static void put(const scene_builder *b, const double at[3], float *p)
{
    const double c = cos(b->turn), s = sin(b->turn);
    const double x = c * at[0] + s * at[2], z = c * at[2] - s * at[0];
    p[0] = (float)x;
    p[1] = (float)(c * at[1] - s * z);
    p[2] = (float)(c * z + s * at[1]);
}

static void add_triangle(scene_builder *b, const double corners[3][3], const body *of)
{
    glint_scene *scene = &b->scene;
    const size_t n = scene->triangle_count++;
    scene->positions = realloc(scene->positions, (n + 1) * 9 * sizeof(float));
    scene->material_of = realloc(scene->material_of, (n + 1) * sizeof(uint32_t));
    assert_non_null(scene->positions);
    assert_non_null(scene->material_of);
    for (int i = 0; i < 3; i++) {
        put(b, corners[i], scene->positions + 9 * n + 3 * i);
    }
    scene->material_of[n] = (uint32_t)of->stuff;
    scene->instances[scene->instance_count - 1].triangle_count++;
}

// Corner in column i and row j of a subdivided face. The face is at right angles to `axis`, `up` or
// down.
static void corner_of(const body *of, int face, int i, int j, double at[3])
{
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int parts = of->parts > 0 ? of->parts : 1;
    at[axis] = face % 2 ? of->high[axis] : of->low[axis];
    at[u] = of->low[u] + (of->high[u] - of->low[u]) * i / parts;
    at[v] = of->low[v] + (of->high[v] - of->low[v]) * j / parts;
}

static void add_box(scene_builder *b, const body *of)
{
    const int parts = of->parts > 0 ? of->parts : 1;
    for (int face = 0; face < 6; face++) {
        for (int k = 0; k < parts * parts; k++) {
            const int i = k % parts, j = k / parts;
            double quad[4][3];
            corner_of(of, face, i, j, quad[0]);
            corner_of(of, face, i + 1, j, quad[1]);
            corner_of(of, face, i + 1, j + 1, quad[2]);
            corner_of(of, face, i, j + 1, quad[3]);
            const bool turned = (face % 2 == 0) != of->inward;
            for (int half = 0; half < 2; half++) {
                double t[3][3];
                memcpy(t[0], quad[0], sizeof t[0]);
                memcpy(t[1], quad[turned ? half + 2 : half + 1], sizeof t[1]);
                memcpy(t[2], quad[turned ? half + 1 : half + 2], sizeof t[2]);
                add_triangle(b, t, of);
            }
        }
    }
}

static void add_stuffs(const bodies *all, glint_scene *scene)
{
    scene->materials = calloc(STUFFS, sizeof *scene->materials);
    assert_non_null(scene->materials);
    scene->material_count = STUFFS;
    for (int i = 0; i < STUFFS; i++) {
        scene->materials[i] =
            (glint_material){GLINT_MATERIAL_CLEAR, .mirror = -1, .transmission = 1,
                             .thickness = 1,       .alpha = 1,   .base_color = {1, 1, 1}};
        scene->materials[i].priority = all->priorities[i];
    }
    scene->materials[WATER].ior = 1.33F;
    scene->materials[WATER].attenuation_distance = 0.5F;
    scene->materials[WATER].attenuation_color[0] = 0.5F;
    scene->materials[WATER].dispersion = all->dispersion;
    scene->materials[ICE].ior = 1.2F;
    scene->materials[PAINT].transmission = 0;
    scene->materials[PAINT].mirror = 0;
    scene->materials[METAL].metallic = 1;
    scene->materials[METAL].base_color[2] = 0.5F;
}

static void add_lamp(glint_scene *scene)
{
    static const glint_punctual_light lamp = {.kind = GLINT_PUNCTUAL_POINT,
                                              .position = {0.3, 0.9, 0.4},
                                              .color = {1, 2, 3},
                                              .range = INFINITY};
    scene->lights = malloc(sizeof lamp);
    assert_non_null(scene->lights);
    scene->lights[0] = lamp;
    scene->light_count = 1;
}

glint_scene bodies_scene(const bodies *all, double turn, bool backwards)
{
    int count = 0;
    while (count < BODIES && all->of[count].high[0] != all->of[count].low[0]) {
        count++;
    }
    scene_builder b = {.turn = turn};
    glint_scene *scene = &b.scene;
    scene->unit = 1;
    scene->instances = calloc((size_t)count + 1, sizeof *scene->instances);
    assert_non_null(scene->instances);
    add_stuffs(all, scene);
    int mesh = 0;
    for (int i = 0; i < count; i++) {
        const body *of = &all->of[backwards ? count - 1 - i : i];
        if (of->mesh == 0 || of->mesh != mesh) {
            scene->instances[scene->instance_count++] = (glint_instance){
                .first_triangle = scene->triangle_count, .material = (uint32_t)of->stuff};
        }
        mesh = of->mesh;
        add_box(&b, of);
    }
    if (all->lamp) {
        add_lamp(scene);
    }
    glint_scene_find_bounds(scene);
    return *scene;
}

void bodies_look(glint_scene *scene, const double at[3], double turn, bool orthographic)
{
    const scene_builder b = {.turn = turn};
    static const double axes[3][3] = {{0.1, 0, -0.9}, {0.2, 1, 0.1}, {0.9, 0.3, 0.15}};
    float eye[3]; // the nearest floats, so that an eye on a corner is exactly there
    put(&b, at, eye);
    glint_mat4 to_world = {.m[3][3] = 1};
    for (int column = 0; column < 4; column++) {
        float turned[3];
        put(&b, column < 3 ? axes[column] : at, turned);
        for (int row = 0; row < 3; row++) {
            to_world.m[row][column] = (double)(column < 3 ? turned[row] : eye[row]);
        }
    }
    glint_camera camera = {.orthographic = orthographic, .yfov = 1.3, .ymag = 0.45};
    assert_true(glint_camera_from_matrix(&to_world, &camera));
    scene->cameras = malloc(sizeof camera);
    assert_non_null(scene->cameras);
    scene->cameras[0] = camera;
    scene->camera_count = 1;
}
