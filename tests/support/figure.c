// Makes a figure with morph targets and a skin. See figure.h.
#include "support/figure.h"

#include "base/random.h"
#include "support/gltf_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

const int figure_parents[FIGURE_JOINTS] = {-1, 0, 1, -1};
const int figure_turning[2] = {0, 2};

const float figure_instance[3] = {3, 0.5f, -2};

// ---- Making ------------------------------------------------------------------------------------

static double between(glint_random *random, double low, double high)
{
    return low + (high - low) * glint_random_number(random);
}

static void make_rotation(glint_random *random, double q[4])
{
    const glint_vec3 axis = glint_random_direction(random);
    const double angle = between(random, -3, 3);
    const double values[4] = {axis.x * sin(angle / 2), axis.y * sin(angle / 2),
                              axis.z * sin(angle / 2), cos(angle / 2)};
    memcpy(q, values, sizeof values);
}

static figure_node make_node(glint_random *random)
{
    figure_node node;
    for (int k = 0; k < 3; k++) {
        node.translation[k] = between(random, -2, 2);
        node.scale[k] = between(random, 0.5, 1.5);
    }
    make_rotation(random, node.rotation);
    return node;
}

// A delta, rounded by its storage.
static double rounded_delta(figure_deltas deltas, int attribute, double value)
{
    if (deltas == FIGURE_BYTES) {
        return fmax(nearbyint(value * 127) / 127, -1);
    }
    if (deltas == FIGURE_SHORTS) {
        return attribute == 0 ? nearbyint(value * 8) : fmax(nearbyint(value * 32767) / 32767, -1);
    }
    return (double)(float)value;
}

static void make_weights(figure *f, glint_random *random, int vertex)
{
    const int count = f->kind.influences;
    double sum = 0, raw[FIGURE_INFLUENCES];
    for (int i = 0; i < count; i++) {
        f->joints[vertex][i] = (int)between(random, 0, FIGURE_JOINTS);
        raw[i] = (i + vertex) % 3 == 0 ? 0 : between(random, 0, 1);
        sum += raw[i];
    }
    const double steps = f->kind.weight_type == 5121   ? 255
                         : f->kind.weight_type == 5123 ? 65535
                                                       : 0;
    for (int i = 0; i < count; i++) {
        const double weight = raw[i] / sum;
        f->weights[vertex][i] =
            steps > 0 ? nearbyint(weight * steps) / steps : (double)(float)weight;
    }
}

static void make_vertex(figure *f, glint_random *random, int vertex)
{
    const glint_vec3 normal = glint_random_direction(random);
    const float values[3] = {(float)normal.x, (float)normal.y, (float)normal.z};
    for (int k = 0; k < 3; k++) {
        f->positions[vertex][k] = (float)between(random, -1, 1);
        f->normals[vertex][k] = values[k];
    }
    for (int target = 0; target < FIGURE_TARGETS; target++) {
        for (int attribute = 0; attribute < 2; attribute++) {
            for (int k = 0; k < 3; k++) {
                const double delta = between(random, -0.7, 0.7);
                f->deltas[target][attribute][vertex][k] =
                    f->kind.deltas == FIGURE_SPARSE && vertex % 3 != 0
                        ? 0
                        : rounded_delta(f->kind.deltas, attribute, delta);
            }
        }
    }
    make_weights(f, random, vertex);
}

static void make_keys(figure *f, glint_random *random)
{
    static const float times[FIGURE_KEYS] = {0, 0.5f, 2};
    memcpy(f->times, times, sizeof times);
    for (int key = 0; key < FIGURE_KEYS; key++) {
        for (int target = 0; target < FIGURE_TARGETS; target++) {
            for (int part = 0; part < 3; part++) {
                f->morph_keys[key][part][target] = (float)between(random, -1, 1);
            }
        }
        for (int i = 0; i < 2; i++) {
            double q[4];
            make_rotation(random, q);
            for (int k = 0; k < 4; k++) {
                f->turn_keys[i][key][k] = (float)q[k];
            }
        }
    }
}

