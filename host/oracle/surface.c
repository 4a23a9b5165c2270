// Surfaces where paths meet them: rule 1, and what textures, colours and alpha make of a material.
// See surface.h.
#include "oracle/surface.h"

#include <stddef.h>

const oracle_material oracle_material_default = {
    .base = {1.0, 1.0, 1.0},
    .ior = 1.5,
    .specular = 1.0,
    .specular_color = {1.0, 1.0, 1.0},
    .attenuation = {1.0, 1.0, 1.0},
    .attenuation_distance = INFINITY,
    .mirror = -1.0,
    .alpha = 1.0,
    .alpha_cutoff = 0.5,
    .normal_scale = 1.0,
    .clearcoat_normal_scale = 1.0,
    .occlusion_strength = 1.0,
};

// What is known of the triangle that was met.
typedef struct place {
    const oracle_triangle *triangle;
    const oracle_corner *corners; // [3]; NULL: they hold nothing
    const double *weights;        // barycentric
    vector edges[2];              // from the first vertex
    vector winding;               // n_g on the side from which the triangle winds left
    // How the weights of the second and third vertex change where the ray moves aside by 1, along
    // the surface's slant and across it.
    double moved[2][2]; // [axis][vertex]
} place;

bool oracle_is_solid(const oracle_material *m)
{
    return !m->unlit && m->mirror < 0.0 && m->metallic < 1.0 && m->transmission > 0.0 &&
           m->thickness > 0.0;
}

bool oracle_is_thin(const oracle_material *m)
{
    return !m->unlit && m->mirror < 0.0 && m->metallic < 1.0 && m->transmission > 0.0 &&
           !(m->thickness > 0.0);
}

// ---- What the pixel sees of the triangle --------------------------------------------------------

// The two axes of the cone's section with the triangle's plane, per width of the cone: one runs
// across the ray, the other is as much longer as the ray is slanted.
static void find_axes(place *p, vector direction)
{
    vector across = cross(p->winding, direction);
    across = unit(largest_magnitude(across) > 0.0 ? across : p->edges[0]);
    double cosine = fmax(fabs(dot(p->winding, direction)), 1e-6);
    vector axes[2] = {scaled(cross(across, p->winding), 1.0 / cosine), across};
    // The dual basis of the edges, in the plane.
    vector dual[2] = {cross(p->edges[1], p->winding), cross(p->winding, p->edges[0])};
    for (int axis = 0; axis < 2; axis++)
        for (int k = 0; k < 2; k++)
            p->moved[axis][k] = dot(axes[axis], dual[k]) / dot(p->edges[k], dual[k]);
}

// A number that the corners hold, here; exactly that which all three hold.
static double here(const place *p, const double of[3])
{
    return of[0] + p->weights[1] * (of[1] - of[0]) + p->weights[2] * (of[2] - of[0]);
}

// How it changes along an axis.
static double change(const place *p, int axis, const double of[3])
{
    return p->moved[axis][0] * (of[1] - of[0]) + p->moved[axis][1] * (of[2] - of[0]);
}

static oracle_spot spot_of(const place *p, int set, const arrival *by)
{
    oracle_spot spot = {.width = by->width, .taps = by->taps};
    for (int k = 0; k < 2; k++) {
        double of[3];
        for (int i = 0; i < 3; i++)
            of[i] = p->corners ? p->corners[i].texcoord[set][k] : 0.0;
        spot.at[k] = here(p, of);
        for (int axis = 0; axis < 2; axis++)
            spot.moved[axis][k] = change(p, axis, of);
    }
    return spot;
}

// ---- Materials ----------------------------------------------------------------------------------

// What a texture says, white where there is none. Notes how near it is to saying something else.
static oracle_glance glance_at(const place *p, const arrival *by, oracle_role role, surface *s)
{
    const oracle_texture *texture = &s->material->texture[role];
    oracle_glance white = {{1.0, 1.0, 1.0, 1.0}, INFINITY, INFINITY, 0.0};
    if (!texture->image)
        return white;
    oracle_spot spot = spot_of(p, texture->set, by);
    oracle_glance glance = oracle_look_up(texture, &spot);
    s->jump = fmin(s->jump, fmin(glance.jump / by->travelled, glance.turn));
    return glance;
}

// Rule 9: how much of the surface is there. `slope` bounds how fast alpha changes.
static void cover(double alpha, double slope, const arrival *by, surface *s)
{
    const oracle_material *m = s->material;
    s->coverage = 1.0;
    if (oracle_is_solid(m) || m->alpha_mode == ORACLE_OPAQUE)
        return;
    s->coverage = alpha;
    if (m->alpha_mode == ORACLE_MASK) {
        s->coverage = alpha >= m->alpha_cutoff ? 1.0 : 0.0;
        s->jump = fmin(s->jump, fabs(alpha - m->alpha_cutoff) / slope / by->travelled);
    }
}

