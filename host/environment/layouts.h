// Names the layouts: how files hold directions.
#ifndef GLINT_ENVIRONMENT_LAYOUTS_H
#define GLINT_ENVIRONMENT_LAYOUTS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum glint_layout {
    GLINT_LAYOUT_UNKNOWN, // as an argument: recognise it
    GLINT_LAYOUT_CUBE,    // OpenEXR's 1 × 6 strip
    GLINT_LAYOUT_FACES,   // six files
    GLINT_LAYOUT_HCROSS,  // 4 × 3 faces
    GLINT_LAYOUT_VCROSS,  // 3 × 4 faces
    GLINT_LAYOUT_VSTRIP,  // 1 × 6 faces, in OpenGL's and Direct3D's order
    GLINT_LAYOUT_HSTRIP,  // 6 × 1 faces, in the same order
    GLINT_LAYOUT_LATLONG,
    GLINT_LAYOUT_BALL,    // a mirror ball's picture
    GLINT_LAYOUT_ANGULAR, // a disc: the distance from its middle is the angle
    GLINT_LAYOUT_STUDIO,  // built in, has no file
} glint_layout;

// The name on the command line ("latlong"); NULL for UNKNOWN.
const char *glint_layout_name(glint_layout layout);

// Returns UNKNOWN if no layout has this name.
glint_layout glint_layout_from_name(const char *name);

// Facts that the user gives about a file. Zero is valid: no facts.
typedef struct glint_layout_request {
    glint_layout layout; // UNKNOWN: recognise it
    // BALL, ANGULAR: the disc's centre and radius in pixels; (0, 0) is the top left corner. Radius
    // 0: the largest circle in the middle of the picture.
    double circle[3];
    // BALL: the viewer's distance, see glint_chart. 0: far away, or computed from ball_fov.
    double ball_distance;
    // BALL: the camera's vertical angle of view over the whole picture, in degrees, under 180.
    // glint computes the distance from it. 0: not known.
    double ball_fov;
} glint_layout_request;

#ifdef __cplusplus
}
#endif

#endif
