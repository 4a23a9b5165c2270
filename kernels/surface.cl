// Surfaces where rays meet them: place, normals and material. The rules are those of ARCHITECTURE.md,
// "Light transport".

#if GLINT_FACETS
// What stands in a surface's place where it is rough glass, see facets.cl.
typedef struct facet {
    mask there;
    real3 normal;       // of the surface: shading normal with n·v ≥ 0; the facet's is the surface's
    real cosine;        // n·v
    real alpha_squared; // α²
    real root;          // √(α² + (1 − α²) (n·v)²)
    real width;         // what a direction's facets turn within, an angle
} facet;
#endif

// A hit, ready for optics.
typedef struct surface {
    real3 position;         // on the triangle, stored coordinates
#if LOCAL_RAYS
    real3 position_low; // what that lacks
#endif
#if GLINT_LOCAL_ORIGINS
    real size; // the largest magnitude of its corners' coordinates, from the anchor
#endif
    real offset;            // how far from it a ray must start, along the geometric normal
    real3 geometric_normal; // unit, towards the viewer
    real3 lit_normal;       // unit shading normal, of which light is received
    real3 normal;           // the same with n·v ≥ 0
    real cosine;            // n·v
#if HEEDS_CURVATURE
    real curvature; // seen from the viewer's side: more than 0 where it is convex
#endif
    mask outside; // the viewer is on the side from which the triangle winds left
    real3 base_color, emission;
    real metallic, transmission, ior, blend;
#if GLINT_ROUGH || GLINT_FACETS
    real roughness;
#endif
#if GLINT_SPECULAR
    real specular;        // of a dielectric's reflection
    real3 specular_color; // of what it reflects at right angles
#endif
#if GLINT_CLEARCOAT
    real clearcoat; // how much of a clear coat there is, which is not to be seen from within a solid
    real clearcoat_roughness;
    real3 clearcoat_normal; // as `normal`
    real clearcoat_cosine;  // n·v of that
#endif
#if GLINT_DIFFUSE_TRANSMISSION
    real through;        // how much of what matte paint sends on comes from behind
    real3 through_color; // and its colour
    real3 behind;        // what lights it there: irradiance over π; set by light_from_behind
#endif
#if GLINT_SHEEN
    real3 sheen_color;
    real sheen_roughness;
#endif
#if GLINT_BRUSHED
    real anisotropy; // 0 where there is no tangent, too
    real brush_x, brush_y; // along tangent and bitangent, in which direction it is rougher
    real3 along; // that direction, a unit vector at right angles to `normal`
    real along_cosine; // v·along
#endif
#if GLINT_IRIDESCENCE
    real film; // how much of a thin film there is
    real film_ior, film_thickness; // nm
#endif
#if GLINT_DISPERSION
    scalar ior_step; // of the path's wavelength; set by disperse
#endif
#if GLINT_FACETS
    facet facet; // none is there until take_facet
#endif
#if GLINT_ALPHA
    real coverage; // how much of the surface is there; its alpha until cover_surface
    real alpha_cutoff;
#endif
#if GLINT_TEXTURES
    real occlusion; // what is left of the irradiance
#endif
#if GLINT_NORMAL_MAPS
    real3 bump; // the normal along tangent, bitangent and normal
#if GLINT_CLEARCOAT
    real3 clearcoat_bump; // likewise
#endif
#endif
#if GLINT_LIGHTS
    real3 direct; // irradiance over π that lights send; 0 until meet_surfaces
#if GLINT_ROUGH
    real3 shine_base, shine_edge; // lobe_light's parts of the lights; likewise
#if GLINT_CLEARCOAT
    real3 clearcoat_shine; // what a whole coat shows of the lights; likewise
#endif
#if GLINT_SHEEN
    real3 sheen_shine; // what white sheen does; likewise
#endif
#endif
#endif
    lanes_int flags, medium;
#if GLINT_OVERLAPS
    lanes_int media_before, media_beyond; // the stacks on both sides; set by find_surface_in_place
    mask media_lost;
#endif
} surface;

