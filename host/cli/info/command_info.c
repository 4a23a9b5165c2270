// Implements glint info: prints what a scene holds, and which kernel features it needs and why.
// Compiles nothing.
#include "cli/commands.h"
#include "cli/common/options.h"

#include "accel/bvh.h"
#include "accel/bvh_build.h"
#include "cli/common/inputs.h"
#include "device/device.h"
#include "render/general.h"
#include "render/plan_make.h"
#include "render/plan_tree.h"
#include "render/view.h"
#include "report/frame/inventory.h"
#include "scene/shape/digits.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define LIST_MAX 20 // printed entries of a list; --json has all

// The options of glint info.
typedef struct info_request {
    glint_input_request inputs; // first: the offsets in the shared tables refer to it
    bool json;
} info_request;

static const glint_option output_options[] = {
    {GLINT_OPTION_HEADING, .help = "Output"},
    {GLINT_OPTION_FLAG, .name = "json", .help = "Print JSON, with everything, instead of text.",
     .offset = offsetof(info_request, json)},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {output_options,         glint_input_options,
                                             glint_view_options,     glint_size_options,
                                             glint_settings_options, NULL};

// The data of a run. Zero is valid.
typedef struct info_work {
    glint_inputs inputs;
    glint_topology topology;
    glint_solids solids;
    glint_bvh bvh;
    glint_device *device;
    glint_plan plan;
    bool has_plan;
    glint_error plan_failure;
    char *json;
} info_work;

static void print_more(size_t count)
{
    if (count > LIST_MAX) {
        printf("  … and %zu more (--json lists all)\n", count - LIST_MAX);
    }
}

static const char *name_or_none(const char *name)
{
    return name != NULL ? name : "(no name)";
}

static void print_scene(const glint_scene *scene, const glint_topology *topology)
{
    size_t closed = 0;
    size_t convex = 0;
    for (size_t i = 0; i < topology->component_count; i++) {
        closed += topology->components[i].closed;
        convex += topology->components[i].convex;
    }
    printf("Scene %s\n", scene->path);
    printf("  %zu triangles, %zu instances, %zu materials, %zu cameras\n", scene->triangle_count,
           scene->instance_count, scene->material_count, scene->camera_count);
    if (scene->triangle_count > 0) {
        const double mib = 1 << 20;
        const size_t bytes = glint_scene_bytes(scene);
        printf("  memory: %.1f MiB, and up to %.1f MiB to build the tree\n", (double)bytes / mib,
               (double)(scene->triangle_count * GLINT_BVH_BYTES_WHILE_BUILT) / mib);
        if (scene->textures != NULL) {
            printf("  %zu texture images, %.1f MiB with their levels (--texture-size reduces "
                   "them)\n",
                   scene->textures->count, (double)glint_textures_bytes(scene->textures) / mib);
        }
        printf("  bounds (%g, %g, %g) to (%g, %g, %g) m\n", scene->low.x, scene->low.y,
               scene->low.z, scene->high.x, scene->high.y, scene->high.z);
        printf("  %zu connected surfaces: %zu closed, %zu proved convex; %zu boundary edges\n",
               topology->component_count, closed, convex, topology->boundary_edges);
    }
    printf("  left out: %zu point primitives, %zu line primitives, %zu triangles without area\n",
           scene->skipped_points, scene->skipped_lines, scene->degenerate_triangles);
}

static void print_contacts(const glint_scene *scene, const glint_solids *solids)
{
    if (solids->contact_count > 0) {
        printf("\nSolids that meet\n");
    }
    for (size_t i = 0; i < solids->contact_count && i < LIST_MAX; i++) {
        const glint_contact *contact = &solids->contacts[i];
        const glint_instance *there = &scene->instances[contact->instances[contact->there]];
        const char *material = scene->materials[there->material].name;
        char text[GLINT_CONTACT_TEXT];
        glint_contact_describe(scene, contact, text, sizeof text);
        printf("  %s: where both are it is %s%s\n", text, name_or_none(material),
               contact->is_guess ? ", which has less volume" : "");
    }
    print_more(solids->contact_count);
}

static void print_lights(const glint_scene *scene)
{
    if (scene->light_count > 0) {
        printf("\nLights\n");
    }
    for (size_t i = 0; i < scene->light_count && i < LIST_MAX; i++) {
        const glint_punctual_light *light = &scene->lights[i];
        printf("  %s (node %d): %s, (%g, %g, %g) %s", name_or_none(light->name), light->node_index,
               glint_punctual_kind_name(light->kind), light->color[0], light->color[1],
               light->color[2], light->kind == GLINT_PUNCTUAL_DIRECTIONAL ? "lx" : "cd");
        if (isfinite(light->range)) {
            printf(", range %g m", light->range);
        }
        if (light->kind == GLINT_PUNCTUAL_SPOT) {
            printf(", cone %g to %g degrees", light->inner_angle * 180 / GLINT_PI,
                   light->outer_angle * 180 / GLINT_PI);
        }
        printf("\n");
    }
    print_more(scene->light_count);
}

static void print_motion(const glint_motion *motion)
{
    const struct {
        bool moves;
        const char *what;
    } parts[] = {{motion->moves_triangles, "objects"},
                 {motion->moves_cameras, "cameras"},
                 {motion->moves_lights, "lights"}};
    const char *before = NULL;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (parts[i].moves && before == NULL) {
            printf("  animation %s: %g s, moves ", name_or_none(motion->clip), motion->duration);
        }
        if (parts[i].moves) {
            printf("%s%s", before != NULL ? before : "", parts[i].what);
            before = " and ";
        }
    }
    if (before != NULL) {
        printf(" (shown at its beginning)\n");
    }
}

