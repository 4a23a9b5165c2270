// Builds spheres, boxes, prisms and sheets. See shapes.h.
#include "shapes.h"

static const glint_vec3 no_normal = {0, 0, 0};

// ---- Sphere ------------------------------------------------------------------------------------

// Corners of the icosahedron: the poles, and two rings of five at latitude ±atan(½).
static glint_vec3 icosahedron_corner(int index)
{
    if (index == 0 || index == 11) {
        return (glint_vec3){0, index == 0 ? 1 : -1, 0};
    }
    int upper = index <= 5;
    double azimuth = GLINT_PI / 5 * (2 * ((index - 1) % 5) + (upper ? 0 : 1));
    double ring = 2 / sqrt(5.0);
    return (glint_vec3){ring * sin(azimuth), (upper ? 1 : -1) / sqrt(5.0), ring * cos(azimuth)};
}

static void icosahedron_face(int face, int corners[3])
{
    int i = face % 5;
    int next = (i + 1) % 5;
    const int table[4][3] = {
        {0, 1 + i, 1 + next},
        {1 + i, 6 + i, 1 + next},
        {6 + i, 6 + next, 1 + next},
        {11, 6 + next, 6 + i},
    };
    for (int k = 0; k < 3; k++) {
        corners[k] = table[face / 5][k];
    }
}

// Adds the point at steps a, b, c towards the corners. On an edge one step is 0, and both faces sum
// the other two to the same bits. So welding closes the sphere.
static uint32_t add_sphere_point(mesh *m, double radius, const int corners[3], const int steps[3])
{
    glint_vec3 sum = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        sum = glint_vec3_add(sum, glint_vec3_scale(icosahedron_corner(corners[k]), steps[k]));
    }
    glint_vec3 normal = glint_vec3_normalize(sum);
    return mesh_add_vertex(m, glint_vec3_scale(normal, radius), normal);
}

void shape_sphere(mesh *m, double radius, int frequency)
{
    for (int face = 0; face < 20; face++) {
        int corners[3];
        icosahedron_face(face, corners);
        uint32_t first = (uint32_t)m->vertex_count;
        for (int row = 0; row <= frequency; row++) {
            for (int i = 0; i <= row; i++) {
                add_sphere_point(m, radius, corners, (const int[3]){frequency - row, row - i, i});
            }
        }
        for (int row = 0; row < frequency; row++) {
            uint32_t above = first + (uint32_t)(row * (row + 1) / 2);
            uint32_t below = above + (uint32_t)row + 1;
            for (uint32_t i = 0; i <= (uint32_t)row; i++) {
                mesh_add_triangle(m, above + i, below + i, below + i + 1);
                if (i < (uint32_t)row) {
                    mesh_add_triangle(m, above + i, below + i + 1, above + i + 1);
                }
            }
        }
    }
    mesh_weld(m);
}

// ---- Boxes and prisms --------------------------------------------------------------------------

void shape_box(mesh *m, glint_vec3 centre, glint_vec3 half)
{
    m->flat = true;
    uint32_t corner[8]; // bit 0: +x, bit 1: +y, bit 2: +z
    for (int i = 0; i < 8; i++) {
        glint_vec3 offset = {i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y,
                             i & 4 ? half.z : -half.z};
        corner[i] = mesh_add_vertex(m, glint_vec3_add(centre, offset), no_normal);
    }
    static const int faces[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                    {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
    for (int face = 0; face < 6; face++) {
        const int *f = faces[face];
        mesh_add_quad(m, corner[f[0]], corner[f[1]], corner[f[2]], corner[f[3]]);
    }
}

// Adds a quad, and flips it if its corners run clockwise seen from outside. The solid is convex and
// holds the origin, so outside is the side away from the origin.
static void add_outward(mesh *m, const uint32_t *corners, int count)
{
    glint_vec3 a = m->positions[corners[0]];
    glint_vec3 ab = glint_vec3_subtract(m->positions[corners[1]], a);
    glint_vec3 ac = glint_vec3_subtract(m->positions[corners[2]], a);
    int turned = glint_vec3_dot(glint_vec3_cross(ab, ac), a) < 0;
    for (int i = 1; i + 1 < count; i++) {
        mesh_add_triangle(m, corners[0], corners[turned ? i + 1 : i], corners[turned ? i : i + 1]);
    }
}

void shape_chamfered_box(mesh *m, glint_vec3 half, double chamfer)
{
    m->flat = true;
    // Three vertices at each of the 8 corners: vertex `axis` lies on the face across this axis.
    uint32_t at[8][3];
    for (int corner = 0; corner < 8; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            double x = half.x - (axis == 0 ? 0 : chamfer);
            double y = half.y - (axis == 1 ? 0 : chamfer);
            double z = half.z - (axis == 2 ? 0 : chamfer);
            at[corner][axis] = mesh_add_vertex(
                m, (glint_vec3){corner & 1 ? x : -x, corner & 2 ? y : -y, corner & 4 ? z : -z},
                no_normal);
        }
    }
    if (m->failed) {
        return;
    }
    for (int corner = 0; corner < 8; corner++) {
        add_outward(m, at[corner], 3);
    }
    for (int axis = 0; axis < 3; axis++) {
        int u = 1 << (axis + 1) % 3;
        int v = 1 << (axis + 2) % 3;
        for (int side = 0; side < 2; side++) {
            int base = side << axis;
            add_outward(m,
                        (const uint32_t[4]){at[base][axis], at[base | u][axis],
                                            at[base | u | v][axis], at[base | v][axis]},
                        4);
        }
        for (int edge = 0; edge < 4; edge++) { // the four edges along this axis
            int from = (edge & 1 ? u : 0) | (edge & 2 ? v : 0);
            int to = from | 1 << axis;
            int first = (axis + 1) % 3;
            int second = (axis + 2) % 3;
            add_outward(m,
                        (const uint32_t[4]){at[from][first], at[to][first], at[to][second],
                                            at[from][second]},
                        4);
        }
    }
}

void shape_prism(mesh *m, const double (*outline)[2], int corners, double half_length)
{
    m->flat = true;
    uint32_t first = (uint32_t)m->vertex_count;
    for (int i = 0; i < corners; i++) {
        for (int end = 0; end < 2; end++) {
            glint_vec3 p = {outline[i][0], outline[i][1], end ? -half_length : half_length};
            mesh_add_vertex(m, p, no_normal);
        }
    }
    for (int i = 0; i < corners; i++) {
        uint32_t a = first + 2 * (uint32_t)i;
        uint32_t b = first + 2 * (uint32_t)((i + 1) % corners);
        mesh_add_quad(m, a, a + 1, b + 1, b);
        if (i > 0 && i + 1 < corners) {
            mesh_add_triangle(m, first, a, b);
            mesh_add_triangle(m, first + 1, b + 1, a + 1);
        }
    }
}

void shape_sheet(mesh *m, double half_x, double half_z)
{
    m->flat = true;
    m->open = true;
    uint32_t first = (uint32_t)m->vertex_count;
    mesh_add_vertex(m, (glint_vec3){-half_x, 0, half_z}, no_normal);
    mesh_add_vertex(m, (glint_vec3){half_x, 0, half_z}, no_normal);
    mesh_add_vertex(m, (glint_vec3){half_x, 0, -half_z}, no_normal);
    mesh_add_vertex(m, (glint_vec3){-half_x, 0, -half_z}, no_normal);
    mesh_add_quad(m, first, first + 1, first + 2, first + 3);
}
