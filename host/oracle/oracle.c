// The oracle's camera and its walk along the tree of paths, rule by rule as ARCHITECTURE.md ("Light
// transport") counts them.
#include "oracle/oracle.h"
#include "oracle/hit.h"
#include "oracle/vector.h"

#include <string.h>

static const double PI = 3.14159265358979323846;

const oracle_material oracle_material_default = {
    .base = {1.0, 1.0, 1.0},
    .ior = 1.5,
    .attenuation = {1.0, 1.0, 1.0},
    .attenuation_distance = INFINITY,
    .mirror = -1.0,
};

// Rule 5: the solids that a path is inside, by material, innermost last. A path meets at most
// ORACLE_DEPTH_LIMIT surfaces and enters at most one solid at each; one more for where it began.
typedef struct media {
    int solid[ORACLE_DEPTH_LIMIT + 1];
    int count;
} media;

typedef struct path {
    vector origin, direction; // of the ray to be traced
    vector weight;            // what radiance along it counts for in the sample
    media inside;
    int left;         // triangle that it leaves, or −1
    int met;          // surfaces met so far
    double travelled; // length of the path so far
} path;

// A surface where a path has met it.
typedef struct surface {
    const oracle_material *material;
    int triangle, index; // of the triangle, of the material
    vector point;
    vector geometric; // n_g on the viewer's side
    vector lit;       // n on n_g's side: what receives light
    vector normal;    // n, on the viewer's side: n·v ≥ 0
    vector viewer;    // v
    double cosine;    // n·v
    bool front;       // met from outside
} surface;

typedef struct walk {
    const oracle_scene *scene;
    const oracle_view *view;
    oracle_report *report;
    vector radiance; // sum so far
    int depth;       // N
} walk;

static void follow(walk *w, const path *p, bool *met);

static void report_clear(oracle_report *report)
{
    *report =
        (oracle_report){.edge = ORACLE_EDGE_REACH, .critical = INFINITY, .threshold = INFINITY};
}

// E′(d) = E(R(−angle) d), R(a) the right-handed turn about +Y by a.
static vector environment(const oracle_scene *scene, oracle_light light, vector d)
{
    double angle = -scene->environment_rotation * PI / 180.0;
    double c = cos(angle), s = sin(angle);
    double turned[3] = {d.at[0], d.at[1], d.at[2]};
    if (scene->environment_rotation != 0.0) {
        turned[0] = c * d.at[0] + s * d.at[2];
        turned[2] = c * d.at[2] - s * d.at[0];
    }
    vector rgb = {{0.0, 0.0, 0.0}};
    light(scene->context, turned, rgb.at);
    return rgb;
}

static void add(walk *w, vector weight, vector radiance)
{
    w->radiance = plus(w->radiance, times(weight, radiance));
}

// Rules 1 and 2.

// n before it is put on the viewer's side: interpolated and made unit, n_g where it can't be.
static vector shading_normal(const oracle_triangle *triangle, const double barycentric[3],
                             vector geometric)
{
    vector sum = {{0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++) {
        vector n = vector_of(triangle->normal[i]);
        if (largest_magnitude(n) == 0.0)
            return geometric;
        sum = plus(sum, scaled(n, barycentric[i]));
    }
    vector n = unit(sum);
    return isfinite(n.at[0] + n.at[1] + n.at[2]) ? n : geometric;
}

static surface surface_at(const oracle_scene *scene, const oracle_hit *hit, vector direction)
{
    const oracle_triangle *triangle = &scene->triangles[hit->triangle];
    vector corners[3];
    surface s = {.triangle = hit->triangle, .index = triangle->material};
    s.material = &scene->materials[s.index];
    // By the vertices' weights, not by origin + distance·direction: exact in the plane.
    for (int i = 0; i < 3; i++) {
        corners[i] = vector_of(triangle->position[i]);
        s.point = plus(s.point, scaled(corners[i], hit->barycentric[i]));
    }
    s.viewer = scaled(direction, -1.0);
    vector winding = unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])));
    s.front = dot(winding, s.viewer) > 0.0;
    s.geometric = s.front ? winding : scaled(winding, -1.0);
    s.normal = shading_normal(triangle, hit->barycentric, s.geometric);
    if (dot(s.normal, s.geometric) < 0.0)
        s.normal = scaled(s.normal, -1.0);
    s.lit = s.normal;
    if (dot(s.normal, s.viewer) < 0.0)
        s.normal = scaled(s.normal, -1.0);
    s.cosine = fmin(fmax(dot(s.normal, s.viewer), 0.0), 1.0);
    return s;
}

