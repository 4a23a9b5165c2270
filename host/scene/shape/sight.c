// Proves how many surfaces paths can meet. See sight.h.
#include "scene/shape/sight.h"

#include "scene/shape/convexity.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

// What happens to a path at a surface.
typedef enum fate {
    FATE_ENDS,
    FATE_REFLECTED,
    FATE_PASSES,    // passes straight through a thin wall, or is reflected
    FATE_REFRACTED, // is refracted or reflected
    FATE_UNKNOWN    // partly covered surface: the path may pass or not
} fate;

static fate fate_at(const glint_material *m, bool rough)
{
    const glint_lobes lobes = glint_material_lobes(m);
    if (lobes.masked || lobes.covers) {
        return FATE_UNKNOWN;
    }
    if (lobes.glass) {
        return lobes.solid ? FATE_REFRACTED : FATE_PASSES;
    }
    const bool smooth_coat = lobes.clearcoat && !(rough && lobes.rough_clearcoat);
    const bool reflects = lobes.metal || lobes.gloss || lobes.blend_mirror || smooth_coat;
    const bool by_lobe = rough && (lobes.rough_path || lobes.rough_clearcoat_path);
    return reflects || by_lobe ? FATE_REFLECTED : FATE_ENDS;
}

typedef struct census {
    size_t ends, reflected, passes, refracted, unknown; // numbers of triangles by fate
} census;

static census take_census(const glint_scene *scene, bool rough)
{
    census c = {0};
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        switch (fate_at(&scene->materials[instance->material], rough)) {
        case FATE_ENDS:
            c.ends += instance->triangle_count;
            break;
        case FATE_REFLECTED:
            c.reflected += instance->triangle_count;
            break;
        case FATE_PASSES:
            c.passes += instance->triangle_count;
            break;
        case FATE_REFRACTED:
            c.refracted += instance->triangle_count;
            break;
        case FATE_UNKNOWN:
            c.unknown += instance->triangle_count;
            break;
        }
    }
    return c;
}

static bool goes_on_at(const glint_scene *scene, bool rough, size_t triangle)
{
    return fate_at(&scene->materials[scene->material_of[triangle]], rough) != FATE_ENDS;
}

static glint_vec3 corner(const glint_scene *scene, size_t triangle, size_t k)
{
    return glint_vec3_from_floats(glint_scene_position(scene, triangle, k));
}

// The plane of a triangle; n is a unit vector.
typedef struct plane {
    glint_vec3 n;
    double offset;
} plane;

// The normal; its length is twice the triangle's area.
static glint_vec3 normal_of(const glint_scene *scene, size_t triangle)
{
    const glint_vec3 a = corner(scene, triangle, 0);
    return glint_vec3_cross(glint_vec3_subtract(corner(scene, triangle, 1), a),
                            glint_vec3_subtract(corner(scene, triangle, 2), a));
}

static plane plane_of(const glint_scene *scene, size_t triangle)
{
    const glint_vec3 a = corner(scene, triangle, 0), n = normal_of(scene, triangle);
    const double length = glint_vec3_length(n);
    const glint_vec3 unit = length > 0 ? glint_vec3_scale(n, 1 / length) : n;
    return (plane){unit, glint_vec3_dot(unit, a)};
}

// The distance that a point may be from a plane, for `roundings` of its coordinates.
static double slack_at(const plane *p, glint_vec3 at, double roundings)
{
    const double reach = fabs(p->n.x * at.x) + fabs(p->n.y * at.y) + fabs(p->n.z * at.z);
    return roundings * (double)FLT_EPSILON / 2 * reach;
}

// True if all triangles where paths go on lie in one plane, the plane of the largest triangle. If
// light passes through, the distance of two sheets must be within the rounding of stored corners.
static bool is_flat(const glint_scene *scene, bool rough, bool passes)
{
    const double roundings = passes ? 2 : GLINT_POSITION_ROUNDINGS;
    size_t largest = 0;
    double size = -1;
    for (size_t i = 0; i < scene->triangle_count; i++) {
        const double of = goes_on_at(scene, rough, i) ? glint_vec3_length(normal_of(scene, i)) : -1;
        if (of > size) {
            size = of;
            largest = i;
        }
    }
    const plane p = plane_of(scene, largest);
    for (size_t i = 0; i < scene->triangle_count; i++) {
        for (size_t k = 0; k < 3 && goes_on_at(scene, rough, i); k++) {
            const glint_vec3 at = corner(scene, i, k);
            if (!(fabs(glint_vec3_dot(p.n, at) - p.offset) <= slack_at(&p, at, roundings))) {
                return false;
            }
        }
    }
    return size > 0;
}

