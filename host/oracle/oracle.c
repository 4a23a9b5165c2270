// Walks along the tree of paths, rule by rule (docs/light_transport.md).
#include "oracle/oracle.h"
#include "oracle/hit.h"
#include "oracle/overlaps.h"
#include "oracle/vector.h"
#include "oracle/walk.h"

#include <string.h>

// If eyes may be on edges, edges within this distance of an eye do not count. Metres.
#define EYE_REACH 1e-5

static void report_clear(oracle_report *report)
{
    *report = (oracle_report){
        .edge = ORACLE_EDGE_REACH, .critical = INFINITY, .threshold = INFINITY, .jump = INFINITY};
}

static arrival arrival_of(const walk *w, const path *here)
{
    return (arrival){here->direction, here->cone.width, here->travelled, w->view->anisotropy,
                     w->view->roughness > 0};
}

// Traces a path's ray and continues from the surface that it meets.
static void follow(walk *w, const path *p)
{
    oracle_ray ray = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    vector_store(p->origin, ray.origin);
    vector_store(p->direction, ray.direction);
    oracle_hit hit = oracle_closest_hit(w->scene, &ray, p->left);
    if (w->scene->overlaps && p->met == 0)
        hit = oracle_pass_eye(w->scene, &ray, hit);
    oracle_report *report = w->report;
    report->rays++;
    if (w->view->edges) {
        // If the eye is on an edge, this edge is near only to rays that run along it.
        double skipped = w->scene->overlaps && p->met == 0 ? EYE_REACH : 0.0;
        oracle_ray from = ray;
        vector_store(plus(p->origin, scaled(p->direction, skipped)), from.origin);
        query q = oracle_query_from(w->scene, &from, p->left);
        double edge = oracle_ray_edge(w->scene, q, p->travelled + skipped, hit.distance - skipped);
        report->edge = fmin(report->edge, edge);
    }
    if (hit.triangle < 0) {
        oracle_escape(w, p);
        return;
    }
    // Arrive at the surface, with the media on both sides.
    path here = *p;
    bool there = true;
    if (w->scene->overlaps) {
        int sides[2];
        there = oracle_sides(w->scene, &ray, &hit, sides);
        here.inside = media_of(sides[0]);
        here.beyond = sides[1];
    }
    here.travelled += hit.distance;
    here.cone.width += here.cone.spread * hit.distance;
    // Evaluate the surface.
    arrival by = arrival_of(w, &here);
    surface s = oracle_surface_at(w->scene, &hit, &by);
    report->jump = fmin(report->jump, s.jump);
    if (!there)
        s.coverage = 0.0;
    here.met++;
    if (s.coverage > 0.0) {
        report->surfaces++;
        report->deepest = here.met > report->deepest ? here.met : report->deepest;
    }
    // Absorb, disperse, and scatter the light.
    oracle_absorb(w->scene, &here, &s, hit.distance);
    oracle_disperse(w, &here, &s);
    if (largest(here.weight) > 0.0)
        oracle_meet(w, &here, &s);
}

static walk walk_along(const oracle_scene *scene, const oracle_view *view, const oracle_ray *ray,
                       const int turn[2], oracle_report *report)
{
    bool cut = view->depth <= 0 || view->depth > ORACLE_DEPTH_LIMIT;
    walk w = {.scene = scene,
              .view = view,
              .report = report,
              .direction = turn[0],
              .wavelength = turn[1],
              .follow = follow};
    w.depth = cut ? ORACLE_DEPTH_LIMIT : view->depth;
    path primary = {.origin = vector_of(ray->origin),
                    .direction = unit(vector_of(ray->direction)),
                    .weight = {{1.0, 1.0, 1.0}},
                    .left = -1};
    primary.cone = oracle_primary_cone(view, primary.direction);
    report_clear(report);
    follow(&w, &primary);
    return w;
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
    sum->jump = fmin(sum->jump, sample->jump);
}

// The mean of the walks along a ray. There is one walk, or one for each facet if the ray meets
// rough glass. If it meets a solid that disperses light, each wavelength has these walks.
static walk mean_walk(const oracle_scene *scene, const oracle_view *view, const oracle_ray *ray,
                      oracle_report *report)
{
    oracle_report one, sum;
    walk mean = {.radiance = {{0.0, 0.0, 0.0}}};
    int facets = 1, wavelengths = 1;
    report_clear(&sum);
    for (int turn[2] = {0, 0}; turn[1] < wavelengths; turn[1]++) {
        for (turn[0] = 0; turn[0] < facets; turn[0]++) {
            walk w = walk_along(scene, view, ray, turn, &one);
            mean.radiance = plus(mean.radiance, w.radiance);
            mean.uncovered += w.uncovered;
            report_add(&sum, &one, 1.0);
            if (turn[1] == 0 && w.faceted)
                facets = oracle_facets_of(view);
            if (turn[1] == 0 && w.disperses)
                wavelengths = view->wavelengths;
        }
    }
    double share = 1.0 / facets / wavelengths;
    mean.radiance = scaled(mean.radiance, share);
    mean.uncovered *= share;
    report_clear(report);
    report_add(report, &sum, 1.0);
    report->truncated_by_depth *= share;
    report->truncated_by_weight *= share;
    return mean;
}

bool oracle_radiance(const oracle_scene *scene, const oracle_view *view, const oracle_ray *ray,
                     double rgb[3], oracle_report *report)
{
    oracle_report own = {.surfaces = 0};
    oracle_report *given = report ? report : &own;
    vector_store(mean_walk(scene, view, ray, given).radiance, rgb);
    return given->surfaces > 0;
}

void oracle_sample(const oracle_scene *scene, const oracle_view *view, const double position[2],
                   double rgba[4], oracle_report *report)
{
    oracle_report ignored;
    oracle_ray ray = oracle_primary_ray(view, position);
    walk w = mean_walk(scene, view, &ray, report ? report : &ignored);
    vector_store(w.radiance, rgba);
    rgba[3] = 1.0 - w.uncovered;
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
