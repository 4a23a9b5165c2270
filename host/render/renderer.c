// Making renderers, and giving them other scenes. See frame.h.
#include "render/renderer.h"

#include "base/clock.h"
#include "device/program.h"
#include "kernels/layout.h"
#include "render/vertices.h"
#include "scene/topology.h"

#include <stdlib.h>
#include <string.h>

static bool has_solids(const glint_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        if (glint_material_lobes(&scene->materials[i]).solid) {
            return true;
        }
    }
    return false;
}

// The topology is found only where solids may nest, or where what paths meet may be proved of it:
// of millions of triangles it takes seconds.
static glint_status analyse(const glint_renderer_inputs *in, const glint_half_rounding *half,
                            glint_prepared_scene *p, glint_error *error)
{
    glint_topology topology = {0};
    const bool sees = glint_plan_may_heed_sight(in->settings);
    const bool wanted = !in->scene->moves &&
                        (has_solids(in->scene) || (sees && glint_sight_wants_topology(in->scene)));
    glint_status status = wanted ? glint_topology_find(in->scene, &topology, error) : GLINT_OK;
    if (status == GLINT_OK) {
        p->sight = sees ? glint_sight_find(in->scene, &topology) : (glint_sight){0};
        const glint_plan_inputs inputs = {
            .scene = in->scene,
            .topology = &topology,
            .sight = &p->sight,
            .environment = &in->environment->radiance,
            .device = glint_device_capabilities(in->device),
            .settings = in->settings,
            .half = half,
        };
        status = glint_plan_make(&inputs, &p->plan, error);
    }
    glint_topology_free(&topology);
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

static bool may_choose_half(const glint_settings *settings)
{
    return settings->texels == GLINT_TEXELS_HALF ||
           (settings->texels == GLINT_TEXELS_AUTO && settings->precision != GLINT_PRECISION_DOUBLE);
}

// Plan and tree of the scene, and whether the device can hold them. Of the renderer nothing is
// changed, and nothing is read that a frame or other settings change: frames may be rendered
// meanwhile. What other settings may want to know of half texels is none of its business.
static glint_status prepare(const glint_renderer *r, const glint_scene *scene,
                            glint_prepared_scene *prepared, glint_error *error)
{
    double clock = glint_now_ms();
    const glint_settings *settings = &r->first_settings;
    glint_renderer_inputs in = r->inputs;
    in.scene = scene;
    glint_upload_sizes sizes = {0};
    glint_status status =
        analyse(&in, may_choose_half(settings) ? &r->half : NULL, prepared, error);
    if (status == GLINT_OK) {
        int size[2];
        glint_settings_pixels(settings, size);
        status = glint_pixels_size(size[0], size[1], glint_plan_scalar_bytes(&prepared->plan),
                                   &sizes.frame, error);
    }
    if (status == GLINT_OK) {
        sizes.environment = prepared->plan.environment_bytes;
        sizes.layers = glint_layers_bytes(settings);
        sizes.terms = glint_terms_bytes(settings);
        sizes.doubts = glint_doubts_bytes(settings);
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

// What rounding to half does is found once, where the settings may choose that.
static glint_status measure_half(glint_renderer *r, const glint_settings *settings,
                                 glint_error *error)
{
    if (r->half_is_known || !may_choose_half(settings)) {
        return GLINT_OK;
    }
    glint_status status =
        glint_half_rounding_measure(&r->inputs.environment->radiance, &r->half, error);
    r->half_is_known = status == GLINT_OK;
    return status;
}

// Only the tree of a scene that moves is needed again.
static glint_status upload_geometry(glint_renderer *r, const glint_scene *scene, glint_error *error)
{
    glint_prepared_scene *shown = &r->shown;
    const glint_upload_inputs inputs = {
        .device = r->device, .scene = scene, .bvh = &shown->tree, .plan = &shown->plan};
    r->phases.analysis = shown->analysis_ms;
    r->phases.bvh = shown->bvh_ms;
    double clock = glint_now_ms();
    glint_geometry_memory fresh;
    glint_status status = glint_geometry_upload(&inputs, &fresh, error);
    if (status == GLINT_OK) {
        r->geometry = fresh;
        r->space = glint_stored_space_of(scene);
        status = glint_vertices_allocate(r, error);
    }
    if (status != GLINT_OK || !scene->moves) {
        glint_bvh_free(&shown->tree);
    }
    r->phases.upload = glint_lap_ms(&clock);
    return status;
}

// What has been prepared becomes what is shown, with the settings of the creation.
static glint_status show(glint_renderer *r, const glint_scene *scene, glint_error *error)
{
    r->settings = r->first_settings;
    r->plan = r->shown.plan;
    glint_status status = upload_geometry(r, scene, error);
    return status == GLINT_OK ? glint_equip(r, error) : status;
}

static glint_status check_proxy(const glint_renderer *r, glint_error *error)
{
    return r->settings.proxy && r->inputs.environment->proxy.kind == GLINT_PROXY_NONE
               ? glint_fail(error, GLINT_USAGE, "the environment has no proxy")
               : GLINT_OK;
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
    r->settings = r->first_settings = *inputs->settings;
    r->inputs = *inputs;
    r->inputs.settings = &r->first_settings;
    r->proxy = inputs->environment->proxy;
    glint_status status = check_proxy(r, error);
    if (status == GLINT_OK) {
        status = measure_half(r, &r->settings, error);
    }
    if (status == GLINT_OK) {
        status = prepare(r, inputs->scene, &r->shown, error);
    }
    if (status == GLINT_OK) {
        status = show(r, inputs->scene, error);
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

glint_status glint_renderer_suit(glint_renderer *r, const glint_camera *camera, glint_error *error)
{
    if (r->plan.sight.depth == 0) {
        return GLINT_OK;
    }
    const glint_plan before = r->plan;
    glint_plan_suit(&r->plan, &r->space, camera);
    if (has_same_options(&before, &r->plan)) {
        return GLINT_OK; // only the depth is another
    }
    r->bands_per_ms = 0;
    return glint_equip(r, error);
}

glint_status glint_renderer_set_settings(glint_renderer *r, const glint_settings *settings,
                                         glint_error *error)
{
    const glint_plan_inputs inputs = {.sight = &r->shown.sight,
                                      .environment = &r->inputs.environment->radiance,
                                      .device = glint_device_capabilities(r->device),
                                      .settings = settings,
                                      .half = &r->half};
    glint_plan plan = r->shown.plan;
    glint_status status =
        glint_settings_are_variation(settings, &r->first_settings)
            ? measure_half(r, settings, error)
            : glint_fail(error, GLINT_USAGE, "these settings need a renderer of their own");
    if (status == GLINT_OK) {
        status = glint_plan_vary(&inputs, &plan, error);
    }
    if (status != GLINT_OK) {
        r->kernel = NULL;
        return status;
    }
    r->settings = *settings;
    r->plan = plan;
    r->bands_per_ms = 0;
    return glint_equip(r, error);
}

glint_status glint_renderer_set_scene(glint_renderer *r, const glint_scene *scene,
                                      glint_error *error)
{
    const glint_plan before = r->shown.plan;
    const glint_sight sight = r->shown.sight;
    glint_geometry_take_back(&r->geometry, &r->shown.tree);
    r->has_failed = true;
    glint_status status = prepare(r, scene, &r->shown, error);
    if (status == GLINT_OK) {
        status = show(r, scene, error);
    } else {
        r->shown.plan = before;
        r->shown.sight = sight;
    }
    r->has_failed = status != GLINT_OK;
    return status;
}

glint_status glint_renderer_set_environment(glint_renderer *r, const glint_environment *environment,
                                            glint_error *error)
{
    const glint_plan before = r->shown.plan;
    r->inputs.environment = environment;
    r->proxy = environment->proxy;
    r->is_dark = true;
    r->is_next_ready = false; // its plan is another environment's
    r->half_is_known = false;
    r->settings = r->first_settings;
    const glint_plan_inputs inputs = {.environment = &environment->radiance,
                                      .device = glint_device_capabilities(r->device),
                                      .settings = &r->settings,
                                      .half = &r->half};
    glint_equipment_darken(&r->equipment);
    glint_status status = check_proxy(r, error);
    if (status == GLINT_OK) {
        status = measure_half(r, &r->settings, error);
    }
    if (status == GLINT_OK) {
        status = glint_plan_choose_texels(&inputs, &r->shown.plan, error);
    }
    if (status != GLINT_OK) {
        r->shown.plan = before;
        return status;
    }
    r->plan = r->shown.plan;
    status = glint_equip(r, error);
    r->is_dark = status != GLINT_OK;
    return status;
}

glint_status glint_renderer_prepare(glint_renderer *r, const glint_scene *scene, glint_error *error)
{
    glint_status status = prepare(r, scene, &r->next, error);
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
    glint_status status = show(r, scene, error);
    r->has_failed = status != GLINT_OK;
    return status;
}

const glint_plan *glint_renderer_plan(const glint_renderer *renderer)
{
    return &renderer->plan;
}

const glint_plan *glint_renderer_first_plan(const glint_renderer *renderer)
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
    return (glint_device_bytes){
        .scene = glint_buffer_bytes(geometry->clusters) + glint_buffer_bytes(geometry->normals) +
                 glint_buffer_bytes(geometry->numbers) + glint_buffer_bytes(geometry->materials) +
                 glint_buffer_bytes(geometry->media),
        .tree = glint_buffer_bytes(geometry->nodes),
        .environment = glint_equipment_light_bytes(&renderer->equipment),
        .frame = glint_pixels_bytes(&renderer->pixels) + glint_layers_bytes(&renderer->settings) +
                 glint_terms_bytes(&renderer->settings) + glint_doubts_bytes(&renderer->settings) +
                 glint_vertices_bytes(&renderer->plan, renderer->shown.bvh.cluster_count),
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
    cl_mem const buffers[] = {renderer->counters, renderer->layers, renderer->terms,
                              renderer->vertices, renderer->list,   renderer->doubts};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) {
        glint_buffer_release(buffers[i]);
    }
    glint_geometry_memory_free(&renderer->geometry);
    glint_equipment_free(&renderer->equipment);
    glint_pixels_free(&renderer->pixels);
    glint_bvh_free(&renderer->shown.tree);
    glint_bvh_free(&renderer->next.tree);
    free(renderer);
}