// q ← q − 2(q·n_g)n_g where q ends on the wrong side: `side` is +1 for reflected directions,
// −1 for refracted ones.
static vector folded(vector q, vector geometric, double side)
{
    double height = dot(q, geometric);
    return height * side < 0.0 ? minus(q, scaled(geometric, 2.0 * height)) : q;
}

static vector mirror_direction(const surface *s)
{
    vector r = {{0.0, 0.0, 0.0}};
    oracle_reflect(s->normal.at, s->viewer.at, r.at);
    return folded(r, s->geometric, 1.0);
}

// Rule 5.

static bool is_solid(const oracle_material *m)
{
    return !m->unlit && m->mirror < 0.0 && m->metallic < 1.0 && m->transmission > 0.0 &&
           m->thickness > 0.0;
}

static double top_ior(const oracle_scene *scene, const media *inside)
{
    return inside->count > 0 ? scene->materials[inside->solid[inside->count - 1]].ior : 1.0;
}

static void media_enter(media *inside, int material)
{
    if (inside->count <= ORACLE_DEPTH_LIMIT)
        inside->solid[inside->count++] = material;
}

// Removes the topmost entry of the material, if there is one.
static void media_leave(media *inside, int material)
{
    for (int i = inside->count - 1; i >= 0; i--) {
        if (inside->solid[i] != material)
            continue;
        size_t above = (size_t)(inside->count - 1 - i);
        memmove(&inside->solid[i], &inside->solid[i + 1], above * sizeof(int));
        inside->count--;
        return;
    }
}

// The segment that ends at this surface was inside the topmost solid. Meeting a solid's back face
// while inside none means that the path began inside that solid.
static void absorb(const oracle_scene *scene, path *p, const surface *s, double distance)
{
    if (p->inside.count == 0 && !s->front && is_solid(s->material))
        media_enter(&p->inside, s->index);
    if (p->inside.count == 0)
        return;
    const oracle_material *m = &scene->materials[p->inside.solid[p->inside.count - 1]];
    for (int i = 0; i < 3; i++)
        p->weight.at[i] *=
            oracle_transmittance(m->attenuation[i], m->attenuation_distance, distance);
}

// Rule 7: the end, or on to the next surface.
static void branch(walk *w, const path *from, const surface *s, vector direction, vector weight)
{
    double share = largest(weight);
    if (share == 0.0)
        return;
    oracle_report *report = w->report;
    bool by_depth = from->met >= w->depth;
    bool by_weight = !by_depth && share < w->view->min_weight;
    if (!by_depth && w->view->min_weight > 0.0)
        report->threshold = fmin(report->threshold, fabs(share / w->view->min_weight - 1.0));
    bool exhausted = !by_depth && !by_weight && report->rays >= ORACLE_RAY_LIMIT;
    if (by_depth || by_weight || exhausted) {
        report->truncated_by_depth += by_depth ? share : 0.0;
        report->truncated_by_weight += by_depth ? 0.0 : share;
        report->exhausted = report->exhausted || exhausted;
        add(w, weight, environment(w->scene, w->scene->radiance, direction));
        return;
    }
    path next = *from;
    next.origin = s->point;
    next.direction = direction;
    next.weight = weight;
    next.left = s->triangle;
    follow(w, &next, NULL);
}

// Rule 4: what glass does with light that meets it, F and the way through.
typedef struct interface {
    double fresnel;
    vector through; // t, where fresnel < 1
    media beyond;   // the media on the other side
} interface;

