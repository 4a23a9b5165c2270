// Scatters light at surfaces on the oracle's walk: rules 2 to 4, 6 and 9 to 18 of
// docs/light_transport.md.
#include "oracle/film.h"
#include "oracle/lights.h"
#include "oracle/overlaps.h"
#include "oracle/rough.h"
#include "oracle/shadow.h"
#include "oracle/vector.h"
#include "oracle/walk.h"

static const double PI = 3.14159265358979323846;

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

// The direction from the proxy's centre to the place where a ray leaves the proxy.
static vector toward_proxy(const oracle_proxy *proxy, vector o, vector d)
{
    double exit = INFINITY, along = 0.0, squared = -proxy->half[0] * proxy->half[0];
    for (int k = 0; k < 3; k++) {
        double from = o.at[k] - proxy->middle[k];
        double side = d.at[k] > 0.0 ? proxy->half[k] : -proxy->half[k];
        exit = d.at[k] != 0.0 ? fmin(exit, (side - from) / d.at[k]) : exit;
        along += from * d.at[k];
        squared += from * from;
    }
    if (proxy->sphere)
        exit = sqrt(along * along - squared) - along;
    vector place = plus(o, scaled(d, exit));
    for (int k = 0; k < 3; k++)
        place.at[k] -= proxy->center[k];
    return scaled(place, 1.0 / sqrt(dot(place, place)));
}

// Adds a path's light where it ends. Rule 9 applies if the path has met nothing.
void oracle_escape(walk *w, const path *p)
{
    const oracle_proxy *proxy = w->scene->proxy;
    vector seen = proxy != NULL ? toward_proxy(proxy, p->origin, p->direction) : p->direction;
    if (p->holds)
        add(w, p->weight, p->held);
    else if (w->view->transparent && p->met == 0)
        w->uncovered += largest(p->weight);
    else
        add(w, p->weight, environment(w->scene, w->scene->radiance, seen));
}

// The place where a ray leaves a surface; see oracle_view.start. Rounding the coordinates by a
// share of the triangle's moves a place off its plane by the sum of their parts along the normal,
// at most.
static vector start_of(const walk *w, const surface *s, vector direction)
{
    const oracle_triangle *t = &w->scene->triangles[s->triangle];
    double reach = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double most = 0.0;
        for (int k = 0; k < 3; k++)
            most = fmax(most, fabs(t->position[k][axis]));
        reach += fabs(s->geometric.at[axis]) * most;
    }
    double side = dot(direction, s->geometric) < 0.0 ? -1.0 : 1.0;
    return plus(s->point, scaled(s->geometric, side * w->view->start * reach));
}

// Rule 7: ends the path or continues to the next surface.
static void branch(walk *w, const path *from, const surface *s, vector direction, vector weight)
{
    double share = largest(weight);
    if (share == 0.0)
        return;
    path next = *from;
    next.origin = w->view->start != 0.0 ? start_of(w, s, direction) : s->point;
    next.direction = direction;
    next.weight = weight;
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
        oracle_escape(w, &next);
        return;
    }
    next.left = s->triangle;
    if (w->scene->overlaps) {
        next.origin = oracle_start_beside(w->scene, s->triangle, s->point, direction);
        next.left = -1;
    }
    w->follow(w, &next);
}

// Rule 2.

// Folds q back if it ends on the wrong side: q ← q − 2(q·n_g)n_g. `side` is +1 for reflected
// directions, −1 for refracted directions.
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

// The path that leaves a surface, with its cone. `by_itself` scales the cone's spread. `bend` is
// the turn of the ray per turn of the normal.
static path leaving(const path *here, const surface *s, double by_itself, double bend)
{
    path next = *here;
    next.cone.spread = by_itself * next.cone.spread + bend * s->curvature * next.cone.width;
    return next;
}

// Rule 14.

