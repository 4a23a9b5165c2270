// Computes bounds over time. See sweep.hpp.
#include "scene/gltf/sweep.hpp"

#include "scene/gltf/flatten.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace glint
{

namespace
{

// A clip is evaluated at this many evenly spaced times, and at its keys, where motion may reverse.
// Between two times, moving things are assumed to stay near their positions at both.
constexpr int sweep_steps = 64;
constexpr std::size_t most_sweep_keys = 4096;

// The most cost of deforming over all times, two seconds of one core. A vertex of four joints costs
// 5, about 120 ns. Scenes of higher cost are evaluated at fewer times.
constexpr double most_deforming = 5 * 0x1p24;
// The most boxes of moving instances over all times, some seconds.
constexpr double most_moving = 0x1p26;
constexpr double fewest_times = 17;

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
    // Of more keys, which lie close together, keep every stride-th.
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

// The bounds of the triangles' corners, deformed by the shape; NULL: as in the file.
Bounds box_of(const glint_primitive &primitive, const glint_shape *shape)
{
    Bounds box;
    for (std::size_t t = 0; t < primitive.triangles; t++) {
        for (std::size_t c = 0; c < 3; c++) {
            if (shape != nullptr) {
                box.grow(shape->positions[glint_shape_element(shape, t, c)]);
                continue;
            }
            std::array<double, 3> p{};
            glint_array_numbers(&primitive.positions, glint_primitive_vertex(&primitive, t, c), 3,
                                p.data());
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

// A visited node with a mesh.
struct Drawing {
    std::size_t visit;
    std::vector<glint_mat4> instances; // relative to the node; empty: the node alone
};

// Lists what is drawn; refuses too much before anything takes time.
std::vector<Drawing> drawings_of(const Load &load)
{
    std::vector<Drawing> drawings;
    std::size_t drawn = 0, triangles = 0;
    for (std::size_t i = 0; i < load.visits.size(); i++) {
        const std::size_t node = load.visits[i].node;
        if (!load.visits[i].is_shown || load.model.nodes[node].mesh < 0) {
            continue;
        }
        const auto mesh = static_cast<std::size_t>(load.model.nodes[node].mesh);
        std::size_t drawable = 0, each = 0;
        for (std::size_t p = load.primitives.first[mesh]; p < load.primitives.first[mesh + 1];
             p++) {
            each += load.primitives.all[p].triangles;
            drawable += load.primitives.all[p].triangles > 0 ? 1 : 0;
        }
        if (drawable > 0) {
            drawings.push_back({i, instances_of(load, node, drawn)});
            const std::size_t copies = std::max<std::size_t>(drawings.back().instances.size(), 1);
            drawn += drawable * copies;
            triangles += each * copies;
        }
    }
    check_triangle_count(triangles);
    return drawings;
}

// Grows bounds by drawings, one time after the other.
class Sweeper
{
  public:
    explicit Sweeper(const Load &load) : load_(load), source_(pose_source(load))
    {
        placed_.reserve(load.visits.size());
        for (std::size_t i = 0; i < load.visits.size(); i++) {
            placed_.push_back(place_node(load, i, 0, placed_));
        }
        boxes_.resize(load.primitives.all.size());
    }

    // Places the moving nodes at a time.
    void place(double time)
    {
        for (std::size_t i = 0; i < load_.visits.size(); i++) {
            if (load_.visits[i].moves) {
                placed_[i] = place_node(load_, i, time, placed_);
            }
        }
    }

    // Deforms the meshes of drawings for the time of place(). Returns the cost.
    double pose(const std::vector<const Drawing *> &drawings, double time)
    {
        shape_boxes_.clear();
        poses_.begin(source_, time, placed_);
        for (const Drawing *drawing : drawings) {
            poses_.shapes_of(source_, load_.visits[drawing->visit].node);
        }
        const std::vector<glint_shape *> shapes = poses_.deforming();
        deform(shapes, false, said_elsewhere_);
        double cost = 0;
        for (const glint_shape *shape : shapes) {
            shape_boxes_[shape] = box_of(*shape->primitive, shape);
            cost += glint_shape_cost(shape);
        }
        return cost;
    }

    // Grows the bounds by posed drawings, at the time of place().
    void grow(const std::vector<const Drawing *> &drawings)
    {
        for (const Drawing *drawing : drawings) {
            grow_by(*drawing);
        }
    }

    const Bounds &bounds() const
    {
        return all_;
    }

  private:
    // Returns a primitive's box as in the file, computed at first use.
    const Bounds &box_as_filed(std::size_t primitive)
    {
        if (boxes_[primitive].is_empty()) {
            boxes_[primitive] = box_of(load_.primitives.all[primitive], nullptr);
        }
        return boxes_[primitive];
    }

    void grow_by(const Drawing &drawing)
    {
        const tinygltf::Node &node = load_.model.nodes[load_.visits[drawing.visit].node];
        const auto mesh = static_cast<std::size_t>(node.mesh);
        const std::size_t first = load_.primitives.first[mesh];
        const auto &shapes = poses_.shapes_of(source_, load_.visits[drawing.visit].node);
        for (std::size_t i = first; i < load_.primitives.first[mesh + 1]; i++) {
            const glint_shape *shape = shapes.empty() ? nullptr : &shapes[i - first];
            const Stand stand = poses_.stand_of(shape, node.skin, placed_[drawing.visit]);
            const bool deforms = shape != nullptr && glint_shape_deforms(shape);
            if (stand.is_hidden || load_.primitives.all[i].triangles == 0) {
                continue;
            }
            const Bounds &box = deforms ? shape_boxes_.at(shape) : box_as_filed(i);
            for (const glint_mat4 &instance : drawing.instances) {
                grow_by_box(glint_mat4_multiply(&stand.to_world, &instance), box, all_);
            }
            if (drawing.instances.empty()) {
                grow_by_box(stand.to_world, box, all_);
            }
        }
    }

    const Load &load_;
    const PoseSource source_;
    std::vector<glint_mat4> placed_; // [visit]
    std::vector<Bounds> boxes_;      // [primitive], as in the file
    std::map<const glint_shape *, Bounds> shape_boxes_;
    Poses poses_;
    Tally said_elsewhere_; // dropped: loading a frame gives the same warnings
    Bounds all_;
};

// Chooses times, evenly and with both ends, if each costs `each` and `all` may be spent.
std::vector<double> affordable(std::vector<double> times, double each, double all)
{
    std::sort(times.begin(), times.end());
    const double count = std::max(fewest_times, all / std::max(each, 1.0));
    const auto most = static_cast<std::size_t>(std::min(count, double(times.size())));
    if (times.size() <= most) {
        return times;
    }
    std::vector<double> chosen;
    chosen.reserve(most);
    for (std::size_t i = 0; i < most; i++) {
        chosen.push_back(times[i * (times.size() - 1) / (most - 1)]);
    }
    return chosen;
}

} // namespace

Bounds sweep(const Load &load)
{
    const std::vector<Drawing> drawings = drawings_of(load);
    std::vector<const Drawing *> rigid; // not deforming: still or moving
    std::vector<const Drawing *> still;
    std::vector<const Drawing *> moving;
    std::vector<const Drawing *> deforming;
    // Sort the drawings by their motion.
    for (const Drawing &drawing : drawings) {
        const Visit &visit = load.visits[drawing.visit];
        (visit.deforms ? deforming : rigid).push_back(&drawing);
        if (!visit.deforms) {
            (visit.moves ? moving : still).push_back(&drawing);
        }
    }
    // Evaluate drawings at rest once.
    const std::vector<double> times = sweep_times(load.clips);
    Sweeper sweeper(load);
    sweeper.pose(rigid, 0);
    sweeper.grow(still);
    // Evaluate rigid motion, as often as its cost allows.
    double boxes = 0;
    for (const Drawing *drawing : moving) {
        boxes += double(std::max<std::size_t>(drawing->instances.size(), 1));
    }
    for (double time : affordable(times, boxes, most_moving)) {
        sweeper.place(time);
        sweeper.grow(moving);
    }
    // Evaluate deforming meshes, as often as their cost allows.
    if (!deforming.empty()) {
        sweeper.place(0);
        const double cost = sweeper.pose(deforming, 0);
        for (double time : affordable(times, cost, most_deforming)) {
            sweeper.place(time);
            sweeper.pose(deforming, time);
            sweeper.grow(deforming);
        }
    }
    return sweeper.bounds();
}

} // namespace glint