// The colours of the vertices, and how fast their alpha changes.
static void take_colors(const place *p, double rgba[4], double *slope)
{
    for (int c = 0; c < 4; c++) {
        double of[3];
        for (int i = 0; i < 3; i++)
            of[i] = p->corners ? p->corners[i].color[c] : 1.0;
        rgba[c] = here(p, of);
        *slope = fabs(change(p, 0, of)) + fabs(change(p, 1, of));
    }
}

static void take_material(const place *p, const arrival *by, surface *s)
{
    const oracle_material *m = s->material;
    double color[4], slope;
    take_colors(p, color, &slope);
    oracle_glance base = glance_at(p, by, ORACLE_BASE, s);
    oracle_glance emission = glance_at(p, by, ORACLE_EMISSION, s);
    for (int c = 0; c < 3; c++) {
        s->base.at[c] = m->base[c] * color[c] * base.rgba[c];
        s->emission.at[c] = m->emission[c] * emission.rgba[c];
    }
    oracle_glance metal = glance_at(p, by, ORACLE_METALLIC, s);
    s->metallic = m->metallic * metal.rgba[2];
    s->roughness = m->roughness * metal.rgba[1];
    s->transmission = m->transmission * glance_at(p, by, ORACLE_TRANSMISSION, s).rgba[0];
    s->specular = m->specular * glance_at(p, by, ORACLE_SPECULAR, s).rgba[3];
    oracle_glance tint = glance_at(p, by, ORACLE_SPECULAR_COLOR, s);
    for (int c = 0; c < 3; c++)
        s->specular_color.at[c] = m->specular_color[c] * tint.rgba[c];
    s->clearcoat = m->clearcoat * glance_at(p, by, ORACLE_CLEARCOAT, s).rgba[0];
    s->film = m->film * glance_at(p, by, ORACLE_IRIDESCENCE, s).rgba[0];
    double far = glance_at(p, by, ORACLE_IRIDESCENCE_THICKNESS, s).rgba[1];
    s->film_thickness = m->film_thickness[0] + far * (m->film_thickness[1] - m->film_thickness[0]);
    s->through = m->diffuse_transmission * glance_at(p, by, ORACLE_DIFFUSE_TRANSMISSION, s).rgba[3];
    oracle_glance through = glance_at(p, by, ORACLE_DIFFUSE_TRANSMISSION_COLOR, s);
    for (int c = 0; c < 3; c++)
        s->through_color.at[c] = m->diffuse_transmission_color[c] * through.rgba[c];
    oracle_glance sheen = glance_at(p, by, ORACLE_SHEEN_COLOR, s);
    for (int c = 0; c < 3; c++)
        s->sheen_color.at[c] = m->sheen_color[c] * sheen.rgba[c];
    s->sheen_roughness = m->sheen_roughness * glance_at(p, by, ORACLE_SHEEN_ROUGHNESS, s).rgba[3];
    s->clearcoat_roughness =
        m->clearcoat_roughness * glance_at(p, by, ORACLE_CLEARCOAT_ROUGHNESS, s).rgba[1];
    double open = glance_at(p, by, ORACLE_OCCLUSION, s).rgba[0];
    s->occlusion = 1.0 - m->occlusion_strength * (1.0 - open);
    cover(m->alpha * color[3] * base.rgba[3], m->alpha * (slope + base.slope), by, s);
}

// ---- Normals ------------------------------------------------------------------------------------