// The index of refraction: n(λ) = A + B/λ², with Abbe's number (n_d − 1)/(n_F − n_C) =
// 20/dispersion.
static double ior_of(const walk *w, const oracle_material *m)
{
    if (m == NULL)
        return 1.0;
    if (w->view->wavelengths == 0 || m->dispersion == 0.0)
        return m->ior;
    double f = 1.0 / (486.1 * 486.1), d = 1.0 / (587.6 * 587.6), c = 1.0 / (656.3 * 656.3);
    double b = (m->ior - 1.0) / (20.0 / m->dispersion) / (f - c), a = m->ior - b * d;
    double nm = w->view->wavelength[w->wavelength].nm;
    return fmax(1.0, a + b / (nm * nm));
}

static bool is_dispersive(const oracle_material *m)
{
    return m != NULL && m->dispersion != 0.0;
}

void oracle_disperse(walk *w, path *p, const surface *s)
{
    bool disperses = oracle_is_solid(s->material) && s->material->dispersion != 0.0;
    if (w->scene->overlaps) // use the solids on both sides; the surface may be another solid's
        disperses = is_dispersive(top_material(w->scene, &p->inside)) ||
                    (p->beyond >= 0 && is_dispersive(&w->scene->materials[p->beyond]));
    if (w->view->wavelengths == 0 || p->dispersed || !disperses)
        return;
    const double *share = w->view->wavelength[w->wavelength].share;
    for (int i = 0; i < 3; i++)
        p->weight.at[i] *= share[i] * w->view->wavelengths;
    p->dispersed = w->disperses = true;
}

// Rule 4: the light at an interface of glass: F and the way through.
typedef struct interface {
    vector fresnel;
    vector through;  // t, without total reflection
    vector unfolded; // t before it is folded
    path beyond;     // path of the transmitted light, with the media on the other side
} interface;

static interface interface_at(walk *w, const path *p, const surface *s)
{
    interface glass = {.beyond = *p};
    double ior_here = 1.0, ior_there = s->material->ior; // for a thin wall, from both sides
    // Find the media on both sides.
    bool solid = oracle_is_solid(s->material);
    if (solid && w->scene->overlaps) {
        glass.beyond.inside = media_of(p->beyond);
        ior_here = ior_of(w, top_material(w->scene, &p->inside));
        ior_there = ior_of(w, top_material(w->scene, &glass.beyond.inside));
    } else if (solid && s->front) {
        ior_here = ior_of(w, top_material(w->scene, &p->inside));
        ior_there = ior_of(w, s->material);
        media_enter(&glass.beyond.inside, s->index);
    } else if (solid) {
        ior_here = ior_of(w, top_material(w->scene, &p->inside));
        media_leave(&glass.beyond.inside, s->index);
        ior_there = ior_of(w, top_material(w->scene, &glass.beyond.inside));
    }
    // Compute Fresnel's term, and how near the critical angle is.
    double eta = ior_here / ior_there;
    if (!w->view->no_fresnel)
        glass.fresnel = oracle_dielectric(s, ior_here, ior_there, solid && !s->front);
    double margin = fabs(1.0 - eta * eta * (1.0 - s->cosine * s->cosine));
    w->report->critical = fmin(w->report->critical, margin);
    glass.through = scaled(s->viewer, -1.0);
    if (!solid)
        return glass;
    // Refract.
    bool passes = oracle_refract(s->normal.at, s->viewer.at, eta, glass.through.at);
    if (!passes) {
        glass.fresnel = (vector){{1.0, 1.0, 1.0}};
        w->report->total_reflections++;
    }
    glass.unfolded = glass.through;
    double bend = eta * s->cosine + dot(glass.through, s->normal); // η cos θi − cos θt
    glass.beyond = leaving(&glass.beyond, s, eta, bend);
    glass.through = folded(glass.through, s->geometric, -1.0);
    return glass;
}

// Rule 15: a film in empty space, on a base that reflects f0 at right angles.
static film_stack stack_on(const surface *s, vector f0)
{
    film_stack stack = {
        .above = 1.0, .film = s->material->film_ior, .thickness = s->film_thickness};
    for (int i = 0; i < 3; i++)
        stack.base[i] = oracle_index_of(f0.at[i]);
    return stack;
}

