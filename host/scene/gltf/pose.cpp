// Computes poses. See pose.hpp.
#include "scene/gltf/pose.hpp"

#include <new>

namespace glint
{

namespace
{

const Curve *weight_curve(const Clips &clips, std::size_t node)
{
    const auto found = clips.nodes.find(node);
    const bool has = found != clips.nodes.end() && !found->second.of[weights].times.empty();
    return has ? &found->second.of[weights] : nullptr;
}

// All joints of a skin in use are visited; joints of other skins may not be.
Bones place_bones(const PoseSource &source, const Skin &skin, const std::vector<glint_mat4> &placed)
{
    Bones bones;
    bones.are_hidden = true;
    for (std::size_t j = 0; j < skin.joints.size(); j++) {
        const std::ptrdiff_t visit = source.visit_of[skin.joints[j]];
        if (visit < 0) {
            return {};
        }
        const glint_mat4 &joint = placed[static_cast<std::size_t>(visit)];
        bones.matrices.push_back(glint_mat4_multiply(&joint, &skin.inverse_bind[j]));
        bones.are_hidden = bones.are_hidden && is_hidden(joint);
    }
    bones.view = {bones.matrices.data(), bones.matrices.size()};
    return bones;
}

} // namespace

Shapes::~Shapes()
{
    for (glint_shape &shape : all) {
        glint_shape_free(&shape);
    }
}

bool is_hidden(const glint_mat4 &matrix)
{
    for (const auto &row : {matrix.m[0], matrix.m[1], matrix.m[2]}) {
        if (row[0] != 0 || row[1] != 0 || row[2] != 0) {
            return false;
        }
    }
    return true;
}

void deform(const std::vector<glint_shape *> &shapes, bool with_normals, Tally &tally)
{
    glint_error error = {};
    if (glint_shapes_deform(shapes.data(), shapes.size(), with_normals, tally.get(), &error) !=
        GLINT_OK) {
        pass_on(error);
    }
}

std::vector<double> weights_at(const PoseSource &source, std::size_t node, double time)
{
    const tinygltf::Node &own = source.model.nodes[node];
    if (const Curve *curve = weight_curve(source.clips, node); curve != nullptr) {
        std::vector<double> values(curve->components);
        const glint_curve view = curve->view();
        glint_curve_sample(&view, time, values.data());
        return values;
    }
    return own.weights.empty() ? source.model.meshes[static_cast<std::size_t>(own.mesh)].weights
                               : own.weights;
}

bool weights_move(const Clips &clips, std::size_t node)
{
    const Curve *curve = weight_curve(clips, node);
    if (curve == nullptr) {
        return false;
    }
    const glint_curve view = curve->view();
    return glint_curve_moves(&view);
}

void Poses::begin(const PoseSource &source, double time, const std::vector<glint_mat4> &placed)
{
    shapes_.clear();
    bones_.clear();
    time_ = time;
    for (const Skin &skin : source.skins) {
        bones_.push_back(place_bones(source, skin, placed));
    }
}

Stand Poses::stand_of(const glint_shape *shape, int skin, const glint_mat4 &node_to_world) const
{
    if (shape != nullptr && shape->bones != nullptr) {
        return {glint_mat4_identity, bones_[static_cast<std::size_t>(skin)].are_hidden};
    }
    return {node_to_world, is_hidden(node_to_world)};
}

const std::vector<glint_shape> &Poses::shapes_of(const PoseSource &source, std::size_t node)
{
    const tinygltf::Node &own = source.model.nodes[node];
    const auto mesh = static_cast<std::size_t>(own.mesh);
    const bool has_weights = !own.weights.empty() || weight_curve(source.clips, node) != nullptr;
    const Key key = {own.mesh, has_weights ? static_cast<std::ptrdiff_t>(node) : -1, own.skin};
    const auto added = shapes_.try_emplace(key);
    std::vector<glint_shape> &shapes = added.first->second.all;
    if (added.second && (own.skin >= 0 || source.model.target_counts[mesh] > 0)) {
        const std::vector<double> now = weights_at(source, node, time_);
        const glint_bones *bones =
            own.skin < 0 ? nullptr : &bones_[static_cast<std::size_t>(own.skin)].view;
        const std::size_t end = source.primitives.first[mesh + 1];
        for (std::size_t i = source.primitives.first[mesh]; i < end; i++) {
            if (!glint_shape_init(&shapes.emplace_back(), &source.primitives.all[i], now.data(),
                                  now.size(), bones)) {
                throw std::bad_alloc();
            }
        }
    }
    return shapes;
}

std::vector<glint_shape *> Poses::deforming()
{
    std::vector<glint_shape *> found;
    for (auto &entry : shapes_) {
        for (glint_shape &shape : entry.second.all) {
            if (glint_shape_deforms(&shape) && shape.primitive->triangles > 0) {
                found.push_back(&shape);
            }
        }
    }
    return found;
}

} // namespace glint