// The vertices' normals, interpolated and made unit; false where that can't be.
static bool interpolated_normal(const place *p, vector *n)
{
    vector sum = {{0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++) {
        vector corner = vector_of(p->triangle->normal[i]);
        if (largest_magnitude(corner) == 0.0)
            return false;
        sum = plus(sum, scaled(corner, p->weights[i]));
    }
    *n = unit(sum);
    return isfinite(n->at[0] + n->at[1] + n->at[2]);
}

// Tangent and bitangent; false where a corner has none, or where they turn different ways.
static bool find_tangents(const place *p, vector n, vector *tangent, vector *bitangent)
{
    double turn = p->corners ? p->corners[0].tangent[3] : 0.0;
    vector sum = {{0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++) {
        if (turn == 0.0 || p->corners[i].tangent[3] != turn)
            return false;
        sum = plus(sum, scaled(vector_of(p->corners[i].tangent), p->weights[i]));
    }
    *tangent = unit(sum);
    *bitangent = scaled(cross(n, *tangent), turn);
    return true;
}

// The normal as a texture bends it. It stays where there are no tangents.
static vector bent(const place *p, const arrival *by, oracle_role role, vector n, surface *s)
{
    const oracle_material *m = s->material;
    vector tangent, bitangent;
    if (!m->texture[role].image || !find_tangents(p, n, &tangent, &bitangent))
        return n;
    oracle_glance glance = glance_at(p, by, role, s);
    double scale = role == ORACLE_NORMAL ? m->normal_scale : m->clearcoat_normal_scale;
    double x = scale * (2.0 * glance.rgba[0] - 1.0);
    double y = scale * (2.0 * glance.rgba[1] - 1.0);
    double z = 2.0 * glance.rgba[2] - 1.0;
    vector to = unit(plus(plus(scaled(tangent, x), scaled(bitangent, y)), scaled(n, z)));
    bool flat = x == 0.0 && y == 0.0;
    return !flat && isfinite(to.at[0] + to.at[1] + to.at[2]) ? to : n;
}

// How much rougher it is along a direction, and which.
static void take_brush(const place *p, const arrival *by, vector own, surface *s)
{
    const oracle_material *m = s->material;
    vector tangent, bitangent;
    s->anisotropy = 0.0;
    if (m->anisotropy == 0.0 || oracle_is_solid(m) || oracle_is_thin(m) ||
        !find_tangents(p, own, &tangent, &bitangent))
        return;
    double strength = m->anisotropy, angle = m->anisotropy_rotation;
    if (m->texture[ORACLE_ANISOTROPY].image) {
        oracle_glance glance = glance_at(p, by, ORACLE_ANISOTROPY, s);
        angle += atan2(2.0 * glance.rgba[1] - 1.0, 2.0 * glance.rgba[0] - 1.0);
        strength *= glance.rgba[2];
    }
    vector way = plus(scaled(tangent, cos(angle)), scaled(bitangent, sin(angle)));
    s->along = unit(minus(way, scaled(s->normal, dot(way, s->normal))));
    if (isfinite(s->along.at[0] + s->along.at[1] + s->along.at[2]))
        s->anisotropy = strength;
}

// The root mean square, over the triangle's edges, of how much normals turn per length; less than 0
// where they lean towards each other.
static double curvature_of(const oracle_triangle *triangle)
{
    double turned = 0.0, parted = 0.0, squares = 0.0;
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3;
        vector edge = minus(vector_of(triangle->position[next]), vector_of(triangle->position[i]));
        vector turn = minus(vector_of(triangle->normal[next]), vector_of(triangle->normal[i]));
        turned += dot(turn, turn);
        parted += dot(turn, edge);
        squares += dot(edge, edge);
    }
    return copysign(sqrt(turned / squares), parted < 0.0 ? -1.0 : 1.0);
}

// Rule 1. Textures bend a normal as the file has it; then it is turned as the file's own is.
static void take_normals(const place *p, const arrival *by, surface *s)
{
    vector own = p->winding;
    bool smooth = interpolated_normal(p, &own);
    own = smooth ? own : p->winding;
    double side = dot(own, s->geometric) < 0.0 ? -1.0 : 1.0;
    s->lit = scaled(bent(p, by, ORACLE_NORMAL, own, s), side);
    double cosine = dot(s->lit, s->viewer);
    s->normal = scaled(s->lit, cosine < 0.0 ? -1.0 : 1.0);
    s->cosine = fmin(fabs(cosine), 1.0);
    take_brush(p, by, own, s);
    vector coat = bent(p, by, ORACLE_CLEARCOAT_NORMAL, own, s);
    double up = dot(coat, s->viewer);
    s->clearcoat_normal = scaled(coat, up < 0.0 ? -1.0 : 1.0);
    s->clearcoat_cosine = fmin(fabs(up), 1.0);
    if (smooth)
        s->curvature = curvature_of(p->triangle) * (dot(own, s->normal) < 0.0 ? -1.0 : 1.0);
    if (smooth && p->corners)
        s->jump = fmin(s->jump, s->cosine); // where the curvature changes its sign
}

surface oracle_surface_at(const oracle_scene *scene, const oracle_hit *hit, const arrival *by)
{
    const oracle_triangle *triangle = &scene->triangles[hit->triangle];
    place p = {.triangle = triangle, .weights = hit->barycentric};
    p.corners = scene->corners ? scene->corners[hit->triangle] : NULL;
    surface s = {.triangle = hit->triangle, .index = triangle->material, .jump = INFINITY};
    s.material = &scene->materials[s.index];
    // By the vertices' weights, not by origin + distance·direction: exact in the plane.
    vector corners[3];
    for (int i = 0; i < 3; i++) {
        corners[i] = vector_of(triangle->position[i]);
        s.point = plus(s.point, scaled(corners[i], hit->barycentric[i]));
    }
    p.edges[0] = minus(corners[1], corners[0]);
    p.edges[1] = minus(corners[2], corners[0]);
    p.winding = unit(cross(p.edges[0], p.edges[1]));
    s.viewer = scaled(by->direction, -1.0);
    s.front = dot(p.winding, s.viewer) > 0.0;
    s.geometric = scaled(p.winding, s.front ? 1.0 : -1.0);
    find_axes(&p, by->direction);
    take_material(&p, by, &s);
    take_normals(&p, by, &s);
    return s;
}
