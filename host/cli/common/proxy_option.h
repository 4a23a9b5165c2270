// Parses --proxy, which says how far away the environment is, and places such as --env-at.
#ifndef GLINT_CLI_COMMON_PROXY_OPTION_H
#define GLINT_CLI_COMMON_PROXY_OPTION_H

#include "cli/common/options.h"
#include "environment/environment.h"
#include "scene/scene.h"

#include <stdbool.h>

typedef enum proxy_kind {
    PROXY_NONE,
    PROXY_BOUNDS, // the bounds of the captured scene
    PROXY_BOX,
    PROXY_SPHERE,
} proxy_kind;

// The option as given. Zero means none.
typedef struct proxy_request {
    proxy_kind kind;
    double numbers[6]; // BOX: two corners, x, y, z each (metres, world space); SPHERE: the radius
} proxy_request;

// Parses "none", "bounds", "sphere:R" or "X0,Y0,Z0,X1,Y1,Z1" into a proxy_request.
glint_option_parser proxy_option_parse;

// A place (metres, world space). Zero means not given.
typedef struct place_request {
    double at[3];
    bool is_given;
} place_request;

// Parses "X,Y,Z" in metres into a place_request.
glint_option_parser place_option_parse;

// Makes the proxy of an environment that was captured from `center`. `scene` is the captured scene;
// only its bounds are read. Errors: GLINT_BAD_INPUT if PROXY_BOUNDS meets an empty scene;
// GLINT_USAGE if `center` is outside the proxy.
glint_status proxy_option_make(const proxy_request *request, glint_vec3 center,
                               const glint_scene *scene, glint_proxy *proxy, glint_error *error);

#endif