figure figure_make(const figure_kind *kind)
{
    figure f = {.kind = *kind};
    glint_random random = {kind->seed};
    for (int vertex = 0; vertex < FIGURE_VERTICES; vertex++) {
        make_vertex(&f, &random, vertex);
    }
    for (int triangle = 0; triangle < FIGURE_TRIANGLES; triangle++) {
        for (int corner = 0; corner < 3; corner++) {
            f.indices[triangle][corner] =
                (uint16_t)((triangle * 5 + corner * (1 + triangle / FIGURE_VERTICES)) %
                           FIGURE_VERTICES);
        }
    }
    f.mesh_node = make_node(&random);
    f.rig = make_node(&random);
    for (int joint = 0; joint < FIGURE_JOINTS; joint++) {
        f.bones[joint] = make_node(&random);
        for (int i = 0; i < 16; i++) {
            f.inverse_bind[joint][i] =
                i % 4 == 3 ? (float)(i == 15) : (float)between(&random, -1, 1);
        }
    }
    // Apply the options of the kind.
    f.bones[1].scale[0] *= kind->mirrors ? -1 : 1;
    if (kind->flattens) {
        f.rig.scale[0] = f.rig.scale[1] = 1;
        f.rig.scale[2] = 0;
    }
    if (kind->hides_mesh_node) {
        memset(f.mesh_node.scale, 0, sizeof f.mesh_node.scale);
    }
    for (int target = 0; target < FIGURE_TARGETS; target++) {
        f.mesh_weights[target] = target == 1 ? 0 : between(&random, -1, 1);
        f.node_weights[target] = between(&random, -1, 1);
    }
    make_keys(&f, &random);
    return f;
}

// ---- The file ----------------------------------------------------------------------------------

// The growing buffer, views and accessors. An accessor has its own view, except sparse accessors.
typedef struct storage {
    unsigned char bytes[16384];
    size_t size;
    char views[4096], accessors[8192];
    int view_count, accessor_count;
} storage;

