// Builds surfaces of revolution, the trefoil knot and the brilliant. See shapes.h.
#include "shapes.h"

// ---- Revolution --------------------------------------------------------------------------------

static void add_point(profile *p, const double at[2], const double direction[2])
{
    if (p->count == PROFILE_CAPACITY) {
        return;
    }
    double length = hypot(direction[0], direction[1]);
    p->points[p->count++] =
        (struct profile_point){at[0], at[1], direction[1] / length, -direction[0] / length};
}

void profile_line(profile *p, double r0, double h0, double r1, double h1)
{
    double direction[2] = {r1 - r0, h1 - h0};
    add_point(p, (const double[2]){r0, h0}, direction);
    add_point(p, (const double[2]){r1, h1}, direction);
}

void profile_curve(profile *p, const double control[3][2], int steps)
{
    struct profile_point last = p->points[p->count - 1];
    const double start[2] = {last.radius, last.height};
    for (int i = 0; i <= steps; i++) {
        double t = (double)i / steps;
        double s = 1 - t;
        double at[2];
        double direction[2];
        for (int k = 0; k < 2; k++) {
            double a = start[k];
            double b = control[0][k];
            double c = control[1][k];
            double d = control[2][k];
            at[k] = s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
            direction[k] = s * s * (b - a) + 2 * s * t * (c - b) + t * t * (d - c);
        }
        add_point(p, at, direction);
    }
}

void profile_arc(profile *p, const double centre[2], double radius, const double degrees[2],
                 int steps)
{
    double turn = degrees[1] > degrees[0] ? 1 : -1;
    for (int i = 0; i <= steps; i++) {
        double angle = (degrees[0] + (degrees[1] - degrees[0]) * i / steps) * GLINT_PI / 180;
        double at[2] = {centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)};
        add_point(p, at, (const double[2]){-turn * sin(angle), turn * cos(angle)});
    }
}

void shape_revolve(mesh *m, const profile *p, int sides)
{
    // Every ring has `sides` vertices, also on the axis. Welding joins the vertices on the axis,
    // whose normals agree there. Quads that end on the axis lose the triangle without area.
    uint32_t first = (uint32_t)m->vertex_count;
    for (int i = 0; i < p->count; i++) {
        struct profile_point point = p->points[i];
        bool on_axis = mesh_snap(point.radius) == 0;
        for (int side = 0; side < sides; side++) {
            double azimuth = 2 * GLINT_PI * side / sides;
            double x = sin(azimuth);
            double z = cos(azimuth);
            double r = on_axis ? 0 : point.radius;
            double n = on_axis ? 0 : point.normal_radius;
            double up = on_axis ? copysign(1, point.normal_height) : point.normal_height;
            mesh_add_vertex(m, (glint_vec3){r * x, point.height, r * z},
                            (glint_vec3){n * x, up, n * z});
        }
    }
    for (uint32_t i = 0; i + 1 < (uint32_t)p->count; i++) {
        for (uint32_t side = 0; side < (uint32_t)sides; side++) {
            uint32_t next = (side + 1) % (uint32_t)sides;
            uint32_t lower = first + i * (uint32_t)sides;
            uint32_t upper = lower + (uint32_t)sides;
            mesh_add_quad(m, lower + side, lower + next, upper + next, upper + side);
        }
    }
    mesh_weld(m);
}

// ---- Trefoil knot ------------------------------------------------------------------------------

// The middle line at parameter t, the normal of the torus there, and the tangent of the line.
static void knot_frame(const knot_shape *shape, double t, glint_vec3 frame[3])
{
    // A quarter turn puts the first lobe up: azimuth 2t + 90°.
    double c = -sin(2 * t);
    double s = cos(2 * t);
    double out = cos(3 * t);
    double up = sin(3 * t);
    double r = shape->ring + shape->inner * out;
    frame[0] = (glint_vec3){r * c, r * s, shape->inner * up};
    frame[1] = (glint_vec3){out * c, out * s, up};
    double dr = -3 * shape->inner * up;
    frame[2] = glint_vec3_normalize(
        (glint_vec3){dr * c - 2 * r * s, dr * s + 2 * r * c, 3 * shape->inner * out});
}

