// Bounds over time. See gltf_sweep.hpp.
#include "scene/gltf_sweep.hpp"

#include <algorithm>
#include <array>

namespace glint
{

namespace
{

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

Bounds box_of(const Primitive &primitive)
{
    Bounds box;
    for (std::size_t t = 0; t < primitive.triangles; t++) {
        for (std::size_t c = 0; c < 3; c++) {
            std::array<double, 3> p{};
            primitive.positions.numbers(primitive.vertex(t, c), 3, p.data());
            box.grow({p[0], p[1], p[2]});
        }
    }
    return box;
}

void grow_by_box(const glint_mat4 &to_world, const Bounds &box, Bounds &all)
{
    for (int corner = 0; corner < 8; corner++) {
        all.grow(glint_mat4_point(&to_world, {(corner & 1) != 0 ? box.high.x : box.low.x,
                                              (corner & 2) != 0 ? box.high.y : box.low.y,
                                              (corner & 4) != 0 ? box.high.z : box.low.z}));
    }
}

// A visited node, and what it draws.
struct Drawing {
    std::size_t visit;
    std::vector<Bounds> boxes;         // of its primitives that have any triangles
    std::vector<glint_mat4> instances; // relative to the node; empty: the node alone
};

void grow_by_drawing(const glint_mat4 &to_world, const Drawing &drawing, Bounds &all)
{
    if (is_hidden(to_world)) {
        return;
    }
    for (const Bounds &box : drawing.boxes) {
        for (const glint_mat4 &instance : drawing.instances) {
            grow_by_box(glint_mat4_multiply(&to_world, &instance), box, all);
        }
        if (drawing.instances.empty()) {
            grow_by_box(to_world, box, all);
        }
    }
}

std::vector<Drawing> drawings_of(const Load &load)
{
    std::vector<Bounds> boxes;
    for (const Primitive &primitive : load.primitives.all) {
        boxes.push_back(box_of(primitive));
    }
    std::vector<Drawing> drawings;
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < load.visits.size(); i++) {
        const int mesh = load.model.nodes[load.visits[i].node].mesh;
        if (mesh < 0) {
            continue;
        }
        Drawing drawing = {i, {}, {}};
        for (std::size_t p = load.primitives.first[static_cast<std::size_t>(mesh)];
             p < load.primitives.first[static_cast<std::size_t>(mesh) + 1]; p++) {
            if (!boxes[p].is_empty()) {
                drawing.boxes.push_back(boxes[p]);
            }
        }
        if (!drawing.boxes.empty()) {
            drawing.instances = instances_of(load, load.visits[i].node, drawn);
            drawn += drawing.boxes.size() * std::max<std::size_t>(drawing.instances.size(), 1);
            drawings.push_back(std::move(drawing));
        }
    }
    return drawings;
}

} // namespace

Bounds sweep(const Load &load)
{
    const std::vector<Drawing> drawings = drawings_of(load);
    std::vector<glint_mat4> placed;
    placed.reserve(load.visits.size());
    std::vector<std::size_t> moving; // visits
    for (std::size_t i = 0; i < load.visits.size(); i++) {
        placed.push_back(place_node(load, i, 0, placed));
        if (load.visits[i].moves) {
            moving.push_back(i);
        }
    }
    Bounds all;
    std::vector<const Drawing *> moving_drawings;
    for (const Drawing &drawing : drawings) {
        if (load.visits[drawing.visit].moves) {
            moving_drawings.push_back(&drawing);
        } else {
            grow_by_drawing(placed[drawing.visit], drawing, all);
        }
    }
    for (double time : sweep_times(load.clips)) {
        for (std::size_t visit : moving) {
            placed[visit] = place_node(load, visit, time, placed);
        }
        for (const Drawing *drawing : moving_drawings) {
            grow_by_drawing(placed[drawing->visit], *drawing, all);
        }
    }
    return all;
}

} // namespace glint
