// Computes punctual lights as KHR_lights_punctual says, with a shadow ray for each, surface by
// surface.
#include "oracle/lights.h"
#include "oracle/overlaps.h"

static const double PI = 3.14159265358979323846;

// A surface within this share of the way from the light contains the light and casts no shadow.
#define HOLDS 1e-9

// The largest number of surfaces that light passes.
enum { PASSED_MOST = 64 };

static double clamped(double x)
{
    return fmin(fmax(x, 0.0), 1.0);
}

// max(min(1 − (d/range)⁴, 1), 0)/d²
static double distance_attenuation(const oracle_punctual *light, double d)
{
    return fmax(fmin(1.0 - pow(d / light->range, 4.0), 1.0), 0.0) / (d * d);
}

static double angular_attenuation(const oracle_punctual *light, vector to_light)
{
    double scale = 1.0 / fmax(0.001, cos(light->inner) - cos(light->outer));
    double offset = -cos(light->outer) * scale;
    double cd = -dot(vector_of(light->direction), to_light);
    double attenuation = clamped(cd * scale + offset);
    return attenuation * attenuation;
}

// The state of a shadow ray, beside the receiver.
typedef struct shadow_ray {
    vector to_light;
    double distance;
    passing pass;
    void *way;
} shadow_ray;

static oracle_ray ray_of(const receiver *r, vector to_light)
{
    oracle_ray ray = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    vector_store(r->point, ray.origin);
    vector_store(to_light, ray.direction);
    return ray;
}

static vector left_of(const receiver *r, shadow_ray s)
{
    oracle_ray ray = ray_of(r, s.to_light);
    vector left = {{1.0, 1.0, 1.0}}, nothing = {{0.0, 0.0, 0.0}};
    int triangle = r->triangle;
    for (int passed = 0; passed <= PASSED_MOST; passed++) {
        if (r->scene->overlaps) {
            vector at = vector_of(ray.origin);
            vector_store(oracle_start_beside(r->scene, triangle, at, s.to_light), ray.origin);
            triangle = -1;
        }
        oracle_hit hit = oracle_closest_hit(r->scene, &ray, triangle);
        if (hit.triangle < 0 || hit.distance >= s.distance * (1.0 - HOLDS))
            return left;
        left = s.pass(s.way, &hit, s.to_light);
        if (largest(left) == 0.0)
            return nothing;
        for (int i = 0; i < 3; i++)
            ray.origin[i] += hit.distance * ray.direction[i];
        s.distance -= hit.distance;
        triangle = hit.triangle;
    }
    return nothing;
}

static void measure_edge(const receiver *r, vector to_light, double distance)
{
    oracle_ray ray = ray_of(r, to_light);
    query q = oracle_query_from(r->scene, &ray, r->triangle);
    double edge = oracle_ray_edge(r->scene, q, r->travelled, distance);
    // Behind the triangle's plane there is no light, whatever the interpolated normal is.
    edge = fmin(edge, fabs(dot(to_light, r->geometric)));
    r->report->edge = fmin(r->report->edge, edge);
}

vector oracle_direction_to_light(const receiver *r, int index)
{
    const oracle_punctual *light = &r->scene->lights[index];
    return light->directional ? scaled(vector_of(light->direction), -1.0)
                              : unit(minus(vector_of(light->position), r->point));
}

vector oracle_light_at(const receiver *r, int index, passing pass, void *way)
{
    const oracle_punctual *light = &r->scene->lights[index];
    vector nothing = {{0.0, 0.0, 0.0}};
    vector to_light = oracle_direction_to_light(r, index);
    double distance = INFINITY, attenuation = 1.0;
    if (!light->directional) {
        distance = length(minus(vector_of(light->position), r->point));
        attenuation = distance_attenuation(light, distance);
        if (light->spot)
            attenuation *= angular_attenuation(light, to_light);
    }
    double cosine = dot(to_light, r->lit);
    if (r->edges)
        measure_edge(r, to_light, distance);
    if (!(dot(to_light, r->geometric) > 0.0) || !(cosine * attenuation > 0.0))
        return nothing;
    vector left = left_of(r, (shadow_ray){to_light, distance, pass, way});
    return scaled(times(vector_of(light->color), left), cosine * attenuation / PI);
}
