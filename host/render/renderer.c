// Making renderers, and giving them other scenes. See frame.h.
#include "render/frame.h"

#include "base/clock.h"
#include "device/program.h"
#include "environment/harmonics.h"
#include "environment/irradiance.h"
#include "kernels/layout.h"
#include "render/renderer.h"
#include "render/vertices.h"
#include "scene/topology.h"

#include <stdlib.h>
#include <string.h>

static size_t scalar_bytes(const glint_renderer *r)
{
    return r->settings.precision == GLINT_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

static bool has_solids(const glint_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        if (glint_material_is_solid(&scene->materials[i])) {
            return true;
        }
    }
    return false;
}

// The topology is found only where solids may nest, or where what paths meet may be proved of it:
// of millions of triangles it takes seconds.
static glint_status analyse(const glint_renderer_inputs *in, const glint_plan *before,
                            glint_plan *plan, glint_error *error)
{
    glint_topology topology = {0};
    const bool sees = glint_plan_heeds_sight(in->settings);
    const bool wanted = !in->scene->moves &&
                        (has_solids(in->scene) || (sees && glint_sight_wants_topology(in->scene)));
    glint_status status = wanted ? glint_topology_find(in->scene, &topology, error) : GLINT_OK;
    if (status == GLINT_OK) {
        const glint_sight sight = sees ? glint_sight_find(in->scene, &topology) : (glint_sight){0};
        const glint_plan_inputs inputs = {
            .scene = in->scene,
            .topology = &topology,
            .sight = &sight,
            .environment = &in->environment->radiance,
            .device = glint_device_capabilities(in->device),
            .settings = in->settings,
            .before = before,
        };
        status = glint_plan_make(&inputs, plan, error);
    }
    glint_topology_free(&topology);
    return status;
}

static bool needs_irradiance(const glint_plan *plan)
{
    return plan->features[GLINT_FEATURE_PAINT].compiled ||
           plan->features[GLINT_FEATURE_BLEND].compiled;
}

glint_status glint_renderer_set_argument(const glint_renderer *r, cl_uint index, size_t size,
                                         const void *value, glint_error *error)
{
    cl_int code = clSetKernelArg(r->kernel, index, size, value);
    return code == CL_SUCCESS
               ? GLINT_OK
               : glint_fail_opencl(error, r->device, "setting a kernel's argument", code);
}

static glint_status set_buffers(const glint_renderer *r, glint_error *error)
{
    const cl_mem buffers[] = {r->geometry.nodes,
                              r->geometry.clusters,
                              r->geometry.normals,
                              r->geometry.numbers,
                              r->geometry.materials,
                              r->geometry.media,
                              r->light.environment,
                              r->light.irradiance,
                              r->pixels.own,
                              r->counters,
                              r->layers,
                              r->terms,
                              r->vertices};
    glint_status status = GLINT_OK;
    for (cl_uint i = 0; status == GLINT_OK && i < sizeof buffers / sizeof *buffers; i++) {
        status = glint_renderer_set_argument(r, i, sizeof buffers[i], &buffers[i], error);
    }
    return status;
}

// Compiles, and launches once over an image without pixels: drivers put off a part of the
// compilation to the first launch.
static glint_status build_kernel(const glint_renderer_inputs *in, glint_renderer *r,
                                 glint_error *error)
{
    char options[4096];
    glint_plan_build_options(&r->shown.plan, options, sizeof options);
    const glint_program_request request = {.kernel_dir = in->kernel_dir, .options = options};
    cl_program program;
    glint_status status = glint_program_build(r->device, &request, &program, error);
    if (status == GLINT_OK) {
        status = glint_program_kernel(r->device, program, "render_tiles", &r->kernel, error);
        status = status == GLINT_OK ? glint_vertices_take_kernel(r, program, error) : status;
        clReleaseProgram(program);
    }
    if (status == GLINT_OK) {
        status = set_buffers(r, error);
    }
    if (status == GLINT_OK) {
        // No pixel is written, so that a device that writes into images needs none yet.
        glint_frame_record nothing = {.band = 1};
        cl_event done;
        status = glint_renderer_launch(r, &nothing, 0, 1, &done, error);
        status = status == GLINT_OK ? glint_renderer_wait(r, done, error) : status;
    }
    return status;
}

