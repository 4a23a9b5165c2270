// Flattens the scene in two passes over the drawn triangles. The first pass finds the bounds, which
// give origin and unit (frame.h); the second stores. World positions in double exist only during
// the work on them. See flatten.h.
#include "scene/gltf/flatten.h"

#include "base/free_memory.h"
#include "base/memory.h"
#include "scene/gltf/attributes.h"
#include "scene/gltf/frame.h"

#include <stdlib.h>
#include <string.h>

// A scene of this size takes up to 10 GiB; indices of its floats stay below 2^31.
static const size_t most_triangles = (size_t)1 << 27;
// Memory of the search for small parts, bytes per triangle. If memory is short, there is no search,
// and all positions are stored relative to the scene's origin.
static const size_t bytes_of_search = 320;

// The vertex that stands for a place of the current draw.
typedef struct known_vertex {
    uint32_t number; // 1 + its number in the scene. Values up to `first` belong to earlier draws
    uint32_t part;
} known_vertex;

typedef struct scene_writer {
    glint_load *load;
    glint_scene *scene;
    size_t taken;        // triangles that were looked at, those without area too
    known_vertex *known; // [place of a draw]
    size_t first;        // vertices of the draws before
    float low[3], high[3];
} scene_writer;

// The places that a draw's corners may have: as many as its triangles need, not as many as its
// arrays have. Files share large arrays among many primitives.
typedef struct draw_places {
    size_t first, count; // vertices of the file; count is at most the number of corners
    bool is_per_corner;  // instead, each corner has a place of its own: 3 t + c
} draw_places;

// What the vertices of a draw share.
typedef struct draw_writer {
    const glint_draw *draw;
    uint32_t material;
    draw_places places;
    glint_vec3 turned[3]; // the normals of the axes
} draw_writer;

// ---- Storing ------------------------------------------------------------------------------------

static glint_vec3 stored_place(const glint_scene *scene, const glint_draw *draw, glint_vec3 local)
{
    const glint_vec3 world = glint_mat4_point(&draw->to_world, local);
    return glint_vec3_scale(glint_vec3_subtract(world, scene->origin), 1 / scene->unit);
}

static float *told_at(const glint_scene *scene, size_t vertex)
{
    return (scene->parts.count > 0 ? scene->parts.positions : scene->positions) + 3 * vertex;
}

static draw_places places_of(const glint_draw *draw)
{
    const glint_primitive *primitive = draw->primitive;
    const size_t corners = 3 * primitive->triangles, vertices = primitive->positions.count;
    const draw_places per_corner = {0, corners, true};
    if (draw->shape != NULL && draw->shape->is_per_corner) {
        return per_corner;
    }
    if (vertices <= corners) {
        return (draw_places){0, vertices, false};
    }
    size_t low = vertices, high = 0;
    for (size_t i = 0; i < corners; i++) {
        const size_t vertex = glint_primitive_vertex(primitive, i / 3, i % 3);
        low = vertex < low ? vertex : low;
        high = vertex > high ? vertex : high;
    }
    return corners > 0 && high - low < corners ? (draw_places){low, high - low + 1, false}
                                               : per_corner;
}

// The number of the place of a triangle's corner in the stored order, from 0.
static size_t place_at(const draw_places *places, const glint_corners *corners, size_t c)
{
    return places->is_per_corner ? 3 * corners->triangle + c
                                 : corners->of[c].vertex - places->first;
}

static bool is_known(const scene_writer *writer, const known_vertex *known, uint32_t part)
{
    return known->number > writer->first && known->part == part;
}

