// Makes renderers and gives them other scenes, environments and settings. See frame.h.
#include "render/renderer.h"

#include "base/clock.h"
#include "render/plan_device.h"
#include "render/plan_make.h"
#include "render/vertices.h"

#include <stdlib.h>
#include <string.h>

// ---- Resources for a plan ----------------------------------------------------------------------

glint_scene_arguments glint_renderer_scene_arguments(const glint_renderer *r)
{
    const glint_geometry_memory *g = &r->scene.geometry;
    return (glint_scene_arguments){
        .nodes = g->nodes.buffer,
        .clusters = g->clusters.buffer,
        .normals = g->normals.buffer,
        .numbers = g->numbers.buffer,
        .materials = g->materials,
        .media = g->media,
        .solids = g->solids,
        .attributes = g->attributes,
        .textures = r->scene.textures.records,
        .texels = r->scene.textures.texels,
        .lights = g->lights,
        .environment = r->light.chosen.environment,
        .irradiance = r->light.chosen.irradiance,
        .lobes = r->light.chosen.lobes,
        .vertices = r->scene.vertices,
        .listed = r->target.buffers[GLINT_TARGET_LIST],
    };
}

glint_launcher glint_renderer_launcher(const glint_renderer *r)
{
    return (glint_launcher){.device = r->device,
                            .plan = &r->plan,
                            .kernels = r->kernels,
                            .scene = glint_renderer_scene_arguments(r),
                            .outputs = glint_target_arguments(&r->target)};
}

static glint_status find_kernels(glint_renderer *r, glint_error *error)
{
    double clock = glint_now_ms();
    const glint_kernel_request request = {r->device, r->kernel_dir, &r->plan, r->settings.kernels};
    glint_kernels *kernels;
    TRY(glint_kernel_cache_get(&r->cache, &request, &kernels, error));
    r->kernels = kernels;
    if (!kernels->have_run) {
        const glint_launcher launcher = glint_renderer_launcher(r);
        TRY(glint_kernels_warm_up(&request, &launcher, kernels, error));
        r->phases.kernel_build += glint_lap_ms(&clock);
    }
    return GLINT_OK;
}

// Fails if the device cannot hold the plan's environment and frames in addition to its current
// data.
static glint_status check_memory(const glint_renderer *r,
                                 const glint_content target[GLINT_TARGET_PARTS], glint_error *error)
{
    const glint_light *light = &r->light;
    const bool has_texels = light->texels[r->plan.half_texels].buffer != NULL;
    const size_t used = glint_device_scene_bytes(&r->scene) +
                        glint_device_scene_tree_bytes(&r->scene) +
                        glint_buffer_bytes(r->scene.vertices) + glint_light_bytes(light);
    glint_content contents[GLINT_TARGET_PARTS + 1] = {
        {"the environment", has_texels ? 0 : r->plan.environment_bytes, NULL}};
    memcpy(contents + 1, target, GLINT_TARGET_PARTS * sizeof *target);
    return glint_contents_check(r->device, contents, GLINT_TARGET_PARTS + 1, used, error);
}

// Finds or makes all data that the plan and the settings need.
static glint_status equip(glint_renderer *r, glint_error *error)
{
    const bool without_frames = r->state & GLINT_RENDERER_IS_WITHOUT_FRAMES;
    const size_t scalar = glint_plan_scalar_bytes(&r->plan);
    glint_content target[GLINT_TARGET_PARTS];
    r->kernels = NULL;
    TRY(glint_target_measure(&r->settings, scalar, target, error));
    TRY(check_memory(r, target, error));
    TRY(glint_light_choose(&r->light, &r->plan, without_frames, error));
    r->phases.irradiance = r->light.irradiance_ms;
    r->phases.cells = r->light.cells_ms;
    r->phases.upload = r->scene.upload_ms + r->light.upload_ms;
    TRY(glint_target_fit(&r->target, &r->settings, scalar, target, error));
    return without_frames ? GLINT_OK : find_kernels(r, error);
}

// ---- Scenes, environments and settings ---------------------------------------------------------

// Updates the state after the renderer got `what`. After a failure, it lacks `what`. After a
// success, it also has settings.
static glint_status note(glint_renderer *r, glint_renderer_state what, glint_status status)
{
    r->state =
        status == GLINT_OK ? r->state & ~(what | GLINT_RENDERER_LACKS_SETTINGS) : r->state | what;
    return status;
}

static glint_plan_inputs plan_inputs(const glint_renderer *r, const glint_settings *settings)
{
    return (glint_plan_inputs){
        .environment = &r->light.environment->radiance,
        .device = &r->device->capabilities,
        .settings = settings,
        .half = glint_light_may_be_half(settings) ? &r->light.half : NULL,
    };
}

