// Computes tangents for surfaces whose file has none. See tangents.h.
#include "scene/shape/tangents.h"

#include "base/hash_table.h"
#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// The common facts of corners that share a tangent: the bits of position, normal and texture
// coordinates, the instance, and the winding in the texture.
enum { KEY_FLOATS = 8, KEY_WORDS = KEY_FLOATS + 2 };
typedef struct corner_key {
    uint32_t words[KEY_WORDS];
} corner_key;

typedef struct shared_tangent {
    corner_key key;
    glint_vec3 sum;
} shared_tangent;

typedef struct tangents {
    glint_scene *scene;
    size_t stride, tangent_at; // floats per vertex; offset of the tangent
    glint_hash_table table;    // of shared tangents
    shared_tangent *shared;    // [shared_count], at most one for each corner
    uint32_t shared_count;
    bool *is_wanted; // [triangle]
    bool *is_set;    // [vertex]: its tangent counts
    uint32_t *copy;  // [vertex]: a copy of it with another tangent; 0: none
} tangents;

// A triangle's corners, and the direction of its texture coordinates.
typedef struct sheet {
    glint_vec3 positions[3];
    const float *uv[3];
    glint_vec3 tangent; // unit, along u
    int turn;           // winding in the texture: 1 or −1; 0: no area in the texture
} sheet;

static float *attributes_at(const tangents *t, size_t triangle, size_t corner)
{
    return t->scene->attributes + glint_scene_vertex(t->scene, triangle, corner) * t->stride;
}

static bool has_tangent(const tangents *t, size_t triangle, size_t corner)
{
    return attributes_at(t, triangle, corner)[t->tangent_at + 3] != 0;
}

static const glint_material *material_of(const tangents *t, size_t triangle)
{
    const glint_scene *scene = t->scene;
    return &scene->materials[scene->material_of[triangle]];
}

static bool lacks_tangents(const tangents *t, size_t triangle)
{
    return glint_material_needs_tangents(material_of(t, triangle)) &&
           !(has_tangent(t, triangle, 0) && has_tangent(t, triangle, 1) &&
             has_tangent(t, triangle, 2));
}

static sheet sheet_of(const tangents *t, size_t triangle)
{
    const int at = glint_material_tangent_texture(material_of(t, triangle))->texcoord == 1 ? 2 : 0;
    sheet s = {.turn = 0};
    for (size_t c = 0; c < 3; c++) {
        s.positions[c] = glint_scene_corner(t->scene, triangle, c);
        s.uv[c] = attributes_at(t, triangle, c) + at;
    }
    const double u1 = (double)s.uv[1][0] - (double)s.uv[0][0];
    const double v1 = (double)s.uv[1][1] - (double)s.uv[0][1];
    const double u2 = (double)s.uv[2][0] - (double)s.uv[0][0];
    const double v2 = (double)s.uv[2][1] - (double)s.uv[0][1];
    const double area = u1 * v2 - u2 * v1;
    const glint_vec3 along = glint_vec3_subtract(
        glint_vec3_scale(glint_vec3_subtract(s.positions[1], s.positions[0]), v2),
        glint_vec3_scale(glint_vec3_subtract(s.positions[2], s.positions[0]), v1));
    s.tangent = glint_vec3_normalize(glint_vec3_scale(along, area < 0 ? -1 : 1));
    s.turn = area == 0 || glint_vec3_length(s.tangent) == 0 ? 0 : area < 0 ? -1 : 1;
    return s;
}

static glint_vec3 normal_at(const glint_scene *scene, size_t triangle, size_t corner,
                            const sheet *s)
{
    const glint_vec3 geometric = glint_vec3_normalize(
        glint_vec3_cross(glint_vec3_subtract(s->positions[1], s->positions[0]),
                         glint_vec3_subtract(s->positions[2], s->positions[0])));
    if (scene->normals == NULL) {
        return geometric;
    }
    const glint_vec3 n = glint_vec3_from_floats(glint_scene_normal(scene, triangle, corner));
    return glint_vec3_length(n) > 0 ? n : geometric;
}

// The part of `v` perpendicular to the unit vector n, normalized; 0 if it vanishes.
static glint_vec3 in_plane(glint_vec3 v, glint_vec3 n)
{
    return glint_vec3_normalize(glint_vec3_subtract(v, glint_vec3_scale(n, glint_vec3_dot(v, n))));
}

