// Makes the scenes and the environment of the measurements in memory. They are the same on every
// machine, except for the last bits of sin and cos.
//
//   S0, S1     a displaced icosphere of 82 thousand and of 1.3 million triangles
//   S2         nine displaced spheres over a plane, 292 thousand
//   needles    200 thousand slivers that grow out of a sphere: long, thin, criss-cross
//   stadium    a displaced icosphere, 82 thousand, that is small inside a hall of 12
//   G0         S0's mesh as solid glass
//   ico:N      like S0, of about N triangles, 20 at least
//   ball:N     like ico:N, without displacement
#ifndef GLINT_BENCH_SCENES_H
#define GLINT_BENCH_SCENES_H

#include "base/status.h"
#include "environment/environment.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Work to do with a scene.
typedef enum bench_job {
    BENCH_TRAVERSE, // primary rays: the hit triangle and point
    BENCH_REFLECT,  // a mirror: the environment along the reflected direction
    BENCH_REFRACT,  // glass without Fresnel's equations: in, out, the environment (depth 2)
    BENCH_GLASS,    // glass with both branches, to depth 8 and weight 1/256
    BENCH_JOBS,
} bench_job;

#define BENCH_IOR 1.5f
#define BENCH_GLASS_DEPTH 8 // also the maximum
#define BENCH_GLASS_MIN_WEIGHT (1.0f / 256)

// The job's name, such as "traverse".
const char *bench_job_name(bench_job job);

// A mesh in two forms: the triangle soup of glint, and indexed vertices. Triangle numbers are the
// same in both, and coordinates are the scene's stored ones.
typedef struct bench_scene {
    char name[32];
    unsigned jobs; // bit 1 << job: the job makes sense here
    size_t vertex_count, triangle_count;
    float *positions;    // [vertex_count + 1][3], owned; the last is padding
    float *normals;      // [vertex_count][3], unit, owned
    uint32_t *triangles; // [triangle_count][3], owned
    glint_scene scene;   // one material
    glint_camera camera; // nothing in it is owned
} bench_scene;

// The names of the scenes without a number, NULL at the end.
extern const char *const bench_scene_names[];

// Makes a scene. Free it with bench_scene_free, also after an error. Errors: GLINT_USAGE for an
// unknown name, GLINT_DEVICE_FAILED if memory is short.
glint_status bench_scene_make(const char *name, bench_scene *scene, glint_error *error);
void bench_scene_free(bench_scene *scene);

// Gives the scene the material of the job.
void bench_scene_set_material(bench_scene *scene, bench_job job);

// Makes a cube map of 6 × 512² texels: smooth, with details of about ten texels, and of high
// contrast. The fourth value of its texels is 1.
glint_status bench_environment_make(glint_environment *environment, glint_error *error);

#endif
