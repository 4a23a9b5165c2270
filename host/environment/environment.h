// Loads the environment: radiance by direction, E(d), as a cube map.
#ifndef GLINT_ENVIRONMENT_ENVIRONMENT_H
#define GLINT_ENVIRONMENT_ENVIRONMENT_H

#include "base/status.h"
#include "base/vector.h"
#include "environment/cube.h"
#include "environment/layouts.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Where the environment's light comes from: the inside of a box or a sphere. With a proxy, mirrors
// in different places see different sides of the environment. All lengths in metres, world space.
typedef enum glint_proxy_kind {
    GLINT_PROXY_NONE, // infinitely far away
    GLINT_PROXY_BOX,
    GLINT_PROXY_SPHERE,
} glint_proxy_kind;

typedef struct glint_proxy {
    glint_proxy_kind kind;
    glint_vec3 center;      // where the environment was seen from, inside the proxy
    glint_vec3 middle;      // centre of the box or sphere
    glint_vec3 half_extent; // along each axis; a sphere has its radius in all three
} glint_proxy;

typedef struct glint_environment {
    char *name;          // the file as given, or "studio"
    glint_layout layout; // the layout that the file was read as
    // How glint knows the layout: "envmap attribute", "shape 2:1", …. Static text.
    const char *reason;
    int source_width, source_height;
    glint_cube radiance;
    glint_proxy proxy;    // used only if the settings say so
    size_t mended_texels; // NaN, infinite or negative texels, replaced (see radiance.h)
    // The cache's entry that is being written from `radiance` (cache.h). NULL: none.
    struct glint_env_cache_write *write;
} glint_environment;

// Reads `path`: a file, a folder with six faces, or a pattern with one %s for the face's name. If
// `request` does not name the layout, it is recognised from the envmap attribute, the name pattern
// and the shape. If the shape is ambiguous, glint refuses it and names the choices. `request` may
// be NULL. Takes the cube from the cache if it is there, else loads the file and writes the
// cube to the cache. Errors:
// GLINT_BAD_INPUT.
glint_status glint_environment_load(const char *path, const glint_layout_request *request,
                                    glint_environment *environment, glint_warnings *warnings,
                                    glint_error *error);

// Does the same with an image in memory, the content of one file; `name` is its name in messages.
// Takes the image over and replaces values that are no radiance. Errors: GLINT_BAD_INPUT.
glint_status glint_environment_from_image(const char *name, glint_image *image,
                                          const glint_layout_request *request,
                                          glint_environment *environment, glint_error *error);

// Waits until nobody reads the radiance, for a caller that changes it.
void glint_environment_end_write(glint_environment *environment);

// Makes the built-in studio (studio.h), named "studio". Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_environment_studio(glint_environment *environment, glint_error *error);

void glint_environment_free(glint_environment *environment);

#ifdef __cplusplus
}
#endif

#endif