// Checks before the tree is built that the device can hold the scene.
static glint_status check_scene_fits(const glint_renderer *r, const glint_scene *scene,
                                     const glint_plan *plan, glint_error *error)
{
    enum { ENVIRONMENT = GLINT_GEOMETRY_CONTENTS, TARGET };
    glint_content contents[TARGET + GLINT_TARGET_PARTS];
    glint_geometry_measure(scene, plan, contents);
    contents[ENVIRONMENT] = (glint_content){"the environment", plan->environment_bytes, NULL};
    TRY(glint_target_measure(&r->first_settings, glint_plan_scalar_bytes(plan), contents + TARGET,
                             error));
    return glint_contents_check(r->device, contents, sizeof contents / sizeof *contents, 0, error);
}

// Makes plan and tree of the scene, and checks that the device can hold them. Does not change the
// renderer, and reads nothing that a frame or other settings change. So frames may be rendered at
// the same time.
static glint_status prepare(const glint_renderer *r, const glint_scene *scene,
                            glint_prepared_scene *prepared, glint_error *error)
{
    glint_plan_inputs inputs = plan_inputs(r, &r->first_settings);
    inputs.scene = scene;
    TRY(glint_prepared_scene_plan(prepared, &inputs, error));
    TRY(check_scene_fits(r, scene, &prepared->plan, error));
    return glint_prepared_scene_tree(prepared, scene, error);
}

// Shows the prepared scene with the settings of the creation.
static glint_status show(glint_renderer *r, const glint_scene *scene, glint_error *error)
{
    const glint_prepared_scene *shown = &r->scene.shown;
    r->settings = r->first_settings;
    r->plan = shown->plan;
    r->phases.analysis = shown->analysis_ms;
    r->phases.bvh = shown->bvh_ms;
    TRY(glint_device_scene_upload(&r->scene, scene, error));
    return equip(r, error);
}

static glint_status prepare_and_show(glint_renderer *r, const glint_scene *scene,
                                     glint_error *error)
{
    TRY(prepare(r, scene, &r->scene.shown, error));
    return show(r, scene, error);
}

glint_status glint_renderer_set_scene(glint_renderer *r, const glint_scene *scene,
                                      glint_error *error)
{
    glint_device_scene_take_back(&r->scene);
    return note(r, GLINT_RENDERER_LACKS_SCENE, prepare_and_show(r, scene, error));
}

glint_status glint_renderer_prepare(glint_renderer *r, const glint_scene *scene, glint_error *error)
{
    r->scene.next_is_ready = false;
    TRY(prepare(r, scene, &r->scene.next, error));
    r->scene.next_is_ready = true;
    return GLINT_OK;
}

glint_status glint_renderer_set_prepared(glint_renderer *r, const glint_scene *scene,
                                         glint_error *error)
{
    if (!r->scene.next_is_ready) {
        return glint_fail(error, GLINT_USAGE, "no scene has been prepared");
    }
    glint_device_scene_swap(&r->scene);
    return note(r, GLINT_RENDERER_LACKS_SCENE, show(r, scene, error));
}

// Measures the properties of the environment that the creation's settings need.
static glint_status measure_light(glint_renderer *r, glint_error *error)
{
    if (r->first_settings.proxy && r->light.proxy.kind == GLINT_PROXY_NONE) {
        return glint_fail(error, GLINT_USAGE, "the environment has no proxy");
    }
    return glint_light_measure_half(&r->light, &r->first_settings, error);
}

static glint_status take_light(glint_renderer *r, glint_error *error)
{
    glint_plan plan = r->scene.shown.plan;
    r->settings = r->first_settings;
    TRY(measure_light(r, error));
    const glint_plan_inputs inputs = plan_inputs(r, &r->settings);
    TRY(glint_plan_choose_texels(&inputs, &plan, error));
    r->plan = r->scene.shown.plan = plan;
    return equip(r, error);
}

glint_status glint_renderer_set_environment(glint_renderer *r, const glint_environment *environment,
                                            glint_error *error)
{
    glint_light_set_environment(&r->light, environment);
    r->scene.next_is_ready = false; // its plan belongs to the old environment
    return note(r, GLINT_RENDERER_LACKS_LIGHT, take_light(r, error));
}

static glint_status take_settings(glint_renderer *r, const glint_settings *settings,
                                  glint_error *error)
{
    if (!glint_settings_are_variation(settings, &r->first_settings)) {
        return glint_fail(error, GLINT_USAGE, "these settings need a renderer of their own");
    }
    TRY(glint_light_measure_half(&r->light, settings, error));
    glint_plan_inputs inputs = plan_inputs(r, settings);
    inputs.sight = &r->scene.shown.sight;
    glint_plan plan = r->scene.shown.plan;
    TRY(glint_plan_vary(&inputs, &plan, error));
    r->settings = *settings;
    r->plan = plan;
    r->bands_per_ms = 0;
    return equip(r, error);
}

