// Validates nodes, scenes and cameras in the raw JSON. All checks take linear time: a graph of 40
// nodes can have 2^40 paths, and a chain can be 50,000 deep. See check.hpp.
#include "decoder/check.hpp"
#include "decoder/check_morph.hpp"
#include "decoder/check_storage.hpp"
#include "decoder/lights.hpp"
#include "decoder/skin.hpp"

#include <array>
#include <cmath>

namespace glint
{

namespace
{

constexpr double pi = 3.14159265358979323846;

std::string node_name(std::size_t i)
{
    return "nodes[" + std::to_string(i) + "]";
}

// Returns the numbers of a member; none if it is missing.
std::vector<double> check_numbers(const json &node, const Place &node_place, const char *key,
                                  std::size_t count)
{
    std::vector<double> numbers;
    const json *found = member(node, key);
    if (found == nullptr) {
        return numbers;
    }
    Place place = node_place / key;
    if (!found->is_array() || found->size() != count) {
        std::string got = found->is_array() ? counted(found->size(), "element") : "no array";
        refuse(place, got + " (it must be an array of " + std::to_string(count) + " numbers)");
    }
    numbers.reserve(count);
    for (std::size_t i = 0; i < count; i++) {
        numbers.push_back(number_of((*found)[i], place[i]));
    }
    return numbers;
}

// Checks that a matrix is affine. It may flatten or hide, as a scale may.
std::vector<double> check_matrix(const json &node, const Place &node_place)
{
    std::vector<double> m = check_numbers(node, node_place, "matrix", 16);
    if (m.empty()) {
        return m;
    }
    Place place = node_place / "matrix";
    // Some exporters round. A projection never differs by only a part in 100,000.
    constexpr double tolerance = 1e-5;
    if (std::fabs(m[3]) > tolerance || std::fabs(m[7]) > tolerance ||
        std::fabs(m[11]) > tolerance || std::fabs(m[15] - 1) > tolerance) {
        refuse(place, "its last row is not 0 0 0 1 (a node's matrix moves, turns and scales only)");
    }
    return m;
}

std::vector<double> check_rotation(const json &node, const Place &place)
{
    std::vector<double> rotation = check_numbers(node, place, "rotation", 4);
    if (rotation.empty()) {
        return rotation;
    }
    double squares = 0;
    for (double value : rotation) {
        squares += value * value;
    }
    if (!(squares > 1e-12 && squares < 1e12)) {
        refuse(place / "rotation", "not a rotation: the quaternion's length is " +
                                       shown(std::sqrt(squares)) +
                                       " (it must be 1; [0, 0, 0, 1] turns nothing)");
    }
    return rotation;
}

void check_instancing(const json &node, const Place &node_place, const Model &model)
{
    const json *instancing = extension_of(node, node_place, "EXT_mesh_gpu_instancing");
    if (instancing == nullptr) {
        return;
    }
    Place place = node_place / "extensions" / "EXT_mesh_gpu_instancing";
    const json &attributes = object_at(*instancing, place, "attributes");
    std::uint64_t instances = 0;
    for (auto it = attributes.begin(); it != attributes.end(); ++it) {
        Place attribute = place / "attributes" / it.key().c_str();
        const tinygltf::Accessor &accessor =
            model.accessors[index_of(it.value(), attribute, model.accessors.size(), "accessor")];
        const std::uint64_t count = accessor.count;
        if (instances != 0 && count != instances) {
            refuse(attribute, "as many elements as the other attributes are needed, there are " +
                                  std::to_string(count) + " and " + std::to_string(instances));
        }
        instances = count;
        if (it.key() == "TRANSLATION" || it.key() == "SCALE") {
            check_format(accessor, attribute, {TINYGLTF_TYPE_VEC3, true, false, false});
        } else if (it.key() == "ROTATION") {
            check_format(accessor, attribute, {TINYGLTF_TYPE_VEC4, true, true, false});
        }
    }
}

tinygltf::Node check_node(const json &root, const json &source, const Place &place,
                          const Model &model)
{
    auto index = [&](const char *key, const char *all) {
        return static_cast<int>(
            optional_index(source, place, key, objects_of(root, all).size(), key));
    };
    tinygltf::Node node;
    node.name = name_of(source);
    node.mesh = index("mesh", "meshes");
    node.camera = index("camera", "cameras");
    node.skin = index("skin", "skins");
    node.matrix = check_matrix(source, place);
    node.translation = check_numbers(source, place, "translation", 3);
    node.scale = check_numbers(source, place, "scale", 3);
    node.rotation = check_rotation(source, place);
    if (node.mesh >= 0) {
        node.weights = check_weights(source, place);
    }
    check_instancing(source, place, model);
    return node;
}

// Sets a child's parent. Refuses a second parent; if it closes a loop, the message says so.
void adopt(std::size_t parent, std::size_t child, std::vector<int> &parents, const Place &place)
{
    if (parents[child] < 0) {
        parents[child] = static_cast<int>(parent);
        return;
    }
    // If a walk up from `parent` meets `child`, there is a loop. The walk ends: it goes around at
    // most once.
    std::size_t steps = 0;
    for (int up = static_cast<int>(parent); up >= 0 && steps < parents.size(); steps++) {
        if (up == static_cast<int>(child)) {
            refuse(place, "node loop: " + node_name(child) + " is above " + node_name(parent) +
                              " and its child");
        }
        up = parents[static_cast<std::size_t>(up)];
    }
    auto first = static_cast<std::size_t>(parents[child]);
    if (first == parent) {
        refuse(place, node_name(child) + " stands there twice (a node has one place only)");
    }
    refuse(place, node_name(child) + " is a child of " + node_name(first) +
                      " already (a node has one parent only: copy it)");
}

// Each node has at most one parent. So a node that no root leads to is in a loop, or below a loop.
void check_loops(const std::vector<int> &parents)
{
    enum : char { unknown, on_the_way, rooted };
    std::vector<char> state(parents.size(), unknown);
    std::vector<std::size_t> way;
    for (std::size_t i = 0; i < parents.size(); i++) {
        way.clear();
        std::size_t node = i;
        while (state[node] == unknown) {
            state[node] = on_the_way;
            way.push_back(node);
            if (parents[node] < 0) {
                break;
            }
            node = static_cast<std::size_t>(parents[node]);
            if (state[node] == on_the_way) {
                refuse((Place() / "nodes")[node],
                       "node loop: it is among its own descendants (mend the children)");
            }
        }
        for (std::size_t passed : way) {
            state[passed] = rooted;
        }
    }
}

bool is_hidden(const json &node, const Place &place)
{
    constexpr const char *name = "KHR_node_visibility";
    const json *extension = extension_of(node, place, name);
    return extension != nullptr &&
           !optional_boolean(*extension, place / "extensions" / name, "visible", true);
}

// True if a node has a matrix beside a translation, rotation or scale.
bool has_two_places(const json &node)
{
    return member(node, "matrix") != nullptr &&
           (member(node, "translation") != nullptr || member(node, "rotation") != nullptr ||
            member(node, "scale") != nullptr);
}

void check_nodes(const json &root, Model &model)
{
    const json &nodes = objects_of(root, "nodes");
    model.parents.assign(nodes.size(), -1);
    model.nodes.reserve(nodes.size()); // they are large
    for (std::size_t i = 0; i < nodes.size(); i++) {
        Place place = (Place() / "nodes")[i];
        tinygltf::Node &node = model.nodes.emplace_back(check_node(root, nodes[i], place, model));
        if (node.mesh >= 0 && !node.weights.empty() &&
            node.weights.size() != model.target_counts[static_cast<std::size_t>(node.mesh)]) {
            model.node_notes[i].emplace_back(wrong_weights);
        }
        if (has_two_places(nodes[i])) {
            model.node_notes[i].emplace_back("the node has a matrix, and translation, rotation or "
                                             "scale, too (the matrix counts)");
        }
        if (is_hidden(nodes[i], place)) {
            model.hidden_nodes.insert(i);
        }
        model.light_of.push_back(read_node_light(nodes[i], place, i, model));
        const json &children = optional_array(nodes[i], place, "children");
        for (std::size_t c = 0; c < children.size(); c++) {
            Place child = (place / "children")[c];
            std::size_t index = index_of(children[c], child, nodes.size(), "node");
            if (index == i) {
                refuse(child, "node loop: a node cannot be its own child");
            }
            adopt(i, index, model.parents, child);
            node.children.push_back(static_cast<int>(index));
        }
    }
    check_loops(model.parents);
}

void check_scenes(const json &root, Model &model)
{
    const json &scenes = objects_of(root, "scenes");
    for (std::size_t s = 0; s < scenes.size(); s++) {
        Place place = (Place() / "scenes")[s];
        tinygltf::Scene &scene = model.scenes.emplace_back();
        scene.name = name_of(scenes[s]);
        const json &nodes = optional_array(scenes[s], place, "nodes");
        for (std::size_t i = 0; i < nodes.size(); i++) {
            Place entry = (place / "nodes")[i];
            std::size_t node = index_of(nodes[i], entry, model.parents.size(), "node");
            scene.nodes.push_back(static_cast<int>(node));
        }
    }
    model.defaultScene =
        static_cast<int>(optional_index(root, Place(), "scene", scenes.size(), "scene"));
}

double check_perspective(const json &camera, const Place &camera_place)
{
    Place place = camera_place / "perspective";
    const json &lens = object_at(camera, camera_place, "perspective");
    const double yfov = number_at(lens, place, "yfov");
    if (!(yfov > 0 && yfov < pi)) {
        refuse(place / "yfov", shown(yfov) + " is no vertical angle (radians, more than 0 and "
                                             "less than pi)");
    }
    return yfov;
}

double check_orthographic(const json &camera, const Place &camera_place)
{
    Place place = camera_place / "orthographic";
    const json &lens = object_at(camera, camera_place, "orthographic");
    const double ymag = number_at(lens, place, "ymag");
    if (ymag == 0) {
        refuse(place / "ymag", "0: the camera sees nothing (give half the height in metres)");
    }
    return ymag;
}

void check_cameras(const json &root, Model &model)
{
    const json &cameras = objects_of(root, "cameras");
    for (std::size_t i = 0; i < cameras.size(); i++) {
        Place place = (Place() / "cameras")[i];
        tinygltf::Camera &camera = model.cameras.emplace_back();
        camera.name = name_of(cameras[i]);
        camera.type = optional_text(cameras[i], place, "type");
        if (camera.type == "perspective") {
            camera.perspective.yfov = check_perspective(cameras[i], place);
        } else if (camera.type == "orthographic") {
            camera.orthographic.ymag = check_orthographic(cameras[i], place);
        } else {
            refuse(place / "type",
                   in_quotes(camera.type) + " is none (perspective or orthographic)");
        }
    }
}

} // namespace

void check_graph(const json &root, Model &model)
{
    check_cameras(root, model);
    read_lights(root, model);
    check_skins(root, model);
    check_nodes(root, model);
    check_scenes(root, model);
}

} // namespace glint
