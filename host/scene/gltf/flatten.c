// Flattens the scene in two passes over the drawn triangles. The first pass finds the bounds, which
// give origin and unit (frame.h); the second stores. World positions in double exist only during
// the work on them. So the scene's arrays take all the memory. See flatten.h.
#include "scene/gltf/flatten.h"

#include "base/free_memory.h"
#include "base/memory.h"
#include "scene/gltf/attributes.h"
#include "scene/gltf/frame.h"

#include <stdlib.h>
#include <string.h>

// A scene of this size takes 10 GiB; indices of its floats stay below 2^31.
static const size_t most_triangles = (size_t)1 << 27;
// Memory of the search for small parts, bytes per triangle. If memory is short, there is no search,
// and all positions are stored relative to the scene's origin.
static const size_t bytes_of_search = 320;

typedef struct scene_writer {
    glint_load *load;
    glint_scene *scene;
    size_t taken; // triangles taken from the parts, including those without area
    float low[3], high[3];
} scene_writer;

// ---- Storing ------------------------------------------------------------------------------------

static glint_vec3 stored_place(const glint_scene *scene, const glint_draw *draw, glint_vec3 local)
{
    const glint_vec3 world = glint_mat4_point(&draw->to_world, local);
    return glint_vec3_scale(glint_vec3_subtract(world, scene->origin), 1 / scene->unit);
}

// Stores a triangle's positions from the parts, for the next triangle in them. Returns false if it
// has no area.
static bool take_from_part(scene_writer *writer, float *p)
{
    glint_parts *parts = &writer->scene->parts;
    const size_t from = writer->taken++, to = writer->scene->triangle_count;
    memmove(parts->positions + 9 * to, parts->positions + 9 * from, 9 * sizeof(float));
    parts->part_of[to] = parts->part_of[from];
    for (int k = 0; k < 9; k++) {
        p[k] = parts->anchors[parts->part_of[to]][k % 3] + parts->positions[9 * to + (size_t)k];
    }
    return glint_triangle_has_area(parts->positions + 9 * to);
}

// Does the same from the corners if there are no parts.
static bool store_positions(scene_writer *writer, const glint_draw *draw,
                            const glint_corners *corners, float *p)
{
    if (writer->scene->parts.count > 0) {
        return take_from_part(writer, p);
    }
    for (int c = 0; c < 3; c++) {
        const glint_vec3 stored = stored_place(writer->scene, draw, corners->of[c].local);
        p[3 * c] = (float)stored.x;
        p[3 * c + 1] = (float)stored.y;
        p[3 * c + 2] = (float)stored.z;
    }
    return glint_triangle_has_area(p);
}

// glint_vec3_normalize turns normals that are zero, NaN or infinite into (0, 0, 0). `turned` holds
// the axes' normals.
static void store_normals(const glint_draw *draw, const glint_corners *corners,
                          const glint_vec3 turned[3], float *stored)
{
    for (int c = 0; c < 3; c++) {
        double n[3];
        if (draw->shape != NULL) {
            const glint_vec3 moved = draw->shape->normals[corners->of[c].element];
            n[0] = moved.x;
            n[1] = moved.y;
            n[2] = moved.z;
        } else {
            glint_array_numbers(&draw->primitive->normals, corners->of[c].vertex, 3, n);
        }
        glint_vec3 sum = glint_vec3_scale(turned[0], n[0]);
        sum = glint_vec3_add(sum, glint_vec3_scale(turned[1], n[1]));
        sum = glint_vec3_normalize(glint_vec3_add(sum, glint_vec3_scale(turned[2], n[2])));
        stored[3 * c] = (float)sum.x;
        stored[3 * c + 1] = (float)sum.y;
        stored[3 * c + 2] = (float)sum.z;
    }
}

static void grow(scene_writer *writer, const float *p)
{
    for (int k = 0; k < 9; k++) {
        float *low = &writer->low[k % 3], *high = &writer->high[k % 3];
        *low = p[k] < *low ? p[k] : *low;
        *high = p[k] > *high ? p[k] : *high;
    }
}