void shape_knot(mesh *m, const knot_shape *shape)
{
    uint32_t first = (uint32_t)m->vertex_count;
    for (int i = 0; i < shape->along; i++) {
        glint_vec3 frame[3];
        knot_frame(shape, 2 * GLINT_PI * i / shape->along, frame);
        glint_vec3 side = glint_vec3_cross(frame[2], frame[1]);
        for (int j = 0; j < shape->around; j++) {
            double angle = 2 * GLINT_PI * j / shape->around;
            glint_vec3 normal = glint_vec3_add(glint_vec3_scale(frame[1], cos(angle)),
                                               glint_vec3_scale(side, sin(angle)));
            mesh_add_vertex(m, glint_vec3_add(frame[0], glint_vec3_scale(normal, shape->tube)),
                            normal);
        }
    }
    uint32_t around = (uint32_t)shape->around;
    for (uint32_t i = 0; i < (uint32_t)shape->along; i++) {
        uint32_t here = first + i * around;
        uint32_t there = first + (i + 1) % (uint32_t)shape->along * around;
        for (uint32_t j = 0; j < around; j++) {
            uint32_t next = (j + 1) % around;
            mesh_add_quad(m, here + j, here + next, there + next, there + j);
        }
    }
}

// ---- Brilliant ---------------------------------------------------------------------------------

// Azimuths count in sixteenths of a turn: even numbers for main facets, odd numbers between them.
static uint32_t add_on_cone(mesh *m, double radius, double height, int sixteenth)
{
    double azimuth = GLINT_PI / 8 * (sixteenth % 16);
    glint_vec3 p = {radius * sin(azimuth), height, radius * cos(azimuth)};
    return mesh_add_vertex(m, p, (glint_vec3){0, 0, 0});
}

void shape_brilliant(mesh *m, const brilliant_shape *shape)
{
    m->flat = true;
    double radius = shape->girdle_radius;
    double girdle = shape->girdle_height * radius;
    double crown = tan(shape->crown * GLINT_PI / 180);
    double pavilion = tan(shape->pavilion * GLINT_PI / 180);
    // A main facet touches the circle of the girdle at its own azimuth. Its height falls with the
    // distance along this azimuth. Half way to the next facet this distance is the radius times cos
    // 22.5°.
    double between = cos(GLINT_PI / 8);
    double table = shape->table * radius;
    double star = table * between + shape->star * (radius - table * between);
    double tip = (1 - shape->lower_half) * radius;
    double star_height = girdle + (radius - star * between) * crown;
    double tip_height = -(radius - tip * between) * pavilion;
    uint32_t culet = add_on_cone(m, 0, -radius * pavilion, 0);
    uint32_t centre = add_on_cone(m, 0, girdle + (radius - table) * crown, 0);
    for (int i = 0; i < 16; i += 2) {
        uint32_t t0 = add_on_cone(m, table, girdle + (radius - table) * crown, i);
        uint32_t t1 = add_on_cone(m, table, girdle + (radius - table) * crown, i + 2);
        uint32_t s0 = add_on_cone(m, star, star_height, i + 15);
        uint32_t s1 = add_on_cone(m, star, star_height, i + 1);
        uint32_t q0 = add_on_cone(m, tip, tip_height, i + 15);
        uint32_t q1 = add_on_cone(m, tip, tip_height, i + 1);
        uint32_t upper[3];
        uint32_t lower[3]; // the girdle at i, i + 1, i + 2
        for (int k = 0; k < 3; k++) {
            upper[k] = add_on_cone(m, radius, girdle, i + k);
            lower[k] = add_on_cone(m, radius, 0, i + k);
        }
        mesh_add_triangle(m, centre, t0, t1);
        mesh_add_triangle(m, t0, s1, t1);
        mesh_add_quad(m, t0, s0, upper[0], s1);
        mesh_add_triangle(m, s1, upper[0], upper[1]);
        mesh_add_triangle(m, s1, upper[1], upper[2]);
        for (int k = 0; k < 2; k++) {
            mesh_add_quad(m, upper[k], lower[k], lower[k + 1], upper[k + 1]);
        }
        mesh_add_triangle(m, q1, lower[1], lower[0]);
        mesh_add_triangle(m, q1, lower[2], lower[1]);
        mesh_add_quad(m, culet, q1, lower[0], q0);
    }
    mesh_weld(m);
}
