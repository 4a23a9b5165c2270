// The JSON of numbers, materials and textures, for write_gltf.c.
#ifndef GLINT_SCENES_WRITE_MATERIAL_H
#define GLINT_SCENES_WRITE_MATERIAL_H

#include "model.h"

#include <jansson.h>

// Whole numbers are written without a fraction.
json_t *gltf_exact(double x);

// Rounded to 10⁻⁹: what sin and cos leave of a zero would be written with an exponent, whose form
// differs between versions of the JSON library.
json_t *gltf_number(double x);
json_t *gltf_numbers(const double *values, int count);

// The names of the extensions that it takes become members of `used`.
json_t *gltf_material(const model *scene, const material *m, json_t *used);

// Sets the file's textures, images and samplers, where the scene has pictures.
void gltf_add_textures(const model *scene, json_t *file);

#endif
