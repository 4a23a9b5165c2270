// Deforms primitives for one time. See shape.hpp.
#include "scene/gltf/shape.hpp"

#include "base/free_memory.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace glint
{

namespace
{

constexpr std::size_t elements_per_task = 2048;

glint_vec3 row3(const glint_mat4 &m, int row)
{
    return {m.m[row][0], m.m[row][1], m.m[row][2]};
}

// −1 or 1, the determinant's sign; 0 if the matrix flattens, because then rounding decides the
// sign.
signed char orientation_of(const glint_mat4 &m)
{
    // Relative to the box of the rows' lengths. This is far above the rounding of sums of doubles
    // and far below the precision of the file's floats.
    constexpr double flat = 1e-12;
    const double determinant = glint_mat4_determinant3(&m);
    double squares = flat * flat;
    for (int row = 0; row < 3; row++) {
        squares *= glint_vec3_dot(row3(m, row), row3(m, row));
    }
    return determinant * determinant <= squares ? 0 : determinant < 0 ? -1 : 1;
}

// Some elements of a shape, and the verdicts on their weights.
struct Task {
    Shape *shape;
    std::size_t first, last;
    std::array<bool, 5> met = {}; // indexed by Weighting
};

void run(std::size_t index, void *context)
{
    Task &task = static_cast<Task *>(context)[index];
    for (; task.first < task.last; task.first++) {
        const Weighting weighting = task.shape->deform_element(task.first);
        task.met[static_cast<std::size_t>(weighting)] = true;
        if (is_fault(weighting)) {
            return; // task.first is the faulty element
        }
    }
}

bool has_met(const Task &task, Weighting weighting)
{
    return task.met[static_cast<std::size_t>(weighting)];
}

// Some minutes of one core.
constexpr double most_cost = 0x1p34;

void check_memory(const std::vector<Shape *> &shapes, bool with_normals)
{
    const std::size_t bytes = sizeof(glint_vec3) * (with_normals ? 2 : 1) + 1;
    std::size_t elements = 0;
    double cost = 0;
    for (const Shape *shape : shapes) {
        elements += shape->element_count();
        cost += shape->cost();
    }
    if (cost > most_cost) {
        throw refusal("its skins and morph targets move " + shown(cost) +
                      " vectors a frame, more than " + shown(most_cost) + " (split the scene)");
    }
    if (elements > glint_free_memory() / bytes) {
        throw shortage(counted(elements, "vertex") + " of skins and morph targets do not fit into "
                                                     "the free memory (render a part with --only)");
    }
}

} // namespace

Shape::Shape(const Primitive &primitive, const std::vector<double> &weights,
             const std::vector<glint_mat4> *joints)
    : primitive_(&primitive), morph_(primitive.targets, weights),
      joints_(primitive.influences.empty() ? nullptr : joints),
      is_per_corner_(primitive.positions.count() / 3 > primitive.triangles)
{
}

bool Shape::is_mirrored(std::size_t t) const
{
    return is_skinned() && orientations_[element(t, 0)] + orientations_[element(t, 1)] +
                                   orientations_[element(t, 2)] <
                               0;
}

void Shape::allocate(bool with_normals)
{
    positions_.resize(element_count());
    normals_.resize(with_normals && primitive_->has_normals ? element_count() : 0);
    orientations_.resize(is_skinned() ? element_count() : 0);
}

Weighting Shape::deform_element(std::size_t element)
{
    const std::size_t vertex = vertex_of(element);
    std::array<double, 3> p{};
    primitive_->positions.numbers(vertex, p.size(), p.data());
    morph_.add(morph_position, vertex, p.data());
    positions_[element] = {p[0], p[1], p[2]};
    std::array<double, 3> n{};
    if (!normals_.empty()) {
        primitive_->normals.numbers(vertex, n.size(), n.data());
        morph_.add(morph_normal, vertex, n.data());
        normals_[element] = {n[0], n[1], n[2]};
    }
    if (!is_skinned()) {
        return Weighting::good;
    }
    glint_mat4 blend;
    const Weighting weighting = blend_joints(primitive_->influences, vertex, *joints_, blend);
    if (is_fault(weighting)) {
        return weighting;
    }
    positions_[element] = glint_mat4_point(&blend, positions_[element]);
    orientations_[element] = orientation_of(blend);
    if (!normals_.empty()) {
        const glint_vec3 turned = glint_mat4_normal(&blend, normals_[element]);
        // A flattened mesh keeps the side of a determinant of +0.
        const bool undo = orientations_[element] == 0 && glint_mat4_determinant3(&blend) < 0;
        normals_[element] = glint_vec3_scale(turned, undo ? -1 : 1);
    }
    return weighting;
}

void Shape::refuse_element(std::size_t element) const
{
    refuse_influence(primitive_->influences, vertex_of(element), joints_->size(),
                     primitive_->place());
}

void deform(const std::vector<Shape *> &shapes, bool with_normals, Tally &tally)
{
    check_memory(shapes, with_normals);
    std::vector<Task> tasks;
    for (Shape *shape : shapes) {
        shape->allocate(with_normals);
        const std::size_t count = shape->element_count();
        for (std::size_t first = 0; first < count; first += elements_per_task) {
            tasks.push_back({shape, first, std::min(first + elements_per_task, count)});
        }
    }
    glint_parallel_for(tasks.size(), run, tasks.data());
    const Shape *said[2] = {nullptr, nullptr};
    for (const Task &task : tasks) {
        if (has_met(task, Weighting::no_weight) || has_met(task, Weighting::no_joint)) {
            task.shape->refuse_element(task.first);
        }
        const std::string where = task.shape->primitive().place().text();
        if (has_met(task, Weighting::not_one) && said[0] != task.shape) {
            tally.add("joint weights do not sum to 1 and are normalised", where);
            said[0] = task.shape;
        }
        if (has_met(task, Weighting::none) && said[1] != task.shape) {
            tally.add("vertices without a joint weight follow the first joint that they name",
                      where);
            said[1] = task.shape;
        }
    }
}

} // namespace glint