// Rule 3: F0 + (1 − F0)(1 − n·v)⁵, mixed with the film's reflectance.
static vector schlick(const walk *w, const surface *s)
{
    vector f = s->base;
    if (w->view->no_fresnel)
        return f;
    for (int i = 0; i < 3; i++)
        f.at[i] += (1.0 - f.at[i]) * pow(1.0 - s->cosine, 5.0);
    if (s->film > 0.0) {
        film_stack stack = stack_on(s, s->base);
        f = plus(scaled(f, 1.0 - s->film), scaled(oracle_film(&stack, s->cosine), s->film));
    }
    return f;
}

// E(n)/π, scaled by occlusion.
static vector irradiance(const walk *w, const surface *s)
{
    return scaled(environment(w->scene, w->scene->irradiance, s->lit), s->occlusion);
}

// Rule 10: punctual lights.

static receiver receiver_at(walk *w, const path *p, const surface *s, vector lit)
{
    return (receiver){.scene = w->scene,
                      .point = s->point,
                      .geometric = s->geometric,
                      .lit = lit,
                      .triangle = s->triangle,
                      .travelled = p->travelled,
                      .edges = w->view->edges,
                      .report = w->report};
}

// Adds the lights' light on paint; `matte` is the share that comes back.
static void add_lights(walk *w, const path *p, const surface *s, vector matte)
{
    receiver r = receiver_at(w, p, s, s->lit);
    for (int i = 0; i < w->scene->light_count; i++) {
        oracle_shadow to_light = {w, *p};
        to_light.way.weight = (vector){{1.0, 1.0, 1.0}};
        add(w, times(p->weight, matte), oracle_light_at(&r, i, oracle_pass_straight, &to_light));
    }
}

// Adds the light that paint sends back: the environment's, scaled by occlusion, and the lights'.
static void add_matte(walk *w, const path *p, const surface *s, vector matte)
{
    if (largest(matte) > 0.0) {
        add(w, times(p->weight, matte), irradiance(w, s));
        add_lights(w, p, s, matte);
    }
}

// Rule 18: adds a share of paint, partly lit from behind.
static void add_paint(walk *w, const path *p, const surface *s, double share)
{
    add_matte(w, p, s, scaled(s->base, share * (1.0 - s->through)));
    surface back = *s;
    back.geometric = scaled(s->geometric, -1.0);
    back.lit = scaled(s->lit, -1.0);
    add_matte(w, p, &back, scaled(s->through_color, share * s->through));
}

// a/b in each colour; 0 where b is 0.
static vector quotient(vector a, vector b)
{
    for (int i = 0; i < 3; i++)
        a.at[i] = b.at[i] > 0.0 ? a.at[i] / b.at[i] : 0.0;
    return a;
}

// Follows the reflected branch. If `held` is not NULL, it is the light that the branch brings where
// it ends, if nothing changes its weight on the way.
static void reflect(walk *w, const path *p, const surface *s, vector weight, const vector *held)
{
    path back = leaving(p, s, 1.0, 2.0);
    back.holds = held != NULL;
    if (held) {
        back.held = quotient(times(p->weight, *held), weight);
        if (s->roughness >= 0.07)
            back.cone.spread = hypot(back.cone.spread, 2.0 * s->roughness * s->roughness);
    }
    branch(w, &back, s, mirror_direction(s), weight);
}

// Rule 9: passes the light straight on past the share that is not there. The path has not met the
// surface.
static void pass(walk *w, const path *p, const surface *s, vector weight)
{
    path past = *p;
    past.met--;
    branch(w, &past, s, scaled(s->viewer, -1.0), weight);
}

// Rule 11.

static vector radiance(const void *scene, vector d)
{
    return environment(scene, ((const oracle_scene *)scene)->radiance, d);
}

static bool is_glass(const surface *s)
{
    return oracle_is_solid(s->material) || oracle_is_thin(s->material);
}

static bool is_rough(const walk *w, const surface *s)
{
    return w->view->roughness > 0 && (s->roughness >= 0.01 || s->anisotropy > 0.0);
}

