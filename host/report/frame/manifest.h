// Manifests: which names the numbers of the layers `object` and `material` stand for.
#ifndef GLINT_REPORT_FRAME_MANIFEST_H
#define GLINT_REPORT_FRAME_MANIFEST_H

#include "base/status.h"
#include "scene/scene.h"

// The names of entries in a file's metadata.
#define GLINT_MANIFEST_OBJECTS "glint:object_names"
#define GLINT_MANIFEST_MATERIALS "glint:material_names"

// A JSON object, on one line, of names by their numbers: {"3":"gem","7":""}, with "" for what has
// no name. Of nodes that have triangles, and of materials that triangles have. `*text` is malloc'd.
// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_manifest_of_objects(const glint_scene *scene, char **text, glint_error *error);
glint_status glint_manifest_of_materials(const glint_scene *scene, char **text, glint_error *error);

#endif
