// Computes the model of a figure with morph targets and a skin. See figure.h.
#include "support/figure.h"

#include <math.h>
#include <string.h>

// Finds the interval of a time between the first key and the last, and the share within it.
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
    // Each column is an axis, rotated by q v q*.
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
            if (figure_turning[i] == joint) {
                turn_at(f, time, i, node.rotation);
            }
        }
        affine local, bind = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
        place(&node, local);
        multiply(figure_parents[joint] < 0 ? rig : worlds[figure_parents[joint]], local,
                 worlds[joint]);
        for (int i = 0; i < 16 && !f->kind.no_inverse_bind; i++) {
            if (i % 4 < 3) {
                bind[i % 4][i / 4] = (double)f->inverse_bind[joint][i];
            }
        }
        multiply(worlds[joint], bind, joints[joint]);
    }
}

// The matrix from a vertex to the world: the weighted sum of the joints' matrices, or the node's.
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

// Cofactors of the 3 × 3 part: its inverse transposed, times the determinant. Returns the
// determinant.
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

// Computes a vertex. Returns the sign of the determinant of its matrix.
static int vertex_at(const figure *f, double time, int vertex, double position[3], double normal[3])
{
    double weights[FIGURE_TARGETS], base[2][3], c[3][3], length = 0;
    affine m;
    weights_at(f, time, weights);
    for (int k = 0; k < 3; k++) {
        base[0][k] = (double)f->positions[vertex][k];
        base[1][k] = (double)f->normals[vertex][k];
        for (int target = 0; target < FIGURE_TARGETS && target < f->kind.targets; target++) {
            base[0][k] += weights[target] * f->deltas[target][0][vertex][k];
            base[1][k] += weights[target] * f->deltas[target][1][vertex][k];
        }
    }
    vertex_matrix(f, time, vertex, m);
    // The determinant of a flattened matrix is rounding error only.
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
    figure_triangle result = {0}, straight = {0};
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