static glint_status create_outputs(glint_renderer *r, glint_error *error)
{
    int size[2];
    glint_settings_pixels(&r->settings, size);
    glint_status status =
        glint_pixels_create(r->device, size[0], size[1], scalar_bytes(r), &r->pixels, error);
    if (status == GLINT_OK) {
        const size_t counters = GLINT_COUNTER_SLOTS * GLINT_COUNTERS * 2 * sizeof(cl_uint);
        status =
            glint_buffer_create(r->device, "the counters", counters, NULL, &r->counters, error);
    }
    if (status == GLINT_OK) {
        status = glint_buffer_create(r->device, "the layers", glint_renderer_layers_bytes(r), NULL,
                                     &r->layers, error);
    }
    if (status == GLINT_OK) {
        status = glint_buffer_create(r->device, "the directions", glint_renderer_terms_bytes(r),
                                     NULL, &r->terms, error);
    }
    return status;
}

// The smallest power of two that is no smaller than the tree needs, so that few sizes are compiled.
static int traversal_stack(int need)
{
    int size = 64;
    while (size < need) {
        size *= 2;
    }
    return size;
}

// A tree that is fitted to triangles that moved is worse than one that is built anew. It is built
// anew where its boxes grew by so much: all together, as where bodies that shared boxes fly apart,
// or beside the root's, as where they come to lie within each other. A quarter more, as a body's
// turn by 45 degrees gives, could not be seen in tracing times.
#define REFIT_GROWTH 1.5

// The tree that there is, fitted, or a new one.
static glint_status make_tree(const glint_scene *scene, glint_prepared_scene *p, glint_error *error)
{
    glint_bvh *tree = &p->tree;
    const glint_bvh_report *report = &tree->report;
    const double metres = scene->unit > 0 ? scene->unit * scene->unit : 1;
    glint_status status = GLINT_OK;
    if (!glint_plan_refit_tree(&p->plan, scene, tree) ||
        report->sah_cost > REFIT_GROWTH * p->built_cost ||
        report->sah_cost * report->root_area * metres > REFIT_GROWTH * p->built_area) {
        glint_bvh_free(tree);
        status = glint_plan_build_tree(&p->plan, scene, tree, error);
        p->built_cost = report->sah_cost;
        p->built_area = report->sah_cost * report->root_area * metres;
    }
    p->bvh = *report;
    p->plan.traversal_stack = traversal_stack(report->stack_need);
    return status;
}

// Plan and tree of the scene, and whether the device can hold them. Of the renderer nothing is
// changed, and nothing is read that a frame changes: frames may be rendered meanwhile.
static glint_status prepare(const glint_renderer *r, const glint_scene *scene,
                            const glint_plan *before, glint_prepared_scene *prepared,
                            glint_error *error)
{
    double clock = glint_now_ms();
    glint_renderer_inputs in = r->inputs;
    in.scene = scene;
    glint_upload_sizes sizes = {0};
    glint_status status = analyse(&in, before, &prepared->plan, error);
    if (status == GLINT_OK) {
        int size[2];
        glint_settings_pixels(&r->settings, size);
        status = glint_pixels_size(size[0], size[1], scalar_bytes(r), &sizes.frame, error);
    }
    if (status == GLINT_OK) {
        sizes.environment = prepared->plan.environment_bytes;
        sizes.layers = glint_renderer_layers_bytes(r);
        sizes.terms = glint_renderer_terms_bytes(r);
        sizes.vertex = glint_vertices_bytes(&prepared->plan, 1);
        status = glint_upload_check(r->device, scene, &sizes, error);
    }
    prepared->analysis_ms = glint_lap_ms(&clock);
    if (status == GLINT_OK) {
        status = make_tree(scene, prepared, error);
        prepared->bvh_ms = glint_lap_ms(&clock);
    }
    return status;
}

