// glint_scenes OUTDIR: writes every scene of this folder, and the axis environment, into OUTDIR.
// Each run gives the same bytes: nothing is random or depends on the time or the locale.
#include "image/image_io.h"
#include "scenes.h"
#include "write_gltf.h"

#include <stdio.h>
#include <stdlib.h>

static const struct {
    const char *name;
    void (*build)(model *scene);
} scenes[] = {
    {"gallery", build_gallery},
    {"mirror_sphere", build_mirror_sphere},
    {"glass_sphere", build_glass_sphere},
    {"glass_slab", build_glass_slab},
    {"prism", build_prism},
    {"lecture_example_2", build_lecture_example_2},
    {"facing_mirrors", build_facing_mirrors},
    {"axes", build_axes},
    {"nested_glass", build_nested_glass},
    {"thin_wall", build_thin_wall},
    {"absorption_box", build_absorption_box},
    {"materials", build_materials},
    {"orthographic", build_orthographic},
    {"clockwork", build_clockwork},
    {"shot", build_shot},
    {"water", build_water},
    {"worm", build_worm},
    {"textures", build_textures},
    {"lights", build_lights},
    {"wine", build_wine},
};

static glint_status write_scenes(const char *folder, glint_error *error)
{
    model *scene = calloc(1, sizeof *scene);
    if (scene == NULL) {
        return glint_fail_memory(error, "a scene");
    }
    glint_status status = GLINT_OK;
    for (size_t i = 0; status == GLINT_OK && i < sizeof scenes / sizeof scenes[0]; i++) {
        scene->name = scenes[i].name;
        scenes[i].build(scene);
        status = write_gltf(scene, folder, error);
        if (status == GLINT_OK) {
            printf("%s: %zu triangles\n", scene->name, model_count_triangles(scene));
        }
        model_free(scene);
    }
    free(scene);
    return status;
}

static glint_status write_axes_map(const char *folder, glint_error *error)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/axes.hdr", folder);
    glint_image image = {0};
    glint_status status = draw_axes_map(&image, error);
    if (status == GLINT_OK) {
        status = glint_image_write(path, &image, NULL, error);
    }
    glint_image_free(&image);
    return status;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: glint_scenes OUTDIR\n");
        return GLINT_USAGE;
    }
    glint_error error = {0};
    glint_status status = write_scenes(argv[1], &error);
    if (status == GLINT_OK) {
        status = write_axes_map(argv[1], &error);
    }
    if (status != GLINT_OK) {
        fprintf(stderr, "glint_scenes: %s\n", error.message);
    }
    glint_error_free(&error);
    return (int)status;
}
