// Walks the nodes. It uses an explicit stack, because a chain of nodes may be as deep as the file
// is long. The checks have excluded loops and second parents. See walk.hpp.
#include "scene/gltf/walk.hpp"

#include "base/memory.h"
#include "scene/gltf/accessor.hpp"
#include "scene/gltf/extensions.hpp"
#include "scene/gltf/lights.hpp"
#include "scene/gltf/roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace glint
{

namespace
{

constexpr std::size_t most_draws = std::size_t{1} << 22;

// `rotation` is (x, y, z, w) of any length but 0. Exporters round, and a longer quaternion means
// the same rotation.
glint_mat4 from_parts(const double *translation, const double *rotation, const double *scale)
{
    double length = std::sqrt(rotation[0] * rotation[0] + rotation[1] * rotation[1] +
                              rotation[2] * rotation[2] + rotation[3] * rotation[3]);
    double x = rotation[0] / length;
    double y = rotation[1] / length;
    double z = rotation[2] / length;
    double w = rotation[3] / length;
    const std::array<std::array<double, 3>, 3> turn = {{
        {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)}},
        {{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)}},
        {{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}},
    }};
    glint_mat4 result = glint_mat4_identity;
    for (std::size_t row = 0; row < 3; row++) {
        for (std::size_t column = 0; column < 3; column++) {
            result.m[row][column] = turn[row][column] * scale[column];
        }
        result.m[row][3] = translation[row];
    }
    return result;
}

[[noreturn]] void refuse_draws()
{
    throw refusal("more than " + std::to_string(most_draws) +
                  " primitives would be drawn (split the scene)");
}

constexpr std::array<double, 3> no_move = {0, 0, 0};
constexpr std::array<double, 4> no_turn = {0, 0, 0, 1};
constexpr std::array<double, 3> no_scale = {1, 1, 1};

// Returns a node's property at a time: from its curve, else from the node, else `value`.
template <std::size_t N>
void take(const std::vector<double> &own, const Moves *moves, Property property, double time,
          std::array<double, N> &value)
{
    if (moves != nullptr && !moves->of[property].times.empty()) {
        const glint_curve curve = moves->of[property].view();
        glint_curve_sample(&curve, time, value.data());
    } else if (!own.empty()) {
        std::copy(own.begin(), own.end(), value.begin());
    }
}

const Moves *moves_of(const Load &load, std::size_t index)
{
    auto found = load.clips.nodes.find(index);
    return found == load.clips.nodes.end() ? nullptr : &found->second;
}

// True if the node's place ever changes.
bool ever_moves(const Moves *moves)
{
    return moves != nullptr &&
           std::any_of(moves->of.begin(), moves->of.begin() + weights, [](const Curve &curve) {
               const glint_curve view = curve.view();
               return !curve.times.empty() && glint_curve_moves(&view);
           });
}

glint_mat4 local_matrix(const Load &load, std::size_t index, double time)
{
    const tinygltf::Node &node = load.model.nodes[index];
    if (!node.matrix.empty()) {
        glint_mat4 result = glint_mat4_identity;
        for (std::size_t i = 0; i < 16; i++) {
            result.m[i % 4][i / 4] = node.matrix[i]; // the file stores columns
        }
        // The check allowed rounding; the exact row avoids any projection.
        result.m[3][0] = result.m[3][1] = result.m[3][2] = 0;
        result.m[3][3] = 1;
        return result;
    }
    const Moves *moves = moves_of(load, index);
    std::array<double, 3> shift = no_move;
    std::array<double, 4> turn = no_turn;
    std::array<double, 3> size = no_scale;
    take(node.translation, moves, translation, time, shift);
    take(node.rotation, moves, rotation, time, turn);
    take(node.scale, moves, scale, time, size);
    return from_parts(shift.data(), turn.data(), size.data());
}

const json *instancing_of(const json &node)
{
    const json *extensions = member(node, "extensions");
    const json *found =
        extensions == nullptr ? nullptr : member(*extensions, "EXT_mesh_gpu_instancing");
    return found == nullptr ? nullptr : member(*found, "attributes");
}

// Returns a property of instance i, or `value` if the attribute is missing.
template <std::size_t N>
std::array<double, N> instance_part(const glint_array &attribute, std::size_t i,
                                    std::array<double, N> value)
{
    if (attribute.count > 0) {
        glint_array_numbers(&attribute, i, N, value.data());
    }
    return value;
}

