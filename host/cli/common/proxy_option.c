// Parses --proxy and makes the proxy. See proxy_option.h.
#include "cli/common/proxy_option.h"

#include <math.h>
#include <string.h>

// Metres. The kernels square distances, in units that may be as small as the scene.
#define FARTHEST 1e9

static bool read_lengths(const char *text, double *numbers, int count)
{
    bool valid = glint_parse_reals(text, numbers, count);
    for (int i = 0; valid && i < count; i++) {
        valid = fabs(numbers[i]) <= FARTHEST;
    }
    return valid;
}

glint_status place_option_parse(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    place_request place = {.is_given = true};
    if (!read_lengths(text, place.at, 3)) {
        return glint_fail(error, GLINT_USAGE, "--%s %s: x,y,z in metres (1e9 at most) is expected",
                          option->name, text);
    }
    memcpy(destination, &place, sizeof place);
    return GLINT_OK;
}

glint_status proxy_option_parse(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    static const char sphere[] = "sphere:";
    proxy_request request = {PROXY_NONE, {0}};
    double *n = request.numbers;
    bool valid = true;
    if (strcmp(text, "bounds") == 0) {
        request.kind = PROXY_BOUNDS;
    } else if (strncmp(text, sphere, sizeof sphere - 1) == 0) {
        request.kind = PROXY_SPHERE;
        valid = read_lengths(text + sizeof sphere - 1, n, 1) && n[0] > 0;
    } else if (strcmp(text, "none") != 0) {
        request.kind = PROXY_BOX;
        valid = read_lengths(text, n, 6) && n[0] < n[3] && n[1] < n[4] && n[2] < n[5];
    }
    if (!valid) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: none, bounds, sphere:RADIUS or a box's least and greatest "
                          "corner, x,y,z,x,y,z, in metres (1e9 at most), are expected",
                          option->name, text);
    }
    memcpy(destination, &request, sizeof request);
    return GLINT_OK;
}

static bool is_inside(const glint_proxy *proxy)
{
    const glint_vec3 d = glint_vec3_subtract(proxy->center, proxy->middle);
    if (proxy->kind == GLINT_PROXY_SPHERE) {
        return glint_vec3_length(d) < proxy->half_extent.x;
    }
    return fabs(d.x) < proxy->half_extent.x && fabs(d.y) < proxy->half_extent.y &&
           fabs(d.z) < proxy->half_extent.z;
}

static void set_box(glint_vec3 low, glint_vec3 high, glint_proxy *proxy)
{
    proxy->kind = GLINT_PROXY_BOX;
    proxy->middle = glint_vec3_scale(glint_vec3_add(low, high), 0.5);
    proxy->half_extent = glint_vec3_scale(glint_vec3_subtract(high, low), 0.5);
}

glint_status proxy_option_make(const proxy_request *request, glint_vec3 center,
                               const glint_scene *scene, glint_proxy *proxy, glint_error *error)
{
    const double *n = request->numbers;
    *proxy = (glint_proxy){.kind = GLINT_PROXY_NONE, .center = center};
    switch (request->kind) {
    case PROXY_NONE:
        return GLINT_OK;
    case PROXY_BOUNDS:
        if (scene->triangle_count == 0) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "%s: --proxy bounds: nothing is around what is lit (leave it out)",
                              scene->path);
        }
        set_box(scene->low, scene->high, proxy);
        break;
    case PROXY_BOX:
        set_box((glint_vec3){n[0], n[1], n[2]}, (glint_vec3){n[3], n[4], n[5]}, proxy);
        break;
    case PROXY_SPHERE:
        proxy->kind = GLINT_PROXY_SPHERE;
        proxy->middle = center;
        proxy->half_extent = (glint_vec3){n[0], n[0], n[0]};
        break;
    }
    if (!is_inside(proxy)) {
        const glint_vec3 low = glint_vec3_subtract(proxy->middle, proxy->half_extent);
        const glint_vec3 high = glint_vec3_add(proxy->middle, proxy->half_extent);
        return glint_fail(error, GLINT_USAGE,
                          "--proxy: the environment was seen from (%g, %g, %g), which is not "
                          "inside the box from (%g, %g, %g) to (%g, %g, %g) (name a larger one, or "
                          "a sphere)",
                          center.x, center.y, center.z, low.x, low.y, low.z, high.x, high.y,
                          high.z);
    }
    return GLINT_OK;
}
