// Renders in tests: one call from a file of scenes/ to pixels.
#ifndef GLINT_TESTS_SUPPORT_RENDER_H
#define GLINT_TESTS_SUPPORT_RENDER_H

#include "device/device.h"
#include "environment/environment.h"
#include "render/frame.h"
#include "scene/scene.h"

// The device and the studio, shared by all tests of a program. The first call opens them; the
// group's teardown, test_close_device, closes them.
glint_device *test_device(void);
const glint_environment *test_studio(void);
int test_close_device(void **state);

// Loads scenes/NAME.gltf. Fails the running test, with the error, if it cannot.
void test_scene_load(const char *name, glint_scene *scene);

// A scene, its first camera, the studio around it, and a renderer. Fails the test on any error.
typedef struct test_stage {
    glint_scene scene;
    const glint_environment *environment;
    glint_camera camera;
    glint_settings settings;
    glint_renderer *renderer;
} test_stage;

void test_stage_open(const char *scene, const glint_settings *settings, test_stage *stage);
void test_stage_close(test_stage *stage);

typedef struct test_frame {
    glint_image image;
    glint_frame_report report;
    glint_plan plan;
    double *exact;       // full precision of the device, [height][width][4]
    glint_layers layers; // the layers of the settings
} test_frame;

// Renders with the camera of this name (NULL: the first). Fails the test on any error.
void test_render(const glint_scene *scene, const glint_environment *environment, const char *camera,
                 const glint_settings *settings, test_frame *frame);
// Renders scenes/NAME.gltf under bridge_direction_environment(32).
void test_render_named(const char *name, const glint_settings *settings, test_frame *frame);
void test_frame_free(test_frame *frame);

// Settings of 61 × 43 pixels. These are no multiples of a packet, so packets hang over both edges.
// Rough surfaces are smooth; test_rough.c tests the other kinds.
glint_settings test_small_frame(int depth);

// Counts the pixels of two images of one size that are not equal bit for bit.
size_t test_count_different(const glint_image *a, const glint_image *b);

#endif
