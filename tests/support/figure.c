// A figure with morph targets and a skin. See figure.h.
#include "support/figure.h"

#include "base/random.h"
#include "support/gltf_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Joint 0 and 3 stand under a rig that is no joint, 1 under 0, 2 under 1.
static const int parents[FIGURE_JOINTS] = {-1, 0, 1, -1};
static const int turning[2] = {0, 2};

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

// Stored integers, and what they stand for.
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

// Buffer, views and accessors as they grow: an accessor has one view of its own, but for the
// sparse.
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

// `format` is the rest of the accessor: count, type and component type.
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

// The deltas of one attribute, packed tightly.
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

// Four influences of each vertex, from `first` on. The joints' accessor; the weights' is the next.
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

// Node 0 has the mesh, node 1 is the rig, then come the joints.
static void write_nodes(char *text, size_t capacity, const figure *f)
{
    append(text, capacity, ",\"nodes\":[{\"mesh\":0%s",
           f->kind.influences > 0 ? ",\"skin\":0" : "");
    if (f->kind.weights_of != NULL && strcmp(f->kind.weights_of, "node") == 0) {
        write_numbers(text, capacity, "weights", f->node_weights, f->kind.targets);
    }
    write_node(text, capacity, &f->mesh_node);
    append(text, capacity, "},{\"children\":[2,5]");
    write_node(text, capacity, &f->rig);
    for (int joint = 0; joint < FIGURE_JOINTS; joint++) {
        append(text, capacity, "},{\"name\":\"joint %d\"", joint);
        write_node(text, capacity, &f->bones[joint]);
        if (joint == 0 || joint == 1) {
            append(text, capacity, ",\"children\":[%d]", 3 + joint);
        }
    }
    append(text, capacity, "}],\"scenes\":[{\"nodes\":[0,1]}]");
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
               samplers > 0 ? "," : "", samplers, 2 + turning[i]);
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
    write_nodes(rest, sizeof rest, f);
    if (f->kind.influences > 0) {
        write_skin(rest, sizeof rest, f, &s);
    }
    write_animation(rest, sizeof rest, f, &s);
    append(all, sizeof all,
           "%s,\"bufferViews\":[%s],\"accessors\":[%s],"
           "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0}}],"
           "\"extensionsUsed\":[\"KHR_mesh_quantization\"]",
           rest, s.views, s.accessors);
    return gltf_text(s.bytes, s.size, all);
}

// ---- The model ---------------------------------------------------------------------------------

// The interval of a time that lies between the first key and the last, and its share.
static int find_interval(const figure *f, double time, double *share)
{
    int key = 0;
    while (key < FIGURE_KEYS - 2 && time >= (double)f->times[key + 1]) {
        key++;
    }
    const double from = (double)f->times[key], to = (double)f->times[key + 1];
    *share = fmin(fmax((time - from) / (to - from), 0), 1);
    return key;
}

static void weights_at(const figure *f, double time, double weights[FIGURE_TARGETS])
{
    const char *of = f->kind.weights_of;
    double t;
    const int key = find_interval(f, time, &t);
    const double seconds = (double)f->times[key + 1] - (double)f->times[key];
    for (int i = 0; i < FIGURE_TARGETS; i++) {
        const double from = (double)f->morph_keys[key][1][i];
        const double to = (double)f->morph_keys[key + 1][1][i];
        const double leaving = seconds * (double)f->morph_keys[key][2][i];
        const double arriving = seconds * (double)f->morph_keys[key + 1][0][i];
        weights[i] = of == NULL                ? 0
                     : strcmp(of, "node") == 0 ? f->node_weights[i]
                                               : f->mesh_weights[i];
        if (f->kind.interpolation == NULL) {
            continue;
        }
        if (strcmp(f->kind.interpolation, "STEP") == 0) {
            weights[i] = t < 1 ? from : to;
        } else if (strcmp(f->kind.interpolation, "LINEAR") == 0) {
            weights[i] = (1 - t) * from + t * to;
        } else {
            weights[i] = (2 * t * t * t - 3 * t * t + 1) * from +
                         (t * t * t - 2 * t * t + t) * leaving + (-2 * t * t * t + 3 * t * t) * to +
                         (t * t * t - t * t) * arriving;
        }
    }
}

static void unit4(double q[4])
{
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) {
        q[k] /= length;
    }
}

static void turn_at(const figure *f, double time, int i, double q[4])
{
    double share, a[4], b[4], dot = 0;
    const int key = find_interval(f, time, &share);
    for (int k = 0; k < 4; k++) {
        a[k] = (double)f->turn_keys[i][key][k];
        b[k] = (double)f->turn_keys[i][key + 1][k];
    }
    unit4(a);
    unit4(b);
    for (int k = 0; k < 4; k++) {
        dot += a[k] * b[k];
    }
    const double angle = acos(fabs(dot));
    for (int k = 0; k < 4; k++) {
        q[k] = (sin((1 - share) * angle) * a[k] + (dot < 0 ? -1 : 1) * sin(share * angle) * b[k]) /
               sin(angle);
    }
}

typedef double affine[3][4]; // rows

