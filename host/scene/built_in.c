// Makes the built-in scenes: displaced spheres of one material each, some of them over a floor. See
// built_in.h.
//
// A sphere is an icosphere (icosphere.h). Its vertex along the unit vector u lies at (1 + f(u)) u,
// with f from displacement() below. The surface is smooth, closed and curved both ways everywhere,
// so that mirrored and refracted rays go in all directions.
#include "scene/built_in.h"

#include "base/memory.h"
#include "scene/shape/icosphere.h"

#include <stdlib.h>
#include <string.h>

typedef struct sphere {
    glint_vec3 centre; // metres
    double relief;     // factor on the displacement
    double phase;      // shifts the displacement, so that no two spheres are alike
    uint32_t material;
} sphere;

// The description of a scene. Its origin is (0, 0, 0).
typedef struct recipe {
    const char *name, *summary;
    int level;   // level of the spheres: 20 × 4^level triangles each
    double unit; // metres, a power of two at least as large as the scene
    bool has_floor;
    double floor_height, floor_half; // metres: y of the floor, and half the side of its square
    uint32_t floor_material;
    glint_vec3 eye, target; // metres
    double yfov;            // radians
    size_t sphere_count, material_count;
    const sphere *spheres;
    const glint_material *materials;
} recipe;

// Glass gets less displacement than metal and paint. A path meets glass several times, and each
// time its curvature multiplies the rounding. With the full displacement a quarter of the pixels
// would exceed the precision of float (host/report/bench/bench_check.c).
#define GLASS_RELIEF 0.25
#define DEGREES (GLINT_PI / 180)
#define COUNT(array) (sizeof(array) / sizeof *(array))

#define CLEAR GLINT_MATERIAL_CLEAR
#define NO_BLEND .mirror = (-1)

static const glint_material silver[] = {
    {CLEAR, NO_BLEND, .name = "silver", .base_color = {0.97F, 0.96F, 0.91F}, .metallic = 1}};
static const glint_material glass[] = {
    {CLEAR, NO_BLEND, .name = "glass", .base_color = {1, 1, 1}, .transmission = 1, .thickness = 1}};
static const sphere silver_sphere[] = {{{0, 0, 0}, 1, 0, 0}};
static const sphere glass_sphere[] = {{{0, 0, 0}, GLASS_RELIEF, 0, 0}};

static const glint_material mixed_materials[] = {
    {CLEAR, NO_BLEND, .name = "silver", .base_color = {0.97F, 0.96F, 0.91F}, .metallic = 1},
    {CLEAR, NO_BLEND, .name = "gold", .base_color = {1, 0.77F, 0.34F}, .metallic = 1},
    {CLEAR, NO_BLEND, .name = "glass", .base_color = {1, 1, 1}, .transmission = 1, .thickness = 1},
    {GLINT_MATERIAL_SPECULAR, .name = "ruby", .base_color = {1, 1, 1}, .transmission = 1,
     .thickness = 1, .ior = 1.76F, .attenuation_distance = 1,
     .attenuation_color = {0.9F, 0.2F, 0.25F}, NO_BLEND},
    {CLEAR, NO_BLEND, .name = "bubble", .base_color = {0.95F, 0.98F, 1}, .transmission = 1},
    {CLEAR, NO_BLEND, .name = "lacquer", .base_color = {0.05F, 0.15F, 0.45F}},
    {CLEAR, NO_BLEND, .name = "clay", .base_color = {0.55F, 0.35F, 0.25F}, .roughness = 1},
    {CLEAR, .name = "blend", .base_color = {0.1F, 0.5F, 0.2F}, .mirror = 0.5F},
    {CLEAR, NO_BLEND, .name = "floor", .base_color = {0.12F, 0.12F, 0.13F}},
};

static const sphere mixed_spheres[] = {
    {{-2.3, 0, -2.3}, 1, 0, 0},
    {{0, 0, -2.3}, 1, 3, 5},
    {{2.3, 0, -2.3}, 1, 6, 1},
    {{-2.3, 0, 0}, 1, 1.7, 6},
    {{0, 0, 0}, GLASS_RELIEF, 4.7, 2},
    {{2.3, 0, 0}, 1, 7.7, 7},
    {{-2.3, 0, 2.3}, GLASS_RELIEF, 3.4, 4},
    {{0, 0, 2.3}, 1, 6.4, 0},
    {{2.3, 0, 2.3}, GLASS_RELIEF, 9.4, 3},
};