static void write_draw(scene_writer *writer, const glint_draw *draw, uint32_t material)
{
    glint_scene *scene = writer->scene;
    const glint_vec3 turned[3] = {
        glint_mat4_normal(&draw->to_world, (glint_vec3){1, 0, 0}),
        glint_mat4_normal(&draw->to_world, (glint_vec3){0, 1, 0}),
        glint_mat4_normal(&draw->to_world, (glint_vec3){0, 0, 1}),
    };
    const size_t floats = 3 * glint_attributes_stride(&scene->attribute_set);
    for (size_t t = 0; t < draw->primitive->triangles; t++) {
        const glint_corners corners = glint_draw_corners(draw, t, glint_draw_winds_back(draw, t));
        float *p = scene->positions + 9 * scene->triangle_count;
        if (glint_corners_are_collapsed(&corners) || !store_positions(writer, draw, &corners, p)) {
            scene->degenerate_triangles++;
            continue;
        }
        grow(writer, p);
        if (draw->primitive->normals.count > 0) {
            store_normals(draw, &corners, turned, scene->normals + 9 * scene->triangle_count);
        }
        if (scene->attributes != NULL) {
            glint_attributes_store(writer->load, draw, &corners, &scene->attribute_set,
                                   scene->attributes + floats * scene->triangle_count);
        }
        scene->material_of[scene->triangle_count++] = material;
    }
}

static void write_draws(scene_writer *writer)
{
    glint_scene *scene = writer->scene;
    const size_t default_material = writer->load->document.materials_count;
    for (size_t i = 0; i < writer->load->draw_count; i++) {
        const glint_draw *draw = &writer->load->draws[i];
        glint_instance *instance = &scene->instances[scene->instance_count];
        instance->node_index = draw->node;
        instance->first_triangle = scene->triangle_count;
        instance->material =
            (uint32_t)(draw->primitive->material < 0 ? default_material
                                                     : (size_t)draw->primitive->material);
        write_draw(writer, draw, instance->material);
        instance->triangle_count = scene->triangle_count - instance->first_triangle;
        scene->instance_count += instance->triangle_count > 0 ? 1 : 0;
    }
}

// ---- Memory and parts ---------------------------------------------------------------------------

glint_status glint_flatten_check_count(size_t triangles, glint_error *error)
{
    return triangles <= most_triangles
               ? GLINT_OK
               : glint_fail(error, GLINT_BAD_INPUT,
                            "%zu triangles are more than the %zu that fit (split the scene)",
                            triangles, most_triangles);
}

// Checks the free memory before touching the arrays: otherwise they would displace other programs'
// memory.
static glint_status check_memory(size_t triangles, size_t bytes, glint_error *error)
{
    const double gib = 1 << 30;
    const uint64_t left = glint_free_memory();
    return bytes <= left
               ? GLINT_OK
               : glint_fail(error, GLINT_OUT_OF_MEMORY,
                            "its %zu triangles take %.9g GiB, and %.9g GiB of memory are free "
                            "(render a part with --only, or instance less)",
                            triangles, round((double)bytes / gib * 10) / 10,
                            round((double)left / gib * 10) / 10);
}

static glint_status allocate(glint_scene *scene, size_t draws, size_t triangles, bool with_normals,
                             glint_error *error)
{
    const size_t stride = glint_attributes_stride(&scene->attribute_set);
    scene->positions = glint_allocate(triangles, 9 * sizeof(float));
    scene->normals = with_normals ? glint_allocate(triangles, 9 * sizeof(float)) : NULL;
    scene->attributes = stride > 0 ? glint_allocate(triangles, 3 * stride * sizeof(float)) : NULL;
    scene->material_of = glint_allocate(triangles, sizeof *scene->material_of);
    // One more: an instance begins before it is known whether any triangle of it remains.
    scene->instances = glint_allocate(draws + 1, sizeof *scene->instances);
    const bool is_whole = scene->positions != NULL && scene->material_of != NULL &&
                          scene->instances != NULL && (!with_normals || scene->normals != NULL) &&
                          (stride == 0 || scene->attributes != NULL);
    return is_whole ? GLINT_OK : glint_fail_memory(error, "the scene");
}

// The number of places that a draw's corners have: its vertices, or its corners if most vertices
// belong to no triangle.
static size_t count_places(const glint_draw *draw)
{
    const size_t vertices = draw->primitive->positions.count,
                 triangles = draw->primitive->triangles;
    return triangles == 0 || vertices / 3 > triangles ? 3 * triangles : vertices;
}

// All places and corners, as they are written.
typedef struct exact_writer {
    const glint_scene *scene;
    double *places;
    uint32_t *corners;
    size_t place_count, corner_count;
} exact_writer;

static glint_corner corner_at_place(const glint_draw *draw, size_t place, bool is_per_corner)
{
    return is_per_corner         ? glint_draw_corner(draw, place / 3, place % 3)
           : draw->shape != NULL ? (glint_corner){place, place, draw->shape->positions[place]}
                                 : glint_draw_vertex(draw, place);
}