static void append(char *text, size_t capacity, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static void append(char *text, size_t capacity, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const size_t length = strlen(text);
    const int more = vsnprintf(text + length, capacity - length, format, arguments);
    va_end(arguments);
    assert_true(more >= 0 && length + (size_t)more < capacity);
}

static int add_view(storage *s, const void *bytes, size_t size)
{
    assert_true(s->size + size + 4 <= sizeof s->bytes);
    memcpy(s->bytes + s->size, bytes, size);
    append(s->views, sizeof s->views, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
           s->view_count > 0 ? "," : "", s->size, size);
    s->size += (size + 3) / 4 * 4;
    return s->view_count++;
}

// Adds an accessor with its view. `format` is the rest of the accessor: count, type and component
// type.
static int add_accessor(storage *s, const void *bytes, size_t size, const char *format)
{
    append(s->accessors, sizeof s->accessors, "%s{\"bufferView\":%d,%s}",
           s->accessor_count > 0 ? "," : "", add_view(s, bytes, size), format);
    return s->accessor_count++;
}

static const char *format_of(int component_type, bool normalized, int count, const char *type)
{
    static char text[128];
    snprintf(text, sizeof text,
             "\"componentType\":%d,\"normalized\":%s,\"count\":%d,\"type\":\"%s\"", component_type,
             normalized ? "true" : "false", count, type);
    return text;
}

static int add_sparse(storage *s, const float deltas[FIGURE_VERTICES][3])
{
    uint8_t indices[FIGURE_VERTICES];
    float values[FIGURE_VERTICES][3];
    int count = 0;
    for (int vertex = 0; vertex < FIGURE_VERTICES; vertex += 3) {
        indices[count] = (uint8_t)vertex;
        memcpy(values[count++], deltas[vertex], sizeof deltas[vertex]);
    }
    const int index_view = add_view(s, indices, (size_t)count);
    const int value_view = add_view(s, values, (size_t)count * sizeof values[0]);
    append(s->accessors, sizeof s->accessors,
           ",{%s,\"sparse\":{\"count\":%d,\"indices\":{\"bufferView\":%d,\"componentType\":5121},"
           "\"values\":{\"bufferView\":%d}}}",
           format_of(5126, false, FIGURE_VERTICES, "VEC3"), count, index_view, value_view);
    return s->accessor_count++;
}

// Adds the deltas of one attribute, packed tightly.
static int add_deltas(storage *s, const figure *f, int target, int attribute)
{
    float floats[FIGURE_VERTICES][3];
    int8_t bytes[FIGURE_VERTICES][3];
    int16_t shorts[FIGURE_VERTICES][3];
    for (int v = 0; v < FIGURE_VERTICES; v++) {
        for (int k = 0; k < 3; k++) {
            const double delta = f->deltas[target][attribute][v][k];
            floats[v][k] = (float)delta;
            bytes[v][k] = (int8_t)nearbyint(fmin(fmax(delta, -1), 1) * 127);
            shorts[v][k] = (int16_t)nearbyint(delta * (attribute == 0 ? 1 : 32767));
        }
    }
    switch (f->kind.deltas) {
    case FIGURE_BYTES:
        return add_accessor(s, bytes, sizeof bytes, format_of(5120, true, FIGURE_VERTICES, "VEC3"));
    case FIGURE_SHORTS:
        return add_accessor(s, shorts, sizeof shorts,
                            format_of(5122, attribute == 1, FIGURE_VERTICES, "VEC3"));
    case FIGURE_SPARSE:
        return add_sparse(s, (const float(*)[3])floats);
    default:
        return add_accessor(s, floats, sizeof floats,
                            format_of(5126, false, FIGURE_VERTICES, "VEC3"));
    }
}

// Adds four influences of each vertex, from `first` on. Returns the accessor of joints; the next
// accessor holds the weights.
static int add_influences(storage *s, const figure *f, int first)
{
    uint8_t small[FIGURE_VERTICES][4], small_weights[FIGURE_VERTICES][4];
    uint16_t large[FIGURE_VERTICES][4], large_weights[FIGURE_VERTICES][4];
    float weights[FIGURE_VERTICES][4];
    for (int v = 0; v < FIGURE_VERTICES; v++) {
        for (int k = 0; k < 4; k++) {
            const double weight = f->weights[v][first + k];
            small[v][k] = (uint8_t)f->joints[v][first + k];
            large[v][k] = small[v][k];
            weights[v][k] = (float)weight;
            small_weights[v][k] = (uint8_t)nearbyint(weight * 255);
            large_weights[v][k] = (uint16_t)nearbyint(weight * 65535);
        }
    }
    const int joints =
        f->kind.short_joints
            ? add_accessor(s, large, sizeof large, format_of(5123, false, FIGURE_VERTICES, "VEC4"))
            : add_accessor(s, small, sizeof small, format_of(5121, false, FIGURE_VERTICES, "VEC4"));
    if (f->kind.weight_type == 5121) {
        add_accessor(s, small_weights, sizeof small_weights,
                     format_of(5121, true, FIGURE_VERTICES, "VEC4"));
    } else if (f->kind.weight_type == 5123) {
        add_accessor(s, large_weights, sizeof large_weights,
                     format_of(5123, true, FIGURE_VERTICES, "VEC4"));
    } else {
        add_accessor(s, weights, sizeof weights, format_of(5126, false, FIGURE_VERTICES, "VEC4"));
    }
    return joints;
}

static void write_numbers(char *text, size_t capacity, const char *key, const double *numbers,
                          int count)
{
    append(text, capacity, ",\"%s\":[", key);
    for (int i = 0; i < count; i++) {
        append(text, capacity, "%s%.17g", i > 0 ? "," : "", numbers[i]);
    }
    append(text, capacity, "]");
}

static void write_node(char *text, size_t capacity, const figure_node *node)
{
    write_numbers(text, capacity, "translation", node->translation, 3);
    write_numbers(text, capacity, "rotation", node->rotation, 4);
    write_numbers(text, capacity, "scale", node->scale, 3);
}

static void write_primitive(char *text, size_t capacity, const figure *f, storage *s)
{
    const char *vec3 = format_of(5126, false, FIGURE_VERTICES, "VEC3");
    append(text, capacity, "{\"attributes\":{\"POSITION\":%d",
           add_accessor(s, f->positions, sizeof f->positions, vec3));
    append(text, capacity, ",\"NORMAL\":%d",
           add_accessor(s, f->normals, sizeof f->normals,
                        format_of(5126, false, FIGURE_VERTICES, "VEC3")));
    for (int first = 0; first < f->kind.influences; first += 4) {
        const int joints = add_influences(s, f, first);
        append(text, capacity, ",\"JOINTS_%d\":%d,\"WEIGHTS_%d\":%d", first / 4, joints, first / 4,
               joints + 1);
    }
    append(text, capacity, "},\"material\":0,\"indices\":%d",
           add_accessor(s, f->indices, sizeof f->indices,
                        format_of(5123, false, 3 * FIGURE_TRIANGLES, "SCALAR")));
    for (int target = 0; target < f->kind.targets; target++) {
        append(text, capacity, "%s{\"POSITION\":%d,", target == 0 ? ",\"targets\":[" : ",",
               add_deltas(s, f, target, 0));
        append(text, capacity, "\"NORMAL\":%d}", add_deltas(s, f, target, 1));
    }
    append(text, capacity, "%s}", f->kind.targets > 0 ? "]" : "");
}

// Node 0 is the mesh, node 1 the rig, and the joints follow.
static void write_nodes(char *text, size_t capacity, const figure *f, storage *s)
{
    append(text, capacity, ",\"nodes\":[{\"mesh\":0%s",
           f->kind.influences > 0 ? ",\"skin\":0" : "");
    if (f->kind.weights_of != NULL && strcmp(f->kind.weights_of, "node") == 0) {
        write_numbers(text, capacity, "weights", f->node_weights, f->kind.targets);
    }
    write_node(text, capacity, &f->mesh_node);
    if (f->kind.instanced) {
        const float places[2][3] = {{0, 0, 0},
                                    {figure_instance[0], figure_instance[1], figure_instance[2]}};
        append(text, capacity,
               ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
               "\"TRANSLATION\":%d}}}",
               add_accessor(s, places, sizeof places, format_of(5126, false, 2, "VEC3")));
    }
    append(text, capacity, "},{\"children\":[2,5]");
    write_node(text, capacity, &f->rig);
    for (int joint = 0; joint < FIGURE_JOINTS; joint++) {
        append(text, capacity, "},{\"name\":\"joint %d\"", joint);
        write_node(text, capacity, &f->bones[joint]);
        if (joint == 0 || joint == 1) {
            append(text, capacity, ",\"children\":[%d]", 3 + joint);
        }
    }
    append(text, capacity, "}],\"scenes\":[{\"nodes\":[0%s]}]", f->kind.joints_outside ? "" : ",1");
}

static void write_skin(char *text, size_t capacity, const figure *f, storage *s)
{
    append(text, capacity, ",\"skins\":[{\"joints\":[2,3,4,5]");
    if (!f->kind.no_inverse_bind) {
        append(text, capacity, ",\"inverseBindMatrices\":%d",
               add_accessor(s, f->inverse_bind, sizeof f->inverse_bind,
                            format_of(5126, false, FIGURE_JOINTS, "MAT4")));
    }
    append(text, capacity, "}]");
}

static int add_morph_keys(storage *s, const figure *f)
{
    float values[FIGURE_KEYS * 3 * FIGURE_TARGETS];
    const bool is_cubic = strcmp(f->kind.interpolation, "CUBICSPLINE") == 0;
    int count = 0;
    for (int key = 0; key < FIGURE_KEYS; key++) {
        for (int part = 0; part < 3; part++) {
            for (int target = 0; target < f->kind.targets && (is_cubic || part == 1); target++) {
                values[count++] = f->morph_keys[key][part][target];
            }
        }
    }
    return add_accessor(s, values, (size_t)count * sizeof *values,
                        format_of(5126, false, count, "SCALAR"));
}

static void write_animation(char *text, size_t capacity, const figure *f, storage *s)
{
    if (f->kind.interpolation == NULL && !f->kind.turns) {
        return;
    }
    const int times =
        add_accessor(s, f->times, sizeof f->times, format_of(5126, false, FIGURE_KEYS, "SCALAR"));
    char channels[512] = "";
    int samplers = 0;
    append(text, capacity, ",\"animations\":[{\"samplers\":[");
    if (f->kind.interpolation != NULL) {
        append(text, capacity, "{\"input\":%d,\"output\":%d,\"interpolation\":\"%s\"}", times,
               add_morph_keys(s, f), f->kind.interpolation);
        append(channels, sizeof channels,
               "{\"sampler\":%d,\"target\":{\"node\":0,\"path\":\"weights\"}}", samplers++);
    }
    for (int i = 0; i < 2 && f->kind.turns; i++) {
        append(text, capacity, "%s{\"input\":%d,\"output\":%d}", samplers > 0 ? "," : "", times,
               add_accessor(s, f->turn_keys[i], sizeof f->turn_keys[i],
                            format_of(5126, false, FIGURE_KEYS, "VEC4")));
        append(channels, sizeof channels,
               "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"rotation\"}}",
               samplers > 0 ? "," : "", samplers, 2 + figure_turning[i]);
        samplers++;
    }
    append(text, capacity, "],\"channels\":[%s]}]", channels);
}

char *figure_text(const figure *f)
{
    storage s = {0};
    static char rest[32768], all[65536];
    rest[0] = all[0] = '\0';
    append(rest, sizeof rest, "\"meshes\":[{\"primitives\":[");
    write_primitive(rest, sizeof rest, f, &s);
    append(rest, sizeof rest, "]");
    if (f->kind.targets > 0 && f->kind.weights_of != NULL) {
        write_numbers(rest, sizeof rest, "weights", f->mesh_weights, f->kind.targets);
    }
    append(rest, sizeof rest, "}]");
    write_nodes(rest, sizeof rest, f, &s);
    if (f->kind.influences > 0) {
        write_skin(rest, sizeof rest, f, &s);
    }
    write_animation(rest, sizeof rest, f, &s);
    append(
        all, sizeof all,
        "%s,\"bufferViews\":[%s],\"accessors\":[%s],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0}}],"
        "\"extensionsUsed\":[\"KHR_mesh_quantization\"]",
        rest, s.views, s.accessors);
    return gltf_text(s.bytes, s.size, all);
}