// A punctual light as lobes see it.
typedef struct lamp {
    bool before;  // in front of the surface; if not, it adds nothing
    vector to;    // unit direction to the light
    vector light; // irradiance of a surface that faces the light
} lamp;

static lamp lamp_at(walk *w, const path *p, const surface *s, int number)
{
    receiver r = receiver_at(w, p, s, s->normal);
    lamp seen = {.to = oracle_direction_to_light(&r, number)};
    double cosine = dot(s->normal, seen.to);
    seen.before = cosine > 0.0;
    if (seen.before) {
        oracle_shadow to_light = {w, *p};
        to_light.way.weight = (vector){{1.0, 1.0, 1.0}};
        seen.light =
            scaled(oracle_light_at(&r, number, oracle_pass_straight, &to_light), PI / cosine);
    }
    return seen;
}

// Adds the lights' highlights in lobes; `base` and `edge` scale the lobe's two parts. A light is a
// point, so lobes have a least width.
static void add_highlights(walk *w, const path *p, const surface *s, vector base, vector edge)
{
    for (int i = 0; i < w->scene->light_count; i++) {
        lamp seen = lamp_at(w, p, s, i);
        if (seen.before) {
            lobe_integrals l = oracle_lobe_towards(s, fmax(s->roughness, 0.07), seen.to);
            vector shown = plus(scaled(base, l.white_base), scaled(edge, l.white_edge));
            add(w, times(p->weight, shown), seen.light);
        }
    }
}

// A lobe's view of the environment, and of a white environment.
typedef struct seen_lobe {
    vector light, white;
} seen_lobe;

// Evaluates the lobe of a surface with this F0, with its film.
static seen_lobe see_lobe(const walk *w, const surface *s, const lobe_integrals *lobe, vector f0,
                          vector f90)
{
    seen_lobe seen = {plus(times(f0, lobe->base), times(f90, lobe->edge)),
                      plus(scaled(f0, lobe->white_base), scaled(f90, lobe->white_edge))};
    if (s->film == 0.0 || w->view->no_fresnel)
        return seen;
    film_stack stack = stack_on(s, f0);
    vector table[ORACLE_FILM_STEPS + 1];
    for (int i = 0; i <= ORACLE_FILM_STEPS; i++)
        table[i] = oracle_film(&stack, (double)i / ORACLE_FILM_STEPS);
    lobe_integrals by_film = oracle_film_lobe(s, w->view->roughness, table, radiance, w->scene);
    seen.light = plus(scaled(seen.light, 1.0 - s->film), scaled(by_film.base, s->film));
    seen.white = plus(scaled(seen.white, 1.0 - s->film), scaled(by_film.edge, s->film));
    return seen;
}

// Scatters light at metal and at the coat of paint, as lobes.
static void scatter_lobes(walk *w, const path *p, const surface *s)
{
    double as_metal = s->coverage * s->metallic, as_paint = s->coverage * (1.0 - s->metallic);
    lobe_integrals lobe = oracle_lobe(s, w->view->roughness, radiance, w->scene);
    double n = s->material->ior;
    vector f0 = oracle_tinted(s, (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0)));
    vector white = {{1.0, 1.0, 1.0}};
    // Turquin 2019: of the light that goes on to other microfacets, F0 is reflected again, and so
    // on.
    double lost = w->view->all_scattering ? 1.0 / (lobe.white_base + lobe.white_edge) - 1.0 : 0.0;
    vector coat = scaled(plus(white, scaled(f0, lost)), w->view->no_fresnel ? 0.0 : s->specular);
    // The rest is added like matte light.
    double by_path = fmin(1.0, fmax(0.0, (0.6 - s->roughness) / 0.3));
    vector paths = scaled(coat, as_paint * by_path),
           matte = scaled(coat, as_paint * (1.0 - by_path));
    vector metal = scaled(plus(white, scaled(s->base, lost)), as_metal);
    vector base = plus(times(s->base, metal), times(paths, f0));
    vector edge = w->view->no_fresnel ? base : plus(metal, paths);
    seen_lobe by_coat = see_lobe(w, s, &lobe, f0, white);
    seen_lobe by_metal = see_lobe(w, s, &lobe, s->base, w->view->no_fresnel ? s->base : white);
    w->radiance = plus(w->radiance, times(p->weight, times(matte, by_coat.light)));
    add_highlights(w, p, s, plus(base, times(matte, f0)), plus(edge, matte));
    double kept = 1.0 - largest(times(coat, by_coat.white));
    add_paint(w, p, s, as_paint * kept);
    vector held = plus(times(metal, by_metal.light), times(paths, by_coat.light));
    vector weight = plus(times(metal, by_metal.white), times(paths, by_coat.white));
    reflect(w, p, s, times(p->weight, weight), &held);
}

