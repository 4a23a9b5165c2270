// Textures on the device: how materials look them up, and their texels.
#ifndef GLINT_RENDER_TEXTURES_H
#define GLINT_RENDER_TEXTURES_H

#include "base/status.h"
#include "device/buffer.h"
#include "kernels/layout.h"
#include "scene/scene.h"

#include <stddef.h>

// How a scene's materials look textures up. Zero is valid: none do.
typedef struct glint_texture_table {
    size_t count;
    glint_texture_record *records;           // owned
    int (*of_material)[GLINT_TEXTURE_SLOTS]; // owned: [materials], places in the records; −1: none
} glint_texture_table;

// Slots that look the same image up alike share a record. Errors: GLINT_OUT_OF_MEMORY; *table is
// then empty.
glint_status glint_texture_table_make(const glint_scene *scene, glint_texture_table *table,
                                      glint_error *error);
void glint_texture_table_free(glint_texture_table *table);

// The textures of the scene that is shown. Zero is valid: none.
typedef struct glint_texture_memory {
    cl_mem records, texels;
    glint_textures *textures; // whose texels they are, an owner of them
} glint_texture_memory;

// Uploads the records, and the texels unless those of the same textures are there already. On a
// device that shares the host's memory they stay where they are. Errors: GLINT_DEVICE_FAILED.
glint_status glint_texture_memory_fill(const struct glint_device *device, const glint_scene *scene,
                                       const glint_texture_table *table,
                                       glint_texture_memory *memory, glint_error *error);
void glint_texture_memory_free(glint_texture_memory *memory);

#endif