// Only the tree of a scene that moves is needed again.
static glint_status upload_geometry(const glint_renderer_inputs *in, glint_renderer *r,
                                    glint_error *error)
{
    glint_prepared_scene *shown = &r->shown;
    const glint_upload_inputs inputs = {
        .device = in->device, .scene = in->scene, .bvh = &shown->tree, .plan = &shown->plan};
    r->phases.analysis = shown->analysis_ms;
    r->phases.bvh = shown->bvh_ms;
    double clock = glint_now_ms();
    glint_geometry_memory fresh;
    glint_status status = glint_geometry_upload(&inputs, &fresh, error);
    if (status == GLINT_OK) {
        r->geometry = fresh;
        r->space = glint_stored_space_of(in->scene);
        status = glint_vertices_allocate(r, error);
    }
    if (status != GLINT_OK || !in->scene->moves) {
        glint_bvh_free(&shown->tree);
    }
    r->phases.upload = glint_lap_ms(&clock);
    return status;
}

static glint_status upload_light(const glint_renderer_inputs *in, glint_renderer *r,
                                 glint_error *error)
{
    double clock = glint_now_ms();
    const glint_cube *radiance = &in->environment->radiance;
    glint_cube irradiance = {0};
    float harmonics[GLINT_HARMONICS][4];
    const bool by_harmonics = r->shown.plan.features[GLINT_FEATURE_IRRADIANCE_HARMONICS].compiled;
    glint_status status = GLINT_OK;
    r->proxy = in->environment->proxy;
    if (r->settings.proxy && r->proxy.kind == GLINT_PROXY_NONE) {
        return glint_fail(error, GLINT_USAGE, "the environment has no proxy");
    }
    if (by_harmonics) {
        status = glint_irradiance_harmonics(radiance, harmonics, error);
        r->phases.irradiance = glint_lap_ms(&clock);
    } else if (needs_irradiance(&r->shown.plan) && !in->without_frames) {
        status = glint_irradiance_map(radiance, GLINT_IRRADIANCE_EDGE, &irradiance, error);
        r->phases.irradiance = glint_lap_ms(&clock);
    }
    if (status == GLINT_OK) {
        const glint_upload_inputs inputs = {
            .device = in->device,
            .plan = &r->shown.plan,
            .environment = radiance,
            .irradiance = by_harmonics ? &harmonics[0][0] : irradiance.texels,
            .irradiance_count =
                by_harmonics ? sizeof harmonics / sizeof(float) : glint_cube_size(&irradiance),
        };
        status = glint_light_upload(&inputs, &r->light, error);
        r->environment_edge = radiance->edge;
        r->irradiance_edge = irradiance.edge;
        r->phases.upload += glint_lap_ms(&clock);
    }
    glint_cube_free(&irradiance);
    return status;
}

// All that a plan is put to work with.
static glint_status set_up(const glint_renderer_inputs *in, glint_renderer *r, glint_error *error)
{
    glint_status status = upload_geometry(in, r, error);
    if (status == GLINT_OK) {
        status = upload_light(in, r, error);
    }
    double clock = glint_now_ms();
    if (status == GLINT_OK) {
        status = create_outputs(r, error);
        r->phases.upload += glint_lap_ms(&clock);
    }
    if (status == GLINT_OK && !in->without_frames) {
        status = build_kernel(in, r, error);
        r->phases.kernel_build = glint_lap_ms(&clock);
    }
    return status;
}

static void release_kernels(glint_renderer *r)
{
    cl_kernel *const kernels[] = {&r->kernel, &r->vertex_kernel};
    for (int i = 0; i < 2; i++) {
        if (*kernels[i] != NULL) {
            clReleaseKernel(*kernels[i]);
            *kernels[i] = NULL;
        }
    }
}

