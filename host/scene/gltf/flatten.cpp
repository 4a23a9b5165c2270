// Flattens the scene in two passes over the drawn triangles. The first pass finds the bounds, which
// give origin and unit; the second stores. World positions in double exist only during the work on
// them. So the scene's arrays take all the memory. See flatten.hpp.
#include "scene/gltf/flatten.hpp"

#include "base/free_memory.h"
#include "base/memory.h"
#include "scene/gltf/attributes.hpp"
#include "scene/gltf/bounds.hpp"
#include "scene/gltf/coverage.h"
#include "scene/shape/tangents.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <new>
#include <set>

namespace glint
{

namespace
{

// A scene of this size takes 10 GiB; indices of its floats stay below 2^31.
constexpr std::size_t most_triangles = std::size_t{1} << 27;
// Memory of the search for small parts, bytes per triangle. If memory is short, there is no search,
// and all positions are stored relative to the scene's origin.
constexpr std::size_t bytes_of_search = 320;
// Metres. Beyond, squares of lengths exceed a float's range.
constexpr double farthest = 1e18;

struct Corner {
    std::size_t vertex;
    std::size_t element; // of the draw's shape, if there is one
    glint_vec3 local;
};
using Triangle = std::array<Corner, 3>;

bool is_finite(glint_vec3 p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool equal(glint_vec3 a, glint_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Returns the triangle's corners in stored order.
Triangle corners_of(const Draw &draw, std::size_t t, bool mirrored)
{
    Triangle result;
    for (std::size_t c = 0; c < 3; c++) {
        // A mirroring node reverses the winding. Swapping two corners restores the outside.
        std::size_t from = mirrored && c > 0 ? 3 - c : c;
        std::size_t vertex = glint_primitive_vertex(draw.primitive, t, from);
        if (draw.shape != nullptr) {
            const std::size_t element = glint_shape_element(draw.shape, t, from);
            result[c] = {vertex, element, draw.shape->positions[element]};
            continue;
        }
        std::array<double, 3> p{};
        glint_array_numbers(&draw.primitive->positions, vertex, 3, p.data());
        result[c] = {vertex, 0, {p[0], p[1], p[2]}};
    }
    return result;
}

[[noreturn]] void refuse_position(const Draw &draw, const Corner &corner)
{
    refuse(place_of(*draw.primitive) / "attributes" / "POSITION",
           "vertex " + std::to_string(corner.vertex) + " is (" + shown(corner.local.x) + ", " +
               shown(corner.local.y) + ", " + shown(corner.local.z) + ")" +
               (draw.shape != nullptr ? " once its targets and joints have moved it" : "") +
               " (positions must be finite)");
}

// True if two corners are at one place. Such a triangle is degenerate under every transform and
// must not stretch the bounds.
bool is_collapsed(const Triangle &triangle)
{
    return equal(triangle[0].local, triangle[1].local) ||
           equal(triangle[1].local, triangle[2].local) ||
           equal(triangle[2].local, triangle[0].local);
}

double larger(double a, double b, double c)
{
    return std::max(a, std::max(b, c));
}

// The results of the first pass.
struct Measures {
    Bounds bounds;
    double smallest = INFINITY; // width of the smallest triangle, metres
};

double width_of(const Bounds &bounds)
{
    return larger(bounds.high.x - bounds.low.x, bounds.high.y - bounds.low.y,
                  bounds.high.z - bounds.low.z);
}

Measures measure(const std::vector<Draw> &draws)
{
    Measures measures;
    for (const Draw &draw : draws) {
        for (std::size_t t = 0; t < draw.primitive->triangles; t++) {
            Triangle triangle = corners_of(draw, t, false);
            for (const Corner &corner : triangle) {
                if (!is_finite(corner.local)) {
                    refuse_position(draw, corner);
                }
            }
            if (is_collapsed(triangle)) {
                continue;
            }
            Bounds own;
            for (const Corner &corner : triangle) {
                glint_vec3 p = glint_mat4_point(&draw.to_world, corner.local);
                // Written so that NaN is refused, too.
                if (!(std::fabs(p.x) <= farthest && std::fabs(p.y) <= farthest &&
                      std::fabs(p.z) <= farthest)) {
                    refuse((Place() / "nodes")[static_cast<std::size_t>(draw.node)],
                           "its mesh reaches farther than " + shown(farthest) +
                               " m from the origin (use smaller coordinates or scales)");
                }
                measures.bounds.grow(p);
                own.grow(p);
            }
            measures.smallest = std::min(measures.smallest, width_of(own));
        }
    }
    return measures;
}

// `step` is a power of two. Beyond 2^52 steps every double is already a multiple of it.
double rounded_to(double value, double step)
{
    return std::nearbyint(value / step) * step + 0.0; // + 0.0 avoids −0
}

// Chooses unit and origin. The unit is the least power of two that holds half the extent. The
// origin is the centre, rounded to 1/64 of the unit: it has few bits, so that most positions keep
// their bits in the subtraction. If the rounding pushes the farthest vertex past 1, the unit
// doubles.
void choose_frame(const Bounds &bounds, glint_scene &scene)
{
    const glint_vec3 low = bounds.low;
    const glint_vec3 high = bounds.high;
    scene.unit = 1;
    scene.origin = {0, 0, 0};
    if (bounds.is_empty()) {
        return;
    }
    double half = width_of(bounds) / 2;
    int exponent = 0;
    double mantissa = std::frexp(half, &exponent); // half = mantissa × 2^exponent, in [1/2, 1)
    // Limit the unit, so that metres per unit stay in a float's range.
    scene.unit =
        half > 0 ? std::ldexp(1.0, std::max(mantissa == 0.5 ? exponent - 1 : exponent, -100)) : 1;
    double step = scene.unit / 64;
    scene.origin = {rounded_to(low.x + (high.x - low.x) / 2, step),
                    rounded_to(low.y + (high.y - low.y) / 2, step),
                    rounded_to(low.z + (high.z - low.z) / 2, step)};
    glint_vec3 o = scene.origin;
    double reach = larger(larger(high.x - o.x, high.y - o.y, high.z - o.z), o.x - low.x,
                          std::max(o.y - low.y, o.z - low.z));
    if (reach > scene.unit) {
        scene.unit *= 2;
    }
}

class Writer
{
  public:
    Writer(Load &load, glint_scene &scene) : load_(load), draws_(load.draws), scene_(scene) {}

    // Stores all draws. `default_material` serves primitives that name no material.
    // `looks_for_parts`: there may be small parts.
    void write(std::size_t triangles, bool with_normals, std::uint32_t default_material,
               bool looks_for_parts)
    {
        allocate(triangles, with_normals);
        if (looks_for_parts && bytes_of_search * triangles <= glint_free_memory() / 2) {
            find_parts(triangles);
        }
        for (const Draw &draw : draws_) {
            glint_instance &instance = scene_.instances[scene_.instance_count];
            instance.node_index = draw.node;
            instance.first_triangle = scene_.triangle_count;
            instance.material = draw.primitive->material < 0
                                    ? default_material
                                    : static_cast<std::uint32_t>(draw.primitive->material);
            write_draw(draw, instance.material);
            instance.triangle_count = scene_.triangle_count - instance.first_triangle;
            if (instance.triangle_count > 0) {
                scene_.instance_count++;
            }
        }
        finish_bounds();
    }

  private:
    // Checks the free memory before touching the arrays: otherwise they would displace other
    // programs' memory.
    static void check_memory(std::size_t triangles, std::size_t bytes)
    {
        const double gib = 1 << 30;
        const std::uint64_t left = glint_free_memory();
        if (bytes > left) {
            throw shortage("its " + std::to_string(triangles) + " triangles take " +
                           shown(std::round(double(bytes) / gib * 10) / 10) + " GiB, and " +
                           shown(std::round(double(left) / gib * 10) / 10) +
                           " GiB of memory are free (render a part with --only, or instance less)");
        }
    }

    void allocate(std::size_t triangles, bool with_normals)
    {
        const std::size_t stride = glint_attributes_stride(&scene_.attribute_set);
        check_memory(triangles, glint_scene_bytes(triangles, with_normals, &scene_.attribute_set));
        scene_.positions = static_cast<float *>(glint_allocate(triangles, 9 * sizeof(float)));
        scene_.normals = with_normals
                             ? static_cast<float *>(glint_allocate(triangles, 9 * sizeof(float)))
                             : nullptr;
        scene_.attributes =
            stride > 0 ? static_cast<float *>(glint_allocate(triangles, 3 * stride * sizeof(float)))
                       : nullptr;
        scene_.material_of =
            static_cast<std::uint32_t *>(glint_allocate(triangles, sizeof(std::uint32_t)));
        // One more: an instance begins before it is known whether any triangle of it remains.
        scene_.instances = static_cast<glint_instance *>(
            glint_allocate(draws_.size() + 1, sizeof(glint_instance)));
        if (scene_.positions == nullptr || scene_.material_of == nullptr ||
            scene_.instances == nullptr || (with_normals && scene_.normals == nullptr) ||
            (stride > 0 && scene_.attributes == nullptr)) {
            throw std::bad_alloc();
        }
    }

    // Finds the parts of all triangles that are not collapsed. Triangles without area are dropped
    // later.
    void find_parts(std::size_t triangles)
    {
        std::vector<double> exact;
        exact.reserve(9 * triangles);
        for (const Draw &draw : draws_) {
            for (std::size_t t = 0; t < draw.primitive->triangles; t++) {
                const Triangle triangle = corners_of(draw, t, winds_back(draw, t));
                for (std::size_t c = 0; !is_collapsed(triangle) && c < 3; c++) {
                    const glint_vec3 p = stored_place(draw, triangle[c]);
                    exact.insert(exact.end(), {p.x, p.y, p.z});
                }
            }
        }
        if (glint_parts_find(exact.data(), exact.size() / 9, &scene_.parts, nullptr) != GLINT_OK) {
            throw std::bad_alloc();
        }
    }

    static bool winds_back(const Draw &draw, std::size_t t)
    {
        const bool inside_out = draw.shape != nullptr && glint_shape_is_mirrored(draw.shape, t);
        return (glint_mat4_determinant3(&draw.to_world) < 0) != inside_out;
    }

    glint_vec3 stored_place(const Draw &draw, const Corner &corner) const
    {
        const glint_vec3 world = glint_mat4_point(&draw.to_world, corner.local);
        return glint_vec3_scale(glint_vec3_subtract(world, scene_.origin), 1 / scene_.unit);
    }

    void write_draw(const Draw &draw, std::uint32_t material)
    {
        const std::array<glint_vec3, 3> turned = {
            glint_mat4_normal(&draw.to_world, {1, 0, 0}),
            glint_mat4_normal(&draw.to_world, {0, 1, 0}),
            glint_mat4_normal(&draw.to_world, {0, 0, 1}),
        };
        for (std::size_t t = 0; t < draw.primitive->triangles; t++) {
            Triangle triangle = corners_of(draw, t, winds_back(draw, t));
            float *p = scene_.positions + 9 * scene_.triangle_count;
            if (is_collapsed(triangle) || !store_positions(draw, triangle, p)) {
                scene_.degenerate_triangles++;
                continue;
            }
            for (int k = 0; k < 9; k++) {
                low_[k % 3] = std::min(low_[k % 3], p[k]);
                high_[k % 3] = std::max(high_[k % 3], p[k]);
            }
            if (draw.primitive->normals.count > 0) {
                store_normals(draw, triangle, turned);
            }
            if (scene_.attributes != nullptr) {
                const std::size_t floats = 3 * glint_attributes_stride(&scene_.attribute_set);
                const std::array<std::size_t, 3> corners = {triangle[0].vertex, triangle[1].vertex,
                                                            triangle[2].vertex};
                store_attributes(load_, draw, corners, scene_.attribute_set,
                                 scene_.attributes + floats * scene_.triangle_count);
            }
            scene_.material_of[scene_.triangle_count++] = material;
        }
    }

    // Stores a triangle's positions. Returns false if it has no area.
    bool store_positions(const Draw &draw, const Triangle &triangle, float *p)
    {
        if (scene_.parts.count > 0) {
            return take_from_part(p);
        }
        for (std::size_t c = 0; c < 3; c++) {
            const glint_vec3 stored = stored_place(draw, triangle[c]);
            p[3 * c] = static_cast<float>(stored.x);
            p[3 * c + 1] = static_cast<float>(stored.y);
            p[3 * c + 2] = static_cast<float>(stored.z);
        }
        return glint_triangle_has_area(p);
    }

    // Does the same from the parts, for the next triangle in them.
    bool take_from_part(float *p)
    {
        const glint_parts &parts = scene_.parts;
        const std::size_t from = taken_++;
        const std::size_t to = scene_.triangle_count;
        std::copy_n(parts.positions + 9 * from, 9, parts.positions + 9 * to);
        parts.part_of[to] = parts.part_of[from];
        for (int k = 0; k < 9; k++) {
            p[k] = parts.anchors[parts.part_of[to]][k % 3] + parts.positions[9 * to + k];
        }
        return glint_triangle_has_area(parts.positions + 9 * to);
    }

    // glint_vec3_normalize turns normals that are zero, NaN or infinite into (0, 0, 0).
    void store_normals(const Draw &draw, const Triangle &triangle,
                       const std::array<glint_vec3, 3> &turned)
    {
        float *stored = scene_.normals + 9 * scene_.triangle_count;
        for (std::size_t c = 0; c < 3; c++) {
            std::array<double, 3> n{};
            if (draw.shape != nullptr) {
                const glint_vec3 moved = draw.shape->normals[triangle[c].element];
                n = {moved.x, moved.y, moved.z};
            } else {
                glint_array_numbers(&draw.primitive->normals, triangle[c].vertex, 3, n.data());
            }
            glint_vec3 sum = glint_vec3_scale(turned[0], n[0]);
            sum = glint_vec3_add(sum, glint_vec3_scale(turned[1], n[1]));
            sum = glint_vec3_normalize(glint_vec3_add(sum, glint_vec3_scale(turned[2], n[2])));
            stored[3 * c] = static_cast<float>(sum.x);
            stored[3 * c + 1] = static_cast<float>(sum.y);
            stored[3 * c + 2] = static_cast<float>(sum.z);
        }
    }

    // Sets the bounds of the stored triangles.
    void finish_bounds()
    {
        auto world = [&](const std::array<float, 3> &p) {
            glint_vec3 stored = {p[0], p[1], p[2]};
            return glint_vec3_add(scene_.origin, glint_vec3_scale(stored, scene_.unit));
        };
        scene_.low = world(low_);
        scene_.high = world(high_);
    }

    Load &load_;
    const std::vector<Draw> &draws_;
    glint_scene &scene_;
    std::size_t taken_ = 0; // triangles taken from the parts, including those without area
    std::array<float, 3> low_ = {INFINITY, INFINITY, INFINITY};
    std::array<float, 3> high_ = {-INFINITY, -INFINITY, -INFINITY};
};

// Stores the file's nodes, and the names of drawn nodes.
void name_nodes(const Model &model, glint_scene &scene)
{
    const std::size_t count = model.nodes.size();
    scene.nodes = static_cast<glint_node *>(glint_allocate(count, sizeof(glint_node)));
    if (scene.nodes == nullptr) {
        throw std::bad_alloc();
    }
    scene.node_count = count;
    for (std::size_t i = 0; i < count; i++) {
        scene.nodes[i].parent = model.parents[i];
        scene.nodes[i].name = copy_text(model.nodes[i].name);
    }
    for (std::size_t i = 0; i < scene.instance_count; i++) {
        glint_instance &instance = scene.instances[i];
        instance.node = scene.nodes[instance.node_index].name;
    }
}

// Keeps the materials that triangles use, in the order of the file, the default one last. So glint
// compiles nothing for other materials and does not warn of them.
void keep_used_materials(Load &load, std::size_t default_material, glint_scene &scene)
{
    constexpr std::uint32_t unused = 0xFFFFFFFF;
    std::vector<std::uint32_t> place(default_material + 1, unused);
    // Find the used materials.
    for (std::size_t i = 0; i < scene.instance_count; i++) {
        place[scene.instances[i].material] = 0;
    }
    auto used = static_cast<std::size_t>(
        std::count_if(place.begin(), place.end(), [](std::uint32_t p) { return p == 0; }));
    scene.materials = static_cast<glint_material *>(glint_allocate(used, sizeof(glint_material)));
    if (scene.materials == nullptr) {
        throw std::bad_alloc();
    }
    // Move them to the scene.
    const json &root = load.document.root;
    for (std::size_t i = 0; i < place.size(); i++) {
        if (place[i] == unused) {
            continue;
        }
        std::ptrdiff_t source = i == default_material ? -1 : static_cast<std::ptrdiff_t>(i);
        place[i] = static_cast<std::uint32_t>(scene.material_count);
        const UsedMaterial &used_material = load.materials.at(source);
        glint_material &material = scene.materials[scene.material_count];
        material = used_material.material;
        material.name = copy_text(material_name(root, source));
        scene.material_count++;
        const bool loses = glint_coverage_is_lost(&scene, load.images.textures(), &material,
                                                  static_cast<std::uint32_t>(i));
        survey_material(root, source, used_material, loses, load.tally);
    }
    // Renumber the materials of instances and triangles.
    for (std::size_t i = 0; i < scene.instance_count; i++) {
        scene.instances[i].material = place[scene.instances[i].material];
    }
    for (std::size_t t = 0; t < scene.triangle_count; t++) {
        scene.material_of[t] = place[scene.material_of[t]];
    }
}

} // namespace

void check_triangle_count(std::size_t triangles)
{
    if (triangles > most_triangles) {
        throw refusal(std::to_string(triangles) + " triangles are more than the " +
                      std::to_string(most_triangles) + " that fit (split the scene)");
    }
}

void flatten(Load &load, glint_scene &scene)
{
    std::size_t triangles = 0;
    bool with_normals = false;
    std::set<const glint_shape *> drawn; // hidden shapes cost nothing
    for (const Draw &draw : load.draws) {
        triangles += draw.primitive->triangles; // at most 2^22 draws of 2^33
        drawn.insert(draw.shape);
        with_normals = with_normals || draw.primitive->normals.count > 0;
    }
    check_triangle_count(triangles);
    std::vector<glint_shape *> shapes = load.poses.deforming();
    shapes.erase(std::remove_if(shapes.begin(), shapes.end(),
                                [&](const glint_shape *shape) { return drawn.count(shape) == 0; }),
                 shapes.end());
    deform(shapes, with_normals, load.tally);
    const Measures measures = measure(load.draws);
    choose_frame(measures.bounds, scene);
    std::size_t default_material = objects_of(load.document.root, "materials").size();
    scene.attribute_set = attributes_of(load);
    Writer(load, scene)
        .write(triangles, with_normals, static_cast<std::uint32_t>(default_material),
               glint_parts_may_be_there(measures.smallest / scene.unit));
    load.poses.clear(); // their memory is free during rendering
    load.draws.clear();
    name_nodes(load.model, scene);
    keep_used_materials(load, default_material, scene);
    scene.textures = glint_textures_share(load.images.textures());
    if (scene.attribute_set.tangents && !glint_scene_complete_tangents(&scene)) {
        throw std::bad_alloc();
    }
}

} // namespace glint