// Rules 3, 4 and 6, mixed: metallic first, then transmission. The shares of light that a surface
// sends on. The reflected parts share one direction, so they are one branch.
typedef struct shares {
    double paint; // share that is lit as paint
    vector reflected, through;
    interface glass;
} shares;

static shares shares_at(walk *w, const path *p, const surface *s)
{
    const oracle_material *m = s->material;
    double as_metal = s->coverage * s->metallic;
    double as_glass = s->coverage * (1.0 - s->metallic) * s->transmission;
    double as_paint = s->coverage * (1.0 - s->metallic) * (1.0 - s->transmission);
    shares of = {.reflected = scaled(schlick(w, s), as_metal),
                 .glass = {.through = scaled(s->viewer, -1.0), .beyond = *p}};
    if (as_paint > 0.0) {
        bool rough = w->view->roughness == 0 && s->roughness >= 0.01; // then paint has no coat
        vector coat = {{0.0, 0.0, 0.0}};
        if (!rough && !w->view->no_fresnel)
            coat = oracle_coat(s, m->ior);
        of.reflected = plus(of.reflected, scaled(coat, as_paint));
        of.paint = as_paint * (1.0 - largest(coat));
    }
    if (as_glass > 0.0) {
        of.glass = interface_at(w, p, s);
        of.reflected = plus(of.reflected, scaled(of.glass.fresnel, as_glass));
        of.through = scaled(s->base, as_glass * (1.0 - largest(of.glass.fresnel)));
    }
    return of;
}

int oracle_facets_of(const oracle_view *view)
{
    return view->roughness * view->roughness;
}

// Rule 12: scatters light at one facet of rough glass. A thin wall transmits the mirror image of
// its reflection.
static void scatter_by_facet(walk *w, const path *p, const surface *s)
{
    w->faceted = true;
    surface facet = oracle_facet(s, w->direction, oracle_facets_of(w->view), p->met);
    shares of = shares_at(w, p, &facet);
    vector r = {{0.0, 0.0, 0.0}};
    oracle_reflect(facet.normal.at, s->viewer.at, r.at);
    double height = dot(s->normal, r);
    double reflects = oracle_opening(s, height), transmits = reflects;
    if (oracle_is_solid(s->material))
        transmits = oracle_opening(s, -dot(s->normal, of.glass.unfolded));
    else
        of.glass.through = folded(minus(r, scaled(s->normal, 2.0 * height)), s->geometric, -1.0);
    add_paint(w, p, s, of.paint);
    reflect(w, p, &facet, times(p->weight, scaled(of.reflected, reflects)), NULL);
    branch(w, &of.glass.beyond, s, of.glass.through,
           times(p->weight, scaled(of.through, transmits)));
}

// Scatters the share `left` of the light, which gets past a clear coat. The light that a thin wall
// transmits and the light that passes beside it (`past`) are one branch.
static void scatter(walk *w, const path *p, const surface *s, double left, vector past)
{
    shares of = shares_at(w, p, s);
    add_paint(w, p, s, of.paint * left);
    reflect(w, p, s, times(p->weight, scaled(of.reflected, left)), NULL);
    branch(w, &of.glass.beyond, s, of.glass.through,
           times(p->weight, plus(past, scaled(of.through, left))));
}