static void tear_down(glint_renderer *r)
{
    glint_geometry_memory_free(&r->geometry);
    glint_light_memory_free(&r->light);
    glint_pixels_free(&r->pixels);
    glint_buffer_release(r->counters);
    glint_buffer_release(r->layers);
    glint_buffer_release(r->terms);
    r->counters = r->layers = r->terms = NULL;
    glint_buffer_release(r->vertices);
    r->vertices = NULL;
    release_kernels(r);
}

glint_status glint_renderer_create(const glint_renderer_inputs *inputs, glint_renderer **renderer,
                                   glint_error *error)
{
    *renderer = NULL;
    glint_renderer *r = calloc(1, sizeof *r);
    if (r == NULL) {
        return glint_fail_memory(error, "the renderer");
    }
    r->device = inputs->device;
    r->settings = *inputs->settings;
    r->inputs = *inputs;
    r->inputs.settings = &r->settings;
    glint_status status = prepare(r, inputs->scene, NULL, &r->shown, error);
    if (status == GLINT_OK) {
        status = set_up(inputs, r, error);
    }
    if (status != GLINT_OK) {
        glint_renderer_free(r);
        return status;
    }
    *renderer = r;
    return GLINT_OK;
}

static bool has_same_options(const glint_plan *a, const glint_plan *b)
{
    char options[2][4096];
    glint_plan_build_options(a, options[0], sizeof options[0]);
    glint_plan_build_options(b, options[1], sizeof options[1]);
    return strcmp(options[0], options[1]) == 0;
}

static glint_status replace_kernel(const glint_renderer_inputs *in, glint_renderer *r,
                                   glint_error *error)
{
    double clock = glint_now_ms();
    release_kernels(r);
    glint_status status = build_kernel(in, r, error);
    r->phases.kernel_build = glint_lap_ms(&clock);
    return status;
}

glint_status glint_renderer_suit(glint_renderer *r, const glint_camera *camera, glint_error *error)
{
    glint_plan *plan = &r->shown.plan;
    if (plan->sight.depth == 0) {
        return GLINT_OK;
    }
    const glint_plan before = *plan;
    const double build_ms = r->phases.kernel_build;
    glint_plan_suit(plan, &r->space, camera);
    if (has_same_options(&before, plan) && r->kernel != NULL) {
        return GLINT_OK; // only the depth is another
    }
    r->bands_per_ms = 0;
    glint_status status = replace_kernel(&r->inputs, r, error);
    r->phases.kernel_build += build_ms;
    return status;
}

// What has been prepared, in the place of what was shown, whose buffers are gone and whose kernel
// was that of the plan `before`.
static glint_status show(glint_renderer *r, const glint_scene *scene, const glint_plan *before,
                         glint_error *error)
{
    glint_renderer_inputs in = r->inputs;
    in.scene = scene;
    if (!has_same_options(before, &r->shown.plan) || r->kernel == NULL) {
        tear_down(r); // other kernels, and what they read
        return set_up(&in, r, error);
    }
    glint_status status = upload_geometry(&in, r, error);
    return status == GLINT_OK ? set_buffers(r, error) : status;
}

glint_status glint_renderer_set_scene(glint_renderer *r, const glint_scene *scene,
                                      glint_error *error)
{
    const glint_plan before = r->shown.plan;
    glint_geometry_take_back(&r->geometry, &r->shown.tree);
    r->has_failed = true;
    glint_status status = prepare(r, scene, &before, &r->shown, error);
    if (status == GLINT_OK) {
        status = show(r, scene, &before, error);
    } else {
        r->shown.plan = before;
    }
    r->has_failed = status != GLINT_OK;
    return status;
}

