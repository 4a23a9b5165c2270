// Uploads textures: their texels, and records that tell how materials look them up.
#ifndef GLINT_RENDER_TEXTURES_H
#define GLINT_RENDER_TEXTURES_H

#include "base/status.h"
#include "device/buffer.h"
#include "kernels/layout.h"
#include "scene/scene.h"

#include <stddef.h>

// The texture look-ups of a scene's materials. Zero is valid: no look-ups.
typedef struct glint_texture_table {
    size_t count;
    glint_texture_record *records; // owned
    // Owned: [materials], indices of records; −1: no texture.
    int (*of_material)[GLINT_TEXTURE_SLOTS];
} glint_texture_table;

// Makes the table. Slots that look up the same image in the same way share a record. Errors:
// GLINT_OUT_OF_MEMORY; *table is then empty.
glint_status glint_texture_table_make(const glint_scene *scene, glint_texture_table *table,
                                      glint_error *error);
void glint_texture_table_free(glint_texture_table *table);

// The textures of the shown scene. Zero is valid: none.
typedef struct glint_texture_memory {
    cl_mem records, texels;
    glint_textures *textures; // owner of the texels, shared
} glint_texture_memory;

// Uploads the records, and the texels if they belong to other textures than before. A device that
// shares the host's memory uses the texels in place. Errors: GLINT_DEVICE_FAILED.
glint_status glint_texture_memory_fill(const struct glint_device *device, const glint_scene *scene,
                                       const glint_texture_table *table,
                                       glint_texture_memory *memory, glint_error *error);
void glint_texture_memory_free(glint_texture_memory *memory);

#endif
