// Prepares a scene without the device. See prepared_scene.h.
#include "render/prepared_scene.h"

#include "accel/bvh_build.h"
#include "base/clock.h"
#include "render/plan_device.h"
#include "render/plan_make.h"
#include "render/plan_tree.h"
#include "scene/shape/topology.h"

static bool has_solids(const glint_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        if (glint_material_lobes(&scene->materials[i]).solid) {
            return true;
        }
    }
    return false;
}

// Finds the topology only if solids may nest, or if it may help a proof about paths. For millions
// of triangles it takes seconds.
glint_status glint_prepared_scene_plan(glint_prepared_scene *p, const glint_plan_inputs *inputs,
                                       glint_error *error)
{
    double clock = glint_now_ms();
    const glint_scene *scene = inputs->scene;
    glint_topology topology = {0};
    const bool sees = glint_plan_may_heed_sight(inputs->settings);
    const bool rough = glint_settings_heed_roughness(inputs->settings);
    const bool solids = has_solids(scene);
    // Find the topology and the solids.
    if (scene->moves && solids) {
        TRY(glint_topology_find_solids(scene, &topology, error));
    } else if (!scene->moves && (solids || (sees && glint_sight_wants_topology(scene, rough)))) {
        TRY(glint_topology_find(scene, &topology, error));
    }
    glint_solids found = {0};
    glint_status status = GLINT_OK;
    if (solids) {
        TRY_OR(cleanup, status, glint_solids_find(scene, &topology, &found, error));
    }
    // Prove what paths can meet.
    const glint_topology none = {0}; // no proofs for a scene that moves
    const glint_sight sight =
        sees ? glint_sight_find(scene, scene->moves ? &none : &topology, rough) : (glint_sight){0};
    // Make the plan, and keep it only if nothing failed.
    glint_plan_inputs all = *inputs;
    all.topology = &topology;
    all.solids = &found;
    all.sight = &sight;
    glint_plan plan;
    TRY_OR(cleanup, status, glint_plan_make(&all, &plan, error));
    p->plan = plan;
    p->sight = sight;
    glint_solids_free(&p->solids);
    p->solids = found;
    found = (glint_solids){0};
cleanup:
    glint_topology_free(&topology);
    glint_solids_free(&found);
    p->analysis_ms = glint_lap_ms(&clock);
    return status;
}

// The smallest power of two that holds what the tree needs, so that few sizes are compiled: nearly
// always the least.
static int traversal_stack(int need)
{
    int size = GLINT_TRAVERSAL_STACK_LEAST;
    while (size < need) {
        size *= 2;
    }
    return size;
}

// A refitted tree is worse than a new one. A new tree is built if the boxes grew by this factor.
// Either the sum of all boxes grew, as when bodies that shared boxes fly apart. Or the sum relative
// to the root's box grew, as when bodies move into each other. A growth of a quarter, as when a
// body turns by 45 degrees, had no measurable effect on tracing times.
#define REFIT_GROWTH 1.5

static glint_status build_or_refit(glint_prepared_scene *p, const glint_scene *scene,
                                   glint_error *error)
{
    glint_bvh *tree = &p->tree;
    const glint_bvh_report *report = &tree->report;
    const double metres = scene->unit > 0 ? scene->unit * scene->unit : 1;
    if (glint_plan_refit_tree(&p->plan, scene, tree) &&
        report->sah_cost <= REFIT_GROWTH * p->built_cost &&
        report->sah_cost * report->root_area * metres <= REFIT_GROWTH * p->built_area) {
        return GLINT_OK;
    }
    glint_bvh_free(tree);
    TRY(glint_plan_build_tree(&p->plan, scene, tree, error));
    p->built_cost = report->sah_cost;
    p->built_area = report->sah_cost * report->root_area * metres;
    return GLINT_OK;
}

glint_status glint_prepared_scene_tree(glint_prepared_scene *p, const glint_scene *scene,
                                       glint_error *error)
{
    double clock = glint_now_ms();
    TRY(build_or_refit(p, scene, error));
    p->bvh = p->tree.report;
    p->plan.traversal_stack = traversal_stack(p->bvh.stack_need);
    p->bvh_ms = glint_lap_ms(&clock);
    return GLINT_OK;
}