static void place(const figure_node *node, affine m)
{
    double q[4];
    memcpy(q, node->rotation, sizeof q);
    unit4(q);
    // Each column is an axis turned by q v q*.
    for (int column = 0; column < 3; column++) {
        double v[3] = {0}, t[3];
        v[column] = node->scale[column];
        for (int k = 0; k < 3; k++) { // t = 2 (q × v), v' = v + w t + q × t
            t[k] = 2 * (q[(k + 1) % 3] * v[(k + 2) % 3] - q[(k + 2) % 3] * v[(k + 1) % 3]);
        }
        for (int k = 0; k < 3; k++) {
            m[k][column] = v[k] + q[3] * t[k] +
                           (q[(k + 1) % 3] * t[(k + 2) % 3] - q[(k + 2) % 3] * t[(k + 1) % 3]);
        }
    }
    for (int k = 0; k < 3; k++) {
        m[k][3] = node->translation[k];
    }
}

static void multiply(affine a, affine b, affine result)
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            result[row][column] = a[row][0] * b[0][column] + a[row][1] * b[1][column] +
                                  a[row][2] * b[2][column] + (column == 3 ? a[row][3] : 0);
        }
    }
}

static void joint_matrices(const figure *f, double time, affine joints[FIGURE_JOINTS])
{
    affine rig, worlds[FIGURE_JOINTS];
    place(&f->rig, rig);
    for (int joint = 0; joint < FIGURE_JOINTS; joint++) {
        figure_node node = f->bones[joint];
        for (int i = 0; i < 2 && f->kind.turns; i++) {
            if (turning[i] == joint) {
                turn_at(f, time, i, node.rotation);
            }
        }
        affine local, bind = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
        place(&node, local);
        multiply(parents[joint] < 0 ? rig : worlds[parents[joint]], local, worlds[joint]);
        for (int i = 0; i < 16 && !f->kind.no_inverse_bind; i++) {
            if (i % 4 < 3) {
                bind[i % 4][i / 4] = (double)f->inverse_bind[joint][i];
            }
        }
        multiply(worlds[joint], bind, joints[joint]);
    }
}

// The matrix that places a vertex in the world: the weighted sum of the joints', or the node's.
static void vertex_matrix(const figure *f, double time, int vertex, affine m)
{
    if (f->kind.influences == 0) {
        place(&f->mesh_node, m);
        return;
    }
    affine joints[FIGURE_JOINTS];
    joint_matrices(f, time, joints);
    double total = 0;
    for (int i = 0; i < f->kind.influences; i++) {
        total += f->weights[vertex][i];
    }
    memset(m, 0, sizeof(affine));
    for (int i = 0; i < f->kind.influences; i++) {
        for (int k = 0; k < 12; k++) {
            m[k / 4][k % 4] +=
                f->weights[vertex][i] / total * joints[f->joints[vertex][i]][k / 4][k % 4];
        }
    }
}

// Cofactors of the 3 × 3 part: its inverse transposed, times its determinant.
static double cofactors(affine m, double c[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            c[i][k] = m[(i + 1) % 3][(k + 1) % 3] * m[(i + 2) % 3][(k + 2) % 3] -
                      m[(i + 1) % 3][(k + 2) % 3] * m[(i + 2) % 3][(k + 1) % 3];
        }
    }
    return m[0][0] * c[0][0] + m[0][1] * c[0][1] + m[0][2] * c[0][2];
}

// The sign of the determinant of the vertex's matrix.
static int vertex_at(const figure *f, double time, int vertex, double position[3], double normal[3])
{
    double weights[FIGURE_TARGETS], base[2][3], c[3][3], length = 0;
    affine m;
    weights_at(f, time, weights);
    for (int k = 0; k < 3; k++) {
        base[0][k] = (double)f->positions[vertex][k];
        base[1][k] = (double)f->normals[vertex][k];
        for (int target = 0; target < f->kind.targets; target++) {
            base[0][k] += weights[target] * f->deltas[target][0][vertex][k];
            base[1][k] += weights[target] * f->deltas[target][1][vertex][k];
        }
    }
    vertex_matrix(f, time, vertex, m);
    // Flattened matrices have a determinant of rounding errors, which means nothing.
    const double determinant = cofactors(m, c);
    const int sign = f->kind.flattens ? 1 : determinant < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        position[k] = m[k][0] * base[0][0] + m[k][1] * base[0][1] + m[k][2] * base[0][2] + m[k][3];
        normal[k] = sign * (c[k][0] * base[1][0] + c[k][1] * base[1][1] + c[k][2] * base[1][2]);
        length += normal[k] * normal[k];
    }
    for (int k = 0; k < 3; k++) {
        normal[k] /= sqrt(length);
    }
    return sign;
}

figure_triangle figure_triangle_at(const figure *f, double time, int triangle)
{
    figure_triangle result, straight;
    int sum = 0;
    for (int corner = 0; corner < 3; corner++) {
        sum += vertex_at(f, time, f->indices[triangle][corner], straight.positions[corner],
                         straight.normals[corner]);
    }
    for (int corner = 0; corner < 3; corner++) {
        const int from = sum < 0 && corner > 0 ? 3 - corner : corner;
        memcpy(result.positions[corner], straight.positions[from], sizeof result.positions[corner]);
        memcpy(result.normals[corner], straight.normals[from], sizeof result.normals[corner]);
    }
    return result;
}