// Hits have places: rays start there, or the environment is seen from there.
#define HAS_PLACES (GLINT_INTERREFLECTION || GLINT_PROXY || GLINT_LIGHTS)
// Light may pass surfaces.
#define TRANSMITS (GLINT_GLASS || GLINT_ALPHA)
// Paths may go on from a clear coat beside those from what is below.
#define COATS_APART (GLINT_CLEARCOAT && GLINT_SPLIT)
#if TRANSMITS || COATS_APART
#define TWO_WAYS 1
#else
#define TWO_WAYS 0
#endif
#if GLINT_DISPERSION
#define IOR_STEP(surface) (surface)->ior_step
#else
#define IOR_STEP(surface) R(0.0)
#endif
#define HAS_FLAG(surface, flag) (((surface).flags & (lane_int)(flag)) != (lane_int)0)

// The geometric normal, as long as twice the triangle's area.
static inline real3 normal_of(const real3 vertices[3])
{
    return cross3(subtract(vertices[1], vertices[0]), subtract(vertices[2], vertices[0]));
}

// A vertex without a usable normal is (0, 0, 0); then the geometric normal serves.
static inline mask normals_given(const real3 normals[3])
{
    return !(is_zero3(normals[0]) | is_zero3(normals[1]) | is_zero3(normals[2]));
}

static inline real3 interpolate(const real3 vertices[3], real b1, real b2)
{
    real b0 = R(1.0) - b1 - b2;
    return scale_add(vertices[2], b2, scale_add(vertices[1], b1, scale(vertices[0], b0)));
}

#if LOCAL_RAYS
// Sets a surface's position to the sum of two floats along each axis.
static inline void set_position(surface *s, pair x, pair y, pair z)
{
    s->position = real3_of(x.high, y.high, z.high);
    s->position_low = real3_of(x.low, y.low, z.low);
}

// How far primary rays run to a triangle that is large beside that way. measure_hits takes it from
// the corners, which have no digits left for it; the plane has.
static inline void measure_nearby(const path *ray, const triangle *t, mask met, closest *hit)
{
    real size = real_of(0), corners[9];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        corners[3 * k] = t->vertices[k].x;
        corners[3 * k + 1] = t->vertices[k].y;
        corners[3 * k + 2] = t->vertices[k].z;
        size = LARGER(size, largest_magnitude3(t->vertices[k]));
    }
    const mask nearby = met & (LARGE_TRIANGLE * hit->t < size);
    if (!any_lane(nearby)) {
        return;
    }
    const real anchor[3] = {t->anchor.x, t->anchor.y, t->anchor.z};
    const real origin[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const real low[3] = {ray->origin_low.x, ray->origin_low.y, ray->origin_low.z};
    const real d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const real found = depth_of_plane(corners, anchor, origin, low, d);
    const mask sound = (found > R(0.0)) & (LARGE_TRIANGLE * fabs(found - hit->t) < size);
    hit->t = SELECT(nearby & sound, found, hit->t);
}

// On a triangle that is large beside the ray's way to it the place is told from the ray's origin,
// which is nearer than the corners. It is then off the plane by roundings of that way alone; or,
// where the plane was not looked at again, of corners up to LARGE_TRIANGLE times as far. What a ray
// from there meets next to nothing away is no mistake: distance_nearby tells it as exactly.
static inline void place_nearby(const path *ray, const closest *hit, surface *s)
{
    const mask nearby = LARGE_TRIANGLE * hit->t < s->size;
    if (!any_lane(nearby)) {
        return;
    }
    surface there = *s;
    const real3 d = ray->direction, o = ray->origin, low = ray->origin_low;
    set_position(&there, sum_of(o.x, fused(d.x, hit->t, low.x)),
                 sum_of(o.y, fused(d.y, hit->t, low.y)), sum_of(o.z, fused(d.z, hit->t, low.z)));
    const real3 n = s->geometric_normal;
    const real across = fabs(n.x * d.x) + fabs(n.y * d.y) + fabs(n.z * d.z);
    s->position = select3(nearby, there.position, s->position);
    s->position_low = select3(nearby, there.position_low, s->position_low);
    s->offset = SELECT(nearby, START_OFFSET * across * (LARGE_TRIANGLE * hit->t), s->offset);
}
#endif

