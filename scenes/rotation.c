// Computes rotations in glTF's form. See rotation.h.
#include "rotation.h"

void rotation_about(glint_vec3 axis, double degrees, double rotation[4])
{
    double half = degrees * GLINT_PI / 360;
    double s = sin(half);
    rotation[0] = axis.x * s;
    rotation[1] = axis.y * s;
    rotation[2] = axis.z * s;
    rotation[3] = cos(half);
}

void rotation_compose(const double second[4], const double first[4], double rotation[4])
{
    const double *p = second;
    const double *q = first;
    const double result[4] = {
        p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1],
        p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0],
        p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3],
        p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2],
    };
    for (int i = 0; i < 4; i++) {
        rotation[i] = result[i];
    }
}

void rotation_look_at(glint_vec3 eye, glint_vec3 target, double rotation[4])
{
    // Yaw about +Y, then pitch about the camera's own +X: no roll. The half angles come from square
    // roots, which are exact to the last bit on every machine.
    glint_vec3 d = glint_vec3_normalize(glint_vec3_subtract(target, eye));
    double level = sqrt(d.x * d.x + d.z * d.z);
    double cos_yaw = level > 0 ? -d.z / level : 1;
    double yaw[4] = {0, copysign(sqrt(fmax(0, (1 - cos_yaw) / 2)), -d.x), 0,
                     sqrt((1 + cos_yaw) / 2)};
    double pitch[4] = {copysign(sqrt((1 - level) / 2), d.y), 0, 0, sqrt((1 + level) / 2)};
    rotation_compose(yaw, pitch, rotation);
}

glint_vec3 rotation_apply(const double rotation[4], glint_vec3 v)
{
    glint_vec3 axis = {rotation[0], rotation[1], rotation[2]};
    glint_vec3 twice = glint_vec3_scale(glint_vec3_cross(axis, v), 2);
    return glint_vec3_add(glint_vec3_add(v, glint_vec3_scale(twice, rotation[3])),
                          glint_vec3_cross(axis, twice));
}
