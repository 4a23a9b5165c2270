// Renders frames by Embree: the setup, which is not timed, and the frames. See reference.h.
#include "embree/cube.h"
#include "embree/tile.h"

#include "base/clock.h"
#include "base/half.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// ---- Trees -------------------------------------------------------------------------------------

static bool count_bytes(void *context, ssize_t bytes, bool post)
{
    (void)post;
    embree_program *program = context;
    __atomic_fetch_add(&program->allocated, bytes, __ATOMIC_RELAXED);
    return true;
}

// Builds a tree of the mesh: one geometry over the scene's own arrays, without callbacks. *ms is
// the time of the commit.
static RTCScene build_scene(embree_program *program, embree_quality quality, double *ms)
{
    const bench_scene *mesh = program->inputs.scene;
    RTCScene scene = rtcNewScene(program->device);
    RTCGeometry geometry = rtcNewGeometry(program->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               mesh->positions, 0, 3 * sizeof(float), mesh->vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh->triangles, 0, 3 * sizeof(uint32_t), mesh->triangle_count);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene, quality == EMBREE_HIGH ? RTC_BUILD_QUALITY_HIGH
                                                          : RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene, program->inputs.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    double start = glint_now_ms();
    rtcCommitScene(scene);
    *ms = glint_now_ms() - start;
    return scene;
}

double embree_program_build(embree_program *program, embree_quality quality)
{
    double ms;
    rtcReleaseScene(build_scene(program, quality, &ms));
    return ms;
}

static glint_status build_scenes(embree_program *program, glint_error *error)
{
    // No other tree, leaf, page size or vector width was faster than the defaults.
    program->device = rtcNewDevice(NULL);
    if (program->device == NULL) {
        return glint_fail(error, GLINT_DEVICE_FAILED, "Embree: no device (error %d)",
                          (int)rtcGetDeviceError(NULL));
    }
    rtcSetDeviceMemoryMonitorFunction(program->device, count_bytes, program);
    for (int quality = 0; quality <= (program->inputs.high ? EMBREE_HIGH : EMBREE_MEDIUM);
         quality++) {
        ssize_t before = program->allocated;
        double ms;
        program->scenes[quality] = build_scene(program, (embree_quality)quality, &ms);
        program->bytes[quality] = (size_t)(program->allocated - before);
    }
    enum RTCError code = rtcGetDeviceError(program->device);
    return code == RTC_ERROR_NONE
               ? GLINT_OK
               : glint_fail(error, GLINT_DEVICE_FAILED,
                            "Embree: the scene cannot be built (error %d)", (int)code);
}

// ---- Data for shading --------------------------------------------------------------------------

static void fill_normals(embree_program *program)
{
    const bench_scene *scene = program->inputs.scene;
    for (size_t i = 0; i < scene->triangle_count; i++) {
        const uint32_t *t = scene->triangles + 3 * i;
        float *packed = program->normals + 9 * i;
        for (int k = 0; k < 3; k++) {
            packed[k] = scene->normals[3 * (size_t)t[0] + (size_t)k];
            packed[3 + k] = scene->normals[3 * (size_t)t[1] + (size_t)k] - packed[k];
            packed[6 + k] = scene->normals[3 * (size_t)t[2] + (size_t)k] - packed[k];
        }
    }
}

static size_t texel_count(const glint_cube *cube)
{
    return glint_cube_size(cube) / 4;
}

static void fill_texel_pairs(embree_program *program)
{
    const glint_cube *cube = program->inputs.environment;
    const size_t count = texel_count(cube), pitch = (size_t)cube->edge + 2 * GLINT_CUBE_BORDER;
    for (size_t i = 0; i < count; i++) {
        // The last row has no row below. No look-up uses it as its upper row.
        size_t below = i + pitch < count ? i + pitch : i;
        for (size_t c = 0; c < 4; c++) {
            uint16_t *pair = program->texel_pairs + PAIR_HALVES * i;
            pair[c] = glint_half_from_float(cube->texels[4 * i + c]);
            pair[4 + c] = glint_half_from_float(cube->texels[4 * below + c]);
        }
    }
}

static void set_floats(float *to, glint_vec3 v)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

static void set_view(embree_program *program)
{
    const glint_scene *scene = &program->inputs.scene->scene;
    const glint_camera *camera = &program->inputs.scene->camera;
    embree_view *view = &program->view;
    glint_vec3 eye = glint_vec3_subtract(camera->eye, scene->origin);
    double step = 2 * tan(camera->yfov / 2) / program->inputs.height;
    set_floats(view->eye, glint_vec3_scale(eye, 1 / scene->unit));
    set_floats(view->direction, glint_vec3_scale(camera->back, -1));
    set_floats(view->direction_x, glint_vec3_scale(camera->right, step));
    set_floats(view->direction_y, glint_vec3_scale(camera->up, step));
}