// The position, and a bound of its distance to the triangle's plane: the interpolation makes about
// 8 roundings of values no larger than the largest vertex, coordinate by coordinate (Pharr, Jakob,
// Humphreys, Physically Based Rendering, 6.8). A ray that starts this far off the plane, on the
// side that it leaves to, cannot meet the neighbours of its triangle because of rounding.
static inline void place_on_triangle(const triangle *t, const path *ray, const closest *hit,
                                     surface *s)
{
    const real3 *vertices = t->vertices;
    s->position = interpolate(vertices, hit->b1, hit->b2);
    real3 reach;
    reach.x = LARGER(fabs(vertices[0].x), LARGER(fabs(vertices[1].x), fabs(vertices[2].x)));
    reach.y = LARGER(fabs(vertices[0].y), LARGER(fabs(vertices[1].y), fabs(vertices[2].y)));
    reach.z = LARGER(fabs(vertices[0].z), LARGER(fabs(vertices[1].z), fabs(vertices[2].z)));
    real3 n = real3_of(fabs(s->geometric_normal.x), fabs(s->geometric_normal.y),
                       fabs(s->geometric_normal.z));
    s->offset = START_OFFSET * dot3(n, reach);
#if GLINT_LOCAL_ORIGINS
    s->size = largest3(reach);
#if LOCAL_RAYS
    const real3 at = s->position;
    set_position(s, sum_of(t->anchor.x, at.x), sum_of(t->anchor.y, at.y),
                 sum_of(t->anchor.z, at.z));
    place_nearby(ray, hit, s);
#else
    s->position = add(t->anchor, s->position);
#endif
#endif
}

// Lets a ray start from a surface, so far off it along the geometric normal.
static inline void start_off_surface(path *ray, const surface *s, real offset)
{
#if LOCAL_RAYS
    ray->origin = s->position;
    ray->origin_low = scale_add(s->geometric_normal, offset, s->position_low);
#else
    ray->origin = scale_add(s->geometric_normal, offset, s->position);
#endif
}

#if GLINT_NORMAL_MAPS
// Along u and v of a texture, at right angles to the unit vector `n`: which hits have them.
static inline mask find_tangents(const scene_buffers *scene, const closest *hit, mask met, real3 n,
                                 real3 *tangent, real3 *bitangent)
{
    const corner_values c = load_corners(scene, hit->place, met, TANGENTS_AT, 4);
    const real3 sum = real3_of(value_of_corners(&c, 0, hit->b1, hit->b2),
                               value_of_corners(&c, 1, hit->b1, hit->b2),
                               value_of_corners(&c, 2, hit->b1, hit->b2));
    // Corners that turn different ways have no bitangent between them.
    const mask alike = (c.first[3] != R(0.0)) & (c.second_more[3] == R(0.0)) &
                       (c.third_more[3] == R(0.0));
    mask valid;
    *tangent = normalized(sum, &valid);
    *bitangent = scale(cross3(n, *tangent), c.first[3]);
    return met & alike & valid;
}

// The normal that a texture bends: `n` is a unit vector. What is not there leaves it as it is.
static inline real3 bent_normal(const scene_buffers *scene, const closest *hit, mask met, real3 n,
                                real3 bump)
{
    real3 tangent, bitangent;
    const mask there = find_tangents(scene, hit, met, n, &tangent, &bitangent);
    mask sound;
    const real3 bent = normalized(
        scale_add(n, bump.z, scale_add(bitangent, bump.y, scale(tangent, bump.x))), &sound);
    const mask flat = (bump.x == R(0.0)) & (bump.y == R(0.0));
    return select3(there & sound & !flat, bent, n);
}
#endif