// The angle at a corner between its edges, projected into the plane of the normal.
static double angle_at(const sheet *s, size_t corner, glint_vec3 n)
{
    const glint_vec3 p = s->positions[corner];
    const glint_vec3 a = in_plane(glint_vec3_subtract(s->positions[(corner + 1) % 3], p), n);
    const glint_vec3 b = in_plane(glint_vec3_subtract(s->positions[(corner + 2) % 3], p), n);
    return acos(fmax(-1, fmin(1, glint_vec3_dot(a, b))));
}

typedef struct sought_tangent {
    const tangents *t;
    const corner_key *key;
} sought_tangent;

static bool has_key(const void *sought, uint32_t number)
{
    const sought_tangent *s = sought;
    return memcmp(s->t->shared[number].key.words, s->key->words, sizeof s->key->words) == 0;
}

// Finds the tangent that a corner shares, or adds it.
static shared_tangent *find(tangents *t, const corner_key *key)
{
    const sought_tangent sought = {t, key};
    uint64_t hash = 0;
    for (int i = 0; i < KEY_WORDS; i++) {
        hash = glint_hash_mix(hash, key->words[i]);
    }
    uint32_t *slot = glint_hash_table_slot(&t->table, hash, has_key, &sought);
    if (*slot == GLINT_NO_ITEM) {
        *slot = t->shared_count++;
        t->shared[*slot] = (shared_tangent){.key = *key};
    }
    return &t->shared[*slot];
}

static corner_key key_of(const tangents *t, size_t triangle, size_t corner, uint32_t instance,
                         const sheet *s)
{
    const float *p = glint_scene_position(t->scene, triangle, corner);
    const glint_vec3 n = normal_at(t->scene, triangle, corner, s);
    float values[KEY_FLOATS] = {
        p[0], p[1], p[2], (float)n.x, (float)n.y, (float)n.z, s->uv[corner][0], s->uv[corner][1]};
    corner_key key;
    for (int i = 0; i < KEY_FLOATS; i++) {
        values[i] += 0.0F; // −0 becomes 0
    }
    memcpy(key.words, values, sizeof values);
    key.words[KEY_FLOATS] = instance;
    key.words[KEY_FLOATS + 1] = s->turn > 0;
    return key;
}

static void add_triangle(tangents *t, size_t triangle, uint32_t instance)
{
    const sheet s = sheet_of(t, triangle);
    for (size_t c = 0; s.turn != 0 && c < 3; c++) {
        const corner_key key = key_of(t, triangle, c, instance, &s);
        const glint_vec3 n = normal_at(t->scene, triangle, c, &s);
        shared_tangent *shared = find(t, &key);
        shared->sum = glint_vec3_add(shared->sum,
                                     glint_vec3_scale(in_plane(s.tangent, n), angle_at(&s, c, n)));
    }
}

static float *tangent_at(const tangents *t, size_t vertex)
{
    return t->scene->attributes + t->stride * vertex + t->tangent_at;
}

// Returns the number of a new vertex with the values of an old one.
static uint32_t copy_vertex(const tangents *t, size_t vertex)
{
    glint_scene *scene = t->scene;
    const size_t copy = scene->vertex_count++, triple = 3 * sizeof(float);
    memcpy(scene->positions + 3 * copy, scene->positions + 3 * vertex, triple);
    if (scene->normals != NULL) {
        memcpy(scene->normals + 3 * copy, scene->normals + 3 * vertex, triple);
    }
    if (scene->parts.count > 0) {
        memcpy(scene->parts.positions + 3 * copy, scene->parts.positions + 3 * vertex, triple);
    }
    memcpy(scene->attributes + t->stride * copy, scene->attributes + t->stride * vertex,
           t->stride * sizeof *scene->attributes);
    return (uint32_t)copy;
}

static bool has_other_tangent(const tangents *t, size_t vertex, const float tangent[4])
{
    uint32_t own[4], other[4];
    memcpy(own, tangent_at(t, vertex), sizeof own);
    memcpy(other, tangent, sizeof other);
    return t->is_set[vertex] && memcmp(own, other, sizeof own) != 0;
}

