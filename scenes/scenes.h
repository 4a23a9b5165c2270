// Declares the scenes, each a builder that fills an empty model. README.md beside this file
// explains them.
#ifndef GLINT_SCENES_SCENES_H
#define GLINT_SCENES_SCENES_H

#include "image/image.h"
#include "model.h"

void build_gallery(model *scene);

// Scenes of single solids (solids.c).
void build_mirror_sphere(model *scene);
void build_glass_sphere(model *scene);
void build_glass_slab(model *scene);
void build_prism(model *scene);
void build_nested_glass(model *scene);
void build_thin_wall(model *scene);
void build_absorption_box(model *scene);
void build_wine(model *scene);

// Several objects (arrangements.c).
void build_lecture_example_2(model *scene);
void build_facing_mirrors(model *scene);
void build_axes(model *scene);
void build_materials(model *scene);
void build_orthographic(model *scene);
void build_water(model *scene);

// Objects that move (motions.c).
void build_clockwork(model *scene);
void build_shot(model *scene);

// A figure that bends and bulges (figures.c).
void build_worm(model *scene);

// Textures, vertex colours and alpha (textures.c).
void build_textures(model *scene);

// Punctual lights and their shadows (lights.c).
void build_lights(model *scene);

// The labelled axis environment, 1024 × 512, lat-long (axes_map.c).
glint_status draw_axes_map(glint_image *image, glint_error *error);

#endif
