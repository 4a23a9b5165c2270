// Loads glTF: reads the file into a document, chooses what is shown, and makes the scene at a time.
// Below this file, messages do not name the scene's file.
#include "scene/gltf/open.h"

#include "base/memory.h"
#include "scene/gltf/find_file.h"
#include "scene/gltf/flatten.h"
#include "scene/gltf/load.h"
#include "scene/gltf/names.h"
#include "scene/gltf/reader.h"
#include "scene/gltf/sweep.h"
#include "scene/gltf/usage.h"
#include "scene/gltf/used_materials.h"
#include "scene/gltf/walk.h"
#include "scene/shape/tangents.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct glint_scene_source {
    glint_load load;
    glint_motion motion;
    glint_bounds swept;
};

static void free_load(glint_load *load)
{
    glint_poses_free(&load->poses);
    glint_visits_free(&load->visits);
    glint_images_free(&load->images);
    glint_clips_free(&load->clips);
    glint_primitives_free(&load->primitives);
    glint_document_close(&load->document);
    glint_tally_free(&load->tally);
    free(load->materials);
    free(load->inverse_bind);
    free(load->placed);
    free(load->draws);
    free(load->folder);
    free(load->path);
}

// ---- Opening ------------------------------------------------------------------------------------

static glint_status open_document(const char *path, int file, glint_load *load, glint_error *error)
{
    TRY(glint_document_open(file, &load->document, error));
    load->path = strdup(path);
    return load->path != NULL ? glint_find_folder(path, &load->folder, error)
                              : glint_fail_memory(error, "the scene");
}

static glint_status choose_variant(const char *name, glint_load *load, glint_error *error)
{
    load->variant = -1;
    if (name != NULL) {
        const glint_named_rows rows =
            GLINT_NAMED_ROWS(&load->document, variants, "material variant");
        size_t chosen;
        TRY(glint_name_find(&rows, name, &chosen, error));
        load->variant = (int)chosen;
    }
    return GLINT_OK;
}

static glint_status prepare(const glint_scene_options *options, glint_scene_source *source,
                            glint_error *error)
{
    glint_load *load = &source->load;
    TRY(choose_variant(options->variant, load, error));
    TRY(glint_primitives_open(&load->document, load->variant, &load->primitives, error));
    TRY(glint_skins_read(&load->document, &load->inverse_bind, error));
    TRY(glint_clips_read(&load->document, options->animation, &load->clips, &load->tally, error));
    load->visits.document = &load->document;
    load->visits.clips = &load->clips;
    TRY(glint_visits_choose(&load->visits, options->scene, &load->tally, error));
    const glint_pose_source poses = {&load->visits, &load->primitives, load->inverse_bind};
    TRY(glint_poses_init(&load->poses, &poses, error));
    TRY(glint_walk_survey(load, error));
    TRY(glint_materials_take(load, options, error));
    if (load->moves_triangles) {
        TRY(glint_sweep(load, &source->swept, error));
    }
    source->motion = (glint_motion){load->moves_triangles, load->moves_cameras, load->moves_lights,
                                    load->clips.duration, load->clips.name};
    glint_tally_mark(&load->tally);
    return GLINT_OK;
}

// Puts the file's name before the message of a failure. Returns the status.
static glint_status name_failure(const char *path, glint_status status, const glint_error *cause,
                                 glint_error *error)
{
    if (status != GLINT_OK) {
        (void)glint_fail(error, status, "%s: %s", path, cause->message);
    }
    return status;
}

glint_status glint_scene_open_document(const char *path, int file,
                                       const glint_scene_options *options,
                                       glint_scene_source **source, glint_error *error)
{
    static const glint_scene_options none;
    glint_error cause = {0};
    glint_scene_source *made = glint_allocate(1, sizeof *made);
    *source = NULL;
    if (made == NULL) {
        (void)glint_fail_memory(&cause, "the scene");
        return name_failure(path, GLINT_OUT_OF_MEMORY, &cause, error);
    }
    made->load.tally = GLINT_TALLY_EMPTY;
    glint_status status = open_document(path, file, &made->load, &cause);
    if (status == GLINT_OK) {
        status = prepare(options != NULL ? options : &none, made, &cause);
    }
    if (status != GLINT_OK) {
        glint_scene_close(made);
        return name_failure(path, status, &cause, error);
    }
    *source = made;
    return GLINT_OK;
}

glint_status glint_scene_open(const char *path, const glint_scene_options *options,
                              glint_scene_source **source, glint_error *error)
{
    glint_error cause = {0};
    int file;
    *source = NULL;
    const glint_status status = glint_reader_run(path, &file, &cause);
    if (status != GLINT_OK) {
        return name_failure(path, status, &cause, error);
    }
    const glint_status opened = glint_scene_open_document(path, file, options, source, error);
    (void)close(file);
    return opened;
}

const glint_motion *glint_scene_motion(const glint_scene_source *source)
{
    return &source->motion;
}