// ---- Convex bodies -----------------------------------------------------------------------------

#define PROBES 64
#define FAR_OFF (8 * GLINT_POSITION_ROUNDINGS * (double)FLT_EPSILON) // for coordinates of at most 1

// Tests a few corners of the mirrors: in a convex body they lie on one side of each triangle's
// plane.
static bool may_be_convex(const glint_scene *scene, bool rough, size_t mirrors)
{
    glint_vec3 probes[PROBES];
    size_t count = 0, seen = 0;
    const size_t every = mirrors / PROBES + 1;
    for (size_t i = 0; i < scene->triangle_count && count < PROBES; i++) {
        if (goes_on_at(scene, rough, i) && seen++ % every == 0) {
            probes[count++] = corner(scene, i, 0);
        }
    }
    for (size_t i = 0; i < scene->triangle_count; i++) {
        if (!goes_on_at(scene, rough, i)) {
            continue;
        }
        const plane p = plane_of(scene, i);
        bool in_front = false, behind = false;
        for (size_t k = 0; k < count; k++) {
            const double distance = glint_vec3_dot(p.n, probes[k]) - p.offset;
            in_front = in_front || distance > FAR_OFF;
            behind = behind || distance < -FAR_OFF;
        }
        if (in_front && behind) {
            return false;
        }
    }
    return count > 0;
}

bool glint_sight_wants_topology(const glint_scene *scene, bool rough)
{
    const census c = take_census(scene, rough);
    return !scene->moves && c.reflected > 0 && c.passes == 0 && c.refracted == 0 &&
           c.unknown == 0 && !is_flat(scene, rough, false) &&
           may_be_convex(scene, rough, c.reflected);
}

// True if paths go on at one body only, and it is proved convex.
static bool is_one_convex_body(const glint_scene *scene, const glint_topology *topology, bool rough)
{
    size_t bodies = 0;
    bool convex = true;
    for (size_t i = 0; i < topology->component_count; i++) {
        const glint_component *component = &topology->components[i];
        const uint32_t material = scene->instances[component->instance].material;
        if (fate_at(&scene->materials[material], rough) != FATE_ENDS) {
            bodies++;
            convex = convex && component->convex;
        }
    }
    return bodies == 1 && convex;
}

static glint_sight proved(bool alone, bool from_outside, const char *what)
{
    glint_sight sight = {.depth = alone ? 1 : 2, .from_outside = from_outside};
    snprintf(sight.reason, sizeof sight.reason, "%s %s", what,
             alone ? "sees nothing but the environment" : "sees nothing that sends paths on");
    return sight;
}

static glint_sight not_proved(const char *why)
{
    glint_sight sight = {0};
    snprintf(sight.reason, sizeof sight.reason, "%s", why);
    return sight;
}

glint_sight glint_sight_find(const glint_scene *scene, const glint_topology *topology, bool rough)
{
    const census c = take_census(scene, rough);
    const bool alone = c.ends == 0;
    if (scene->triangle_count == 0) {
        return not_proved("there is no surface");
    }
    if (c.unknown > 0) {
        return not_proved("some surface is there in part: light passes, or not");
    }
    if (c.reflected + c.passes + c.refracted == 0) {
        glint_sight sight = {.depth = 1};
        snprintf(sight.reason, sizeof sight.reason, "every path ends at the first surface");
        return sight;
    }
    if (scene->moves) {
        return not_proved("what moves is not looked at");
    }
    if (c.refracted == 0 && is_flat(scene, rough, c.passes > 0)) {
        return proved(alone, false, c.passes > 0 ? "a flat pane" : "a flat mirror");
    }
    const bool is_convex = is_one_convex_body(scene, topology, rough);
    if (c.refracted == 0 && c.passes == 0 && is_convex) {
        return proved(alone, true, "a closed, convex mirror");
    }
    if (alone && c.reflected + c.passes == 0 && is_convex) {
        glint_sight sight = not_proved("inside of glass light is reflected any number of times");
        sight.exits_escape = true;
        return sight;
    }
    return not_proved(c.refracted > 0
                          ? "what sends paths on is not one convex body alone"
                          : "what sends paths on is neither one convex mirror nor flat");
}