static const recipe recipes[] = {
    {.name = "mirror",
     .summary = "a silver displaced sphere of 81,920 triangles",
     .level = 6,
     .unit = 2,
     .eye = {0.3, 0.6, 2.4},
     .yfov = 44 * DEGREES,
     .sphere_count = 1,
     .spheres = silver_sphere,
     .material_count = 1,
     .materials = silver},
    {.name = "glass",
     .summary = "such a sphere of solid glass, with a quarter of the relief",
     .level = 6,
     .unit = 2,
     .eye = {0.3, 0.6, 2.4},
     .yfov = 44 * DEGREES,
     .sphere_count = 1,
     .spheres = glass_sphere,
     .material_count = 1,
     .materials = glass},
    {.name = "mixed",
     .summary = "nine spheres of metal, glass and paint on a floor, 184,322 triangles",
     .level = 5,
     .unit = 8,
     .has_floor = true,
     .floor_height = -1.25,
     .floor_half = 6,
     .floor_material = 8,
     .eye = {2.5, 3.5, 6.2},
     .target = {0, -0.3, 0},
     .yfov = 46 * DEGREES,
     .sphere_count = COUNT(mixed_spheres),
     .spheres = mixed_spheres,
     .material_count = COUNT(mixed_materials),
     .materials = mixed_materials},
};

const char *glint_built_in_name(size_t index)
{
    return index < COUNT(recipes) ? recipes[index].name : NULL;
}

const char *glint_built_in_summary(size_t index)
{
    return index < COUNT(recipes) ? recipes[index].summary : NULL;
}

// Returns f(u), and its gradient as a function of three independent coordinates.
static double displacement(const sphere *ball, glint_vec3 u, glint_vec3 *gradient)
{
    const double phase = ball->phase, large = 0.12 * ball->relief, small = 0.03 * ball->relief;
    const double a = 5 * u.x + phase, b = 4 * u.y + 1 + phase, c = 6 * u.z + 2;
    const double p = 17 * u.x, q = 13 * u.y, r = 15 * u.z + phase;
    gradient->x = large * 5 * cos(a) * sin(b) * sin(c) + small * 17 * cos(p) * sin(q) * sin(r);
    gradient->y = large * 4 * sin(a) * cos(b) * sin(c) + small * 13 * sin(p) * cos(q) * sin(r);
    gradient->z = large * 6 * sin(a) * sin(b) * cos(c) + small * 15 * sin(p) * sin(q) * cos(r);
    return large * sin(a) * sin(b) * sin(c) + small * sin(p) * sin(q) * sin(r);
}

static void put(float *to, glint_vec3 v)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

// Writes the vertex along u. It depends on u alone, so triangles that share it agree on every bit.
static void put_vertex(const glint_scene *scene, const sphere *ball, glint_vec3 u, size_t vertex)
{
    glint_vec3 gradient;
    double radius = 1 + displacement(ball, u, &gradient);
    glint_vec3 position = glint_vec3_add(ball->centre, glint_vec3_scale(u, radius));
    put(scene->positions + 3 * vertex, glint_vec3_scale(position, 1 / scene->unit));
    // The surface is where F(p) = |p| − 1 − f(p/|p|) is 0, and ∇F = u − (∇f − (∇f·u) u)/|p|.
    glint_vec3 across =
        glint_vec3_subtract(gradient, glint_vec3_scale(u, glint_vec3_dot(gradient, u)));
    glint_vec3 normal = glint_vec3_subtract(u, glint_vec3_scale(across, 1 / radius));
    put(scene->normals + 3 * vertex, glint_vec3_normalize(normal));
}

typedef struct ball_to_put {
    glint_scene *scene;
    const sphere *ball;
} ball_to_put;

static void put_triangle(void *context, const glint_vec3 corners[3])
{
    const ball_to_put *put = context;
    glint_scene *scene = put->scene;
    for (size_t k = 0; k < 3; k++) {
        put_vertex(scene, put->ball, corners[k], 3 * scene->triangle_count + k);
    }
    scene->material_of[scene->triangle_count++] = put->ball->material;
}