static void print_maps(const glint_material *material)
{
    const char *before = "; textures: ";
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        if (material->textures[slot].image != 0) {
            printf("%s%s", before, glint_texture_slot_name((glint_texture_slot)slot));
            before = ", ";
        }
    }
    if (material->has_vertex_colors) {
        printf("; colours at vertices");
    }
    const glint_lobes lobes = glint_material_lobes(material);
    if (lobes.masked) {
        printf("; alpha cut off at %g", (double)material->alpha_cutoff);
    } else if (lobes.covers) {
        printf("; alpha is coverage");
    }
}

// Prints the material extensions of glass and of reflecting surfaces.
static void print_layers(const glint_material *material)
{
    const glint_lobes lobes = glint_material_lobes(material);
    if (lobes.dispersion) {
        printf(", dispersion %g", (double)material->dispersion);
    }
    if (lobes.specular) {
        printf(", specular %g (%g, %g, %g)", (double)material->specular,
               (double)material->specular_color[0], (double)material->specular_color[1],
               (double)material->specular_color[2]);
    }
    if (lobes.brushed) {
        printf(", anisotropy %g turned by %g", (double)material->anisotropy,
               (double)material->anisotropy_rotation);
    }
    if (lobes.translucent) {
        const float *color = material->diffuse_transmission_color;
        printf(", diffuse transmission %g (%g, %g, %g)", (double)material->diffuse_transmission,
               (double)color[0], (double)color[1], (double)color[2]);
    }
    if (lobes.sheen) {
        printf(", sheen (%g, %g, %g) of roughness %g", (double)material->sheen_color[0],
               (double)material->sheen_color[1], (double)material->sheen_color[2],
               (double)material->sheen_roughness);
    }
    if (lobes.iridescent) {
        const bool varies = material->textures[GLINT_TEXTURE_IRIDESCENCE_THICKNESS].image != 0;
        printf(", film %g of ior %g, ", (double)material->iridescence,
               (double)material->iridescence_ior);
        if (varies) {
            printf("%g to ", (double)material->iridescence_thickness[0]);
        }
        printf("%g nm", (double)material->iridescence_thickness[1]);
    }
    if (lobes.clearcoat) {
        printf(", clear coat %g of roughness %g", (double)material->clearcoat,
               (double)material->clearcoat_roughness);
    }
}

