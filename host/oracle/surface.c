// Evaluates surfaces where paths meet them: rule 1, and materials after textures, colours and
// alpha. See surface.h.
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

// The hit triangle and the place on it.
typedef struct place {
    const oracle_triangle *triangle;
    const oracle_corner *corners; // [3]; NULL: no attributes
    const double *weights;        // barycentric
    vector edges[2];              // from the first vertex to the others
    vector winding;               // n_g on the side from which the winding is counter-clockwise
    // Change of the second and third vertex's weight if the ray moves aside by 1, along the
    // surface's slant and across it.
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

// ---- The pixel's view of the triangle -----------------------------------------------------------

// The two axes of the cone's section with the triangle's plane, per width of the cone. One axis
// runs across the ray. The other axis is longer, by the slant of the ray.
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

// Interpolates an attribute of the corners. If all three are equal, the result is exactly equal
// too.
static double here(const place *p, const double of[3])
{
    return of[0] + p->weights[1] * (of[1] - of[0]) + p->weights[2] * (of[2] - of[0]);
}

// The attribute's change along an axis.
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

// Looks up a texture; white if there is none. Records how near the look-up is to a jump.
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

// Computes coverage (rule 9). `slope` bounds the change of alpha.
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

// Interpolates the vertices' colours, and bounds the change of their alpha.
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
    // Base colour and emission.
    oracle_glance base = glance_at(p, by, ORACLE_BASE, s);
    oracle_glance emission = glance_at(p, by, ORACLE_EMISSION, s);
    for (int c = 0; c < 3; c++) {
        s->base.at[c] = m->base[c] * color[c] * base.rgba[c];
        s->emission.at[c] = m->emission[c] * emission.rgba[c];
    }
    // Metallic, roughness, transmission and specular.
    oracle_glance metal = glance_at(p, by, ORACLE_METALLIC, s);
    s->metallic = m->metallic * metal.rgba[2];
    s->roughness = m->roughness * metal.rgba[1];
    s->transmission = m->transmission * glance_at(p, by, ORACLE_TRANSMISSION, s).rgba[0];
    s->specular = m->specular * glance_at(p, by, ORACLE_SPECULAR, s).rgba[3];
    oracle_glance tint = glance_at(p, by, ORACLE_SPECULAR_COLOR, s);
    for (int c = 0; c < 3; c++)
        s->specular_color.at[c] = m->specular_color[c] * tint.rgba[c];
    // Clear coat and film.
    s->clearcoat = m->clearcoat * glance_at(p, by, ORACLE_CLEARCOAT, s).rgba[0];
    s->film = m->film * glance_at(p, by, ORACLE_IRIDESCENCE, s).rgba[0];
    double far = glance_at(p, by, ORACLE_IRIDESCENCE_THICKNESS, s).rgba[1];
    s->film_thickness = m->film_thickness[0] + far * (m->film_thickness[1] - m->film_thickness[0]);
    // Diffuse transmission and sheen.
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
    // Occlusion and coverage.
    double open = glance_at(p, by, ORACLE_OCCLUSION, s).rgba[0];
    s->occlusion = 1.0 - m->occlusion_strength * (1.0 - open);
    cover(m->alpha * color[3] * base.rgba[3], m->alpha * (slope + base.slope), by, s);
}

// ---- Normals ------------------------------------------------------------------------------------

// Interpolates the vertices' normals and normalises. False if that is impossible.
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

// Interpolates tangent and bitangent. False if a corner has none, or if their signs differ.
static bool find_tangents(const place *p, vector n, vector *tangent, vector *bitangent)
{
    if (!p->corners || p->corners[0].tangent[3] == 0.0)
        return false;
    double turn = p->corners[0].tangent[3];
    vector sum = {{0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++) {
        if (p->corners[i].tangent[3] != turn)
            return false;
        sum = plus(sum, scaled(vector_of(p->corners[i].tangent), p->weights[i]));
    }
    *tangent = unit(sum);
    *bitangent = scaled(cross(n, *tangent), turn);
    return true;
}

// Bends a normal by a texture. Without tangents the normal stays.
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

// Sets the strength and direction of anisotropy.
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

// The root mean square, over the triangle's edges, of the normals' change per length. Negative if
// the normals lean towards each other.
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

// n on the viewer's side: turned round, or mirrored in the plane across v if it spreads light.
static vector towards_viewer(vector n, vector v, bool spreads)
{
    double cosine = dot(n, v);
    if (cosine >= 0.0)
        return n;
    return spreads ? minus(n, scaled(v, 2.0 * cosine)) : scaled(n, -1.0);
}

static bool spreads_light(const surface *s)
{
    const oracle_material *m = s->material;
    bool glass = oracle_is_solid(m) || oracle_is_thin(m);
    bool sheen = !glass && largest_magnitude(s->sheen_color) > 0.0;
    return m->mirror < 0.0 && (s->roughness >= 0.01 || s->anisotropy > 0.0 || sheen);
}

// Rule 1: a texture bends the normal as the file has it. From inside it is turned round, as n_g is.
static void take_normals(const place *p, const arrival *by, surface *s)
{
    vector own = p->winding;
    bool smooth = interpolated_normal(p, &own);
    own = smooth ? own : p->winding;
    double side = s->front ? 1.0 : -1.0;
    s->lit = scaled(bent(p, by, ORACLE_NORMAL, own, s), side);
    s->normal = towards_viewer(s->lit, s->viewer, false);
    s->cosine = fmin(dot(s->normal, s->viewer), 1.0);
    if (smooth)
        s->curvature = curvature_of(p->triangle) * (dot(own, s->normal) < 0.0 ? -1.0 : 1.0);
    if (smooth && p->corners)
        s->jump = fmin(s->jump, s->cosine); // here the curvature changes its sign
    take_brush(p, by, own, s);
    if (by->lobes && spreads_light(s)) {
        s->normal = towards_viewer(s->lit, s->viewer, true);
        take_brush(p, by, own, s);
    }
    vector coat = scaled(bent(p, by, ORACLE_CLEARCOAT_NORMAL, own, s), side);
    bool rough_coat = by->lobes && s->clearcoat_roughness >= 0.01;
    s->clearcoat_normal = towards_viewer(coat, s->viewer, rough_coat);
    s->clearcoat_cosine = fmin(dot(s->clearcoat_normal, s->viewer), 1.0);
}

surface oracle_surface_at(const oracle_scene *scene, const oracle_hit *hit, const arrival *by)
{
    const oracle_triangle *triangle = &scene->triangles[hit->triangle];
    place p = {.triangle = triangle, .weights = hit->barycentric};
    p.corners = scene->corners ? scene->corners[hit->triangle] : NULL;
    surface s = {.triangle = hit->triangle, .index = triangle->material, .jump = INFINITY};
    s.material = &scene->materials[s.index];
    // Use the vertices' weights, not origin + distance·direction: the point is exact in the plane.
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
