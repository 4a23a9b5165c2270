// Tells how two triangles meet; contacts.c, openings.c and digits.c use it.
//
// Two surfaces coincide if their distance along the normal is less than GLINT_TOUCHING of their
// coordinates. This is a few times the distance that the kernels use (kernels/overlaps.cl).
#ifndef GLINT_SCENE_SHAPE_FACES_H
#define GLINT_SCENE_SHAPE_FACES_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct glint_face {
    glint_vec3 at[3], normal; // the normal is a unit vector
    double along_normal;      // the corners' coordinates along the normal
    double size;              // the largest coordinate
} glint_face;

typedef enum glint_meeting {
    GLINT_FACES_APART,
    GLINT_FACES_TOUCH,        // they coincide in part
    GLINT_FACES_CROSS,        // each has corners on both sides of the other
    GLINT_FACES_MEET_IN_EDGE, // an edge of one lies in the plane of the other
} glint_meeting;

// An edge of a face that lies on another face.
typedef struct glint_face_edge {
    glint_vec3 ends[2]; // in order: x, then y, then z
    bool is_above;      // of the other face, as that one's normal points
} glint_face_edge;

glint_face glint_face_of(const glint_scene *scene, size_t triangle);

// True if a point is above or below the face, or nearer than `reach` to being so.
bool glint_face_faces(const glint_face *f, glint_vec3 point, double reach);

// The distance from the plane of `f` within which `other` coincides with it.
double glint_face_reach(const glint_face *f, const glint_face *other);

glint_meeting glint_faces_meet(const glint_face *a, const glint_face *b);

// True if one edge of `other`, and no more of it, lies on `f`; an edge that only meets the boundary
// of `f` does not count.
bool glint_edge_on_face(const glint_face *f, const glint_face *other, glint_face_edge *edge);

#endif
