// Makes the oracle's primary rays and their cones.
#include "oracle/surface.h"
#include "oracle/vector.h"

cone oracle_primary_cone(const oracle_view *view, vector direction)
{
    if (view->height <= 0)
        return (cone){0.0, 0.0};
    double apart = (view->yfov == 0.0 ? 2.0 * view->ymag : 2.0 * tan(0.5 * view->yfov)) /
                   view->height / (view->samples > 0 ? view->samples : 1);
    if (view->yfov == 0.0)
        return (cone){apart, 0.0};
    return (cone){0.0, -apart * dot(direction, vector_of(view->back))};
}

oracle_ray oracle_primary_ray(const oracle_view *view, const double position[2])
{
    bool orthographic = view->yfov == 0.0;
    double half_height = orthographic ? view->ymag : tan(0.5 * view->yfov);
    double half_width = half_height * view->width / view->height;
    double x = (2.0 * position[0] / view->width - 1.0) * half_width;
    double y = (1.0 - 2.0 * position[1] / view->height) * half_height;
    vector across = plus(scaled(vector_of(view->right), x), scaled(vector_of(view->up), y));
    vector forward = scaled(vector_of(view->back), -1.0), eye = vector_of(view->eye);
    oracle_ray ray = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    vector_store(orthographic ? plus(eye, across) : eye, ray.origin);
    vector_store(orthographic ? forward : unit(plus(across, forward)), ray.direction);
    return ray;
}
