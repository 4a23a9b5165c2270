// Vectors and matrices of double. See vector.h.
#include "base/vector.h"

const glint_mat4 glint_mat4_identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

glint_vec3 glint_vec3_normalize(glint_vec3 a)
{
    // Divide by the largest component first, so that the squares do not overflow or underflow.
    double largest = fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
    if (!(largest > 0) || !isfinite(a.x) || !isfinite(a.y) || !isfinite(a.z)) {
        return (glint_vec3){0, 0, 0};
    }
    glint_vec3 b = {a.x / largest, a.y / largest, a.z / largest};
    return glint_vec3_scale(b, 1 / sqrt(glint_vec3_dot(b, b)));
}

// True if a·b = c·d exactly. The rounding error of each product is itself a double, because the
// products are far from underflow here. So comparing both parts compares the exact products.
static bool products_equal(double a, double b, double c, double d)
{
    const double first = a * b, second = c * d;
    return first == second && fma(a, b, -first) == fma(c, d, -second);
}

bool glint_triangle_has_area(const float a[3], const float b[3], const float c[3])
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
    }
    return !(products_equal(u[1], v[2], u[2], v[1]) && products_equal(u[2], v[0], u[0], v[2]) &&
             products_equal(u[0], v[1], u[1], v[0]));
}

glint_mat4 glint_mat4_multiply(const glint_mat4 *a, const glint_mat4 *b)
{
    glint_mat4 c;
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            double sum = 0;
            for (int k = 0; k < 4; k++) {
                sum += a->m[row][k] * b->m[k][column];
            }
            c.m[row][column] = sum;
        }
    }
    return c;
}

glint_vec3 glint_mat4_point(const glint_mat4 *a, glint_vec3 p)
{
    const double(*m)[4] = a->m;
    return (glint_vec3){m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
                        m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
                        m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
}

glint_vec3 glint_mat4_direction(const glint_mat4 *a, glint_vec3 d)
{
    const double(*m)[4] = a->m;
    return (glint_vec3){m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z,
                        m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z,
                        m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z};
}

static glint_vec3 row3(const glint_mat4 *a, int row)
{
    return (glint_vec3){a->m[row][0], a->m[row][1], a->m[row][2]};
}

double glint_mat4_determinant3(const glint_mat4 *a)
{
    return glint_vec3_dot(row3(a, 0), glint_vec3_cross(row3(a, 1), row3(a, 2)));
}

glint_vec3 glint_mat4_normal(const glint_mat4 *a, glint_vec3 n)
{
    glint_vec3 result = {
        glint_vec3_dot(glint_vec3_cross(row3(a, 1), row3(a, 2)), n),
        glint_vec3_dot(glint_vec3_cross(row3(a, 2), row3(a, 0)), n),
        glint_vec3_dot(glint_vec3_cross(row3(a, 0), row3(a, 1)), n),
    };
    return glint_vec3_scale(result, glint_mat4_determinant3(a) < 0 ? -1 : 1);
}