static interface interface_at(walk *w, const path *p, const surface *s)
{
    interface glass = {.beyond = p->inside};
    double ior_here = 1.0, ior_there = s->material->ior; // a thin wall, from both sides
    bool solid = is_solid(s->material);
    if (solid && s->front) {
        ior_here = top_ior(w->scene, &p->inside);
        media_enter(&glass.beyond, s->index);
    } else if (solid) {
        ior_here = top_ior(w->scene, &p->inside);
        media_leave(&glass.beyond, s->index);
        ior_there = top_ior(w->scene, &glass.beyond);
    }
    double eta = ior_here / ior_there;
    glass.fresnel = w->view->no_fresnel ? 0.0 : oracle_fresnel(s->cosine, ior_here, ior_there);
    double margin = fabs(1.0 - eta * eta * (1.0 - s->cosine * s->cosine));
    w->report->critical = fmin(w->report->critical, margin);
    glass.through = scaled(s->viewer, -1.0);
    if (!solid)
        return glass;
    bool passes = oracle_refract(s->normal.at, s->viewer.at, eta, glass.through.at);
    if (!passes) {
        glass.fresnel = 1.0;
        w->report->total_reflections++;
    }
    glass.through = folded(glass.through, s->geometric, -1.0);
    return glass;
}

// Rule 3: F0 + (1 − F0)(1 − n·v)⁵.
static vector schlick(const walk *w, const oracle_material *m, double cosine)
{
    vector f = vector_of(m->base);
    if (w->view->no_fresnel)
        return f;
    for (int i = 0; i < 3; i++)
        f.at[i] = m->base[i] + (1.0 - m->base[i]) * pow(1.0 - cosine, 5.0);
    return f;
}

// Rules 3, 4 and 6, mixed: metallic first, then transmission. The reflected parts share one
// direction and so are one branch.
static void scatter(walk *w, const path *p, const surface *s)
{
    const oracle_material *m = s->material;
    vector base = vector_of(m->base);
    double as_metal = m->metallic;
    double as_glass = (1.0 - m->metallic) * m->transmission;
    double as_paint = (1.0 - m->metallic) * (1.0 - m->transmission);
    vector reflected = scaled(schlick(w, m, s->cosine), as_metal);
    vector matte = {{0.0, 0.0, 0.0}}, through = matte;
    interface glass = {0};

    if (as_paint > 0.0) {
        bool smooth = !(m->roughness > 0.0) && !w->view->no_fresnel;
        double f = smooth ? oracle_fresnel(s->cosine, 1.0, m->ior) : 0.0;
        reflected = plus(reflected, (vector){{as_paint * f, as_paint * f, as_paint * f}});
        matte = scaled(base, as_paint * (1.0 - f));
    }
    if (as_glass > 0.0) {
        glass = interface_at(w, p, s);
        double f = as_glass * glass.fresnel;
        reflected = plus(reflected, (vector){{f, f, f}});
        through = scaled(base, as_glass * (1.0 - glass.fresnel));
    }
    if (largest(matte) > 0.0)
        add(w, times(p->weight, matte), environment(w->scene, w->scene->irradiance, s->lit));
    branch(w, p, s, mirror_direction(s), times(p->weight, reflected));
    if (as_glass > 0.0) {
        path beyond = *p;
        beyond.inside = glass.beyond;
        branch(w, &beyond, s, glass.through, times(p->weight, through));
    }
}

// The lecture's blend: (1 − m)·base·irradiance/π + m·L(r).
static void blend(walk *w, const path *p, const surface *s)
{
    double m = s->material->mirror;
    if (m < 1.0) {
        vector matte = scaled(vector_of(s->material->base), 1.0 - m);
        add(w, times(p->weight, matte), environment(w->scene, w->scene->irradiance, s->lit));
    }
    branch(w, p, s, mirror_direction(s), scaled(p->weight, m));
}