void glint_scene_close(glint_scene_source *source)
{
    if (source != NULL) {
        free_load(&source->load);
        free(source);
    }
}

// ---- A time -------------------------------------------------------------------------------------

// Stores the file's nodes, and the names of drawn nodes; the variants; the path.
static glint_status name_all(const glint_load *load, glint_scene *scene, glint_error *error)
{
    const glint_document *document = &load->document;
    bool is_short = false;
    scene->nodes = glint_allocate(document->nodes_count, sizeof *scene->nodes);
    scene->variants = glint_allocate(document->variants_count, sizeof *scene->variants);
    if (scene->nodes == NULL || scene->variants == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i < document->nodes_count; i++) {
        const glint_document_node *node = &document->nodes[i];
        scene->nodes[i].parent = node->parent;
        scene->nodes[i].name = glint_name_copy(glint_load_text(load, node->name), &is_short);
        scene->node_count++;
    }
    for (size_t i = 0; i < scene->instance_count; i++) {
        scene->instances[i].node = scene->nodes[scene->instances[i].node_index].name;
    }
    for (size_t i = 0; i < document->variants_count; i++) {
        const char *name = glint_load_text(load, document->variants[i].name);
        scene->variants[scene->variant_count++] = glint_name_copy(name, &is_short);
    }
    scene->variant = load->variant + 1;
    scene->path = glint_name_copy(load->path, &is_short);
    return is_short ? glint_fail_memory(error, "the scene") : GLINT_OK;
}

static glint_status fill(glint_scene_source *source, double time, glint_scene *scene,
                         glint_error *error)
{
    glint_load *load = &source->load;
    TRY(glint_walk(load, time, scene, error));
    TRY(glint_flatten(load, scene, error));
    TRY(name_all(load, scene, error));
    TRY(glint_materials_give(load, scene, error));
    scene->textures = glint_textures_share(load->images.textures);
    if (scene->attribute_set.tangents && !glint_scene_complete_tangents(scene)) {
        return glint_fail_memory(error, "the scene");
    }
    TRY(glint_usages_list(load, scene, error));
    scene->moves = load->moves_triangles;
    if (scene->moves) {
        scene->swept_low = source->swept.low;
        scene->swept_high = source->swept.high;
    }
    return GLINT_OK;
}

static void report(glint_load *load, glint_scene *scene, glint_warnings *warnings)
{
    const char *path = load->path;
    for (size_t i = 0; i < scene->material_count; i++) {
        scene->materials[i].warnings =
            glint_tally_lines_about(&load->tally, scene->materials[i].index);
    }
    glint_tally_report(&load->tally, path, warnings);
    if (scene->skipped_points + scene->skipped_lines > 0) {
        glint_warn(warnings,
                   "%s: %zu point and %zu line primitives are skipped (only triangles are "
                   "rendered)",
                   path, scene->skipped_points, scene->skipped_lines);
    }
    glint_material_overrides_warn(&load->overrides, scene->materials, scene->material_count, path,
                                  warnings);
    // Who hides all meshes means it.
    if (scene->triangle_count == 0 && !load->hides_any) {
        glint_warn(warnings, "%s: the scene has no triangles, only the environment will be seen",
                   path);
    }
}

glint_status glint_scene_at(glint_scene_source *source, double time, glint_scene *scene,
                            glint_warnings *warnings, glint_error *error)
{
    *scene = (glint_scene){0};
    glint_load *load = &source->load;
    glint_error cause = {0};
    const glint_status status = fill(source, time, scene, &cause);
    if (status == GLINT_OK) {
        report(load, scene, warnings);
    } else {
        glint_scene_free(scene);
    }
    glint_tally_rewind(&load->tally); // the next walk adds the same warnings again
    return name_failure(load->path, status, &cause, error);
}

glint_status glint_scene_load(const char *path, const glint_scene_options *options,
                              glint_scene *scene, glint_warnings *warnings, glint_error *error)
{
    *scene = (glint_scene){0};
    glint_scene_source *source = NULL;
    TRY(glint_scene_open(path, options, &source, error));
    const glint_status status = glint_scene_at(source, 0, scene, warnings, error);
    glint_scene_close(source);
    return status;
}

glint_status glint_scene_cameras_at(glint_scene_source *source, double time, glint_scene *scene,
                                    glint_error *error)
{
    glint_scene at = {0}; // only its cameras are used
    glint_error cause = {0};
    const glint_status status = glint_walk(&source->load, time, &at, &cause);
    if (status == GLINT_OK) {
        const glint_scene before = *scene;
        scene->cameras = at.cameras;
        scene->camera_count = at.camera_count;
        at.cameras = before.cameras;
        at.camera_count = before.camera_count;
    }
    glint_scene_free(&at);
    glint_tally_rewind(&source->load.tally);
    return name_failure(source->load.path, status, &cause, error);
}
