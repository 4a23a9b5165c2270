// Finds where a scene's digits do not suffice. See digits.h. A part has digits of its own
// (parts.h), but a larger surface beside it is rounded to the digits of its far corners. Linear in
// time.
#include "scene/shape/digits.h"

#include "base/memory.h"
#include "kernels/layout.h"
#include "scene/shape/faces.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define CANDIDATES_MAX 64 // more parts are not looked at

// A small part: the triangles of one anchor.
typedef struct part {
    double low[3], high[3];
    size_t first_triangle;
    double place; // the greatest depth of a place on a surface beside it
} part;

static double width_of(const part *p)
{
    return fmax(p->high[0] - p->low[0], fmax(p->high[1] - p->low[1], p->high[2] - p->low[2]));
}

static glint_vec3 middle_of(const part *p)
{
    return (glint_vec3){(p->low[0] + p->high[0]) / 2, (p->low[1] + p->high[1]) / 2,
                        (p->low[2] + p->high[2]) / 2};
}

// The depth of a place on a face.
static double place_on(const glint_face *f)
{
    return (double)GLINT_TOUCHING * f->along_normal;
}

// True if the part is beside the face, at a distance of up to its width and a place.
static bool is_beside(const part *p, const glint_face *f)
{
    const glint_vec3 middle = middle_of(p);
    const double reach = width_of(p);
    const double height = glint_vec3_dot(f->normal, glint_vec3_subtract(middle, f->at[0]));
    return fabs(height) <= reach + place_on(f) && glint_face_faces(f, middle, reach);
}

// True if a part is at least as wide as a pixel.
static bool is_seen(const glint_scene *scene, const part *p, const glint_camera *camera, int height)
{
    if (camera == NULL) {
        return true;
    }
    const glint_vec3 middle =
        glint_vec3_add(scene->origin, glint_vec3_scale(middle_of(p), scene->unit));
    const double width = width_of(p) * scene->unit;
    const double depth =
        -glint_vec3_dot(glint_vec3_subtract(middle, camera->eye), camera->back) - width;
    const double shown =
        camera->orthographic ? 2 * camera->ymag : 2 * tan(camera->yfov / 2) * fmax(depth, 0);
    return depth > -2 * width && width * height >= shown;
}

// Finds the bounds of the parts.
static part *measure_parts(const glint_scene *scene)
{
    const glint_parts *parts = &scene->parts;
    part *all = glint_allocate(parts->count, sizeof *all);
    for (size_t i = 0; all != NULL && i < parts->count; i++) {
        all[i] = (part){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0, 0};
    }
    for (size_t t = 0; all != NULL && t < scene->triangle_count; t++) {
        part *own = &all[parts->part_of[t]];
        own->first_triangle = own->low[0] > own->high[0] ? t : own->first_triangle;
        for (size_t i = 0; i < 3; i++) {
            const glint_vec3 at = glint_scene_corner(scene, t, i);
            const double p[3] = {at.x, at.y, at.z};
            for (int k = 0; k < 3; k++) {
                own->low[k] = fmin(own->low[k], p[k]);
                own->high[k] = fmax(own->high[k], p[k]);
            }
        }
    }
    return all;
}

// Keeps only parts that may be too small, and are seen. Returns their number.
static size_t choose_parts(const glint_scene *scene, const glint_camera *camera, int height,
                           part *all)
{
    double largest = 0; // depth of a place on the triangles that have no anchor
    for (size_t t = 0; t < scene->triangle_count; t++) {
        if (scene->parts.part_of[t] == 0) {
            const glint_face f = glint_face_of(scene, t);
            largest = fmax(largest, place_on(&f));
        }
    }
    size_t count = 0;
    for (size_t i = 1; i < scene->parts.count && count < CANDIDATES_MAX; i++) {
        if (width_of(&all[i]) < largest && is_seen(scene, &all[i], camera, height)) {
            all[count++] = all[i];
        }
    }
    return count;
}

static uint32_t instance_of(const glint_scene *scene, size_t triangle)
{
    size_t i = 0;
    while (i + 1 < scene->instance_count && scene->instances[i + 1].first_triangle <= triangle) {
        i++;
    }
    return (uint32_t)i;
}

glint_coarse_places glint_coarse_places_find(const glint_scene *scene, const glint_camera *camera,
                                             int height)
{
    glint_coarse_places found = {0};
    part *all = scene->parts.count > 0 ? measure_parts(scene) : NULL;
    const size_t count = all != NULL ? choose_parts(scene, camera, height, all) : 0;
    for (size_t t = 0; count > 0 && t < scene->triangle_count; t++) {
        const glint_face f = glint_face_of(scene, t);
        const double place = place_on(&f);
        for (size_t i = 0; scene->parts.part_of[t] == 0 && i < count; i++) {
            if (width_of(&all[i]) < place && is_beside(&all[i], &f)) {
                all[i].place = fmax(all[i].place, place);
            }
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (all[i].place > 0 && found.count++ == 0) {
            found.instance = instance_of(scene, all[i].first_triangle);
            found.width = width_of(&all[i]) * scene->unit;
            found.place = all[i].place * scene->unit;
        }
    }
    free(all);
    return found;
}

void glint_coarse_places_warn(const glint_scene *scene, const glint_camera *camera, int height,
                              glint_warnings *warnings)
{
    const glint_coarse_places found = glint_coarse_places_find(scene, camera, height);
    if (found.count == 0) {
        return;
    }
    const glint_instance *instance = &scene->instances[found.instance];
    char more[40] = "";
    if (found.count > 1) {
        snprintf(more, sizeof more, ", and %zu more part%s", found.count - 1,
                 found.count == 2 ? "" : "s");
    }
    glint_warn(warnings,
               "%s: %s%s%s (node %d) is %.2g m wide, and a large surface beside it is placed to "
               "%.2g m%s: they run into each other (in the file, remove what is far away)",
               scene->path != NULL ? scene->path : "the scene", instance->node != NULL ? "\"" : "",
               instance->node != NULL ? instance->node : "a part",
               instance->node != NULL ? "\"" : "", instance->node_index, found.width, found.place,
               more);
}
