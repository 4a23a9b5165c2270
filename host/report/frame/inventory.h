// Prints the JSON of glint info --json and glint devices --json.
#ifndef GLINT_REPORT_FRAME_INVENTORY_H
#define GLINT_REPORT_FRAME_INVENTORY_H

#include "base/status.h"
#include "report/frame/subject.h"

#include <stddef.h>

// The subject as JSON, with all details. `*text` is malloc'd.
glint_status glint_inventory_json(const glint_subject *subject, char **text, glint_error *error);

// A list of devices as JSON. `*text` is malloc'd.
glint_status glint_devices_json(const glint_capabilities *devices, size_t count, char **text,
                                glint_error *error);

// Estimates the bytes that a frame needs on the device: scene, tree, environment, pixels.
size_t glint_inventory_device_bytes(const glint_subject *subject);

#endif
