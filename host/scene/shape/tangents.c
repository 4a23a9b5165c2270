// Computes tangents for surfaces whose file has none. See tangents.h.
#include "scene/shape/tangents.h"

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
    bool is_taken;
} shared_tangent;

typedef struct tangents {
    glint_scene *scene;
    size_t stride, tangent_at; // floats per corner; offset of the tangent
    shared_tangent *table;     // hash table; its size is a power of two
    size_t mask;
} tangents;

// A triangle's corners, and the direction of its texture coordinates.
typedef struct sheet {
    glint_vec3 positions[3];
    const float *uv[3];
    glint_vec3 tangent; // unit, along u
    int turn;           // winding in the texture: 1 or −1; 0: no area in the texture
} sheet;

static glint_vec3 vector_of(const float *p)
{
    return (glint_vec3){(double)p[0], (double)p[1], (double)p[2]};
}

static float *corner_attributes(const tangents *t, size_t triangle, int corner)
{
    return t->scene->attributes + (3 * triangle + (size_t)corner) * t->stride;
}

static float *tangent_of(const tangents *t, size_t triangle, int corner)
{
    return corner_attributes(t, triangle, corner) + t->tangent_at;
}

static const glint_material *material_of(const tangents *t, size_t triangle)
{
    const glint_scene *scene = t->scene;
    return &scene->materials[scene->material_of[triangle]];
}

static bool is_wanted(const tangents *t, size_t triangle)
{
    return glint_material_needs_tangents(material_of(t, triangle)) &&
           (tangent_of(t, triangle, 0)[3] == 0 || tangent_of(t, triangle, 1)[3] == 0 ||
            tangent_of(t, triangle, 2)[3] == 0);
}

static sheet sheet_of(const tangents *t, size_t triangle)
{
    const int at = glint_material_tangent_texture(material_of(t, triangle))->texcoord == 1 ? 2 : 0;
    sheet s = {.turn = 0};
    for (int c = 0; c < 3; c++) {
        s.positions[c] = glint_scene_corner(t->scene, triangle, (int)c);
        s.uv[c] = corner_attributes(t, triangle, c) + at;
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

static glint_vec3 normal_at(const glint_scene *scene, size_t triangle, int corner, const sheet *s)
{
    const glint_vec3 geometric = glint_vec3_normalize(
        glint_vec3_cross(glint_vec3_subtract(s->positions[1], s->positions[0]),
                         glint_vec3_subtract(s->positions[2], s->positions[0])));
    if (scene->normals == NULL) {
        return geometric;
    }
    const glint_vec3 n = vector_of(scene->normals + 9 * triangle + 3 * corner);
    return glint_vec3_length(n) > 0 ? n : geometric;
}

// The part of `v` perpendicular to the unit vector n, normalized; 0 if it vanishes.
static glint_vec3 in_plane(glint_vec3 v, glint_vec3 n)
{
    return glint_vec3_normalize(glint_vec3_subtract(v, glint_vec3_scale(n, glint_vec3_dot(v, n))));
}

// The angle at a corner between its edges, projected into the plane of the normal.
static double angle_at(const sheet *s, int corner, glint_vec3 n)
{
    const glint_vec3 p = s->positions[corner];
    const glint_vec3 a = in_plane(glint_vec3_subtract(s->positions[(corner + 1) % 3], p), n);
    const glint_vec3 b = in_plane(glint_vec3_subtract(s->positions[(corner + 2) % 3], p), n);
    return acos(fmax(-1, fmin(1, glint_vec3_dot(a, b))));
}

static uint32_t hash_of(const corner_key *key)
{
    uint32_t hash = 2166136261u;
    for (int i = 0; i < KEY_WORDS; i++) {
        hash = (hash ^ key->words[i]) * 0x9E3779B1u;
        hash ^= hash >> 15;
    }
    return hash;
}

// Finds the tangent that a corner shares, or adds it.
static shared_tangent *find(const tangents *t, const corner_key *key)
{
    size_t slot = hash_of(key) & t->mask;
    while (t->table[slot].is_taken &&
           memcmp(t->table[slot].key.words, key->words, sizeof key->words) != 0) {
        slot = (slot + 1) & t->mask;
    }
    t->table[slot].is_taken = true;
    t->table[slot].key = *key;
    return &t->table[slot];
}

static corner_key key_of(const tangents *t, size_t triangle, int corner, uint32_t instance,
                         const sheet *s)
{
    const float *p = t->scene->positions + 9 * triangle + 3 * (size_t)corner;
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

static void add_triangle(const tangents *t, size_t triangle, uint32_t instance)
{
    const sheet s = sheet_of(t, triangle);
    for (int c = 0; s.turn != 0 && c < 3; c++) {
        const corner_key key = key_of(t, triangle, c, instance, &s);
        const glint_vec3 n = normal_at(t->scene, triangle, c, &s);
        shared_tangent *shared = find(t, &key);
        shared->sum = glint_vec3_add(shared->sum,
                                     glint_vec3_scale(in_plane(s.tangent, n), angle_at(&s, c, n)));
    }
}

static void take_tangents(const tangents *t, size_t triangle, uint32_t instance)
{
    const sheet s = sheet_of(t, triangle);
    for (int c = 0; c < 3; c++) {
        float *stored = tangent_of(t, triangle, c);
        glint_vec3 unit = {0, 0, 0};
        if (s.turn != 0) {
            const corner_key key = key_of(t, triangle, c, instance, &s);
            unit = glint_vec3_normalize(find(t, &key)->sum);
        }
        stored[0] = (float)unit.x;
        stored[1] = (float)unit.y;
        stored[2] = (float)unit.z;
        // In MikkTSpace v rises upwards, and also in glTF's normal map: green is up.
        stored[3] = glint_vec3_length(unit) > 0 ? (float)-s.turn : 0;
    }
}

static void for_each_wanted(const tangents *t,
                            void (*work)(const tangents *t, size_t triangle, uint32_t instance))
{
    const glint_scene *scene = t->scene;
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        for (size_t k = 0; k < instance->triangle_count; k++) {
            if (is_wanted(t, instance->first_triangle + k)) {
                work(t, instance->first_triangle + k, (uint32_t)i);
            }
        }
    }
}

bool glint_scene_complete_tangents(glint_scene *scene)
{
    tangents t = {.scene = scene, .stride = glint_attributes_stride(&scene->attribute_set)};
    t.tangent_at = t.stride - 4;
    size_t wanted = 0;
    for (size_t i = 0; i < scene->triangle_count; i++) {
        wanted += is_wanted(&t, i);
    }
    if (wanted == 0) {
        return true;
    }
    size_t size = 16;
    while (size < 6 * wanted) {
        size *= 2;
    }
    t.table = glint_allocate(size, sizeof *t.table);
    t.mask = size - 1;
    if (t.table == NULL) {
        return false;
    }
    for_each_wanted(&t, add_triangle);
    for_each_wanted(&t, take_tangents);
    free(t.table);
    return true;
}
