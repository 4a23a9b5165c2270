// Makes the JSON of numbers, materials and textures, for write_gltf.c.
#ifndef GLINT_SCENES_WRITE_MATERIAL_H
#define GLINT_SCENES_WRITE_MATERIAL_H

#include "model.h"

#include <jansson.h>

// A number; whole numbers have no fraction.
json_t *gltf_exact(double x);

// A number rounded to 10⁻⁹. A tiny number from sin or cos in place of 0 would have an exponent,
// whose form differs between versions of the JSON library.
json_t *gltf_number(double x);
json_t *gltf_numbers(const double *values, int count);

// A material. Adds the names of its extensions to `used` as members.
json_t *gltf_material(const model *scene, const material *m, json_t *used);

// Sets the textures, images and samplers of the file, if the scene has pictures.
void gltf_add_textures(const model *scene, json_t *file);

#endif
