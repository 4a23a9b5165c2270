// The glTF loader, from the file to the scene: read, check, let tinygltf load, walk, flatten.
// Whatever is thrown on the way ends here as a status.
//
// Limits: files of 4 GiB, buffers of 8 GiB, 2^27 triangles; textures, skins and morph targets are
// not applied, which is said in the warnings.
#include "scene/scene.h"

#include "scene/gltf_flatten.hpp"
#include "scene/gltf_walk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace glint
{

namespace
{

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

// A scene that only cameras are taken of.
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

// Whatever a walk adds to a tally, which the next walk adds again, is taken back.
class TallyRestorer
{
  public:
    explicit TallyRestorer(Tally &tally) : tally_(tally), before_(tally) {}
    TallyRestorer(const TallyRestorer &) = delete;
    TallyRestorer &operator=(const TallyRestorer &) = delete;
    ~TallyRestorer()
    {
        std::swap(tally_, before_);
    }

  private:
    Tally &tally_;
    Tally before_;
};

// ---- Over time ---------------------------------------------------------------------------------

// A clip is looked at at so many times evenly apart, and at its keys, where things turn back.
// Between those what moves is taken to stay near where it is at both.
constexpr int sweep_steps = 64;
constexpr std::size_t most_sweep_keys = 4096;

std::vector<double> sweep_times(const Clips &clips)
{
    std::vector<double> times;
    for (const auto &node : clips.nodes) {
        for (const Curve &curve : node.second.of) {
            times.insert(times.end(), curve.times.begin(), curve.times.end());
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    // Of more keys than that, which lie close, every so many-th.
    const std::size_t stride = times.size() / most_sweep_keys + 1;
    for (std::size_t i = 0; i * stride < times.size(); i++) {
        times[i] = times[i * stride];
    }
    times.resize((times.size() + stride - 1) / stride);
    for (int step = 0; step <= sweep_steps; step++) {
        times.push_back(clips.duration * step / sweep_steps);
    }
    return times;
}

struct Box {
    glint_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};

    void grow(glint_vec3 p)
    {
        low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
        high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    }
};

Box box_of(const Primitive &primitive)
{
    Box box;
    for (std::size_t t = 0; t < primitive.triangles; t++) {
        for (std::size_t c = 0; c < 3; c++) {
            std::array<double, 3> p{};
            primitive.positions.numbers(primitive.vertex(t, c), 3, p.data());
            box.grow({p[0], p[1], p[2]});
        }
    }
    return box;
}

// Bounds of all that is drawn over the whole clip, by the corners of the primitives' boxes.
Box sweep(Load &load, const char *name)
{
    std::vector<Box> boxes;
    for (const Primitive &primitive : load.primitives.all) {
        boxes.push_back(box_of(primitive));
    }
    Box all;
    for (double time : sweep_times(load.clips)) {
        CameraScene nothing;
        walk_scene(load, name, time, nothing.scene);
        for (const Draw &draw : load.draws) {
            const Box &box =
                boxes[static_cast<std::size_t>(draw.primitive - load.primitives.all.data())];
            for (int corner = 0; box.low.x <= box.high.x && corner < 8; corner++) {
                all.grow(
                    glint_mat4_point(&draw.to_world, {(corner & 1) != 0 ? box.high.x : box.low.x,
                                                      (corner & 2) != 0 ? box.high.y : box.low.y,
                                                      (corner & 4) != 0 ? box.high.z : box.low.z}));
            }
        }
    }
    return all;
}

} // namespace

} // namespace glint

struct glint_scene_source {
    glint::Load load;
    std::string name; // of the scene within the file
    bool has_name = false;
    std::string clip;
    glint_motion motion = {};
    glint::Box swept;

    const char *scene_name() const
    {
        return has_name ? name.c_str() : nullptr;
    }
};

namespace glint
{

namespace
{

void fill(glint_scene_source &source, double time, glint_scene &scene)
{
    walk_scene(source.load, source.scene_name(), time, scene);
    flatten(source.load, scene);
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
    check_document(load.document, load.checked);
    read_buffers(load.document);
    load_model(load.document, load.model);
    load.primitives = prepare_primitives(load.document, load.model, load.tally);
    load.clips = read_clips(load.document, load.model, options.animation, load.tally);
    source.has_name = options.scene != nullptr;
    source.name = source.has_name ? options.scene : "";
    // The first walk tells what moves.
    TallyRestorer restorer(load.tally);
    CameraScene first;
    walk_scene(load, source.scene_name(), 0, first.scene);
    if (load.moves_triangles) {
        source.swept = sweep(load, source.scene_name());
    }
    source.motion = {load.moves_triangles, load.moves_cameras, load.clips.duration,
                     load.clips.name.empty() ? nullptr : load.clips.name.c_str()};
}

// What `work` throws as a status.
template <typename Work>
glint_status guard(const char *path, glint_error *error, Work work)
{
    try {
        work();
        return GLINT_OK;
    } catch (const refusal &refused) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s", path, refused.what());
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

glint_status glint_scene_cameras_at(glint_scene_source *source, double time, glint_scene *scene,
                                    glint_error *error)
{
    return glint::guard(source->load.document.path.c_str(), error, [&] {
        glint::TallyRestorer restorer(source->load.tally);
        glint::CameraScene at;
        glint::walk_scene(source->load, source->scene_name(), time, at.scene);
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
