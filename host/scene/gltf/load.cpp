// Loads glTF, from the file to the scene: read, check, walk, flatten. Turns every exception into a
// status.
//
// Limits: files of 4 GiB, buffers of 8 GiB, 2^27 triangles.
#include "scene/scene.h"

#include "scene/gltf/buffers.hpp"
#include "scene/gltf/check.hpp"
#include "scene/gltf/draco.hpp"
#include "scene/gltf/flatten.hpp"
#include "scene/gltf/material.hpp"
#include "scene/gltf/meshopt.hpp"
#include "scene/gltf/sweep.hpp"
#include "scene/gltf/usage.hpp"
#include "scene/gltf/used_materials.hpp"
#include "scene/gltf/variants.hpp"

#include <memory>
#include <new>
#include <string>
#include <utility>

namespace glint
{

namespace
{

void report(Load &load, glint_scene &scene, glint_warnings *warnings)
{
    const char *path = load.document.path.c_str();
    for (std::size_t i = 0; i < scene.material_count; i++) {
        scene.materials[i].warnings =
            glint_tally_lines_about(load.tally.get(), scene.materials[i].index);
    }
    glint_tally_report(load.tally.get(), path, warnings);
    if (scene.skipped_points + scene.skipped_lines > 0) {
        glint_warn(warnings,
                   "%s: %zu point and %zu line primitives are skipped (only triangles are "
                   "rendered)",
                   path, scene.skipped_points, scene.skipped_lines);
    }
    glint_material_overrides_warn(&load.overrides, scene.materials, scene.material_count, path,
                                  warnings);
    // Who hides all meshes means it.
    if (scene.triangle_count == 0 && !load.hides_any) {
        glint_warn(warnings, "%s: the scene has no triangles, only the environment will be seen",
                   path);
    }
}

// A scene of which only the cameras are used.
struct CameraScene {
    glint_scene scene = {};

    CameraScene() = default;
    CameraScene(const CameraScene &) = delete;
    CameraScene &operator=(const CameraScene &) = delete;
    ~CameraScene()
    {
        glint_scene_free(&scene);
    }
};

// Takes back the warnings of a walk: the next walk adds the same ones again.
class TallyRestorer
{
  public:
    explicit TallyRestorer(Tally &tally) : tally_(tally) {}
    TallyRestorer(const TallyRestorer &) = delete;
    TallyRestorer &operator=(const TallyRestorer &) = delete;
    ~TallyRestorer()
    {
        glint_tally_rewind(tally_.get());
    }

  private:
    Tally &tally_;
};

} // namespace

} // namespace glint

struct glint_scene_source {
    glint::Load load;
    glint_motion motion = {};
    glint::Bounds swept;
};

namespace glint
{

namespace
{

void fill(glint_scene_source &source, double time, glint_scene &scene)
{
    walk_scene(source.load, time, scene);
    flatten(source.load, scene);
    name_variants(source.load.model, scene);
    list_usages(source.load, scene);
    scene.path = copy_text(source.load.document.path);
    scene.moves = source.load.moves_triangles;
    if (scene.moves) {
        scene.swept_low = source.swept.low;
        scene.swept_high = source.swept.high;
    }
}

void open(const char *path, const glint_scene_options &options, glint_scene_source &source)
{
    Load &load = source.load;
    read_document(path, load.document);
    check_document(load.document, load.model);
    choose_variant(options.variant, load.model);
    read_buffers(load.document, load.model);
    unpack_views(load.model);
    decode_draco(load.model);
    settle_attributes(load.model);
    load.primitives = prepare_primitives(load.model, load.tally);
    load.skins = read_skins(load.model);
    load.clips = read_clips(load.document, load.model, options.animation, load.tally);
    choose_nodes(load, options.scene);
    read_used_materials(options, load);
    if (load.moves_triangles) {
        source.swept = sweep(load);
    }
    source.motion = {load.moves_triangles, load.moves_cameras, load.moves_lights,
                     load.clips.duration,
                     load.clips.name.empty() ? nullptr : load.clips.name.c_str()};
    glint_tally_mark(load.tally.get());
}

// Calls `work` and turns its exceptions into a status.
template <typename Work>
glint_status guard(const char *path, glint_error *error, Work work)
{
    try {
        work();
        return GLINT_OK;
    } catch (const refusal &refused) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s", path, refused.what());
    } catch (const shortage &lack) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY, "%s: %s", path, lack.what());
    } catch (const std::bad_alloc &) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY, "%s: not enough memory for the scene", path);
    } catch (const std::exception &unexpected) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be loaded: %s", path,
                          unexpected.what());
    } catch (...) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be loaded", path);
    }
}

} // namespace

} // namespace glint

glint_status glint_scene_open(const char *path, const glint_scene_options *options,
                              glint_scene_source **source, glint_error *error)
{
    const glint_scene_options none = {};
    *source = nullptr;
    return glint::guard(path, error, [&] {
        auto made = std::make_unique<glint_scene_source>();
        glint::open(path, options != nullptr ? *options : none, *made);
        *source = made.release();
    });
}

glint_status glint_scene_at(glint_scene_source *source, double time, glint_scene *scene,
                            glint_warnings *warnings, glint_error *error)
{
    *scene = {};
    const char *path = source->load.document.path.c_str();
    glint_status status = glint::guard(path, error, [&] {
        glint::TallyRestorer restorer(source->load.tally);
        glint::fill(*source, time, *scene);
        glint::report(source->load, *scene, warnings);
    });
    if (status != GLINT_OK) {
        glint_scene_free(scene);
    }
    return status;
}

glint_status glint_scene_load(const char *path, const glint_scene_options *options,
                              glint_scene *scene, glint_warnings *warnings, glint_error *error)
{
    *scene = {};
    glint_scene_source *source = nullptr;
    TRY(glint_scene_open(path, options, &source, error));
    const glint_status status = glint_scene_at(source, 0, scene, warnings, error);
    glint_scene_close(source);
    return status;
}

glint_status glint_scene_cameras_at(glint_scene_source *source, double time, glint_scene *scene,
                                    glint_error *error)
{
    return glint::guard(source->load.document.path.c_str(), error, [&] {
        glint::TallyRestorer restorer(source->load.tally);
        glint::CameraScene at;
        glint::walk_scene(source->load, time, at.scene);
        std::swap(at.scene.cameras, scene->cameras);
        std::swap(at.scene.camera_count, scene->camera_count);
    });
}

const glint_motion *glint_scene_motion(const glint_scene_source *source)
{
    return &source->motion;
}

void glint_scene_close(glint_scene_source *source)
{
    delete source;
}