#if GLINT_BRUSHED
// The direction in which the surface is rougher; `own` is its normal as the file has it.
static inline void orient_brush(const scene_buffers *scene, const closest *hit, real3 own, real3 v,
                                surface *s)
{
    real3 tangent, bitangent;
    const mask there =
        find_tangents(scene, hit, hit->place >= (lane_int)0, own, &tangent, &bitangent);
    const real3 along = scale_add(bitangent, s->brush_y, scale(tangent, s->brush_x));
    mask valid;
    s->along = normalized(scale_add(s->normal, -dot3(along, s->normal), along), &valid);
    s->anisotropy = SELECT(there & valid, s->anisotropy, real_of(0));
    s->along_cosine = dot3(s->along, v);
}
#endif

// Rule 1: the side is the geometric normal's alone; both normals are turned to the viewer.
static inline void orient_normals(const scene_buffers *scene, const triangle *t, const path *ray,
                                  const closest *hit, surface *s)
{
    real3 v = negate(ray->direction);
    real facing = dot3(s->geometric_normal, v);
    s->outside = facing > R(0.0);
    s->geometric_normal = select3(s->outside, s->geometric_normal, negate(s->geometric_normal));
    s->lit_normal = s->geometric_normal;
#if HEEDS_CURVATURE
    s->curvature = real_of(0);
#endif
#if GLINT_SMOOTH_NORMALS
    const real3 *normals = t->normals;
    const mask given = normals_given(normals);
    mask valid;
    real3 n = normalized(interpolate(normals, hit->b1, hit->b2), &valid);
    mask against = dot3(n, s->geometric_normal) < R(0.0);
    n = select3(against, negate(n), n);
    s->lit_normal = select3(given & valid, n, s->geometric_normal);
#endif
#if GLINT_NORMAL_MAPS
#if GLINT_SMOOTH_NORMALS
    const mask turned_round = SELECT(given & valid, against, !s->outside);
#else
    const mask turned_round = !s->outside;
#endif
    // Textures bend the normal as the file has it.
    const real3 own = select3(turned_round, negate(s->lit_normal), s->lit_normal);
    const real3 bent = bent_normal(scene, hit, hit->place >= (lane_int)0, own, s->bump);
    s->lit_normal = select3(turned_round, negate(bent), bent);
#endif
#if GLINT_CLEARCOAT && GLINT_NORMAL_MAPS
    const real3 coat = bent_normal(scene, hit, hit->place >= (lane_int)0, own, s->clearcoat_bump);
    const real up = dot3(coat, v);
    s->clearcoat_normal = select3(up < R(0.0), negate(coat), coat);
    s->clearcoat_cosine = SMALLER(fabs(up), real_of(1));
#endif
    real cosine = dot3(s->lit_normal, v);
    mask away = cosine < R(0.0);
    s->normal = select3(away, negate(s->lit_normal), s->lit_normal);
#if HEEDS_CURVATURE && GLINT_SMOOTH_NORMALS
    // Flat where a vertex has no normal.
    const real curvature = curvature_of(t->vertices, normals);
    mask turned = dot3(interpolate(normals, hit->b1, hit->b2), s->normal) < R(0.0);
    s->curvature = SELECT(given & valid, SELECT(turned, -curvature, curvature), s->curvature);
#endif
    cosine = fabs(cosine);
    s->cosine = SMALLER(cosine, real_of(1));
#if GLINT_BRUSHED
    orient_brush(scene, hit, own, v, s);
#endif
#if GLINT_CLEARCOAT && !GLINT_NORMAL_MAPS
    s->clearcoat_normal = s->normal;
    s->clearcoat_cosine = s->cosine;
#endif
}