void survey_rotation(Load &load, std::size_t index, const std::string &where)
{
    const std::vector<double> &rotation = load.model.nodes[index].rotation;
    double squares = 0;
    for (double value : rotation) {
        squares += value * value;
    }
    if (!rotation.empty() && std::fabs(squares - 1) > 2e-3) {
        load.tally.add("the rotation is no unit quaternion and is normalized", where);
    }
}

// Adds the notes about a node or a primitive.
template <typename Key>
void add_notes(const std::map<Key, std::vector<std::string>> &notes, const Key &key,
               const std::string &where, Tally &tally)
{
    const auto found = notes.find(key);
    if (found != notes.end()) {
        for (const std::string &note : found->second) {
            tally.add(note, where);
        }
    }
}

void survey_node(Load &load, std::size_t index)
{
    std::string where = node_where(load, index);
    survey_rotation(load, index, where);
    survey_extensions(objects_of(load.document.root, "nodes")[index], Holder::node, where,
                      load.tally);
    add_notes(load.model.node_notes, index, where, load.tally);
}

void survey_primitive(Load &load, const glint_primitive &primitive)
{
    const json &source =
        objects_of(load.document.root, "meshes")[primitive.mesh]["primitives"][primitive.number];
    std::string where = place_of(primitive).text();
    survey_extensions(source, Holder::primitive, where, load.tally);
    add_notes(load.model.notes, {primitive.mesh, primitive.number}, where, load.tally);
}

void draw_mesh(Load &load, std::size_t node, const glint_mat4 &to_world, glint_scene &scene)
{
    const std::vector<glint_mat4> instances = instances_of(load, node, load.draws.size());
    const std::size_t copies = std::max<std::size_t>(instances.size(), 1);
    const std::vector<glint_shape> &shapes = load.poses.shapes_of(pose_source(load), node);
    const int skin = load.model.nodes[node].skin;
    auto mesh = static_cast<std::size_t>(load.model.nodes[node].mesh);
    const std::size_t first = load.primitives.first[mesh];
    for (std::size_t i = first; i < load.primitives.first[mesh + 1]; i++) {
        const glint_primitive &primitive = load.primitives.all[i];
        const glint_shape *shape = shapes.empty() ? nullptr : &shapes[i - first];
        const Stand stand = load.poses.stand_of(shape, skin, to_world);
        if (stand.is_hidden) {
            load.hides_any = true;
            continue;
        }
        if (primitive.mode < GLINT_MODE_TRIANGLES) {
            (primitive.mode == GLINT_MODE_POINTS ? scene.skipped_points : scene.skipped_lines) +=
                copies;
            continue;
        }
        survey_primitive(load, primitive);
        if (skin >= 0 && shape->bones == nullptr) {
            load.tally.add("a skin does not move it, as it has no JOINTS_0; its node places it",
                           place_of(primitive).text());
        }
        // Draw the primitive at each instance. A shape that does not deform is the file's own.
        shape = shape != nullptr && glint_shape_deforms(shape) ? shape : nullptr;
        for (const glint_mat4 &instance : instances) {
            load.draws.push_back({&primitive, static_cast<int>(node),
                                  glint_mat4_multiply(&stand.to_world, &instance), shape});
        }
        if (instances.empty()) {
            load.draws.push_back({&primitive, static_cast<int>(node), stand.to_world, shape});
        }
    }
}

// Collects cameras. Owns their names until give() moves all to the scene.
class Cameras
{
  public:
    Cameras() = default;
    Cameras(const Cameras &) = delete;
    Cameras &operator=(const Cameras &) = delete;
    ~Cameras()
    {
        for (glint_camera &camera : all_) {
            std::free(camera.name);
        }
    }

    void add(const glint_camera &camera, const std::string &name)
    {
        all_.push_back(camera);
        all_.back().name = copy_text(name);
    }

    void give(glint_scene &scene)
    {
        scene.cameras =
            static_cast<glint_camera *>(glint_allocate(all_.size(), sizeof *scene.cameras));
        if (scene.cameras == nullptr) {
            throw std::bad_alloc();
        }
        std::copy(all_.begin(), all_.end(), scene.cameras);
        scene.camera_count = all_.size();
        all_.clear();
    }

  private:
    std::vector<glint_camera> all_;
};

