// A floor that punctual lights shine on, under a dark sky, and what it should show: by the text of
// KHR_lights_punctual, in closed form.
#ifndef GLINT_TESTS_SUPPORT_LIT_FLOOR_H
#define GLINT_TESTS_SUPPORT_LIT_FLOOR_H

#include "support/render.h"

#include <stdbool.h>
#include <stdint.h>

#define LIT_FLOOR_TRIANGLES 600
#define LIT_FLOOR_Y (-0.3125)

// Triangles with unit 1, the floor of material 0, and lights. Nothing is owned.
typedef struct lit_floor {
    float positions[LIT_FLOOR_TRIANGLES][9];
    uint32_t material_of[LIT_FLOOR_TRIANGLES];
    glint_material materials[2];
    glint_instance instances[2];
    glint_punctual_light lights[4];
    glint_camera camera;
    glint_scene scene;
} lit_floor;

// A square about the y axis, in parts × parts quads, that rises by `slope` along x.
typedef struct sheet {
    double half, y, slope;
    int parts;
    bool faces_down;
} sheet;

// The floor as most tests have it. Its corners are floats, so that nothing is rounded before it
// comes to the device.
extern const sheet flat_floor;
extern const glint_material floor_paint; // matte, the materials that there are at first
extern const glint_punctual_light floor_lamp;

// A floor without lights, seen from above.
void lit_floor_begin(lit_floor *s, const sheet *floor);
void lit_floor_add_quad(lit_floor *s, const double corners[4][3], uint32_t material);
void lit_floor_add_sheet(lit_floor *s, const sheet *f, uint32_t material);
void lit_floor_add_light(lit_floor *s, const glint_punctual_light *light);
// Parallel rays from height y, down or up.
void lit_floor_look(lit_floor *s, double y, bool up);

void lit_floor_render(lit_floor *s, const glint_settings *settings, test_frame *frame);

// Calls `check` in single and in double precision.
void lit_floor_in_both(void (*check)(const glint_settings *settings));

// The largest relative rounding error.
double lit_floor_rounding(const glint_settings *settings);

// Where a pixel's ray meets a sheet.
void lit_floor_point(const lit_floor *s, const glint_settings *settings, int pixel, const sheet *on,
                     double p[3]);

// What is judged: a frame that shows a sheet.
typedef struct lit_frame {
    const lit_floor *floor;
    const glint_settings *settings;
    const test_frame *frame;
    const sheet *on;
} lit_frame;

// A few dozen roundings of a point's coordinates, each of which counts by up to 1/distance.
#define LIT_FLOOR_SLACK 256

extern const double lit_fully[3], lit_not[3];

// A pixel's R, G and B must be the sum of the lights', each times `left`. `slack`: of what there
// would be without cones and range, in roundings.
void lit_floor_expect(const lit_frame *f, int pixel, const double left[3], double slack);
void lit_floor_expect_everywhere(const lit_frame *f, const double left[3], double slack);

#endif
