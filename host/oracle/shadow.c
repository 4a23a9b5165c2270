// Computes the light that is left on a light's straight way to a surface (rule 10).
#include "oracle/shadow.h"
#include "oracle/overlaps.h"
#include "oracle/vector.h"

double oracle_clearcoat_of(const walk *w, const surface *s)
{
    const oracle_material *m = s->material;
    bool none =
        w->view->no_fresnel || m->unlit || m->mirror >= 0.0 || (oracle_is_solid(m) && !s->front);
    return none ? 0.0 : s->clearcoat;
}

// Finds the surface that a shadow ray meets among those in one place, where solids may overlap.
static bool shows(oracle_shadow *to_light, oracle_hit *hit, vector direction)
{
    const oracle_scene *scene = to_light->walk->scene;
    const oracle_triangle *t = &scene->triangles[hit->triangle];
    vector point = {{0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++)
        point = plus(point, scaled(vector_of(t->position[i]), hit->barycentric[i]));
    oracle_ray ray;
    vector_store(minus(point, scaled(direction, hit->distance)), ray.origin);
    vector_store(direction, ray.direction);
    int sides[2];
    bool there = oracle_sides(scene, &ray, hit, sides);
    to_light->way.inside = media_of(sides[0]);
    return there;
}

// Passes the share that is not there, and glass by its Fresnel term and colour.
vector oracle_pass_straight(void *state, const oracle_hit *hit, vector direction)
{
    oracle_shadow *to_light = state;
    path *way = &to_light->way;
    const walk *w = to_light->walk;
    arrival by = {direction, 0.0, way->travelled + hit->distance, 1, false};
    oracle_hit met = *hit;
    bool shown = !w->scene->overlaps || shows(to_light, &met, direction);
    surface s = oracle_surface_at(w->scene, &met, &by);
    const oracle_material *m = s.material;
    if (!shown)
        s.coverage = 0.0;
    w->report->jump = fmin(w->report->jump, s.jump);
    oracle_absorb(w->scene, way, &s, hit->distance);
    if (oracle_is_solid(m) && s.front)
        media_enter(&way->inside, s.index);
    else if (oracle_is_solid(m))
        media_leave(&way->inside, s.index);
    double f = 0.0;
    if (!w->view->no_fresnel)
        f = largest(oracle_dielectric(&s, 1.0, m->ior, false));
    f += (1.0 - f) * oracle_clearcoat_of(w, &s) * oracle_fresnel(s.clearcoat_cosine, 1.0, 1.5);
    double glass = m->unlit || m->mirror >= 0.0 ? 0.0 : (1.0 - s.metallic) * s.transmission;
    double gone = 1.0 - s.coverage;
    vector there = scaled(s.base, s.coverage * glass * (1.0 - f)), past = {{gone, gone, gone}};
    way->weight = times(way->weight, plus(there, past));
    return way->weight;
}
