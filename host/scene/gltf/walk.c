// Walks the chosen nodes at one time. See walk.h.
#include "scene/gltf/walk.h"

#include "base/memory.h"
#include "scene/gltf/lights.h"
#include "scene/gltf/notes.h"

#include <stdlib.h>
#include <string.h>

static const size_t most_draws = (size_t)1 << 22;

static glint_status refuse_draws(glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT,
                      "more than %zu primitives would be drawn (split the scene)", most_draws);
}

// ---- Instances ----------------------------------------------------------------------------------

glint_status glint_instances_find(const glint_load *load, int node, size_t drawn,
                                  glint_instances *instances, glint_error *error)
{
    static const double no_move[] = {0, 0, 0}, no_turn[] = {0, 0, 0, 1}, no_scale[] = {1, 1, 1};
    static const double *const neutral[] = {no_move, no_turn, no_scale};
    const glint_document_node *source = &load->document.nodes[node];
    const size_t primitives = load->document.meshes[source->mesh].primitives.count;
    const size_t most = (most_draws - drawn) / (primitives > 0 ? primitives : 1);
    glint_array arrays[3];
    *instances = (glint_instances){0};
    for (int i = 0; i < 3; i++) {
        arrays[i] = glint_array_open(&load->document, source->instances[i]);
        instances->count = arrays[i].count > instances->count ? arrays[i].count : instances->count;
    }
    if (most == 0 || instances->count > most) { // before any is made: a small file can ask for many
        return refuse_draws(error);
    }
    instances->places = glint_allocate(instances->count, sizeof *instances->places);
    if (instances->places == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i < instances->count; i++) {
        double parts[3][4];
        for (int k = 0; k < 3; k++) {
            const size_t numbers = k == 1 ? 4 : 3;
            memcpy(parts[k], neutral[k], numbers * sizeof(double));
            if (arrays[k].count > 0) {
                glint_array_numbers(&arrays[k], i, numbers, parts[k]);
            }
        }
        instances->places[i] = glint_matrix_of_parts(parts[0], parts[1], parts[2]);
    }
    return GLINT_OK;
}

// ---- Draws --------------------------------------------------------------------------------------

static void tally_primitive(glint_load *load, size_t index, bool lacks_joints)
{
    const glint_primitive *primitive = &load->primitives.all[index];
    char place[GLINT_PRIMITIVE_PLACE];
    (void)glint_primitive_place(primitive, place);
    glint_notes_tally(&load->document, load->document.primitives[index].notes, place, &load->tally);
    const glint_text fault = load->document.primitives[index].mapping_fault;
    if (load->variant >= 0 && fault != 0) {
        glint_tally_add_once(&load->tally, glint_load_text(load, fault), place);
    }
    if (primitive->left_over > 0) {
        glint_tally_add_once(&load->tally,
                             "the last vertices make no whole triangle and are left out", place);
    }
    if (lacks_joints) {
        glint_tally_add(&load->tally,
                        "a skin does not move it, as it has no JOINTS_0; its node places it",
                        place);
    }
}

static glint_status add_draw(glint_load *load, glint_draw draw, glint_error *error)
{
    if (!glint_make_room((void **)&load->draws, load->draw_count, &load->draw_capacity,
                         sizeof *load->draws)) {
        return glint_fail_memory(error, "the scene");
    }
    load->draws[load->draw_count++] = draw;
    return GLINT_OK;
}

// Draws a primitive at the node's place, `draw`, or at each of its instances there.
static glint_status draw_primitive(glint_load *load, size_t index, glint_draw draw,
                                   const glint_instances *instances, glint_error *error)
{
    draw.primitive = &load->primitives.all[index];
    const int skin = load->document.nodes[draw.node].skin;
    const glint_stand stand = glint_poses_stand(&load->poses, draw.shape, skin, &draw.to_world);
    if (stand.is_hidden) {
        load->hides_any = true;
        return GLINT_OK;
    }
    if (draw.primitive->mode < GLINT_MODE_TRIANGLES) {
        *(draw.primitive->mode == GLINT_MODE_POINTS ? &load->skipped_points
                                                    : &load->skipped_lines) +=
            instances->count > 0 ? instances->count : 1;
        return GLINT_OK;
    }
    const bool lacks_joints = skin >= 0 && draw.shape != NULL && draw.shape->bones == NULL;
    tally_primitive(load, index, lacks_joints);
    draw.to_world = stand.to_world;
    if (draw.shape != NULL && !glint_shape_deforms(draw.shape)) {
        draw.shape = NULL; // it is the file's own
    }
    for (size_t i = 0; i < instances->count; i++) {
        draw.to_world = glint_mat4_multiply(&stand.to_world, &instances->places[i]);
        TRY(add_draw(load, draw, error));
    }
    return instances->count > 0 ? GLINT_OK : add_draw(load, draw, error);
}

static glint_status draw_mesh(glint_load *load, size_t visit, glint_error *error)
{
    const int index = load->visits.all[visit].node;
    const glint_run primitives = glint_load_primitives(load, visit);
    glint_shape *shapes;
    glint_instances instances;
    TRY(glint_poses_shapes(&load->poses, index, &shapes, error));
    glint_status status = glint_instances_find(load, index, load->draw_count, &instances, error);
    for (uint32_t i = 0; status == GLINT_OK && i < primitives.count; i++) {
        const glint_draw draw = {.node = index,
                                 .to_world = load->placed[visit],
                                 .shape = shapes == NULL ? NULL : &shapes[i]};
        status = draw_primitive(load, primitives.first + i, draw, &instances, error);
    }
    free(instances.places);
    return status;
}