// Sets what the compiled features need of a material, for the rays in `yes`.
static inline void set_material(surface *s, mask yes, global const glint_material_record *m)
{
    s->base_color.x = SELECT(yes, real_of(m->base_color[0]), s->base_color.x);
    s->base_color.y = SELECT(yes, real_of(m->base_color[1]), s->base_color.y);
    s->base_color.z = SELECT(yes, real_of(m->base_color[2]), s->base_color.z);
    if (GLINT_EMISSION) {
        s->emission.x = SELECT(yes, real_of(m->emission[0]), s->emission.x);
        s->emission.y = SELECT(yes, real_of(m->emission[1]), s->emission.y);
        s->emission.z = SELECT(yes, real_of(m->emission[2]), s->emission.z);
    }
#if GLINT_ALPHA
    s->coverage = SELECT(yes, real_of(m->base_color[3]), s->coverage);
    s->alpha_cutoff = SELECT(yes, real_of(m->alpha_cutoff), s->alpha_cutoff);
#endif
    s->metallic = SELECT(yes, real_of(m->metallic), s->metallic);
    s->transmission = SELECT(yes, real_of(m->transmission), s->transmission);
    s->ior = SELECT(yes, real_of(m->ior), s->ior);
#if GLINT_ROUGH || GLINT_FACETS
    s->roughness = SELECT(yes, real_of(m->roughness), s->roughness);
#endif
#if GLINT_SPECULAR
    s->specular = SELECT(yes, real_of(m->specular), s->specular);
    s->specular_color.x = SELECT(yes, real_of(m->specular_color[0]), s->specular_color.x);
    s->specular_color.y = SELECT(yes, real_of(m->specular_color[1]), s->specular_color.y);
    s->specular_color.z = SELECT(yes, real_of(m->specular_color[2]), s->specular_color.z);
#endif
#if GLINT_CLEARCOAT
    s->clearcoat = SELECT(yes, real_of(m->clearcoat), s->clearcoat);
    s->clearcoat_roughness =
        SELECT(yes, real_of(m->clearcoat_roughness), s->clearcoat_roughness);
#endif
#if GLINT_DIFFUSE_TRANSMISSION
    s->through = SELECT(yes, real_of(m->diffuse_transmission), s->through);
    global const float *through = m->diffuse_transmission_color;
    s->through_color.x = SELECT(yes, real_of(through[0]), s->through_color.x);
    s->through_color.y = SELECT(yes, real_of(through[1]), s->through_color.y);
    s->through_color.z = SELECT(yes, real_of(through[2]), s->through_color.z);
#endif
#if GLINT_SHEEN
    s->sheen_color.x = SELECT(yes, real_of(m->sheen_color[0]), s->sheen_color.x);
    s->sheen_color.y = SELECT(yes, real_of(m->sheen_color[1]), s->sheen_color.y);
    s->sheen_color.z = SELECT(yes, real_of(m->sheen_color[2]), s->sheen_color.z);
    s->sheen_roughness = SELECT(yes, real_of(m->sheen_roughness), s->sheen_roughness);
#endif
#if GLINT_BRUSHED
    s->anisotropy = SELECT(yes, real_of(m->anisotropy), s->anisotropy);
    s->brush_x = SELECT(yes, real_of(m->brush_direction[0]), s->brush_x);
    s->brush_y = SELECT(yes, real_of(m->brush_direction[1]), s->brush_y);
#endif
#if GLINT_IRIDESCENCE
    s->film = SELECT(yes, real_of(m->iridescence), s->film);
    s->film_ior = SELECT(yes, real_of(m->iridescence_ior), s->film_ior);
    s->film_thickness = SELECT(yes, real_of(m->iridescence_thickness[1]), s->film_thickness);
#endif
    s->blend = SELECT(yes, real_of(m->blend), s->blend);
    s->flags = SELECT(yes, int_of((lane_int)m->flags), s->flags);
    s->medium = SELECT(yes, int_of((lane_int)m->medium), s->medium);
}

static inline void load_materials(const scene_buffers *scene, const triangle *t, surface *s)
{
    set_material(s, mask_all(), scene->materials);
#if GLINT_MANY_MATERIALS
    uint left = mask_bits(t->material != (lane_int)0);
    while (left != 0) {
        int number;
        mask here = next_alike(t->material, &left, &number);
        set_material(s, here, scene->materials + number);
    }
#endif
}