static void print_material(const glint_scene *scene, size_t index)
{
    const glint_material *material = &scene->materials[index];
    size_t triangles = 0;
    for (size_t i = 0; i < scene->instance_count; i++) {
        if (scene->instances[i].material == index) {
            triangles += scene->instances[i].triangle_count;
        }
    }
    printf("  %d %s: %s, %zu triangles; colour (%g, %g, %g), metallic %g, roughness %g",
           material->index, name_or_none(material->name), glint_material_kind(material), triangles,
           (double)material->base_color[0], (double)material->base_color[1],
           (double)material->base_color[2], (double)material->metallic,
           (double)material->roughness);
    if (material->transmission > 0) {
        printf(", transmission %g, ior %g", (double)material->transmission, (double)material->ior);
    }
    if (material->thickness > 0) {
        printf(", thickness %g", (double)material->thickness);
        if (isfinite(material->attenuation_distance)) {
            printf(", attenuation to (%g, %g, %g) in %g m", (double)material->attenuation_color[0],
                   (double)material->attenuation_color[1], (double)material->attenuation_color[2],
                   (double)material->attenuation_distance);
        }
    }
    if (material->priority != 0) {
        printf(", priority %g", (double)material->priority);
    }
    print_layers(material);
    if (material->mirror >= 0) {
        printf(", mirror %g", (double)material->mirror);
    }
    if (material->emission[0] > 0 || material->emission[1] > 0 || material->emission[2] > 0) {
        printf(", emission (%g, %g, %g)", (double)material->emission[0],
               (double)material->emission[1], (double)material->emission[2]);
    }
    print_maps(material);
    printf("\n");
}

static void print_lists(const glint_scene *scene)
{
    printf("\nMaterials\n");
    for (size_t i = 0; i < scene->material_count && i < LIST_MAX; i++) {
        print_material(scene, i);
    }
    print_more(scene->material_count);
    printf("\nInstances\n");
    for (size_t i = 0; i < scene->instance_count && i < LIST_MAX; i++) {
        const glint_instance *instance = &scene->instances[i];
        printf("  %s (node %d): %zu triangles of material %d\n", name_or_none(instance->node),
               instance->node_index, instance->triangle_count,
               scene->materials[instance->material].index);
    }
    print_more(scene->instance_count);
}

static void print_usages(const glint_scene *scene)
{
    if (scene->usage_count > 0) {
        printf("\nWhat the file uses\n");
    }
    for (int treatment = GLINT_RENDERED; treatment <= GLINT_IGNORED; treatment++) {
        for (size_t i = 0; i < scene->usage_count; i++) {
            if ((int)scene->usages[i].treatment == treatment) {
                printf("  %-13s %s\n", glint_treatment_name(scene->usages[i].treatment),
                       scene->usages[i].name);
            }
        }
    }
}

static void print_variants(const glint_scene *scene)
{
    if (scene->variant_count == 0) {
        return;
    }
    printf("\nVariants of the materials\n");
    for (size_t i = 0; i < scene->variant_count && i < LIST_MAX; i++) {
        printf("  %zu %s%s\n", i, name_or_none(scene->variants[i]),
               (int)i + 1 == scene->variant ? " (shown)" : "");
    }
    print_more(scene->variant_count);
    if (scene->variant == 0) {
        printf("  the plain materials are shown (--variant NAME shows one of these)\n");
    }
}

static void print_camera(const glint_camera *camera)
{
    if (camera->orthographic) {
        printf("orthographic, %g m high", 2 * camera->ymag);
    } else {
        printf("perspective, field of view %.4g° (vertical)", camera->yfov * 180 / GLINT_PI);
    }
    printf(", at (%g, %g, %g), looking along (%.3g, %.3g, %.3g)\n", camera->eye.x, camera->eye.y,
           camera->eye.z, 0 - camera->back.x, 0 - camera->back.y, 0 - camera->back.z);
}

static void print_cameras(const glint_scene *scene, const glint_view_request *view,
                          const glint_camera *chosen)
{
    const bool is_made = scene->camera_count == 0 && !view->eye.is_given;
    printf("\nCameras\n");
    for (size_t i = 0; i < scene->camera_count && i < LIST_MAX; i++) {
        printf("  %zu %s: ", i, name_or_none(scene->cameras[i].name));
        print_camera(&scene->cameras[i]);
    }
    print_more(scene->camera_count);
    printf("  used%s%s: ", is_made ? " (it frames the scene)" : "", view->fit ? ", fitted" : "");
    print_camera(chosen);
}

static void print_environment(const glint_environment *environment)
{
    const char *layout = glint_layout_name(environment->layout);
    printf("\nEnvironment %s\n", environment->name);
    printf("  layout %s (%s)", layout != NULL ? layout : "unknown",
           environment->reason != NULL ? environment->reason : "built in");
    if (environment->source_width > 0) {
        printf(", %dx%d pixels", environment->source_width, environment->source_height);
    }
    printf("; held as a cube map of 6 x %d x %d texels\n", environment->radiance.edge,
           environment->radiance.edge);
    if (environment->mended_texels > 0) {
        printf("  %zu texels were not finite or negative, and are mended\n",
               environment->mended_texels);
    }
}

