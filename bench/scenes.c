// Makes the scenes and the environment of the measurements. See scenes.h.
#include "scenes.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "kernels/layout.h"
#include "mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ENVIRONMENT_EDGE 512
#define SMALLEST_ICOSPHERE 20
#define LARGEST_ICOSPHERE 50000000

const char *bench_job_name(bench_job job)
{
    static const char *const names[BENCH_JOBS] = {"traverse", "reflect", "refract", "glass"};
    return names[job];
}

// ---- Meshes ------------------------------------------------------------------------------------

static const bench_ball bumpy_ball = {.radius = 1, .displacement = bench_bumps};
static const bench_ball smooth_ball = {.radius = 1};

static glint_status make_level_6(bench_mesh *mesh, glint_error *error)
{
    return bench_mesh_add_icosphere(mesh, &bumpy_ball, 64, error);
}

static glint_status make_level_8(bench_mesh *mesh, glint_error *error)
{
    return bench_mesh_add_icosphere(mesh, &bumpy_ball, 256, error);
}

static glint_status make_nine_spheres(bench_mesh *mesh, glint_error *error)
{
    const bench_sheet plane = {
        .corner = {-6, -1.25, 6}, .u = {12, 0, 0}, .v = {0, 0, -12}, .cells = 60};
    for (int k = 0; k < 9; k++) {
        int i = k / 3, j = k % 3;
        const bench_ball ball = {.center = {2.3 * (i - 1), 0, 2.3 * (j - 1)},
                                 .radius = 1,
                                 .displacement = bench_bumps,
                                 .phase = 3 * i + 1.7 * j};
        TRY(bench_mesh_add_latlong(mesh, &ball, 160, 100, error));
    }
    return bench_mesh_add_sheet(mesh, &plane, error);
}

static glint_status make_needles(bench_mesh *mesh, glint_error *error)
{
    const bench_needles hair = {.count = 200000, .radius = 0.85, .length = 0.1, .width = 0.004};
    return bench_mesh_add_needles(mesh, &hair, error);
}

// Makes a hall of 200 × 60 × 120 m that faces inwards, and in it, off its centre, a ball of half a
// metre.
static glint_status make_stadium(bench_mesh *mesh, glint_error *error)
{
    static const bench_sheet walls[6] = {
        {.corner = {-100, 0, 60}, .u = {200, 0, 0}, .v = {0, 0, -120}, .cells = 1},
        {.corner = {-100, 60, -60}, .u = {200, 0, 0}, .v = {0, 0, 120}, .cells = 1},
        {.corner = {-100, 0, 60}, .u = {0, 0, -120}, .v = {0, 60, 0}, .cells = 1},
        {.corner = {100, 0, -60}, .u = {0, 0, 120}, .v = {0, 60, 0}, .cells = 1},
        {.corner = {-100, 0, -60}, .u = {200, 0, 0}, .v = {0, 60, 0}, .cells = 1},
        {.corner = {100, 0, 60}, .u = {-200, 0, 0}, .v = {0, 60, 0}, .cells = 1},
    };
    const bench_ball ball = {
        .center = {31.7, 1.5, 12.3}, .radius = 0.5, .displacement = bench_bumps};
    TRY(bench_mesh_add_icosphere(mesh, &ball, 64, error));
    for (int k = 0; k < 6; k++) {
        TRY(bench_mesh_add_sheet(mesh, &walls[k], error));
    }
    return GLINT_OK;
}

typedef struct recipe {
    const char *name;
    glint_status (*make)(bench_mesh *mesh, glint_error *error);
    glint_vec3 eye, target; // metres
    double yfov;            // degrees
    unsigned jobs;
} recipe;

#define JOB(job) (1u << BENCH_##job)
#define RAYS (JOB(TRAVERSE) | JOB(REFLECT))

#define BALL_VIEW .eye = {0.3, 0.6, 2.4}, .yfov = 44

static const recipe recipes[] = {
    {"S0", make_level_6, BALL_VIEW, .jobs = RAYS | JOB(REFRACT)},
    {"S1", make_level_8, BALL_VIEW, .jobs = RAYS | JOB(REFRACT)},
    {"S2", make_nine_spheres, .eye = {2.5, 3.5, 6.2}, .target = {0, -0.3, 0}, .yfov = 46,
     .jobs = RAYS | JOB(REFRACT)},
    {"needles", make_needles, BALL_VIEW, .jobs = RAYS},
    {"stadium", make_stadium, .eye = {31.85, 1.8, 13.5}, .target = {31.7, 1.5, 12.3}, .yfov = 44,
     .jobs = RAYS},
    {"G0", make_level_6, BALL_VIEW, .jobs = JOB(GLASS)},
};
#define RECIPES (sizeof recipes / sizeof *recipes)

const char *const bench_scene_names[] = {"S0", "S1", "S2", "needles", "stadium", "G0", NULL};

// ---- Scenes ------------------------------------------------------------------------------------