// Traces a path's ray and goes on from the surface that it meets. `met`, where given, says whether
// there is one.
static void follow(walk *w, const path *p, bool *met)
{
    oracle_ray ray = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    vector_store(p->origin, ray.origin);
    vector_store(p->direction, ray.direction);
    oracle_hit hit = oracle_closest_hit(w->scene, &ray, p->left);
    oracle_report *report = w->report;
    report->rays++;
    if (w->view->edges) {
        query q = oracle_query_from(w->scene, &ray, p->left);
        report->edge = fmin(report->edge, oracle_ray_edge(w->scene, q, p->travelled, hit.distance));
    }
    if (met)
        *met = hit.triangle >= 0;
    if (hit.triangle < 0) {
        add(w, p->weight, environment(w->scene, w->scene->radiance, p->direction));
        return;
    }

    surface s = surface_at(w->scene, &hit, p->direction);
    path here = *p;
    here.met++;
    here.travelled += hit.distance;
    report->surfaces++;
    report->deepest = here.met > report->deepest ? here.met : report->deepest;
    absorb(w->scene, &here, &s, hit.distance);
    if (largest(here.weight) == 0.0)
        return;
    if (s.material->unlit) {
        add(w, here.weight, vector_of(s.material->base));
        return;
    }
    add(w, here.weight, vector_of(s.material->emission));
    if (s.material->mirror >= 0.0)
        blend(w, &here, &s);
    else
        scatter(w, &here, &s);
}

bool oracle_radiance(const oracle_scene *scene, const oracle_view *view, const oracle_ray *ray,
                     double rgb[3], oracle_report *report)
{
    oracle_report ignored = {0};
    report = report ? report : &ignored;
    report_clear(report);
    bool cut = view->depth <= 0 || view->depth > ORACLE_DEPTH_LIMIT;
    walk w = {.scene = scene, .view = view, .report = report};
    w.depth = cut ? ORACLE_DEPTH_LIMIT : view->depth;
    path primary = {.origin = vector_of(ray->origin),
                    .direction = unit(vector_of(ray->direction)),
                    .weight = {{1.0, 1.0, 1.0}},
                    .left = -1};
    bool met = false;
    follow(&w, &primary, &met);
    vector_store(w.radiance, rgb);
    return met;
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

void oracle_sample(const oracle_scene *scene, const oracle_view *view, const double position[2],
                   double rgba[4], oracle_report *report)
{
    oracle_ray ray = oracle_primary_ray(view, position);
    bool met = oracle_radiance(scene, view, &ray, rgba, report);
    rgba[3] = 1.0;
    if (!met && view->transparent)
        memset(rgba, 0, 4 * sizeof(double));
}

static void report_add(oracle_report *sum, const oracle_report *sample, double share)
{
    sum->truncated_by_depth += share * sample->truncated_by_depth;
    sum->truncated_by_weight += share * sample->truncated_by_weight;
    sum->rays += sample->rays;
    sum->surfaces += sample->surfaces;
    sum->total_reflections += sample->total_reflections;
    sum->deepest = sample->deepest > sum->deepest ? sample->deepest : sum->deepest;
    sum->exhausted = sum->exhausted || sample->exhausted;
    sum->edge = fmin(sum->edge, sample->edge);
    sum->critical = fmin(sum->critical, sample->critical);
    sum->threshold = fmin(sum->threshold, sample->threshold);
}

void oracle_pixel(const oracle_scene *scene, const oracle_view *view, const int pixel[2],
                  double rgba[4], oracle_report *report)
{
    int k = view->samples > 0 ? view->samples : 1;
    double share = 1.0 / k / k;
    oracle_report total, one;
    report_clear(&total);
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    for (int sample = 0; sample < k * k; sample++) {
        int column = sample % k, row = sample / k;
        double position[2] = {pixel[0] + (column + 0.5) / k, pixel[1] + (row + 0.5) / k};
        double value[4];
        oracle_sample(scene, view, position, value, &one);
        report_add(&total, &one, share);
        for (int i = 0; i < 4; i++)
            sum[i] += share * value[i];
    }
    memcpy(rgba, sum, sizeof sum);
    if (report)
        *report = total;
}
