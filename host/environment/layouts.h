// How files hold directions: the layouts and their names.
#ifndef GLINT_ENVIRONMENT_LAYOUTS_H
#define GLINT_ENVIRONMENT_LAYOUTS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum glint_layout {
    GLINT_LAYOUT_UNKNOWN, // as an argument: to be recognised
    GLINT_LAYOUT_CUBE,    // OpenEXR's 1 × 6 strip
    GLINT_LAYOUT_FACES,   // six files
    GLINT_LAYOUT_HCROSS,  // 4 × 3 faces
    GLINT_LAYOUT_VCROSS,  // 3 × 4
    GLINT_LAYOUT_VSTRIP,  // 1 × 6, in OpenGL's and Direct3D's order
    GLINT_LAYOUT_HSTRIP,  // 6 × 1, likewise
    GLINT_LAYOUT_LATLONG,
    GLINT_LAYOUT_BALL,    // a mirror ball's picture
    GLINT_LAYOUT_ANGULAR, // a disc: the angle from its middle is the distance from there
    GLINT_LAYOUT_STUDIO,  // built in, no file
} glint_layout;

// The name on the command line ("latlong"); NULL for UNKNOWN.
const char *glint_layout_name(glint_layout layout);

// UNKNOWN for a name that is none.
glint_layout glint_layout_from_name(const char *name);

// What is known of a file beside its content. Zero is valid: nothing.
typedef struct glint_layout_request {
    glint_layout layout;  // UNKNOWN: to be recognised
    double circle[3];     // BALL, ANGULAR: the disc's centre and radius in pixels, (0, 0) the top
                          // left corner; radius 0: the circle that fills the picture's middle
    double ball_distance; // BALL: see glint_chart; 0: far away, or as ball_fov has it
    double ball_fov;      // BALL: the camera's vertical angle of view in degrees, under 180, of the
                          // whole picture, which tells the distance; 0: not known
} glint_layout_request;

#ifdef __cplusplus
}
#endif

#endif
