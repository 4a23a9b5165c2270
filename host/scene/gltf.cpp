// The glTF loader, from the file to the scene: read, check, let tinygltf load, walk, flatten.
// Whatever is thrown on the way ends here as a status.
//
// Limits: files of 4 GiB, buffers of 8 GiB, 2^27 triangles; textures, skins, morph targets and
// animations are not applied, which is said in the warnings.
#include "scene/gltf.h"

#include "scene/gltf_flatten.hpp"
#include "scene/gltf_walk.hpp"

#include <new>

namespace glint
{

namespace
{

void survey_animations(Load &load)
{
    const json &animations = objects_of(load.document.root, "animations");
    for (std::size_t i = 0; i < animations.size(); i++) {
        const json *name = member(animations[i], "name");
        std::string label =
            name != nullptr && name->is_string() ? " " + in_quotes(name->get<std::string>()) : "";
        load.tally.add("animations are not applied, the scene is shown at rest",
                       "animations[" + std::to_string(i) + "]" + label);
    }
}

void report(const Load &load, const glint_scene &scene, glint_warnings *warnings)
{
    const char *path = load.document.path.c_str();
    if (scene.skipped_points + scene.skipped_lines > 0) {
        glint_warn(warnings,
                   "%s: %zu point and %zu line primitives are skipped (only triangles are "
                   "rendered)",
                   path, scene.skipped_points, scene.skipped_lines);
    }
    load.tally.report(path, warnings);
    if (scene.triangle_count == 0) {
        glint_warn(warnings, "%s: the scene has no triangles, only the environment will be seen",
                   path);
    }
}

void load_scene(const char *path, const char *name, glint_scene &scene, glint_warnings *warnings)
{
    Load load;
    read_document(path, load.document);
    check_document(load.document, load.checked);
    read_buffers(load.document);
    load_model(load.document, load.model);
    load.primitives = prepare_primitives(load.document, load.model, load.tally);
    walk_scene(load, name, scene);
    survey_animations(load);
    flatten(load, scene);
    scene.path = copy_text(path);
    report(load, scene, warnings);
}

} // namespace

} // namespace glint

glint_status glint_gltf_load(const char *path, const glint_scene_options *options,
                             glint_scene *scene, glint_warnings *warnings, glint_error *error)
{
    try {
        glint::load_scene(path, options == nullptr ? nullptr : options->scene, *scene, warnings);
        return GLINT_OK;
    } catch (const glint::refusal &refused) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s", path, refused.what());
    } catch (const std::bad_alloc &) {
        return glint_fail(error, GLINT_DEVICE_FAILED, "%s: not enough memory for the scene", path);
    } catch (const std::exception &unexpected) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be loaded: %s", path,
                          unexpected.what());
    } catch (...) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be loaded", path);
    }
}