// ---- Cameras ------------------------------------------------------------------------------------

static glint_status add_camera(glint_load *load, size_t visit, glint_scene *scene,
                               glint_error *error)
{
    const glint_document_node *node = glint_load_node(load, visit);
    const glint_document_camera *source = &load->document.cameras[node->camera];
    glint_camera camera = {0};
    // A camera that is lost for some time keeps its place in the list.
    camera.is_lost = !glint_camera_from_matrix(&load->placed[visit], &camera);
    if (camera.is_lost && load->clips.count == 0) {
        char where[GLINT_WHERE];
        glint_tally_add(
            &load->tally,
            "the camera has no direction (its scale is 0, or not finite) and is left out",
            glint_node_place(&load->document, load->visits.all[visit].node, where));
        return GLINT_OK;
    }
    glint_notes_tally(&load->document, source->notes, "", &load->tally);
    camera.orthographic = source->is_orthographic != 0;
    *(camera.orthographic ? &camera.ymag : &camera.yfov) = source->size;
    bool is_short = false;
    camera.name = glint_name_copy(
        glint_load_text(load, node->name != 0 ? node->name : source->name), &is_short);
    scene->cameras[scene->camera_count++] = camera;
    return is_short ? glint_fail_memory(error, "the scene") : GLINT_OK;
}

// ---- All ----------------------------------------------------------------------------------------

static bool any_joint_moves(const glint_load *load, const glint_document_skin *skin)
{
    for (uint32_t j = 0; j < skin->joints.count; j++) {
        const ptrdiff_t visit = load->visits.of[load->document.joints[skin->joints.first + j]];
        if (visit >= 0 && load->visits.all[visit].moves) {
            return true;
        }
    }
    return false;
}

// True if the node itself places a primitive of its mesh; joints place the other primitives.
static bool places_any(const glint_load *load, const glint_document_node *node)
{
    const glint_run primitives = load->document.meshes[node->mesh].primitives;
    for (uint32_t i = 0; i < primitives.count; i++) {
        if (load->primitives.all[primitives.first + i].influences.count == 0) {
            return true;
        }
    }
    return node->skin < 0;
}

glint_status glint_walk_survey(glint_load *load, glint_error *error)
{
    bool *skin_moves = glint_allocate(load->document.skins_count, sizeof *skin_moves);
    load->placed = glint_allocate(load->visits.count, sizeof *load->placed);
    if (skin_moves == NULL || load->placed == NULL) {
        free(skin_moves);
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i < load->document.skins_count; i++) {
        skin_moves[i] = any_joint_moves(load, &load->document.skins[i]);
    }
    for (size_t i = 0; i < load->visits.count; i++) {
        glint_visit *visit = &load->visits.all[i];
        const glint_document_node *node = glint_load_node(load, i);
        if (!visit->is_shown) {
            continue;
        }
        load->moves_cameras = load->moves_cameras || (visit->moves && node->camera >= 0);
        load->moves_lights = load->moves_lights || (visit->moves && node->light >= 0);
        if (node->mesh >= 0) {
            const glint_curve *weights =
                glint_clips_curve(&load->clips, visit->node, GLINT_PROPERTY_WEIGHTS);
            visit->deforms = (weights != NULL && glint_curve_moves(weights)) ||
                             (node->skin >= 0 && skin_moves[node->skin]);
            load->moves_triangles =
                load->moves_triangles || visit->deforms || (visit->moves && places_any(load, node));
        }
    }
    free(skin_moves);
    return GLINT_OK;
}

// Allocates the scene's cameras and lights, enough for all nodes that it shows.
static glint_status allocate(const glint_load *load, glint_scene *scene, glint_error *error)
{
    size_t cameras = 0, lights = 0;
    for (size_t i = 0; i < load->visits.count; i++) {
        const glint_document_node *node = glint_load_node(load, i);
        cameras += load->visits.all[i].is_shown && node->camera >= 0 ? 1 : 0;
        lights += load->visits.all[i].is_shown && node->light >= 0 ? 1 : 0;
    }
    scene->cameras = glint_allocate(cameras, sizeof *scene->cameras);
    scene->lights = glint_allocate(lights, sizeof *scene->lights);
    return scene->cameras != NULL && scene->lights != NULL ? GLINT_OK
                                                           : glint_fail_memory(error, "the scene");
}

glint_status glint_walk(glint_load *load, double time, glint_scene *scene, glint_error *error)
{
    load->draw_count = load->skipped_points = load->skipped_lines = 0;
    load->hides_any = false;
    for (size_t i = 0; i < load->visits.count; i++) {
        load->placed[i] = glint_visit_place(&load->visits, i, time, load->placed);
    }
    glint_poses_begin(&load->poses, time, load->placed);
    TRY(allocate(load, scene, error));
    for (size_t i = 0; i < load->visits.count; i++) {
        const glint_document_node *node = glint_load_node(load, i);
        if (!load->visits.all[i].is_shown) {
            load->hides_any = load->hides_any || node->mesh >= 0;
            continue;
        }
        char where[GLINT_WHERE];
        if (node->notes.count > 0) {
            (void)glint_node_place(&load->document, load->visits.all[i].node, where);
            glint_notes_tally(&load->document, node->notes, where, &load->tally);
        }
        if (node->camera >= 0) {
            TRY(add_camera(load, i, scene, error));
        }
        if (node->light >= 0) {
            TRY(glint_light_add(load, i, scene, error));
        }
        if (node->mesh >= 0) {
            TRY(draw_mesh(load, i, error));
        }
    }
    scene->skipped_points = load->skipped_points;
    scene->skipped_lines = load->skipped_lines;
    return GLINT_OK;
}
