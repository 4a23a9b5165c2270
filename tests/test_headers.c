// Proves that every public header is plain C11: this file compiles with -std=c11 -pedantic. At run
// time it only checks that zero is a valid object everywhere.
#include "accel/bvh_build.h"
#include "glint.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void zeroed_objects_can_be_freed(void **state)
{
    (void)state;
    for (int twice = 0; twice < 2; twice++) {
        glint_error error = {0};
        glint_error_free(&error);
        glint_warnings warnings = {0};
        glint_warnings_free(&warnings);
        glint_image image = {0};
        glint_image_free(&image);
        glint_cube cube = {0};
        glint_cube_free(&cube);
        glint_environment environment = {0};
        glint_environment_free(&environment);
        glint_scene scene = {0};
        glint_scene_free(&scene);
        glint_topology topology = {0};
        glint_topology_free(&topology);
        glint_layers layers = {0};
        glint_layers_free(&layers);
        glint_bvh bvh = {0};
        glint_bvh_free(&bvh);
    }
    glint_device_close(NULL);
    glint_renderer_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(zeroed_objects_can_be_freed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