glint_status glint_renderer_set_environment(glint_renderer *r, const glint_environment *environment,
                                            glint_error *error)
{
    const glint_plan before = r->shown.plan;
    r->inputs.environment = environment;
    r->is_dark = true;
    r->is_next_ready = false; // its plan is another environment's
    const glint_plan_inputs inputs = {.environment = &environment->radiance,
                                      .device = glint_device_capabilities(r->device),
                                      .settings = &r->settings};
    glint_status status = glint_plan_choose_texels(&inputs, &r->shown.plan, error);
    if (status != GLINT_OK) {
        r->shown.plan = before;
        return status;
    }
    const bool same_kernel = has_same_options(&before, &r->shown.plan) && r->kernel != NULL;
    const bool needs_kernel = !r->inputs.without_frames;
    glint_light_memory_free(&r->light);
    status = upload_light(&r->inputs, r, error);
    if (status == GLINT_OK) {
        status = same_kernel    ? set_buffers(r, error)
                 : needs_kernel ? replace_kernel(&r->inputs, r, error)
                                : GLINT_OK;
    }
    r->is_dark = status != GLINT_OK;
    return status;
}

glint_status glint_renderer_prepare(glint_renderer *r, const glint_scene *scene, glint_error *error)
{
    glint_status status = prepare(r, scene, &r->shown.plan, &r->next, error);
    r->is_next_ready = status == GLINT_OK;
    return status;
}

glint_status glint_renderer_set_prepared(glint_renderer *r, const glint_scene *scene,
                                         glint_error *error)
{
    if (!r->is_next_ready) {
        return glint_fail(error, GLINT_USAGE, "no scene has been prepared");
    }
    const glint_prepared_scene before = r->shown;
    r->shown = r->next;
    r->next = before;
    r->is_next_ready = false;
    glint_geometry_take_back(&r->geometry, &r->next.tree);
    glint_status status = show(r, scene, &before.plan, error);
    r->has_failed = status != GLINT_OK;
    return status;
}

const glint_plan *glint_renderer_plan(const glint_renderer *renderer)
{
    return &renderer->shown.plan;
}

const glint_bvh_report *glint_renderer_bvh(const glint_renderer *renderer)
{
    return &renderer->shown.bvh;
}

const glint_phases *glint_renderer_phases(const glint_renderer *renderer)
{
    return &renderer->phases;
}

glint_device_bytes glint_renderer_device_bytes(const glint_renderer *renderer)
{
    const glint_geometry_memory *geometry = &renderer->geometry;
    const glint_light_memory *light = &renderer->light;
    return (glint_device_bytes){
        .scene = glint_buffer_bytes(geometry->clusters) + glint_buffer_bytes(geometry->normals) +
                 glint_buffer_bytes(geometry->numbers) + glint_buffer_bytes(geometry->materials) +
                 glint_buffer_bytes(geometry->media),
        .tree = glint_buffer_bytes(geometry->nodes),
        .environment =
            glint_buffer_bytes(light->environment) + glint_buffer_bytes(light->irradiance),
        .frame = glint_pixels_bytes(&renderer->pixels) + glint_renderer_layers_bytes(renderer) +
                 glint_renderer_terms_bytes(renderer) +
                 glint_vertices_bytes(&renderer->shown.plan, renderer->shown.bvh.cluster_count),
    };
}

size_t glint_renderer_program_bytes(const glint_renderer *renderer)
{
    cl_program program = NULL;
    size_t bytes = 0; // for the one device that it was built for
    if (renderer->kernel == NULL ||
        clGetKernelInfo(renderer->kernel, CL_KERNEL_PROGRAM, sizeof program, &program, NULL) !=
            CL_SUCCESS ||
        clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof bytes, &bytes, NULL) !=
            CL_SUCCESS) {
        return 0;
    }
    return bytes;
}

void glint_renderer_free(glint_renderer *renderer)
{
    if (renderer == NULL) {
        return;
    }
    tear_down(renderer);
    glint_bvh_free(&renderer->shown.tree);
    glint_bvh_free(&renderer->next.tree);
    free(renderer);
}
