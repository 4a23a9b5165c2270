// Writes the manifests of layers. See manifest.h.
#include "report/frame/manifest.h"

#include "report/json.h"

#include <stdio.h>

static void put_name(json_t *names, int number, const char *name)
{
    char key[16];
    snprintf(key, sizeof key, "%d", number);
    glint_json_put_text(names, key, name != NULL ? name : "");
}

static glint_status print(json_t *names, char **text, glint_error *error)
{
    *text = json_dumps(names, JSON_COMPACT);
    json_decref(names);
    return *text != NULL ? GLINT_OK : glint_fail_memory(error, "the names of what is seen");
}

glint_status glint_manifest_of_objects(const glint_scene *scene, char **text, glint_error *error)
{
    json_t *names = json_object();
    for (size_t i = 0; i < scene->instance_count; i++) {
        put_name(names, scene->instances[i].node_index, scene->instances[i].node);
    }
    return print(names, text, error);
}

glint_status glint_manifest_of_materials(const glint_scene *scene, char **text, glint_error *error)
{
    json_t *names = json_object();
    for (size_t i = 0; i < scene->material_count; i++) {
        put_name(names, scene->materials[i].index, scene->materials[i].name);
    }
    return print(names, text, error);
}
