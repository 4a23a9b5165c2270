// Reads the images that the used materials need.
#ifndef GLINT_SCENE_GLTF_IMAGES_H
#define GLINT_SCENE_GLTF_IMAGES_H

#include "scene/document.h"
#include "scene/texture/texture.h"

// An image of the file, and how materials use it.
typedef struct glint_image_use {
    uint32_t image; // index in the document
    bool is_color, is_coverage;
    char *fault; // why it has no texels; NULL: it has; owned
} glint_image_use;

// The images, each once per use. Zero is valid: none.
typedef struct glint_images {
    glint_image_use *uses; // [count]; owned
    size_t count, capacity;
    uint32_t (*numbers)[4];   // [image]: the number of each kind of use; 0: not used; owned
    glint_textures *textures; // NULL: none; one owner is here
} glint_images;

// Returns the number of an image for a use, from 1; 0 if memory is short.
uint32_t glint_images_number(glint_images *images, const glint_document *document, uint32_t image,
                             bool is_color, bool is_coverage);

// Decodes all images, on all cores. Files must lie under the folder. Leaves out levels larger than
// `largest` texels across; 0: no limit. Fails with GLINT_OUT_OF_MEMORY.
glint_status glint_images_read(glint_images *images, const glint_document *document,
                               const char *folder, int largest, glint_error *error);

void glint_images_free(glint_images *images);

#endif