// Writes a draw's places, and the corners of its triangles that are not collapsed.
static void write_exact(exact_writer *writer, const glint_draw *draw)
{
    const size_t base = writer->place_count, count = count_places(draw);
    const bool is_per_corner = count != draw->primitive->positions.count;
    for (size_t i = 0; i < count; i++) {
        const glint_corner corner = corner_at_place(draw, i, is_per_corner);
        const glint_vec3 p = stored_place(writer->scene, draw, corner.local);
        double *place = writer->places + 3 * writer->place_count++;
        place[0] = p.x;
        place[1] = p.y;
        place[2] = p.z;
    }
    for (size_t t = 0; t < draw->primitive->triangles; t++) {
        const bool winds_back = glint_draw_winds_back(draw, t);
        const glint_corners at = glint_draw_corners(draw, t, winds_back);
        for (size_t c = 0; !glint_corners_are_collapsed(&at) && c < 3; c++) {
            const size_t from = 3 * t + (winds_back && c > 0 ? 3 - c : c);
            const size_t place = base + (is_per_corner ? from : at.of[c].vertex);
            writer->corners[writer->corner_count++] = (uint32_t)place;
        }
    }
}

// Finds the parts of all triangles that are not collapsed. Triangles without area are dropped
// later.
static glint_status find_parts(const glint_load *load, size_t triangles, glint_scene *scene,
                               glint_error *error)
{
    size_t places = 0;
    for (size_t i = 0; i < load->draw_count; i++) {
        places += count_places(&load->draws[i]);
    }
    exact_writer writer = {.scene = scene,
                           .places = glint_allocate_unset(places, 3 * sizeof(double)),
                           .corners = glint_allocate_unset(triangles, 3 * sizeof(uint32_t))};
    const bool has_room = writer.places != NULL && writer.corners != NULL;
    for (size_t i = 0; has_room && i < load->draw_count; i++) {
        write_exact(&writer, &load->draws[i]);
    }
    const glint_exact_triangles exact = {writer.places, writer.place_count, writer.corners,
                                         writer.corner_count / 3};
    const bool is_found = has_room && glint_parts_find(&exact, &scene->parts, NULL) == GLINT_OK;
    free(writer.places);
    free(writer.corners);
    return is_found ? GLINT_OK : glint_fail_memory(error, "the scene");
}

// ---- All ----------------------------------------------------------------------------------------

// Computes the shapes that draws show; hidden shapes cost nothing.
static glint_status deform(glint_load *load, bool with_normals, glint_error *error)
{
    size_t count, drawn = 0;
    glint_shape **shapes = glint_poses_deforming(&load->poses, &count);
    if (shapes == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i < count; i++) {
        shapes[i]->is_drawn = false;
    }
    for (size_t i = 0; i < load->draw_count; i++) {
        if (load->draws[i].shape != NULL) {
            load->draws[i].shape->is_drawn = true;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (shapes[i]->is_drawn) {
            shapes[drawn++] = shapes[i];
        }
    }
    const glint_status status =
        glint_shapes_deform(shapes, drawn, with_normals, &load->tally, error);
    free(shapes);
    return status;
}

static void finish_bounds(const scene_writer *writer)
{
    glint_scene *scene = writer->scene;
    const float *low = writer->low, *high = writer->high;
    const glint_vec3 from = {(double)low[0], (double)low[1], (double)low[2]};
    const glint_vec3 to = {(double)high[0], (double)high[1], (double)high[2]};
    scene->low = glint_vec3_add(scene->origin, glint_vec3_scale(from, scene->unit));
    scene->high = glint_vec3_add(scene->origin, glint_vec3_scale(to, scene->unit));
}

glint_status glint_flatten(glint_load *load, glint_scene *scene, glint_error *error)
{
    size_t triangles = 0;
    bool with_normals = false;
    for (size_t i = 0; i < load->draw_count; i++) {
        const glint_primitive *primitive = load->draws[i].primitive;
        triangles += primitive->triangles; // at most 2^22 draws of 2^40
        with_normals = with_normals || primitive->normals.count > 0;
    }
    double smallest;
    TRY(glint_flatten_check_count(triangles, error));
    TRY(deform(load, with_normals, error));
    TRY(glint_frame_choose(load, scene, &smallest, error));
    scene->attribute_set = glint_attributes_needed(load);
    TRY(check_memory(triangles, glint_scene_bytes(triangles, with_normals, &scene->attribute_set),
                     error));
    // Before the arrays take their memory.
    if (glint_parts_may_be_there(smallest) &&
        bytes_of_search * triangles <= glint_free_memory() / 2) {
        TRY(find_parts(load, triangles, scene, error));
    }
    TRY(allocate(scene, load->draw_count, triangles, with_normals, error));
    scene_writer writer = {
        load, scene, 0, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    write_draws(&writer);
    finish_bounds(&writer);
    glint_poses_clear(&load->poses); // their memory is free during rendering
    free(load->draws);
    load->draws = NULL;
    load->draw_count = load->draw_capacity = 0;
    return GLINT_OK;
}
