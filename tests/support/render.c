// Renders in tests. See render.h.
#include "support/render.h"

#include "support/bridge.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static glint_device *shared_device;
static glint_environment shared_studio;

// cmocka leaves the test at fail(), so the error is printed first.
static void require(glint_status status, const glint_error *error)
{
    if (status != GLINT_OK) {
        print_error("%s\n%s\n", error->message, error->details != NULL ? error->details : "");
        fail();
    }
}

glint_device *test_device(void)
{
    if (shared_device == NULL) {
        glint_error error = {0};
        require(glint_device_open(NULL, &shared_device, &error), &error);
    }
    return shared_device;
}

const glint_environment *test_studio(void)
{
    if (shared_studio.radiance.edge == 0) {
        glint_error error = {0};
        require(glint_environment_studio(&shared_studio, &error), &error);
    }
    return &shared_studio;
}

int test_close_device(void **state)
{
    (void)state;
    glint_environment_free(&shared_studio);
    glint_device_close(shared_device);
    shared_device = NULL;
    return 0;
}

void test_scene_load(const char *name, glint_scene *scene)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/scenes/%s.gltf", GLINT_SOURCE_DIR, name);
    glint_error error = {0};
    require(glint_scene_load(path, NULL, scene, NULL, &error), &error);
}

static double *exact_values(const glint_image *image)
{
    size_t count = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    double *values = malloc(count * sizeof *values);
    assert_non_null(values);
    for (size_t i = 0; i < count; i++) {
        values[i] = (double)image->pixels[i];
    }
    return values;
}

void test_render(const glint_scene *scene, const glint_environment *environment,
                 const char *camera_name, const glint_settings *settings, test_frame *frame)
{
    *frame = (test_frame){0};
    glint_error error = {0};
    glint_camera camera;
    require(glint_scene_camera(scene, camera_name, &camera, &error), &error);
    const glint_renderer_inputs inputs = {
        .device = test_device(),
        .scene = scene,
        .environment = environment,
        .settings = settings,
    };
    glint_renderer *renderer;
    require(glint_renderer_create(&inputs, &renderer, &error), &error);
    frame->plan = *glint_renderer_plan(renderer);
    require(
        glint_renderer_frame(
            &(glint_frame_request){renderer, &camera, NULL, &frame->image, &frame->report}, &error),
        &error);
    if (frame->plan.precision == GLINT_PRECISION_DOUBLE) {
        require(glint_renderer_exact_pixels(renderer, &frame->exact, &error), &error);
    } else {
        frame->exact = exact_values(&frame->image);
    }
    if (settings->aovs != 0 || settings->terms > 0) {
        require(glint_renderer_layers(renderer, &frame->layers, &error), &error);
    }
    glint_renderer_free(renderer);
}

void test_render_named(const char *name, const glint_settings *settings, test_frame *frame)
{
    glint_scene scene = {0};
    test_scene_load(name, &scene);
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    test_render(&scene, &environment, NULL, settings, frame);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

glint_settings test_small_frame(int depth)
{
    glint_settings settings = glint_settings_default;
    settings.width = 61;
    settings.height = 43;
    settings.depth = depth;
    settings.roughness = GLINT_ROUGHNESS_SMOOTH;
    return settings;
}

void test_frame_free(test_frame *frame)
{
    glint_image_free(&frame->image);
    glint_layers_free(&frame->layers);
    free(frame->exact);
    *frame = (test_frame){0};
}

size_t test_count_different(const glint_image *a, const glint_image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channels, b->channels);
    size_t different = 0, pixels = (size_t)a->width * (size_t)a->height;
    size_t bytes = (size_t)a->channels * sizeof(float);
    for (size_t i = 0; i < pixels; i++) {
        different += memcmp((const char *)a->pixels + i * bytes,
                            (const char *)b->pixels + i * bytes, bytes) != 0;
    }
    return different;
}

void test_stage_open(const char *scene, const glint_settings *settings, test_stage *stage)
{
    *stage = (test_stage){.environment = test_studio(), .settings = *settings};
    test_scene_load(scene, &stage->scene);
    assert_int_equal(glint_scene_camera(&stage->scene, NULL, &stage->camera, NULL), GLINT_OK);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &stage->scene,
                                          .environment = stage->environment,
                                          .settings = &stage->settings};
    assert_int_equal(glint_renderer_create(&inputs, &stage->renderer, NULL), GLINT_OK);
}

void test_stage_close(test_stage *stage)
{
    glint_renderer_free(stage->renderer);
    glint_scene_free(&stage->scene);
    *stage = (test_stage){0};
}