static glint_status allocate(embree_program *program, glint_error *error)
{
    const embree_inputs *in = &program->inputs;
    const size_t pixels = (size_t)in->width * (size_t)in->height;
    const size_t threads = (size_t)bench_pool_threads(in->pool);
    program->normals = glint_allocate(in->scene->triangle_count, 9 * sizeof(float));
    program->texel_pairs =
        glint_allocate(texel_count(in->environment), PAIR_HALVES * sizeof(uint16_t));
    program->pixels = glint_allocate(pixels, 4 * sizeof(float));
    program->hits = glint_allocate(pixels, sizeof *program->hits);
    program->tiles = glint_allocate(threads, sizeof *program->tiles);
    if (program->normals == NULL || program->texel_pairs == NULL || program->pixels == NULL ||
        program->hits == NULL || program->tiles == NULL) {
        return glint_fail_memory(error, "the Embree program");
    }
    set_view(program);
    for (size_t i = 0; i < threads; i++) {
        embree_tile_prepare(&program->tiles[i], &program->view);
    }
    fill_normals(program);
    fill_texel_pairs(program);
    return GLINT_OK;
}

glint_status embree_program_create(const embree_inputs *inputs, embree_program **program,
                                   glint_error *error)
{
    *program = NULL;
    embree_program *made = calloc(1, sizeof *made);
    if (made == NULL) {
        return glint_fail_memory(error, "the Embree program");
    }
    made->inputs = *inputs;
    glint_status status;
    TRY_OR(cleanup, status, allocate(made, error));
    TRY_OR(cleanup, status, build_scenes(made, error));
    *program = made;
    return GLINT_OK;
cleanup:
    embree_program_free(made);
    return status;
}

void embree_program_free(embree_program *program)
{
    if (program == NULL) {
        return;
    }
    for (int quality = 0; quality < EMBREE_QUALITIES; quality++) {
        if (program->scenes[quality] != NULL) {
            rtcReleaseScene(program->scenes[quality]);
        }
    }
    if (program->device != NULL) {
        rtcReleaseDevice(program->device);
    }
    free(program->normals);
    free(program->texel_pairs);
    free(program->pixels);
    free(program->hits);
    free(program->tiles);
    free(program);
}

// ---- Frames ------------------------------------------------------------------------------------

double embree_program_frame(embree_program *program, bench_job job, int depth,
                            const embree_mode *mode)
{
    embree_frame frame = {program, program->scenes[mode->quality], job, depth, mode};
    return bench_pool_run(program->inputs.pool, embree_tile_count(&program->inputs),
                          embree_render_tile, &frame);
}

const float *embree_program_pixels(const embree_program *program)
{
    return program->pixels;
}

const embree_hit *embree_program_hits(const embree_program *program)
{
    return program->hits;
}

size_t embree_program_bytes(const embree_program *program, embree_quality quality)
{
    return program->bytes[quality];
}

size_t embree_program_shading_bytes(const embree_program *program)
{
    return program->inputs.scene->triangle_count * 9 * sizeof(float);
}

void embree_version(char *text, size_t capacity)
{
    snprintf(text, capacity, "%s", RTC_VERSION_STRING);
}

static const char *call_name(embree_call call)
{
    static const char *const names[EMBREE_CALLS] = {"1", "8", "16", "NM 16x1", "NM 16x16"};
    return names[call];
}

void embree_mode_describe(const embree_mode *mode, bench_job job, char *text, size_t capacity)
{
    char second[64] = "", shading[32] = "";
    if (job == BENCH_REFRACT) {
        snprintf(second, sizeof second, ", then %s %s", call_name(mode->secondary.call),
                 mode->secondary.coherent ? "coherent" : "incoherent");
    }
    if (job == BENCH_REFLECT || job == BENCH_REFRACT) {
        snprintf(shading, sizeof shading, ", %s",
                 mode->shading == EMBREE_PLAIN ? "plain" : "staged");
    }
    snprintf(text, capacity, "%s %s%s, %s, %s%s", call_name(mode->primary.call),
             mode->primary.coherent ? "coherent" : "incoherent", second,
             job == BENCH_GLASS ? "1x1"
             : mode->rows       ? "16x1"
                                : "4x4",
             mode->quality == EMBREE_HIGH ? "HIGH" : "MEDIUM", shading);
}