// Sets the positions of a triangle's corners, relative to the anchor of its part.
static void tell_corners(const scene_writer *writer, const draw_writer *of,
                         const glint_corners *corners, uint32_t part, float told[3][3])
{
    for (size_t c = 0; c < 3; c++) {
        const known_vertex *known = &writer->known[place_at(&of->places, corners, c)];
        if (is_known(writer, known, part)) {
            memcpy(told[c], told_at(writer->scene, known->number - 1), sizeof told[c]);
        } else {
            const glint_vec3 p = stored_place(writer->scene, of->draw, corners->of[c].local);
            glint_parts_tell(&writer->scene->parts, part, (const double[3]){p.x, p.y, p.z},
                             told[c]);
        }
    }
}

// glint_vec3_normalize turns normals that are zero, NaN or infinite into (0, 0, 0).
static void store_normal(const draw_writer *of, const glint_corner *corner, float *stored)
{
    const glint_draw *draw = of->draw;
    double n[3] = {0, 0, 0};
    if (draw->primitive->normals.count > 0 && draw->shape != NULL) {
        const glint_vec3 moved = draw->shape->normals[corner->element];
        n[0] = moved.x;
        n[1] = moved.y;
        n[2] = moved.z;
    } else if (draw->primitive->normals.count > 0) {
        glint_array_numbers(&draw->primitive->normals, corner->vertex, 3, n);
    }
    glint_vec3 sum = glint_vec3_scale(of->turned[0], n[0]);
    sum = glint_vec3_add(sum, glint_vec3_scale(of->turned[1], n[1]));
    sum = glint_vec3_normalize(glint_vec3_add(sum, glint_vec3_scale(of->turned[2], n[2])));
    stored[0] = (float)sum.x;
    stored[1] = (float)sum.y;
    stored[2] = (float)sum.z;
}

static void grow(scene_writer *writer, const float *p)
{
    for (int k = 0; k < 3; k++) {
        writer->low[k] = p[k] < writer->low[k] ? p[k] : writer->low[k];
        writer->high[k] = p[k] > writer->high[k] ? p[k] : writer->high[k];
    }
}

// Returns the number of the new vertex.
static uint32_t write_vertex(scene_writer *writer, const draw_writer *of,
                             const glint_corner *corner, uint32_t part, const float told[3])
{
    glint_scene *scene = writer->scene;
    const size_t vertex = scene->vertex_count++;
    const size_t stride = glint_attributes_stride(&scene->attribute_set);
    float *position = scene->positions + 3 * vertex;
    memcpy(told_at(scene, vertex), told, 3 * sizeof *told);
    glint_parts_round(&scene->parts, part, told, position);
    grow(writer, position);
    if (scene->normals != NULL) {
        store_normal(of, corner, scene->normals + 3 * vertex);
    }
    if (scene->attributes != NULL) {
        glint_attributes_store(writer->load, of->draw, corner->vertex, &scene->attribute_set,
                               scene->attributes + stride * vertex);
    }
    return (uint32_t)vertex;
}

// Writes a triangle that is not collapsed, unless it has no area.
static void write_triangle(scene_writer *writer, const draw_writer *of,
                           const glint_corners *corners)
{
    glint_scene *scene = writer->scene;
    const size_t triangle = scene->triangle_count;
    const bool about_parts = scene->parts.count > 0;
    const uint32_t part = about_parts ? scene->parts.part_of[writer->taken] : 0;
    float told[3][3];
    writer->taken++;
    tell_corners(writer, of, corners, part, told);
    if (!glint_triangle_has_area(told[0], told[1], told[2])) {
        scene->degenerate_triangles++;
        return;
    }
    for (size_t c = 0; c < 3; c++) {
        known_vertex *known = &writer->known[place_at(&of->places, corners, c)];
        if (!is_known(writer, known, part)) {
            known->number = write_vertex(writer, of, &corners->of[c], part, told[c]) + 1;
            known->part = part;
        }
        scene->indices[3 * triangle + c] = known->number - 1;
    }
    if (about_parts) {
        scene->parts.part_of[triangle] = part;
    }
    scene->material_of[scene->triangle_count++] = of->material;
}