static void put_floor(glint_scene *scene, const recipe *made)
{
    const double h = made->floor_half, y = made->floor_height;
    const glint_vec3 corners[4] = {{-h, y, h}, {h, y, h}, {h, y, -h}, {-h, y, -h}};
    static const int order[6] = {0, 1, 2, 0, 2, 3};
    for (size_t i = 0; i < 6; i++) {
        size_t vertex = 3 * scene->triangle_count + i;
        put(scene->positions + 3 * vertex, glint_vec3_scale(corners[order[i]], 1 / scene->unit));
        put(scene->normals + 3 * vertex, (glint_vec3){0, 1, 0});
    }
    for (int i = 0; i < 2; i++) {
        scene->material_of[scene->triangle_count++] = made->floor_material;
    }
}

// Ends an instance: the triangles from `first` on.
static void end_instance(glint_scene *scene, size_t first)
{
    scene->instances[scene->instance_count] = (glint_instance){
        .node_index = (int)scene->instance_count,
        .first_triangle = first,
        .triangle_count = scene->triangle_count - first,
        .material = scene->material_of[first],
    };
    scene->instance_count++;
}

static void look(const recipe *made, glint_camera *camera)
{
    glint_vec3 back = glint_vec3_subtract(made->eye, made->target);
    const glint_mat4 to_world = {{{1, 0, back.x, made->eye.x},
                                  {0, 1, back.y, made->eye.y},
                                  {0, 0, back.z, made->eye.z},
                                  {0, 0, 0, 1}}};
    *camera = (glint_camera){.yfov = made->yfov};
    // No recipe looks straight up or down.
    (void)glint_camera_from_matrix(&to_world, camera);
}

static bool copy_text(const char *text, char **copy)
{
    *copy = strdup(text);
    return *copy != NULL;
}

static bool copy_materials(const recipe *made, glint_scene *scene)
{
    scene->materials = calloc(made->material_count, sizeof *scene->materials);
    bool done = scene->materials != NULL;
    for (size_t i = 0; done && i < made->material_count; i++) {
        scene->materials[i] = made->materials[i];
        scene->materials[i].index = (int)i;
        done = copy_text(made->materials[i].name, &scene->materials[i].name);
        scene->material_count++;
    }
    return done;
}

// Allocates everything except the triangles' contents.
static bool allocate(const recipe *made, glint_scene *scene)
{
    size_t triangles = made->sphere_count * 20 * ((size_t)1 << 2 * made->level) + 2;
    scene->positions = glint_allocate(triangles, 9 * sizeof(float));
    scene->normals = glint_allocate(triangles, 9 * sizeof(float));
    scene->material_of = glint_allocate(triangles, sizeof *scene->material_of);
    scene->instances = calloc(made->sphere_count + 1, sizeof *scene->instances);
    scene->cameras = calloc(1, sizeof *scene->cameras);
    return scene->positions != NULL && scene->normals != NULL && scene->material_of != NULL &&
           scene->instances != NULL && scene->cameras != NULL && copy_materials(made, scene) &&
           copy_text(made->name, &scene->path);
}

static const recipe *find_recipe(const char *name)
{
    for (size_t i = 0; i < COUNT(recipes); i++) {
        if (strcmp(recipes[i].name, name) == 0) {
            return &recipes[i];
        }
    }
    return NULL;
}

glint_status glint_built_in_scene(const char *name, glint_scene *scene, glint_error *error)
{
    *scene = (glint_scene){0};
    const recipe *made = find_recipe(name);
    if (made == NULL) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: no built-in scene has that name", name);
    }
    scene->unit = made->unit;
    if (!allocate(made, scene)) {
        glint_scene_free(scene);
        return glint_fail_memory(error, "a scene");
    }
    for (size_t i = 0; i < made->sphere_count; i++) {
        size_t first = scene->triangle_count;
        ball_to_put put = {scene, &made->spheres[i]};
        glint_icosphere(made->level, put_triangle, &put);
        end_instance(scene, first);
    }
    if (made->has_floor) {
        size_t first = scene->triangle_count;
        put_floor(scene, made);
        end_instance(scene, first);
    }
    glint_scene_find_bounds(scene);
    look(made, &scene->cameras[scene->camera_count++]);
    return GLINT_OK;
}
