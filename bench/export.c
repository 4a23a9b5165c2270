// bench_export SCENE WIDTHxHEIGHT FOLDER: writes a scene and the built-in studio for other
// renderers. FOLDER gets studio.hdr, a lat-long image with OpenEXR's conventions, and scene.pov for
// POV-Ray, with the triangles as glint stores them.
#include "environment/environment.h"
#include "image/image_io.h"
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STUDIO_HEIGHT = 1024 };

// ---- The studio --------------------------------------------------------------------------------

static glint_status write_studio(const char *folder, glint_error *error)
{
    const int height = STUDIO_HEIGHT, width = 2 * height;
    glint_environment studio = {0};
    glint_image image = {0};
    char path[4096];
    snprintf(path, sizeof path, "%s/studio.hdr", folder);
    glint_status status;
    TRY_OR(cleanup, status, glint_environment_studio(&studio, error));
    TRY_OR(cleanup, status, glint_image_create(width, height, 4, &image, error));
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            // Longitude from π on the left to −π, 0 at +Z; latitude from π/2 at the top.
            const double longitude = M_PI * (1 - 2 * (x + 0.5) / width);
            const double latitude = M_PI * (0.5 - (y + 0.5) / height);
            const glint_vec3 direction = {cos(latitude) * sin(longitude), sin(latitude),
                                          cos(latitude) * cos(longitude)};
            double rgb[3];
            glint_cube_sample(&studio.radiance, direction, rgb);
            float *pixel = image.pixels + 4 * ((size_t)y * (size_t)width + (size_t)x);
            for (int k = 0; k < 3; k++) {
                pixel[k] = (float)rgb[k];
            }
            pixel[3] = 1;
        }
    }
    status = glint_image_write(path, &image, NULL, error);
cleanup:
    glint_image_free(&image);
    glint_environment_free(&studio);
    return status;
}

// ---- The scene for POV-Ray ---------------------------------------------------------------------
// POV-Ray's space is left-handed: z is turned round.

static void put_vector(FILE *out, glint_vec3 v)
{
    fprintf(out, "<%.9g, %.9g, %.9g>", v.x, v.y, -v.z);
}

static void put_camera(FILE *out, const glint_camera *camera, int width, int height)
{
    const double half = tan(camera->yfov / 2);
    fputs("camera {\n  perspective\n  location ", out);
    put_vector(out, camera->eye);
    fputs("\n  right ", out);
    put_vector(out, glint_vec3_scale(camera->right, 2 * half * width / height));
    fputs("\n  up ", out);
    put_vector(out, glint_vec3_scale(camera->up, 2 * half));
    fputs("\n  direction ", out);
    put_vector(out, glint_vec3_scale(camera->back, -1));
    fputs("\n}\n", out);
}

// Writes a material. Metal and thin walls use Schlick's approximation, as POV-Ray's variable
// reflection does; solids use Fresnel's equations. Paint gets its reflection only: in POV-Ray an
// image lights matte surfaces through radiosity, which is an estimate.
static void put_texture(FILE *out, const glint_material *m)
{
    const float *c = m->base_color;
    if (m->metallic > 0.5f) {
        fprintf(out,
                "  texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection { "
                "rgb <%.9g, %.9g, %.9g>, rgb 1 falloff 5 } } }\n",
                (double)c[0], (double)c[1], (double)c[2]);
        return;
    }
    const double f0 = pow(((double)m->ior - 1) / ((double)m->ior + 1), 2);
    if (!glint_material_lobes(m).solid) {
        fprintf(out,
                "  texture { pigment { rgbt <1, 1, 1, %d> } finish { ambient 0 diffuse 0 "
                "reflection { rgb %.9g, rgb 1 falloff 5 } conserve_energy } }\n",
                m->transmission > 0 ? 1 : 0, m->roughness > 0 ? 0.0 : f0);
        return;
    }
    fputs("  texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { rgb 0, rgb 1 "
          "fresnel on } conserve_energy } }\n",
          out);
    fprintf(out, "  interior { ior %.9g", (double)m->ior);
    if (isfinite(m->attenuation_distance)) {
        const float *a = m->attenuation_color;
        // POV-Ray: exp(−(1 − colour)·d/distance).
        fprintf(out, " fade_power 1001 fade_distance %.9g fade_color <%.9g, %.9g, %.9g>",
                (double)m->attenuation_distance, 1 + log((double)a[0]), 1 + log((double)a[1]),
                1 + log((double)a[2]));
    }
    fputs(" }\n", out);
}

