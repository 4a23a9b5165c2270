// Uploads punctual lights to the device.
#ifndef GLINT_RENDER_PUNCTUAL_H
#define GLINT_RENDER_PUNCTUAL_H

#include "device/buffer.h"
#include "scene/scene.h"

// Uploads the scene's lights in the form that the kernels read. Errors: GLINT_DEVICE_FAILED,
// GLINT_OUT_OF_MEMORY.
glint_status glint_lights_upload(const struct glint_device *device, const glint_scene *scene,
                                 cl_mem *lights, glint_error *error);

#endif