void add_camera(Load &load, std::size_t node, const glint_mat4 &to_world, Cameras &cameras)
{
    auto index = static_cast<std::size_t>(load.model.nodes[node].camera);
    const tinygltf::Camera &source = load.model.cameras[index];
    glint_camera camera = {};
    // A camera that is lost for some time keeps its place in the list.
    camera.is_lost = !glint_camera_from_matrix(&to_world, &camera);
    if (camera.is_lost && load.clips.nodes.empty()) {
        load.tally.add(
            "the camera has no direction (its scale is 0, or not finite) and is left out",
            node_where(load, node));
        return;
    }
    camera.orthographic = source.type == "orthographic";
    if (camera.orthographic) {
        camera.ymag = std::fabs(source.orthographic.ymag);
        if (source.orthographic.ymag < 0) {
            load.tally.add("a negative ymag is taken as positive",
                           "cameras[" + std::to_string(index) + "]");
        }
    } else {
        camera.yfov = source.perspective.yfov;
    }
    const std::string &name = load.model.nodes[node].name;
    cameras.add(camera, name.empty() ? source.name : name);
}

// Adds the roots and all nodes below them to the visits, except nodes that are visited already.
void visit_trees(Load &load, const std::vector<int> &roots, bool is_shown)
{
    struct Step {
        int node;
        std::ptrdiff_t parent;
    };
    std::vector<Step> stack;
    for (auto it = roots.rbegin(); it != roots.rend(); ++it) {
        stack.push_back({*it, -1});
    }
    while (!stack.empty()) {
        const Step step = stack.back();
        stack.pop_back();
        auto index = static_cast<std::size_t>(step.node);
        if (load.visit_of[index] >= 0) {
            continue;
        }
        const tinygltf::Node &node = load.model.nodes[index];
        const bool moves =
            ever_moves(moves_of(load, index)) ||
            (step.parent >= 0 && load.visits[static_cast<std::size_t>(step.parent)].moves);
        const auto here = static_cast<std::ptrdiff_t>(load.visits.size());
        load.visit_of[index] = here;
        const bool is_below_shown =
            step.parent < 0 ? is_shown
                            : load.visits[static_cast<std::size_t>(step.parent)].is_shown;
        load.visits.push_back({index, step.parent,
                               is_below_shown && load.model.hidden_nodes.count(index) == 0, moves,
                               false});
        for (auto it = node.children.rbegin(); it != node.children.rend(); ++it) {
            stack.push_back({*it, here});
        }
    }
}

// Visits joints in trees that the scene does not show. Visits each tree once, in linear time.
void visit_joints(Load &load)
{
    const std::size_t shown = load.visits.size();
    std::vector<char> is_known(load.skins.size(), 0);
    for (std::size_t i = 0; i < shown; i++) {
        const tinygltf::Node &node = load.model.nodes[load.visits[i].node];
        if (!load.visits[i].is_shown || node.mesh < 0 || node.skin < 0 ||
            is_known[static_cast<std::size_t>(node.skin)] != 0) {
            continue;
        }
        is_known[static_cast<std::size_t>(node.skin)] = 1;
        for (std::size_t joint : load.skins[static_cast<std::size_t>(node.skin)].joints) {
            if (load.visit_of[joint] < 0) {
                auto root = static_cast<int>(joint);
                while (load.model.parents[static_cast<std::size_t>(root)] >= 0) {
                    root = load.model.parents[static_cast<std::size_t>(root)];
                }
                visit_trees(load, {root}, false);
            }
        }
    }
}

bool any_joint_moves(const Load &load, const Skin &skin)
{
    return std::any_of(skin.joints.begin(), skin.joints.end(), [&](std::size_t joint) {
        const std::ptrdiff_t visit = load.visit_of[joint];
        return visit >= 0 && load.visits[static_cast<std::size_t>(visit)].moves;
    });
}

// True if the node itself places a primitive of its mesh; joints place the other primitives.
bool places_any(const Load &load, const tinygltf::Node &node)
{
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const auto begin = load.primitives.all.begin();
    return node.skin < 0 ||
           std::any_of(begin + std::ptrdiff_t(load.primitives.first[mesh]),
                       begin + std::ptrdiff_t(load.primitives.first[mesh + 1]),
                       [](const glint_primitive &p) { return p.influences.count == 0; });
}