static void print_sight(const glint_plan *plan)
{
    const glint_sight *sight = &plan->sight;
    if (sight->depth > 0 && !plan->depth_is_exact) {
        printf("  no depth is exact from inside of the scene's bounds; from outside %d is: %s\n",
               sight->depth, sight->reason);
    } else if (sight->depth > 0) {
        printf("  depth %d is exact here: %s%s\n", sight->depth, sight->reason,
               sight->from_outside ? ", as the eye is outside of the scene's bounds" : "");
    } else if (sight->reason[0] != '\0') {
        printf("  no depth is proved to be exact: %s\n", sight->reason);
    }
    if (sight->exits_escape) {
        printf(
            "  what leaves the glass is not traced: it is closed, convex and alone, so that there "
            "is nothing but the environment\n");
    }
}

static void print_plan(const glint_subject *subject)
{
    const glint_plan *plan = subject->plan;
    printf("\nPlan\n");
    if (subject->device != NULL) {
        printf("  device: %s (%s)\n", subject->device->name, subject->device->platform);
    }
    if (plan == NULL) {
        printf("  none: %s\n", subject->plan_failure);
        return;
    }
    char text[512];
    glint_plan_describe(plan, text, sizeof text);
    printf("  %s\n", text);
    printf("  %d lanes: %s\n", plan->kernel_width, plan->width_reason);
    printf("  tiles of %d packet%s: %s\n", plan->tiles ? 16 : 1, plan->tiles ? "s" : "",
           plan->tiles_reason);
    print_sight(plan);
    printf("  secondary rays: %s\n", plan->secondary);
    printf("  %s texels: %s\n", plan->half_texels ? "half" : "float", plan->texels_reason);
    if (plan->stack_capacity > 0) {
        printf("  %d waiting branches a pixel: %s\n", plan->stack_capacity, plan->stack_reason);
    }
    const glint_kernel_kind general = glint_general_kernel_of(plan);
    printf("  kernels: %s\n",
           general != GLINT_KERNEL_SPECIAL
               ? glint_kernel_kind_name(general)
               : "special ones alone: no general kernel has all these features and sizes");
    for (int compiled = 1; compiled >= 0; compiled--) {
        printf("  %s\n", compiled ? "compiled in" : "left out");
        for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
            if (plan->features[i].compiled == (compiled == 1)) {
                printf("    %-16s %s (%s)\n", glint_feature_name((glint_feature)i),
                       glint_feature_meaning((glint_feature)i), plan->features[i].reason);
            }
        }
    }
}

static void print_tree(const glint_bvh_report *bvh)
{
    printf("  tree: %zu nodes, %zu clusters %.0f%% full, depth %d, cost %.1f\n", bvh->node_count,
           bvh->cluster_count, 100 * bvh->fill, bvh->depth, bvh->sah_cost);
    printf("  tree: %.1f MiB, %.1f bytes a triangle\n", (double)bvh->bytes / 0x1p20,
           bvh->bytes_per_triangle);
}

static void print_text(const glint_subject *subject, const glint_view_request *view)
{
    print_scene(subject->scene, subject->topology);
    print_motion(subject->motion);
    print_lists(subject->scene);
    print_contacts(subject->scene, subject->solids);
    print_usages(subject->scene);
    print_variants(subject->scene);
    print_lights(subject->scene);
    print_cameras(subject->scene, view, subject->camera);
    print_environment(subject->environment);
    print_plan(subject);
    printf("\nMemory\n  about %.1f MiB on the device\n",
           (double)glint_inventory_device_bytes(subject) / 0x1p20);
    if (subject->bvh != NULL) {
        print_tree(subject->bvh);
    }
    printf("\nWarnings\n");
    for (size_t i = 0; i < subject->warnings->count; i++) {
        printf("  %s\n", subject->warnings->texts[i]);
    }
    if (subject->warnings->count == 0) {
        printf("  none\n");
    }
}

