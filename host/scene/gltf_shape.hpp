// Primitives as they stand at one time: morphed by their targets, then skinned. This is where
// flattening asks for positions and normals that are not the file's own.
#ifndef GLINT_SCENE_GLTF_SHAPE_HPP
#define GLINT_SCENE_GLTF_SHAPE_HPP

#include "scene/gltf_morph.hpp"
#include "scene/gltf_primitive.hpp"
#include "scene/gltf_skin.hpp"
#include "scene/gltf_tally.hpp"

#include <vector>

namespace glint
{

class Shape
{
  public:
    // `joints` are the matrices of a skin's joints, from the mesh as bound to the world; NULL:
    // none. Borrows both.
    Shape(const Primitive &primitive, const std::vector<double> &weights,
          const std::vector<glint_mat4> *joints);

    // False where all is as the file has it: there is nothing to compute then.
    bool deforms() const
    {
        return is_skinned() || morph_.moves(morph_position) || morph_.moves(morph_normal);
    }

    // Positions are the world's then, and the node's own place does not count. False also where the
    // primitive has no influences.
    bool is_skinned() const
    {
        return joints_ != nullptr;
    }

    // Of the vertex at corner c of triangle t, after deform(). Normals have any length.
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

    // Whether the joints turn a triangle inside out, by most of its corners.
    bool is_mirrored(std::size_t t) const;

    // Steps of deform(): the memory; one element, which allocates nothing; the refusal of one that
    // is at fault.
    void allocate(bool with_normals);
    Weighting deform_element(std::size_t element);
    [[noreturn]] void refuse_element(std::size_t element) const;

    std::size_t element_count() const
    {
        return is_per_corner_ ? 3 * primitive_->triangles : primitive_->positions.count();
    }
    // About how many vectors deform() reads and adds.
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
    // Where most vertices belong to no triangle, each corner has an element of its own, so that
    // time and memory are bounded by the triangles.
    bool is_per_corner_;
    std::vector<glint_vec3> positions_, normals_; // by element; no normals where there are none
    std::vector<signed char> orientations_;       // −1: mirrored, 0: flattened, 1
};

// Computes the shapes on all cores, each vertex in double precision by itself, so that the result
// depends on no other and on no number of threads. Refuses influences that mean nothing, and what
// memory does not hold. Those that can be mended are tallied.
void deform(const std::vector<Shape *> &shapes, bool with_normals, Tally &tally);

} // namespace glint

#endif