// Finds which meshes, cameras and lights the clip moves. Call it after all visits are known.
void survey_motion(Load &load)
{
    std::vector<char> skin_moves;
    skin_moves.reserve(load.skins.size());
    for (const Skin &skin : load.skins) {
        skin_moves.push_back(any_joint_moves(load, skin) ? 1 : 0);
    }
    for (Visit &visit : load.visits) {
        if (!visit.is_shown) {
            continue;
        }
        const tinygltf::Node &node = load.model.nodes[visit.node];
        load.moves_cameras = load.moves_cameras || (visit.moves && node.camera >= 0);
        load.moves_lights =
            load.moves_lights || (visit.moves && load.model.light_of[visit.node] >= 0);
        if (node.mesh >= 0) {
            visit.deforms =
                weights_move(load.clips, visit.node) ||
                (node.skin >= 0 && skin_moves[static_cast<std::size_t>(node.skin)] != 0);
            load.moves_triangles =
                load.moves_triangles || visit.deforms || (visit.moves && places_any(load, node));
        }
    }
}

} // namespace

PoseSource pose_source(const Load &load)
{
    return {load.model, load.primitives, load.clips, load.skins, load.visit_of};
}

std::vector<glint_mat4> instances_of(const Load &load, std::size_t node, std::size_t drawn)
{
    auto mesh = static_cast<std::size_t>(load.model.nodes[node].mesh);
    std::size_t primitives = load.primitives.first[mesh + 1] - load.primitives.first[mesh];
    std::size_t most = (most_draws - drawn) / primitives;
    if (most == 0) {
        refuse_draws();
    }
    std::vector<glint_mat4> result;
    const json *attributes = instancing_of(objects_of(load.document.root, "nodes")[node]);
    if (attributes == nullptr) {
        return result;
    }
    auto open = [&](const char *key) {
        const json *accessor = member(*attributes, key);
        return accessor == nullptr ? glint_array{}
                                   : open_array(load.model, accessor->get<std::size_t>());
    };
    const glint_array translations = open("TRANSLATION");
    const glint_array rotations = open("ROTATION");
    const glint_array scales = open("SCALE");
    std::size_t count =
        std::max({translations.count, rotations.count, scales.count, std::size_t{1}});
    if (count > most) { // checked before making any: a small file can ask for many
        refuse_draws();
    }
    result.reserve(count);
    for (std::size_t i = 0; i < count; i++) {
        result.push_back(from_parts(instance_part(translations, i, no_move).data(),
                                    instance_part(rotations, i, no_turn).data(),
                                    instance_part(scales, i, no_scale).data()));
    }
    return result;
}

void choose_nodes(Load &load, const char *name)
{
    load.visit_of.assign(load.model.nodes.size(), -1);
    visit_trees(load, find_roots(load, name), true);
    visit_joints(load);
    survey_motion(load);
}

glint_mat4 place_node(const Load &load, std::size_t visit, double time,
                      const std::vector<glint_mat4> &placed)
{
    const Visit &at = load.visits[visit];
    const glint_mat4 local = local_matrix(load, at.node, time);
    const glint_mat4 &parent =
        at.parent < 0 ? glint_mat4_identity : placed[static_cast<std::size_t>(at.parent)];
    return glint_mat4_multiply(&parent, &local);
}

void walk_scene(Load &load, double time, glint_scene &scene)
{
    load.draws.clear();
    load.hides_any = false;
    std::vector<glint_mat4> placed;
    placed.reserve(load.visits.size());
    Cameras cameras;
    for (std::size_t i = 0; i < load.visits.size(); i++) {
        placed.push_back(place_node(load, i, time, placed));
    }
    load.poses.begin(pose_source(load), time, placed);
    allocate_lights(load, scene);
    for (std::size_t i = 0; i < load.visits.size(); i++) {
        const std::size_t index = load.visits[i].node;
        const tinygltf::Node &node = load.model.nodes[index];
        if (!load.visits[i].is_shown) {
            load.hides_any = load.hides_any || node.mesh >= 0;
            continue;
        }
        survey_node(load, index);
        if (node.camera >= 0) {
            add_camera(load, index, placed[i], cameras);
        }
        if (load.model.light_of[index] >= 0) {
            add_light(load, index, placed[i], scene);
        }
        if (node.mesh >= 0) {
            draw_mesh(load, index, placed[i], scene);
        }
    }
    cameras.give(scene);
}

} // namespace glint