static void look_at(const recipe *from, glint_camera *camera)
{
    *camera = (glint_camera){.yfov = from->yfov * GLINT_PI / 180, .eye = from->eye};
    camera->back = glint_vec3_normalize(glint_vec3_subtract(from->eye, from->target));
    camera->right = glint_vec3_normalize(glint_vec3_cross((glint_vec3){0, 1, 0}, camera->back));
    camera->up = glint_vec3_cross(camera->back, camera->right);
}

// Places the scene in the stored space of scene.h: the origin is the centre of the bounds, the unit
// the least power of two that holds half their extent.
static void place_scene(const bench_mesh *mesh, glint_scene *scene)
{
    glint_vec3 low = mesh->vertices[0], high = low;
    for (size_t i = 1; i < mesh->vertex_count; i++) {
        glint_vec3 v = mesh->vertices[i];
        low = (glint_vec3){fmin(low.x, v.x), fmin(low.y, v.y), fmin(low.z, v.z)};
        high = (glint_vec3){fmax(high.x, v.x), fmax(high.y, v.y), fmax(high.z, v.z)};
    }
    scene->low = low;
    scene->high = high;
    scene->origin = glint_vec3_scale(glint_vec3_add(low, high), 0.5);
    glint_vec3 half = glint_vec3_scale(glint_vec3_subtract(high, low), 0.5);
    scene->unit = exp2(ceil(log2(fmax(half.x, fmax(half.y, half.z)))));
}

static void set_floats(float *to, glint_vec3 v)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

static glint_status store_vertices(const bench_mesh *mesh, bench_scene *scene, glint_error *error)
{
    scene->vertex_count = mesh->vertex_count;
    scene->triangle_count = mesh->triangle_count;
    scene->positions = glint_allocate(mesh->vertex_count + 1, 3 * sizeof(float));
    scene->normals = glint_allocate(mesh->vertex_count, 3 * sizeof(float));
    scene->triangles = glint_allocate(mesh->triangle_count, 3 * sizeof(uint32_t));
    if (scene->positions == NULL || scene->normals == NULL || scene->triangles == NULL) {
        return glint_fail_memory(error, "a scene");
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        glint_vec3 from_origin = glint_vec3_subtract(mesh->vertices[i], scene->scene.origin);
        set_floats(scene->positions + 3 * i, glint_vec3_scale(from_origin, 1 / scene->scene.unit));
        set_floats(scene->normals + 3 * i, mesh->normals[i]);
    }
    memcpy(scene->triangles, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
    return GLINT_OK;
}

// Stores the triangle soup, as one instance of one material.
static glint_status store_soup(bench_scene *scene, glint_error *error)
{
    glint_scene *soup = &scene->scene;
    const size_t count = scene->triangle_count;
    soup->triangle_count = count;
    soup->positions = glint_allocate(9 * count, sizeof(float));
    soup->normals = glint_allocate(9 * count, sizeof(float));
    soup->material_of = glint_allocate(count, sizeof(uint32_t));
    soup->materials = glint_allocate(1, sizeof *soup->materials);
    soup->instances = glint_allocate(1, sizeof *soup->instances);
    if (soup->positions == NULL || soup->normals == NULL || soup->material_of == NULL ||
        soup->materials == NULL || soup->instances == NULL) {
        return glint_fail_memory(error, "a scene");
    }
    soup->material_count = 1;
    soup->instance_count = 1;
    soup->instances[0].triangle_count = count;
    for (size_t i = 0; i < 3 * count; i++) {
        const size_t from = 3 * (size_t)scene->triangles[i];
        memcpy(soup->positions + 3 * i, scene->positions + from, 3 * sizeof(float));
        memcpy(soup->normals + 3 * i, scene->normals + from, 3 * sizeof(float));
    }
    return GLINT_OK;
}

static glint_status store(const recipe *from, bench_mesh *mesh, bench_scene *scene,
                          glint_error *error)
{
    if (mesh->normals == NULL) {
        TRY(bench_mesh_smooth(mesh, error));
    }
    place_scene(mesh, &scene->scene);
    TRY(store_vertices(mesh, scene, error));
    TRY(store_soup(scene, error));
    look_at(from, &scene->camera);
    scene->jobs = from->jobs;
    return GLINT_OK;
}

// Parses NUMBER of "PREFIX:NUMBER"; 0 for other names.
static size_t icosphere_size(const char *name, const char *prefix)
{
    const size_t length = strlen(prefix);
    if (strncmp(name, prefix, length) != 0 || name[length] != ':') {
        return 0;
    }
    char *end;
    double count = strtod(name + length + 1, &end);
    bool valid = *end == '\0' && count >= SMALLEST_ICOSPHERE && count <= LARGEST_ICOSPHERE;
    return valid ? (size_t)count : 0;
}

glint_status bench_scene_make(const char *name, bench_scene *scene, glint_error *error)
{
    *scene = (bench_scene){0};
    snprintf(scene->name, sizeof scene->name, "%s", name);
    const recipe *found = NULL;
    for (size_t i = 0; i < RECIPES; i++) {
        found = strcmp(name, recipes[i].name) == 0 ? &recipes[i] : found;
    }
    bench_mesh mesh = {0};
    glint_status status;
    const size_t smooth = icosphere_size(name, "ball");
    const size_t triangles = smooth > 0 ? smooth : icosphere_size(name, "ico");
    if (triangles > 0) {
        found = &recipes[0];
        int frequency = (int)lround(sqrt((double)triangles / SMALLEST_ICOSPHERE));
        status = bench_mesh_add_icosphere(&mesh, smooth > 0 ? &smooth_ball : &bumpy_ball, frequency,
                                          error);
    } else if (found != NULL) {
        status = found->make(&mesh, error);
    } else {
        return glint_fail(
            error, GLINT_USAGE,
            "--scenes: '%s' is none (S0, S1, S2, needles, stadium, G0, or ico:N or ball:N "
            "with %d to %d triangles)",
            name, SMALLEST_ICOSPHERE, LARGEST_ICOSPHERE);
    }
    if (status == GLINT_OK) {
        status = store(found, &mesh, scene, error);
    }
    bench_mesh_free(&mesh);
    return status;
}

void bench_scene_free(bench_scene *scene)
{
    glint_scene_free(&scene->scene);
    free(scene->positions);
    free(scene->normals);
    free(scene->triangles);
    *scene = (bench_scene){0};
}

void bench_scene_set_material(bench_scene *scene, bench_job job)
{
    const bool glass = job == BENCH_REFRACT || job == BENCH_GLASS;
    scene->scene.materials[0] = (glint_material){
        GLINT_MATERIAL_SPECULAR,
        .base_color = {1, 1, 1},
        .metallic = glass ? 0 : 1,
        .transmission = glass ? 1 : 0,
        .ior = BENCH_IOR,
        .thickness = glass ? 1 : 0,
        .attenuation_distance = INFINITY,
        .attenuation_color = {1, 1, 1},
        .mirror = -1,
    };
}

// ---- Environment -------------------------------------------------------------------------------

// Radiance along a direction: the exponential of a sum of waves in the direction's components, plus
// three soft lights. Shorter waves have smaller amplitudes; in the middle of a face the shortest is
// 10 texels long.
static double radiance(glint_vec3 d, int channel)
{
    static const struct {
        double frequency[3], phase, amplitude;
    } waves[] = {
        {{1.3, 2.1, -0.7}, 0.4, 0.60},    {{-4.1, 2.9, 3.7}, 1.9, 0.45},
        {{9.0, -7.3, 8.1}, 0.8, 0.35},    {{-19.0, 23.0, 17.0}, 2.6, 0.25},
        {{52.0, 41.0, -47.0}, 1.1, 0.15}, {{-101.0, 87.0, 93.0}, 0.2, 0.08},
    };
    static const struct {
        glint_vec3 direction;
        double sharpness, color[3];
    } lights[] = {
        {{0.48, 0.80, 0.36}, 120, {14.0, 12.5, 10.0}},
        {{-0.80, 0.36, 0.48}, 60, {3.0, 4.0, 6.0}},
        {{0.36, 0.48, -0.80}, 400, {30.0, 30.0, 28.0}},
    };
    double exponent = 0.25 * d.y + 0.15 * channel * d.x - 0.5;
    for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
        const double *f = waves[i].frequency;
        double phase = waves[i].phase * (1 + 0.3 * channel);
        exponent += waves[i].amplitude * sin(f[0] * d.x + f[1] * d.y + f[2] * d.z + phase);
    }
    double sum = exp(exponent);
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        double cosine = glint_vec3_dot(d, lights[i].direction);
        sum += lights[i].color[channel] * exp(lights[i].sharpness * (cosine - 1));
    }
    return sum;
}

