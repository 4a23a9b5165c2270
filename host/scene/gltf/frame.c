// Chooses a scene's origin and unit. See frame.h.
#include "scene/gltf/frame.h"

#include "scene/gltf/bounds.h"
#include "scene/gltf/corners.h"

static const double farthest = 1e18; // metres; beyond, squares of lengths exceed a float's range

static glint_status refuse_position(const glint_draw *draw, const glint_corner *corner,
                                    glint_error *error)
{
    char place[GLINT_PRIMITIVE_PLACE];
    return glint_fail(
        error, GLINT_BAD_INPUT,
        "%s.attributes.POSITION: vertex %zu is (%.9g, %.9g, %.9g)%s (positions must be finite)",
        glint_primitive_place(draw->primitive, place), corner->vertex, corner->local.x,
        corner->local.y, corner->local.z,
        draw->shape != NULL ? " once its targets and joints have moved it" : "");
}

static bool is_finite(glint_vec3 p)
{
    return isfinite(p.x) && isfinite(p.y) && isfinite(p.z);
}

// What the triangles measure.
typedef struct measured {
    glint_bounds bounds;
    double smallest; // width of the smallest triangle, metres
} measured;

static glint_status measure_triangle(const glint_draw *draw, const glint_corners *corners,
                                     measured *measures, glint_error *error)
{
    for (int c = 0; c < 3; c++) {
        if (!is_finite(corners->of[c].local)) {
            return refuse_position(draw, &corners->of[c], error);
        }
    }
    if (glint_corners_are_collapsed(corners)) {
        return GLINT_OK;
    }
    glint_bounds own = GLINT_BOUNDS_EMPTY;
    for (int c = 0; c < 3; c++) {
        const glint_vec3 p = glint_mat4_point(&draw->to_world, corners->of[c].local);
        // Written so that NaN is refused, too.
        if (!(fabs(p.x) <= farthest && fabs(p.y) <= farthest && fabs(p.z) <= farthest)) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "nodes[%d]: its mesh reaches farther than %.9g m from the origin "
                              "(use smaller coordinates or scales)",
                              draw->node, farthest);
        }
        glint_bounds_grow(&measures->bounds, p);
        glint_bounds_grow(&own, p);
    }
    const double width = glint_bounds_width(&own);
    measures->smallest = width < measures->smallest ? width : measures->smallest;
    return GLINT_OK;
}

// `step` is a power of two. Beyond 2^52 steps every double is already a multiple of it.
static double rounded_to(double value, double step)
{
    return nearbyint(value / step) * step + 0.0; // + 0.0 avoids −0
}

// The unit is the least power of two that holds half the extent. The origin is the centre, rounded
// to 1/64 of the unit: it has few bits, so that most positions keep their bits in the subtraction.
// If the rounding pushes the farthest vertex past 1, the unit doubles.
static void choose(const glint_bounds *bounds, glint_scene *scene)
{
    const glint_vec3 low = bounds->low, high = bounds->high;
    scene->unit = 1;
    scene->origin = (glint_vec3){0, 0, 0};
    if (glint_bounds_are_empty(bounds)) {
        return;
    }
    const double half = glint_bounds_width(bounds) / 2;
    int exponent = 0;
    const double mantissa = frexp(half, &exponent); // half = mantissa × 2^exponent, in [1/2, 1)
    const int least = mantissa == 0.5 ? exponent - 1 : exponent;
    // Limit the unit, so that metres per unit stay in a float's range.
    scene->unit = half > 0 ? ldexp(1.0, least > -100 ? least : -100) : 1;
    const double step = scene->unit / 64;
    const glint_vec3 o = {rounded_to(low.x + (high.x - low.x) / 2, step),
                          rounded_to(low.y + (high.y - low.y) / 2, step),
                          rounded_to(low.z + (high.z - low.z) / 2, step)};
    scene->origin = o;
    const double above = fmax(fmax(high.x - o.x, high.y - o.y), high.z - o.z);
    const double below = fmax(fmax(o.x - low.x, o.y - low.y), o.z - low.z);
    if (fmax(above, below) > scene->unit) {
        scene->unit *= 2;
    }
}

glint_status glint_frame_choose(const glint_load *load, glint_scene *scene, double *smallest,
                                glint_error *error)
{
    measured measures = {GLINT_BOUNDS_EMPTY, INFINITY};
    for (size_t i = 0; i < load->draw_count; i++) {
        const glint_draw *draw = &load->draws[i];
        for (size_t t = 0; t < draw->primitive->triangles; t++) {
            const glint_corners corners = glint_draw_corners(draw, t, false);
            TRY(measure_triangle(draw, &corners, &measures, error));
        }
    }
    choose(&measures.bounds, scene);
    *smallest = measures.smallest / scene->unit;
    return GLINT_OK;
}
