// The environment: radiance by direction, E(d), held as a cube map.
#ifndef GLINT_ENVIRONMENT_ENVIRONMENT_H
#define GLINT_ENVIRONMENT_ENVIRONMENT_H

#include "base/status.h"
#include "base/vector.h"
#include "environment/cube.h"
#include "environment/layouts.h"
#include "image/image.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Where what an environment shows is taken to be: on the inside of a box or a sphere, so that
// mirrors in different places see different sides of it. All in metres, world space.
typedef enum glint_proxy_kind {
    GLINT_PROXY_NONE, // infinitely far away
    GLINT_PROXY_BOX,
    GLINT_PROXY_SPHERE,
} glint_proxy_kind;

typedef struct glint_proxy {
    glint_proxy_kind kind;
    glint_vec3 center;      // where the environment was seen from, inside the proxy
    glint_vec3 middle;      // of the proxy
    glint_vec3 half_extent; // along each axis; of a sphere the radius thrice
} glint_proxy;

typedef struct glint_environment {
    char *name;          // the file as given, or "studio"
    glint_layout layout; // what it was read as
    const char *reason;  // how that was known: "envmap attribute", "shape 2:1", …; static text
    int source_width, source_height;
    glint_cube radiance;
    glint_proxy proxy;    // heeded where the settings say so
    size_t mended_texels; // NaN, infinite or negative ones, replaced (see radiance.h)
} glint_environment;

// Reads `path`: a file, a folder that holds six faces, or a pattern with one %s for the face's
// name. The layout, where `request` does not say, is recognised from the envmap attribute, the name
// pattern and the shape; an ambiguous shape is refused with the choices named. `request` may be
// NULL. Errors: GLINT_BAD_INPUT.
glint_status glint_environment_load(const char *path, const glint_layout_request *request,
                                    glint_environment *environment, glint_warnings *warnings,
                                    glint_error *error);

// The same from an image in memory, called `name` in messages: a single file's content, which is
// taken over. Values that are no radiance are mended in it. Errors: GLINT_BAD_INPUT.
glint_status glint_environment_from_image(const char *name, glint_image *image,
                                          const glint_layout_request *request,
                                          glint_environment *environment, glint_error *error);

// The built-in studio (studio.h), called "studio". Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_environment_studio(glint_environment *environment, glint_error *error);

void glint_environment_free(glint_environment *environment);

#ifdef __cplusplus
}
#endif

#endif