// Triangles do not share vertices.
static void put_mesh(FILE *out, const glint_scene *scene, uint32_t material)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->triangle_count; i++) {
        count += scene->material_of[i] == material;
    }
    fprintf(out, "mesh2 {\n  vertex_vectors {\n    %zu", 3 * count);
    for (size_t i = 0; i < 3 * scene->triangle_count; i++) {
        if (scene->material_of[i / 3] == material) {
            const glint_vec3 stored =
                glint_vec3_from_floats(glint_scene_position(scene, i / 3, i % 3));
            fputs(",\n    ", out);
            put_vector(out, glint_vec3_add(scene->origin, glint_vec3_scale(stored, scene->unit)));
        }
    }
    fputs("\n  }\n", out);
    if (scene->normals != NULL) {
        fprintf(out, "  normal_vectors {\n    %zu", 3 * count);
        for (size_t i = 0; i < 3 * scene->triangle_count; i++) {
            if (scene->material_of[i / 3] == material) {
                fputs(",\n    ", out);
                put_vector(out, glint_vec3_from_floats(glint_scene_normal(scene, i / 3, i % 3)));
            }
        }
        fputs("\n  }\n", out);
    }
    fprintf(out, "  face_indices {\n    %zu", count);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, ",\n    <%zu, %zu, %zu>", 3 * i, 3 * i + 1, 3 * i + 2);
    }
    // POV-Ray finds the inside of a closed mesh by a ray along this vector.
    fputs("\n  }\n  inside_vector <0.3, 1, 0.2>\n", out);
    put_texture(out, &scene->materials[material]);
    fputs("}\n", out);
}

static void put_scene(FILE *out, const glint_scene *scene, const glint_camera *camera,
                      const int size[2])
{
    fputs("#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 12 adc_bailout "
          "0.00390625 }\n",
          out);
    put_camera(out, camera, size[0], size[1]);
    fputs("sky_sphere { pigment { image_map { hdr \"studio.hdr\" gamma 1 map_type 1 "
          "interpolate 2 } scale <-1, 1, 1> rotate 90*y } }\n",
          out);
    for (size_t i = 0; i < scene->material_count; i++) {
        put_mesh(out, scene, (uint32_t)i);
    }
}

static glint_status write_scene(const char *path, const int size[2], const char *folder,
                                glint_error *error)
{
    glint_scene scene = {0};
    glint_camera camera;
    char name[4096];
    snprintf(name, sizeof name, "%s/scene.pov", folder);
    glint_status status;
    TRY_OR(cleanup, status, glint_scene_load(path, NULL, &scene, NULL, error));
    TRY_OR(cleanup, status, glint_scene_camera(&scene, NULL, &camera, error));
    FILE *out = fopen(name, "w");
    if (out != NULL) {
        put_scene(out, &scene, &camera, size);
    }
    if (out == NULL || fclose(out) != 0) {
        status = glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be written", name);
    }
cleanup:
    glint_scene_free(&scene);
    return status;
}

int main(int argc, char **argv)
{
    int size[2] = {0, 0};
    if (argc != 4 || sscanf(argv[2], "%dx%d", &size[0], &size[1]) != 2 || size[0] < 1 ||
        size[1] < 1) {
        fprintf(stderr, "usage: bench_export SCENE WIDTHxHEIGHT FOLDER\n");
        return GLINT_USAGE;
    }
    glint_error error = {0};
    glint_status status = write_studio(argv[3], &error);
    if (status == GLINT_OK) {
        status = write_scene(argv[1], size, argv[3], &error);
    }
    if (status != GLINT_OK) {
        fprintf(stderr, "bench_export: %s\n", error.message);
    }
    glint_error_free(&error);
    return (int)status;
}
