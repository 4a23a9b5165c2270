// Writes manifests: the names for the numbers in the layers `object` and `material`.
#ifndef GLINT_REPORT_FRAME_MANIFEST_H
#define GLINT_REPORT_FRAME_MANIFEST_H

#include "base/status.h"
#include "scene/scene.h"

// The names of the manifests' entries in a file's metadata.
#define GLINT_MANIFEST_OBJECTS "glint:object_names"
#define GLINT_MANIFEST_MATERIALS "glint:material_names"

// Make a JSON object on one line that maps numbers to names: {"3":"gem","7":""}; "" means no name.
// The objects are nodes with triangles; the materials are those of triangles. `*text` is malloc'd.
// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_manifest_of_objects(const glint_scene *scene, char **text, glint_error *error);
glint_status glint_manifest_of_materials(const glint_scene *scene, char **text, glint_error *error);

#endif