glint_status glint_renderer_set_settings(glint_renderer *r, const glint_settings *settings,
                                         glint_error *error)
{
    return note(r, GLINT_RENDERER_LACKS_SETTINGS, take_settings(r, settings, error));
}

static bool has_same_options(const glint_plan *a, const glint_plan *b)
{
    char options[2][GLINT_BUILD_OPTIONS_BYTES];
    glint_plan_build_options(a, options[0]);
    glint_plan_build_options(b, options[1]);
    return strcmp(options[0], options[1]) == 0;
}

glint_status glint_renderer_suit(glint_renderer *r, const glint_camera *camera, glint_error *error)
{
    if (r->plan.sight.depth == 0 && r->plan.box_count == 0) {
        return GLINT_OK;
    }
    const glint_plan before = r->plan;
    glint_plan_suit(&r->plan, &r->scene.space, camera);
    if (has_same_options(&before, &r->plan)) {
        return GLINT_OK; // only the depth changed
    }
    r->bands_per_ms = 0;
    return note(r, GLINT_RENDERER_LACKS_SETTINGS, equip(r, error));
}

// ---- The renderer ------------------------------------------------------------------------------

static glint_status fill(glint_renderer *r, const glint_renderer_inputs *inputs, glint_error *error)
{
    r->device = inputs->device;
    r->light.device = r->scene.device = r->target.device = inputs->device;
    r->kernel_dir = inputs->kernel_dir;
    r->settings = r->first_settings = *inputs->settings;
    r->state = inputs->without_frames ? GLINT_RENDERER_IS_WITHOUT_FRAMES : GLINT_RENDERER_IS_READY;
    glint_light_set_environment(&r->light, inputs->environment);
    TRY(measure_light(r, error));
    return prepare_and_show(r, inputs->scene, error);
}

glint_status glint_renderer_create(const glint_renderer_inputs *inputs, glint_renderer **renderer,
                                   glint_error *error)
{
    *renderer = NULL;
    glint_renderer *r = calloc(1, sizeof *r);
    if (r == NULL) {
        return glint_fail_memory(error, "the renderer");
    }
    const glint_status status = fill(r, inputs, error);
    if (status != GLINT_OK) {
        glint_renderer_free(r);
        return status;
    }
    *renderer = r;
    return GLINT_OK;
}

void glint_renderer_free(glint_renderer *renderer)
{
    if (renderer == NULL) {
        return;
    }
    glint_device_scene_free(&renderer->scene);
    glint_light_free(&renderer->light);
    glint_kernel_cache_free(&renderer->cache);
    glint_target_free(&renderer->target);
    free(renderer);
}

bool glint_renderer_wants_special(const glint_renderer *r)
{
    return r->settings.kernels == GLINT_KERNELS_AUTO && r->kernel_dir == NULL &&
           !r->special_failed && glint_renderer_kernels(r) != GLINT_KERNEL_SPECIAL;
}

void glint_renderer_take_special(glint_renderer *r)
{
    const glint_kernels *before = r->kernels;
    glint_error error = {0};
    if (!glint_renderer_wants_special(r)) {
        return;
    }
    if (find_kernels(r, &error) != GLINT_OK) {
        r->kernels = before; // the cache still has them: they are not its oldest
        r->special_failed = true;
        glint_error_free(&error);
    }
    if (r->kernels != before) {
        r->bands_per_ms = 0;
    }
}

const glint_plan *glint_renderer_plan(const glint_renderer *renderer)
{
    return &renderer->plan;
}

const glint_plan *glint_renderer_first_plan(const glint_renderer *renderer)
{
    return &renderer->scene.shown.plan;
}

const glint_bvh_report *glint_renderer_bvh(const glint_renderer *renderer)
{
    return &renderer->scene.shown.bvh;
}

const glint_phases *glint_renderer_phases(const glint_renderer *renderer)
{
    return &renderer->phases;
}

glint_device_bytes glint_renderer_device_bytes(const glint_renderer *r)
{
    return (glint_device_bytes){
        .scene = glint_device_scene_bytes(&r->scene),
        .tree = glint_device_scene_tree_bytes(&r->scene),
        .environment = glint_light_bytes(&r->light),
        .frame = glint_target_frame_bytes(&r->settings, glint_plan_scalar_bytes(&r->plan)) +
                 glint_vertices_bytes(&r->plan) * r->scene.shown.bvh.cluster_count,
    };
}

glint_kernel_kind glint_renderer_kernels(const glint_renderer *renderer)
{
    return renderer->kernels != NULL ? renderer->kernels->kind : GLINT_KERNEL_SPECIAL;
}