// The lecture's blend: (1 − m)·base·irradiance/π + m·L(r).
static void blend(walk *w, const path *p, const surface *s)
{
    double m = s->material->mirror;
    add_matte(w, p, s, scaled(s->base, s->coverage * (1.0 - m)));
    reflect(w, p, s, scaled(p->weight, s->coverage * m), NULL);
}

// Rule 13: adds the light of a clear coat, which is paint of index 1.5 without a base. Returns the
// share of light that it leaves. If the view has no roughness, the coat is smooth.
static double add_clearcoat(walk *w, const path *p, const surface *s)
{
    double there = oracle_clearcoat_of(w, s);
    if (there == 0.0)
        return 1.0;
    surface coat = *s;
    coat.material = &oracle_material_default;
    coat.base = coat.emission = (vector){{0.0, 0.0, 0.0}};
    coat.specular_color = (vector){{1.0, 1.0, 1.0}};
    coat.specular = 1.0;
    coat.film = coat.anisotropy = coat.through = 0.0;
    coat.metallic = coat.transmission = 0.0;
    coat.normal = s->clearcoat_normal;
    coat.cosine = s->clearcoat_cosine;
    coat.roughness = w->view->roughness > 0 ? s->clearcoat_roughness : 0.0;
    coat.coverage = s->coverage * there;
    if (!is_rough(w, &coat)) {
        scatter(w, p, &coat, 1.0, coat.base);
        return 1.0 - there * oracle_fresnel(coat.cosine, 1.0, 1.5);
    }
    scatter_lobes(w, p, &coat);
    lobe_integrals lobe = oracle_lobe(&coat, w->view->roughness, radiance, w->scene);
    double lost = w->view->all_scattering ? 1.0 / (lobe.white_base + lobe.white_edge) - 1.0 : 0.0;
    return 1.0 - there * (1.0 + 0.04 * lost) * (0.04 * lobe.white_base + lobe.white_edge);
}

// Rule 17: adds sheen above metal and paint, from the environment and the lights. Returns the share
// of light that it leaves.
static double add_sheen(walk *w, const path *p, const surface *s)
{
    double most = largest(s->sheen_color);
    if (most == 0.0 || w->view->roughness == 0 || is_glass(s) || s->material->mirror >= 0.0)
        return 1.0;
    lobe_integrals seen = oracle_sheen(s, w->view->roughness, radiance, w->scene);
    vector color = scaled(times(p->weight, s->sheen_color), s->coverage);
    add(w, color, seen.base);
    for (int i = 0; i < w->scene->light_count; i++) {
        lamp one = lamp_at(w, p, s, i);
        if (one.before)
            add(w, scaled(color, oracle_sheen_towards(s, one.to)), one.light);
    }
    return fmax(0.0, 1.0 - most * seen.white_base);
}

// Scatters the light of a path that has met a surface.
void oracle_meet(walk *w, const path *p, const surface *s)
{
    double gone = 1.0 - s->coverage;
    double left = s->coverage > 0.0 ? add_clearcoat(w, p, s) : 1.0;
    vector none = {{0.0, 0.0, 0.0}}, past = {{gone, gone, gone}};
    path below = *p;
    below.weight = scaled(p->weight, left);
    bool faceted = is_rough(w, s) && is_glass(s);
    bool together = oracle_is_thin(s->material) && s->coverage > 0.0 && !faceted;
    if (s->material->unlit) {
        add(w, scaled(p->weight, s->coverage), s->base);
    } else {
        add(w, scaled(below.weight, s->coverage), s->emission);
        left *= add_sheen(w, &below, s);
        below.weight = scaled(p->weight, left);
        if (s->material->mirror >= 0.0)
            blend(w, &below, s);
        else if (faceted)
            scatter_by_facet(w, &below, s);
        else if (is_rough(w, s))
            scatter_lobes(w, &below, s);
        else
            scatter(w, p, s, left, together ? past : none);
    }
    if (!together)
        pass(w, p, s, times(p->weight, past));
}
