// --proxy: how far away the environment is taken to be.
#ifndef GLINT_CLI_COMMON_PROXY_OPTION_H
#define GLINT_CLI_COMMON_PROXY_OPTION_H

#include "cli/common/options.h"
#include "environment/environment.h"
#include "scene/scene.h"

#include <stdbool.h>

typedef enum proxy_kind {
    PROXY_NONE,
    PROXY_BOUNDS, // of what is captured
    PROXY_BOX,
    PROXY_SPHERE,
} proxy_kind;

// As it was asked for. Zero is none.
typedef struct proxy_request {
    proxy_kind kind;
    double numbers[6]; // BOX: two corners, x, y, z each (metres, world space); SPHERE: the radius
} proxy_request;

// "none", "bounds", "sphere:R" or "X0,Y0,Z0,X1,Y1,Z1", into a proxy_request.
glint_option_parser proxy_option_parse;

// A place (metres, world space). Zero: not given.
typedef struct place_request {
    double at[3];
    bool is_given;
} place_request;

// "X,Y,Z" in metres, into a place_request.
glint_option_parser place_option_parse;

// The proxy of an environment that was seen from `center`; `scene` is what is captured, and is read
// for its bounds alone. Errors: GLINT_BAD_INPUT where there is nothing to have bounds, GLINT_USAGE
// where the environment was seen from outside of the proxy.
glint_status proxy_option_make(const proxy_request *request, glint_vec3 center,
                               const glint_scene *scene, glint_proxy *proxy, glint_error *error);

#endif
