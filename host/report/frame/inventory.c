// Prints the inventory of a scene and of the devices as JSON. See inventory.h.
#include "report/frame/inventory.h"

#include "kernels/layout.h"
#include "report/json.h"

size_t glint_inventory_device_bytes(const glint_subject *subject)
{
    size_t bytes = 0;
    bool is_double = false;
    if (subject->plan != NULL) {
        is_double = subject->plan->precision == GLINT_PRECISION_DOUBLE;
        bytes += subject->plan->environment_bytes;
    }
    bytes += subject->scene->material_count * sizeof(glint_material_record);
    if (subject->bvh != NULL) {
        bytes += subject->bvh->bytes;
    }
    if (subject->settings != NULL) {
        bytes += (size_t)subject->settings->width * (size_t)subject->settings->height * 4 *
                 (is_double ? sizeof(double) : sizeof(float));
    }
    return bytes;
}

// The animation as JSON; null if nothing moves.
static json_t *animation_object(const glint_motion *motion)
{
    if (motion == NULL || !(glint_motion_moves_scene(motion) || motion->moves_cameras)) {
        return json_null();
    }
    json_t *object = json_object();
    glint_json_put_text(object, "clip", motion->clip);
    glint_json_put_real(object, "seconds", motion->duration);
    glint_json_put_flag(object, "moves_triangles", motion->moves_triangles);
    glint_json_put_flag(object, "moves_cameras", motion->moves_cameras);
    glint_json_put_flag(object, "moves_lights", motion->moves_lights);
    return object;
}

glint_status glint_inventory_json(const glint_subject *subject, char **text, glint_error *error)
{
    json_t *root = json_object();
    glint_json_put_text(root, "glint", GLINT_VERSION);
    glint_json_put(root, "scene", glint_json_scene(subject, true));
    glint_json_put(root, "animation", animation_object(subject->motion));
    glint_json_put(root, "environment", glint_json_environment(subject->environment));
    glint_json_put(root, "camera", glint_json_camera(subject->camera));
    glint_json_put(root, "settings", glint_json_settings(subject->settings));
    if (subject->device != NULL) {
        glint_json_put(root, "device", glint_json_device(subject->device));
    }
    if (subject->plan != NULL) {
        glint_json_put(root, "plan", glint_json_plan(subject->plan));
    } else {
        glint_json_put_text(root, "plan_failure", subject->plan_failure);
    }
    if (subject->bvh != NULL) {
        glint_json_put(root, "bvh", glint_json_bvh(subject->bvh));
    }
    glint_json_put_count(root, "device_bytes", glint_inventory_device_bytes(subject));
    glint_json_put(root, "warnings", glint_json_warnings(subject->warnings));
    return glint_json_print(root, text, error);
}

glint_status glint_devices_json(const glint_capabilities *devices, size_t count, char **text,
                                glint_error *error)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        (void)json_array_append_new(list, glint_json_device(&devices[i]));
    }
    return glint_json_print(list, text, error);
}
