// Renders a floor under punctual lights and a dark sky, and computes its expected colours in closed
// form, by the text of KHR_lights_punctual.
#ifndef GLINT_TESTS_SUPPORT_LIT_FLOOR_H
#define GLINT_TESTS_SUPPORT_LIT_FLOOR_H

#include "support/render.h"

#include <stdbool.h>
#include <stdint.h>

#define LIT_FLOOR_TRIANGLES 600
#define LIT_FLOOR_Y (-0.3125)

// A scene of triangles with unit 1, a floor of material 0, and lights. Nothing is owned.
typedef struct lit_floor {
    float positions[LIT_FLOOR_TRIANGLES][9];
    uint32_t material_of[LIT_FLOOR_TRIANGLES];
    glint_material materials[2];
    glint_instance instances[2];
    glint_punctual_light lights[4];
    glint_camera camera;
    glint_scene scene;
} lit_floor;

// A square about the y axis, in parts × parts quads, with slope `slope` along x.
typedef struct sheet {
    double half, y, slope;
    int parts;
    bool faces_down;
} sheet;

// The floor of most tests. Its corners are floats, so that nothing is rounded on the way to the
// device.
extern const sheet flat_floor;
extern const glint_material floor_paint; // matte, used by all materials at first
extern const glint_punctual_light floor_lamp;

// Begins a scene: a floor without lights, seen from above.
void lit_floor_begin(lit_floor *s, const sheet *floor);
void lit_floor_add_quad(lit_floor *s, const double corners[4][3], uint32_t material);
void lit_floor_add_sheet(lit_floor *s, const sheet *f, uint32_t material);
void lit_floor_add_light(lit_floor *s, const glint_punctual_light *light);
// Sets a camera with parallel rays from height y, down or up.
void lit_floor_look(lit_floor *s, double y, bool up);

void lit_floor_render(lit_floor *s, const glint_settings *settings, test_frame *frame);

// Calls `check` in single and in double precision.
void lit_floor_in_both(void (*check)(const glint_settings *settings));

// The largest relative rounding error.
double lit_floor_rounding(const glint_settings *settings);

// Computes the point where the ray of a pixel meets a sheet.
void lit_floor_point(const lit_floor *s, const glint_settings *settings, int pixel, const sheet *on,
                     double p[3]);

// A frame to check, which shows the sheet `on`.
typedef struct lit_frame {
    const lit_floor *floor;
    const glint_settings *settings;
    const test_frame *frame;
    const sheet *on;
} lit_frame;

// A few dozen roundings of a point's coordinates. Each counts by up to 1/distance.
#define LIT_FLOOR_SLACK 256

extern const double lit_fully[3], lit_not[3];

// Asserts that R, G and B of a pixel are the sum of the lights, each times `left`. `slack`: the
// tolerance in roundings of the sum without cones and range.
void lit_floor_expect(const lit_frame *f, int pixel, const double left[3], double slack);
void lit_floor_expect_everywhere(const lit_frame *f, const double left[3], double slack);

#endif