static void write_draw(scene_writer *writer, const glint_draw *draw, uint32_t material)
{
    const draw_writer of = {draw,
                            material,
                            places_of(draw),
                            {glint_mat4_normal(&draw->to_world, (glint_vec3){1, 0, 0}),
                             glint_mat4_normal(&draw->to_world, (glint_vec3){0, 1, 0}),
                             glint_mat4_normal(&draw->to_world, (glint_vec3){0, 0, 1})}};
    writer->first = writer->scene->vertex_count;
    for (size_t t = 0; t < draw->primitive->triangles; t++) {
        const glint_corners corners = glint_draw_corners(draw, t, glint_draw_winds_back(draw, t));
        if (glint_corners_are_collapsed(&corners)) {
            writer->scene->degenerate_triangles++;
        } else {
            write_triangle(writer, &of, &corners);
        }
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

// Sizes of a scene's arrays.
typedef struct scene_size {
    size_t draws, triangles;
    size_t vertices; // an upper bound
    size_t places;   // of the draw that has the most
    bool with_normals;
} scene_size;

// Checks the free memory before touching the arrays: otherwise they would displace other programs'
// memory.
static glint_status check_memory(const scene_size *size, const glint_attributes *set,
                                 glint_error *error)
{
    const double gib = 1 << 30;
    const size_t floats = (size->with_normals ? 6U : 3U) + glint_attributes_stride(set);
    const size_t triangles = size->triangles;
    const size_t bytes = triangles * 4 * sizeof(uint32_t) +
                         size->vertices * floats * sizeof(float) +
                         size->places * sizeof(known_vertex);
    const uint64_t left = glint_free_memory();
    return bytes <= left
               ? GLINT_OK
               : glint_fail(error, GLINT_OUT_OF_MEMORY,
                            "its %zu triangles take %.9g GiB, and %.9g GiB of memory are free "
                            "(render a part with --only, or instance less)",
                            triangles, round((double)bytes / gib * 10) / 10,
                            round((double)left / gib * 10) / 10);
}

static glint_status allocate(scene_writer *writer, const scene_size *size, glint_error *error)
{
    glint_scene *scene = writer->scene;
    const size_t triple = 3 * sizeof(float), vertices = size->vertices;
    const size_t stride = glint_attributes_stride(&scene->attribute_set);
    const bool about_parts = scene->parts.count > 0;
    scene->indices = glint_allocate_unset(size->triangles, 3 * sizeof *scene->indices);
    scene->material_of = glint_allocate_unset(size->triangles, sizeof *scene->material_of);
    scene->positions = glint_allocate_unset(vertices, triple);
    scene->normals = size->with_normals ? glint_allocate_unset(vertices, triple) : NULL;
    scene->parts.positions = about_parts ? glint_allocate_unset(vertices, triple) : NULL;
    scene->attributes = stride > 0 ? glint_allocate_unset(vertices, stride * sizeof(float)) : NULL;
    // One more: an instance begins before it is known whether any triangle of it remains.
    scene->instances = glint_allocate(size->draws + 1, sizeof *scene->instances);
    writer->known = glint_allocate(size->places, sizeof *writer->known);
    const bool is_whole = scene->indices != NULL && scene->material_of != NULL &&
                          scene->positions != NULL && scene->instances != NULL &&
                          writer->known != NULL &&
                          (!size->with_normals || scene->normals != NULL) &&
                          (!about_parts || scene->parts.positions != NULL) &&
                          (stride == 0 || scene->attributes != NULL);
    return is_whole ? GLINT_OK : glint_fail_memory(error, "the scene");
}

// Gives back the memory beyond the vertices; failing to do so does no harm. Drops the indices if no
// triangle shares a vertex.
static void finish_arrays(glint_scene *scene)
{
    (void)glint_scene_resize_vertices(scene, scene->vertex_count);
    if (scene->vertex_count == 3 * scene->triangle_count) {
        free(scene->indices);
        scene->indices = NULL;
        scene->vertex_count = 0;
    }
}

// All places and corners, as they are written.
typedef struct exact_writer {
    const glint_scene *scene;
    double *places;
    uint32_t *corners;
    size_t place_count, corner_count;
} exact_writer;

static void write_place(exact_writer *writer, const glint_draw *draw, glint_vec3 local)
{
    const glint_vec3 p = stored_place(writer->scene, draw, local);
    memcpy(writer->places + 3 * writer->place_count++, (const double[3]){p.x, p.y, p.z},
           3 * sizeof(double));
}

// Writes a draw's places, and the corners of its triangles that are not collapsed.
static void write_exact(exact_writer *writer, const glint_draw *draw)
{
    const draw_places places = places_of(draw);
    const size_t base = writer->place_count;
    for (size_t i = 0; !places.is_per_corner && i < places.count; i++) {
        const size_t vertex = places.first + i;
        write_place(writer, draw,
                    draw->shape != NULL ? draw->shape->positions[vertex]
                                        : glint_draw_vertex(draw, vertex).local);
    }
    for (size_t t = 0; t < draw->primitive->triangles; t++) {
        const glint_corners at = glint_draw_corners(draw, t, glint_draw_winds_back(draw, t));
        const bool counts = !glint_corners_are_collapsed(&at);
        for (size_t c = 0; c < 3; c++) {
            if (places.is_per_corner) {
                write_place(writer, draw, at.of[c].local);
            }
            if (counts) {
                const size_t place = base + place_at(&places, &at, c);
                writer->corners[writer->corner_count++] = (uint32_t)place;
            }
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
        places += places_of(&load->draws[i]).count;
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
    const glint_vec3 from = glint_vec3_from_floats(low), to = glint_vec3_from_floats(high);
    scene->low = glint_vec3_add(scene->origin, glint_vec3_scale(from, scene->unit));
    scene->high = glint_vec3_add(scene->origin, glint_vec3_scale(to, scene->unit));
}

// Counts what the draws need. A vertex that lies in several parts may be stored for each corner.
static scene_size measure(const glint_load *load, const glint_scene *scene)
{
    scene_size size = {.draws = load->draw_count};
    for (size_t i = 0; i < load->draw_count; i++) {
        const glint_draw *draw = &load->draws[i];
        const glint_primitive *primitive = draw->primitive;
        const size_t places = places_of(draw).count;
        size.triangles += primitive->triangles; // at most 2^22 draws of 2^40
        size.vertices += scene->parts.count == 0 ? places : 3 * primitive->triangles;
        size.places = places > size.places ? places : size.places;
        size.with_normals = size.with_normals || primitive->normals.count > 0;
    }
    return size;
}

glint_status glint_flatten(glint_load *load, glint_scene *scene, glint_error *error)
{
    scene_size size = measure(load, scene);
    double smallest;
    TRY(glint_flatten_check_count(size.triangles, error));
    TRY(deform(load, size.with_normals, error));
    TRY(glint_frame_choose(load, scene, &smallest, error));
    scene->attribute_set = glint_attributes_needed(load);
    TRY(check_memory(&size, &scene->attribute_set, error));
    // Before the arrays take their memory.
    if (glint_parts_may_be_there(smallest) &&
        bytes_of_search * size.triangles <= glint_free_memory() / 2) {
        TRY(find_parts(load, size.triangles, scene, error));
        size = measure(load, scene);
    }
    scene_writer writer = {.load = load,
                           .scene = scene,
                           .low = {INFINITY, INFINITY, INFINITY},
                           .high = {-INFINITY, -INFINITY, -INFINITY}};
    const glint_status status = allocate(&writer, &size, error);
    if (status == GLINT_OK) {
        write_draws(&writer);
        finish_arrays(scene);
        finish_bounds(&writer);
        glint_poses_clear(&load->poses); // their memory is free during rendering
        free(load->draws);
        load->draws = NULL;
        load->draw_count = load->draw_capacity = 0;
    }
    free(writer.known);
    return status;
}
