// Builds and refits the trees of plans. See plan_tree.h.
#include "render/plan_tree.h"

#include "accel/bvh_build.h"
#include "scene/shape/complete_normals.h"

#include <stdlib.h>

static glint_bvh_inputs tree_inputs(const glint_plan *plan, const glint_scene *scene,
                                    const float *normals)
{
    const bool about_parts = plan->features[GLINT_FEATURE_LOCAL_ORIGINS].compiled;
    return (glint_bvh_inputs){
        .told = about_parts ? scene->parts.positions : NULL,
        .part_of = scene->parts.part_of,
        .anchors = (const float(*)[3])scene->parts.anchors,
        .indices = scene->indices,
        .positions = scene->positions,
        .normals = normals,
        .has_normals_by_corner = normals != scene->normals,
        .material_of = scene->material_of,
        .triangle_count = scene->triangle_count,
        .width = plan->bvh_width,
    };
}

// Finds the normals of a tree's clusters. If vertices are shaded, every vertex gets a normal.
static glint_status find_normals(const glint_plan *plan, const glint_scene *scene, float **own,
                                 const float **normals, glint_error *error)
{
    *own = NULL;
    *normals = scene->normals;
    if (!glint_plan_shades_vertices(plan)) {
        return GLINT_OK;
    }
    TRY(glint_scene_complete_normals(scene, own, error));
    *normals = *own;
    return GLINT_OK;
}

glint_status glint_plan_build_tree(const glint_plan *plan, const glint_scene *scene, glint_bvh *bvh,
                                   glint_error *error)
{
    float *own;
    const float *normals;
    TRY(find_normals(plan, scene, &own, &normals, error));
    const glint_bvh_inputs inputs = tree_inputs(plan, scene, normals);
    const glint_status status = glint_bvh_build(&inputs, bvh, error);
    free(own);
    return status;
}

bool glint_plan_refit_tree(const glint_plan *plan, const glint_scene *scene, glint_bvh *bvh)
{
    float *own;
    const float *normals;
    if (find_normals(plan, scene, &own, &normals, NULL) != GLINT_OK) {
        return false;
    }
    const glint_bvh_inputs inputs = tree_inputs(plan, scene, normals);
    const bool fits = glint_bvh_refit(&inputs, bvh);
    free(own);
    return fits;
}