// Sets the tangent of a corner. If its vertex has another tangent already, the corner gets a copy
// of the vertex.
static void set_tangent(const tangents *t, size_t triangle, size_t corner, const float tangent[4])
{
    enum { TRIES = 8 }; // so that a vertex of many triangles takes linear time
    const size_t first = glint_scene_vertex(t->scene, triangle, corner);
    size_t vertex = first;
    for (int i = 0; i < TRIES && has_other_tangent(t, vertex, tangent) && t->copy[vertex] > 0;
         i++) {
        vertex = t->copy[vertex];
    }
    if (has_other_tangent(t, vertex, tangent)) {
        vertex = copy_vertex(t, first);
        t->copy[vertex] = t->copy[first];
        t->copy[first] = (uint32_t)vertex;
    }
    memcpy(tangent_at(t, vertex), tangent, 4 * sizeof *tangent);
    t->is_set[vertex] = true;
    if (vertex != first) { // never without indices, where a vertex has one corner
        t->scene->indices[3 * triangle + corner] = (uint32_t)vertex;
    }
}

static void take_tangents(tangents *t, size_t triangle, uint32_t instance)
{
    const sheet s = sheet_of(t, triangle);
    for (size_t c = 0; c < 3; c++) {
        glint_vec3 unit = {0, 0, 0};
        if (s.turn != 0) {
            const corner_key key = key_of(t, triangle, c, instance, &s);
            unit = glint_vec3_normalize(find(t, &key)->sum);
        }
        // In MikkTSpace v rises upwards, and also in glTF's normal map: green is up.
        const float tangent[4] = {(float)unit.x, (float)unit.y, (float)unit.z,
                                  glint_vec3_length(unit) > 0 ? (float)-s.turn : 0};
        set_tangent(t, triangle, c, tangent);
    }
}

static void for_each_wanted(tangents *t,
                            void (*work)(tangents *t, size_t triangle, uint32_t instance))
{
    const glint_scene *scene = t->scene;
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        for (size_t k = 0; k < instance->triangle_count; k++) {
            if (t->is_wanted[instance->first_triangle + k]) {
                work(t, instance->first_triangle + k, (uint32_t)i);
            }
        }
    }
}

// Marks the triangles to work on. Returns their number.
static size_t mark_wanted(const tangents *t)
{
    size_t wanted = 0;
    for (size_t i = 0; i < t->scene->triangle_count; i++) {
        t->is_wanted[i] = lacks_tangents(t, i);
        wanted += t->is_wanted[i];
    }
    return wanted;
}

// Makes room for the table, and for a copy at every corner. Returns false if memory is short.
static bool make_room(tangents *t, size_t wanted)
{
    const size_t vertices = glint_scene_vertex_count(t->scene);
    const size_t copies = t->scene->indices != NULL ? 3 * wanted : 0;
    t->shared = glint_allocate_unset(3 * wanted, sizeof *t->shared);
    t->copy = glint_allocate(vertices + copies, sizeof *t->copy);
    t->is_set = glint_allocate(vertices + copies, sizeof *t->is_set);
    return glint_hash_table_create(3 * wanted, &t->table) && t->shared != NULL && t->copy != NULL &&
           t->is_set != NULL && glint_scene_resize_vertices(t->scene, vertices + copies);
}

// The other triangles keep their tangents.
static void keep_tangents(const tangents *t)
{
    for (size_t i = 0; i < 3 * t->scene->triangle_count; i++) {
        if (!t->is_wanted[i / 3]) {
            t->is_set[glint_scene_vertex(t->scene, i / 3, i % 3)] = true;
        }
    }
}

bool glint_scene_complete_tangents(glint_scene *scene)
{
    tangents t = {.scene = scene, .stride = glint_attributes_stride(&scene->attribute_set)};
    t.tangent_at = t.stride - 4;
    t.is_wanted = glint_allocate(scene->triangle_count, sizeof *t.is_wanted);
    bool done = t.is_wanted != NULL;
    const size_t wanted = done ? mark_wanted(&t) : 0;
    if (wanted > 0) {
        done = make_room(&t, wanted);
        if (done) {
            keep_tangents(&t);
            for_each_wanted(&t, add_triangle);
            for_each_wanted(&t, take_tangents);
        }
        (void)glint_scene_resize_vertices(scene, glint_scene_vertex_count(scene));
    }
    glint_hash_table_free(&t.table);
    free(t.shared);
    free(t.copy);
    free(t.is_set);
    free(t.is_wanted);
    return done;
}
