// Shapes: primitives at one time, morphed by their targets and then skinned. Flattening asks here
// for positions and normals that are not the file's own.
#ifndef GLINT_SCENE_GLTF_SHAPE_HPP
#define GLINT_SCENE_GLTF_SHAPE_HPP

#include "scene/gltf/morph.hpp"
#include "scene/gltf/primitive.hpp"
#include "scene/gltf/skin.hpp"
#include "scene/gltf/tally.hpp"

#include <vector>

namespace glint
{

class Shape
{
  public:
    // `joints` are the matrices of a skin's joints, from the bound mesh to the world; NULL: none.
    // Borrows the primitive and the joints.
    Shape(const Primitive &primitive, const std::vector<double> &weights,
          const std::vector<glint_mat4> *joints);

    // False if positions and normals are the file's: then there is nothing to compute.
    bool deforms() const
    {
        return is_skinned() || morph_.moves(morph_position) || morph_.moves(morph_normal);
    }

    // True if positions are in world space, so that the node's own place does not count. False for
    // a primitive without influences.
    bool is_skinned() const
    {
        return joints_ != nullptr;
    }

    // The element at corner c of triangle t, after deform(). Normals have any length.
    std::size_t element(std::size_t t, std::size_t c) const
    {
        return is_per_corner_ ? 3 * t + c : primitive_->vertex(t, c);
    }
    glint_vec3 position(std::size_t element) const
    {
        return positions_[element];
    }
    glint_vec3 normal(std::size_t element) const
    {
        return normals_[element];
    }

    // True if the joints turn the triangle inside out, by the majority of its corners.
    bool is_mirrored(std::size_t t) const;

    // The steps of deform(): allocate the memory; compute one element, without allocation; refuse a
    // faulty element.
    void allocate(bool with_normals);
    Weighting deform_element(std::size_t element);
    [[noreturn]] void refuse_element(std::size_t element) const;

    std::size_t element_count() const
    {
        return is_per_corner_ ? 3 * primitive_->triangles : primitive_->positions.count();
    }
    // The approximate number of vectors that deform() reads and adds.
    double cost() const
    {
        const std::size_t each = 1 + morph_.part_count() + 4 * primitive_->influences.size();
        return static_cast<double>(element_count()) * static_cast<double>(each);
    }
    const Primitive &primitive() const
    {
        return *primitive_;
    }

  private:
    std::size_t vertex_of(std::size_t element) const
    {
        return is_per_corner_ ? primitive_->vertex(element / 3, element % 3) : element;
    }

    const Primitive *primitive_;
    Morph morph_;
    const std::vector<glint_mat4> *joints_;
    // If most vertices belong to no triangle, each corner has an element of its own. So the number
    // of triangles limits time and memory.
    bool is_per_corner_;
    std::vector<glint_vec3> positions_, normals_; // [element]; normals only if the file has them
    std::vector<signed char> orientations_;       // −1: mirrored, 0: flattened, 1: neither
};

// Computes the shapes on all cores. Each vertex is computed by itself in double precision, so the
// number of threads does not change the result. Refuses influences that are faulty, and shapes too
// large for memory. Repairs and tallies other bad weights.
void deform(const std::vector<Shape *> &shapes, bool with_normals, Tally &tally);

} // namespace glint

#endif