static void fill_row(size_t index, void *context)
{
    const glint_cube *cube = context;
    int face = (int)index / cube->edge, j = (int)index % cube->edge;
    for (int i = 0; i < cube->edge; i++) {
        double s = (2.0 * i + 1) / cube->edge - 1, t = (2.0 * j + 1) / cube->edge - 1;
        glint_vec3 d = glint_vec3_normalize(glint_cube_direction(face, s, t));
        float *texel = glint_cube_texel(cube, face, i, j);
        for (int channel = 0; channel < 3; channel++) {
            texel[channel] = (float)radiance(d, channel);
        }
        texel[3] = 1;
    }
}

glint_status bench_environment_make(glint_environment *environment, glint_error *error)
{
    *environment = (glint_environment){.reason = "made by formula"};
    environment->name = strdup("waves");
    if (environment->name == NULL) {
        return glint_fail_memory(error, "an environment");
    }
    environment->source_width = ENVIRONMENT_EDGE;
    environment->source_height = ENVIRONMENT_EDGE * GLINT_CUBE_FACES;
    TRY(glint_cube_create(ENVIRONMENT_EDGE, &environment->radiance, error));
    glint_cube *cube = &environment->radiance;
    glint_parallel_for((size_t)GLINT_CUBE_FACES * ENVIRONMENT_EDGE, fill_row, cube);
    glint_cube_fill_border(cube);
    return GLINT_OK;
}
