// Gives each corner a vertex of its own. See by_corner.h.
#include "support/by_corner.h"

#include <stdlib.h>
#include <string.h>
// cmocka.h needs the four headers before it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void spread(float **array, size_t stride, const glint_scene *scene)
{
    if (*array == NULL || stride == 0) {
        return;
    }
    float *all = calloc(3 * scene->triangle_count + 1, stride * sizeof *all);
    assert_non_null(all);
    for (size_t i = 0; i < 3 * scene->triangle_count; i++) {
        memcpy(all + stride * i, *array + stride * scene->indices[i], stride * sizeof *all);
    }
    free(*array);
    *array = all;
}

void scene_by_corner(glint_scene *scene)
{
    if (scene->indices == NULL) {
        return;
    }
    spread(&scene->positions, 3, scene);
    spread(&scene->normals, 3, scene);
    spread(&scene->parts.positions, 3, scene);
    spread(&scene->attributes, glint_attributes_stride(&scene->attribute_set), scene);
    free(scene->indices);
    scene->indices = NULL;
    scene->vertex_count = 0;
}
