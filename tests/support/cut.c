// Cuts the meshes of a scene into more instances. See cut.h.
#include "support/cut.h"

#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// A piece of an instance.
typedef struct piece {
    size_t instance;
    int number;
} piece;

static void *copy_of(const void *bytes, size_t size)
{
    void *copy = malloc(size + 1);
    assert_non_null(copy);
    if (bytes != NULL) {
        memcpy(copy, bytes, size);
    }
    return copy;
}

static size_t number_below(glint_random *random, size_t count)
{
    return (size_t)(glint_random_number(random) * (double)count);
}

// Gives every triangle the number of a piece.
static int *choose_pieces(const glint_scene *scene, const cut *how, glint_random *random)
{
    int *piece_of = calloc(scene->triangle_count + 1, sizeof *piece_of);
    assert_non_null(piece_of);
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        for (size_t t = 1; t < instance->triangle_count; t++) {
            int *of = &piece_of[instance->first_triangle + t];
            const bool ends = glint_random_number(random) * (double)instance->triangle_count <
                              (double)how->pieces;
            *of = how->scattered ? (int)number_below(random, (size_t)how->pieces)
                  : ends && of[-1] + 1 < how->pieces ? of[-1] + 1
                                                     : of[-1];
        }
    }
    return piece_of;
}

// A scene being cut.
typedef struct cutting {
    const glint_scene *from;
    const cut *how;
    const int *piece_of; // [triangle]
    glint_scene to;
    size_t *origin; // [triangle of `to`]
} cutting;

static void add_triangle(cutting *c, size_t t)
{
    const glint_scene *from = c->from;
    glint_scene *to = &c->to;
    const size_t n = to->triangle_count++;
    c->origin[n] = t;
    for (size_t k = 0; k < 3; k++) {
        const size_t corner = 9 * n + 3 * k, triple = 3 * sizeof(float);
        memcpy(to->positions + corner, glint_scene_position(from, t, k), triple);
        if (from->normals != NULL) {
            memcpy(to->normals + corner, glint_scene_normal(from, t, k), triple);
        }
        if (from->parts.count > 0) {
            memcpy(to->parts.positions + corner, glint_scene_told(from, t, k), triple);
        }
    }
    if (from->parts.count > 0) {
        to->parts.part_of[n] = from->parts.part_of[t];
    }
    to->material_of[n] = to->instances[to->instance_count].material;
}

static void add_piece(cutting *c, piece cut_off)
{
    glint_scene *to = &c->to;
    const glint_instance *instance = &c->from->instances[cut_off.instance];
    const size_t first = instance->first_triangle;
    glint_instance *own = &to->instances[to->instance_count];
    *own = (glint_instance){.node_index = instance->node_index,
                            .first_triangle = to->triangle_count,
                            .material = instance->material};
    if (c->how->recolored) {
        own->material = (uint32_t)to->material_count;
        to->materials[to->material_count] = c->from->materials[instance->material];
        to->materials[to->material_count++].name = NULL;
    }
    for (size_t t = first; t < first + instance->triangle_count; t++) {
        if (c->piece_of[t] == cut_off.number) {
            add_triangle(c, t);
            own->triangle_count++;
        }
    }
    to->instance_count += own->triangle_count > 0;
}

// An empty scene with room for all triangles.
static glint_scene empty_scene(const glint_scene *scene, size_t pieces, bool recolored)
{
    const size_t count = scene->triangle_count;
    const size_t materials = recolored ? pieces : scene->material_count;
    glint_scene to = {.origin = scene->origin,
                      .unit = scene->unit,
                      .low = scene->low,
                      .high = scene->high,
                      .camera_count = scene->camera_count > 0,
                      .parts.count = scene->parts.count,
                      .material_count = recolored ? 0 : scene->material_count};
    assert_null(scene->attributes);
    to.positions = copy_of(NULL, 9 * count * sizeof(float));
    to.normals = scene->normals != NULL ? copy_of(NULL, 9 * count * sizeof(float)) : NULL;
    to.material_of = copy_of(NULL, count * sizeof *to.material_of);
    to.instances = copy_of(NULL, (pieces + 1) * sizeof *to.instances);
    to.materials = copy_of(NULL, (materials + 1) * sizeof *to.materials);
    to.cameras = copy_of(scene->cameras, sizeof *to.cameras * (size_t)to.camera_count);
    for (size_t i = 0; i < to.material_count; i++) {
        to.materials[i] = scene->materials[i];
        to.materials[i].name = NULL;
    }
    for (size_t i = 0; i < to.camera_count; i++) {
        to.cameras[i].name = NULL;
    }
    if (scene->parts.count > 0) {
        to.parts.anchors =
            copy_of(scene->parts.anchors, scene->parts.count * sizeof *to.parts.anchors);
        to.parts.part_of = copy_of(NULL, count * sizeof *to.parts.part_of);
        to.parts.positions = copy_of(NULL, 9 * count * sizeof(float));
    }
    return to;
}

glint_scene cut_scene(const glint_scene *scene, const cut *how, uint64_t seed, size_t **origin)
{
    glint_random random = {seed};
    const size_t count = scene->instance_count * (size_t)how->pieces;
    piece *pieces = calloc(count + 1, sizeof *pieces);
    assert_non_null(pieces);
    for (size_t i = 0; i < count; i++) {
        pieces[i] = (piece){i / (size_t)how->pieces, (int)(i % (size_t)how->pieces)};
    }
    for (size_t i = count; how->scattered && i > 1; i--) {
        const size_t other = number_below(&random, i);
        const piece swap = pieces[i - 1];
        pieces[i - 1] = pieces[other];
        pieces[other] = swap;
    }
    int *piece_of = choose_pieces(scene, how, &random);
    cutting c = {scene, how, piece_of, empty_scene(scene, count, how->recolored),
                 calloc(scene->triangle_count + 1, sizeof *c.origin)};
    assert_non_null(c.origin);
    for (size_t i = 0; i < count; i++) {
        add_piece(&c, pieces[i]);
    }
    assert_int_equal(c.to.triangle_count, scene->triangle_count);
    free(pieces);
    free(piece_of);
    if (origin != NULL) {
        *origin = c.origin;
    } else {
        free(c.origin);
    }
    return c.to;
}