// Opens the device and makes the plan. A missing device is part of the output, except if --device
// names one.
static glint_status make_plan(const info_request *request, info_work *work, glint_error *error)
{
    glint_status status =
        glint_device_open(request->inputs.device, &work->device, &work->plan_failure);
    if (status != GLINT_OK && request->inputs.device == NULL) {
        return GLINT_OK;
    }
    if (status != GLINT_OK) {
        return glint_fail(error, status, "%s", work->plan_failure.message);
    }
    const glint_sight sight =
        glint_sight_find(&work->inputs.scene, &work->topology,
                         glint_settings_heed_roughness(&request->inputs.settings));
    const glint_plan_inputs inputs = {
        .scene = &work->inputs.scene,
        .topology = &work->topology,
        .solids = &work->solids,
        .sight = &sight,
        .environment = &work->inputs.environment.radiance,
        .device = glint_device_capabilities(work->device),
        .settings = &request->inputs.settings,
    };
    status = glint_plan_make(&inputs, &work->plan, error);
    if (status != GLINT_OK) {
        return status;
    }
    const glint_stored_space space = glint_stored_space_of(&work->inputs.scene);
    glint_plan_suit(&work->plan, &space, &work->inputs.viewpoint.camera);
    work->has_plan = true;
    return glint_plan_build_tree(&work->plan, &work->inputs.scene, &work->bvh, error);
}

static glint_status gather(const info_request *request, info_work *work, glint_error *error)
{
    glint_progress_display display;
    glint_progress_begin(&display, GLINT_PROGRESS_NONE);
    TRY(glint_inputs_load(&request->inputs, &display, &work->inputs, error));
    const glint_scene *scene = &work->inputs.scene;
    TRY(glint_topology_find(scene, &work->topology, error));
    TRY(glint_solids_find(scene, &work->topology, &work->solids, error));
    glint_solids_remarks remarks;
    glint_solids_remark(scene, &work->topology, &work->solids, &remarks);
    glint_solids_warn(scene, &remarks, &work->inputs.warnings);
    glint_coarse_places_warn(scene, &work->inputs.viewpoint.camera, request->inputs.settings.height,
                             &work->inputs.warnings);
    return make_plan(request, work, error);
}

static glint_status print(const info_request *request, info_work *work, glint_error *error)
{
    const glint_subject subject = {
        .scene = &work->inputs.scene,
        .topology = &work->topology,
        .solids = &work->solids,
        .overrides = &request->inputs.overrides,
        .motion = &work->inputs.motion,
        .environment = &work->inputs.environment,
        .camera = &work->inputs.viewpoint.camera,
        .settings = &request->inputs.settings,
        .device = work->device != NULL ? glint_device_capabilities(work->device) : NULL,
        .plan = work->has_plan ? &work->plan : NULL,
        .plan_failure = work->plan_failure.message,
        .bvh = work->has_plan ? &work->bvh.report : NULL,
        .warnings = &work->inputs.warnings,
    };
    if (!request->json) {
        print_text(&subject, &request->inputs.view);
        return GLINT_OK;
    }
    TRY(glint_inventory_json(&subject, &work->json, error));
    fputs(work->json, stdout);
    return GLINT_OK;
}

static void set_defaults(void *request)
{
    glint_input_request_default(&((info_request *)request)->inputs);
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    info_request *request = context;
    request->inputs.scene = arguments->positionals[0];
    info_work work = {0};
    glint_status status;
    TRY_OR(cleanup, status, glint_input_request_finish(&request->inputs, error));
    TRY_OR(cleanup, status, gather(request, &work, error));
    TRY_OR(cleanup, status, print(request, &work, error));
cleanup:
    free(work.json);
    glint_bvh_free(&work.bvh);
    glint_topology_free(&work.topology);
    glint_solids_free(&work.solids);
    glint_error_free(&work.plan_failure);
    glint_device_close(work.device);
    glint_inputs_free(&work.inputs);
    return status;
}

const glint_command glint_command_info = {
    .name = "info",
    .summary = "what a scene holds, and what would be compiled for it",
    .synopsis = "SCENE [options]",
    .description = "Prints the contents of the scene and of the environment, and the plan: which "
                   "features of the kernels would be compiled, and why. It compiles nothing. "
                   "Without an OpenCL device it prints no plan.",
    .examples = "  glint info scenes/gallery.gltf\n"
                "  glint info car.glb --env studio.hdr --depth 2 --json\n",
    .groups = groups,
    .positional = "SCENE",
    .request_size = sizeof(info_request),
    .set_defaults = set_defaults,
    .run = run,
};
