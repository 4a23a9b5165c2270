// Describes surfaces where rays meet them: position, normals and material. The rules are those of
// docs/light_transport.md.

#if GLINT_FACETS
// A microfacet of rough glass, which replaces the surface; see facets.cl.
typedef struct facet {
    mask there;
    // The surface's own shading normal, with n·v ≥ 0. The facet's normal stands in surface.normal.
    real3 normal;
    real cosine;        // n·v
    real alpha_squared; // α²
    real root;          // √(α² + (1 − α²) (n·v)²)
    real width;         // angle within which the facets of one direction lie
} facet;
#endif

// A hit, ready for optics.
typedef struct surface {
    real3 position;         // on the triangle, stored coordinates
#if LOCAL_RAYS
    real3 position_low; // the low parts of the position
#endif
#if GLINT_LOCAL_ORIGINS
    real size; // largest magnitude of the corners' coordinates, from the anchor
#endif
#if LOCAL_RAYS
    real along_normal; // the corners' coordinates along the normal: their rounding is a share of it
#endif
    real offset; // distance off the surface at which rays must start, along the geometric normal
    real3 geometric_normal; // unit, towards the viewer
    real3 lit_normal;       // unit shading normal on the side that receives light
    real3 normal;           // lit_normal, turned so that n·v ≥ 0
    real cosine;            // n·v
#if HEEDS_CURVATURE
    real curvature; // seen from the viewer's side: above 0 if convex
#endif
    mask outside; // the viewer is on the side from which the triangle winds left
    real3 base_color, emission;
    real metallic, transmission, ior, blend;
    real roughness;
#if GLINT_SPECULAR
    real specular;        // factor of a dielectric's reflection
    real3 specular_color; // factor of its reflection at right angles
#endif
#if GLINT_CLEARCOAT
    real clearcoat; // amount of clear coat; 0 from within a solid
    real clearcoat_roughness;
    real3 clearcoat_normal; // unit, with n·v ≥ 0
    real clearcoat_cosine;  // n·v of the coat's normal
#endif
#if GLINT_DIFFUSE_TRANSMISSION
    real through;        // share of matte paint's light that comes from behind
    real3 through_color; // colour of the light from behind
    real3 behind;        // irradiance over π from behind; set by light_from_behind
#endif
#if GLINT_SHEEN
    real3 sheen_color;
    real sheen_roughness;
#endif
#if GLINT_BRUSHED
    real anisotropy; // 0 also if there is no tangent
    real brush_x, brush_y; // direction of larger roughness, along tangent and bitangent
    real3 along; // this direction as a unit vector at right angles to `normal`
    real along_cosine; // v·along
#endif
#if GLINT_IRIDESCENCE
    real film; // amount of thin film
    real film_ior, film_thickness; // nm
#endif
#if GLINT_DISPERSION
    scalar ior_step; // of the path's wavelength; set by disperse
#endif
#if GLINT_FACETS
    facet facet; // absent until take_facet
#endif
#if GLINT_ALPHA
    real coverage; // coverage of the surface; its alpha until cover_surface
    real alpha_cutoff;
#endif
#if GLINT_TEXTURES
    real occlusion; // remaining share of the irradiance
#endif
#if GLINT_NORMAL_MAPS
    real3 bump; // normal of the texture, along tangent, bitangent and normal
#if GLINT_CLEARCOAT
    real3 clearcoat_bump; // normal of the coat's texture
#endif
#endif
#if GLINT_LIGHTS
    real3 direct; // irradiance over π from lights; 0 until meet_surfaces
#if GLINT_ROUGH
    real3 shine_base, shine_edge; // lobe_light's parts of the lights; 0 until meet_surfaces
#if GLINT_CLEARCOAT
    real3 clearcoat_shine; // light of a full coat from the lights; 0 until meet_surfaces
#endif
#if GLINT_SHEEN
    real3 sheen_shine; // light of white sheen from the lights; 0 until meet_surfaces
#endif
#endif
#endif
    lanes_int flags, medium;
#if GLINT_OVERLAPS
    lanes_int media_before, media_beyond; // the stacks on both sides; set by find_surface_in_place
    mask media_lost;
#endif
} surface;

// Hits need positions: rays start there, or see the environment from there.
#define HAS_PLACES (GLINT_INTERREFLECTION || GLINT_PROXY || GLINT_LIGHTS)
// Light may pass surfaces.
#define TRANSMITS (GLINT_GLASS || GLINT_ALPHA)
// A clear coat may have its own branch beside the branch from the layers below.
#define COATS_APART (GLINT_CLEARCOAT && GLINT_SPLIT)
#if TRANSMITS || COATS_APART
#define TWO_WAYS (HAS(GLASS) || HAS(ALPHA) || (HAS(CLEARCOAT) && HAS(SPLIT)))
#else
#define TWO_WAYS false
#endif
#if GLINT_DISPERSION
#define IOR_STEP(surface) (surface)->ior_step
#else
#define IOR_STEP(surface) R(0.0)
#endif
#define HAS_FLAG(surface, flag) (((surface).flags & (lane_int)(flag)) != (lane_int)0)

// The geometric normal; its length is twice the triangle's area.
static inline real3 normal_of(const real3 vertices[3])
{
    return cross3(subtract(vertices[1], vertices[0]), subtract(vertices[2], vertices[0]));
}

// A vertex without a usable normal has (0, 0, 0). Then the geometric normal is used.
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

// The distance of primary rays to a triangle that is large compared with it. measure_hits computes
// it from the corners, which have no digits left for it. The plane has these digits.
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

// On a triangle that is large compared with the ray's distance, the position is computed from the
// ray's origin, which is nearer than the corners. Its error off the plane then comes only from this
// distance. If the plane was not measured again, the error comes from corners up to LARGE_TRIANGLE
// times as far. A ray from this position may hit a surface at a very short distance. Such a hit is
// correct: distance_nearby measures it with the same precision.
static inline void place_nearby(const scene_buffers *scene, const path *ray, const closest *hit,
                                surface *s)
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
    s->offset = SELECT(nearby, START_OFFSET(scene) * across * (LARGE_TRIANGLE * hit->t), s->offset);
}
#endif

// Sets the position, and a bound of its distance to the triangle's plane. The interpolation makes
// about 8 roundings of values no larger than the largest vertex, coordinate by coordinate (Pharr,
// Jakob, Humphreys, Physically Based Rendering, 6.8). A ray starts this far off the plane, on the
// side that it leaves to. So rounding cannot make it hit the neighbours of its triangle.
static inline void place_on_triangle(const scene_buffers *scene, const triangle *t, const path *ray,
                                     const closest *hit, surface *s)
{
    const real3 *vertices = t->vertices;
    s->position = interpolate(vertices, hit->b1, hit->b2);
    real3 reach;
    reach.x = LARGER(fabs(vertices[0].x), LARGER(fabs(vertices[1].x), fabs(vertices[2].x)));
    reach.y = LARGER(fabs(vertices[0].y), LARGER(fabs(vertices[1].y), fabs(vertices[2].y)));
    reach.z = LARGER(fabs(vertices[0].z), LARGER(fabs(vertices[1].z), fabs(vertices[2].z)));
    real3 n = real3_of(fabs(s->geometric_normal.x), fabs(s->geometric_normal.y),
                       fabs(s->geometric_normal.z));
    const real along_normal = dot3(n, reach);
    s->offset = START_OFFSET(scene) * along_normal;
#if GLINT_LOCAL_ORIGINS
    s->size = largest3(reach);
#if LOCAL_RAYS
    s->along_normal = along_normal;
    s->position_low = real3_of(real_of(0), real_of(0), real_of(0));
    if (HAS(LOCAL_ORIGINS)) {
        const real3 at = s->position;
        set_position(s, sum_of(t->anchor.x, at.x), sum_of(t->anchor.y, at.y),
                     sum_of(t->anchor.z, at.z));
        place_nearby(scene, ray, hit, s);
    }
#else
    s->position = add(t->anchor, s->position);
#endif
#endif
}

// Starts a ray from a surface, at the distance `offset` along the geometric normal.
static inline void start_off_surface(const scene_buffers *scene, path *ray, const surface *s,
                                     real offset)
{
    ray->origin = scale_add(s->geometric_normal, offset, s->position);
#if LOCAL_RAYS
    ray->origin_low = real3_of(real_of(0), real_of(0), real_of(0));
    if (HAS(LOCAL_ORIGINS)) {
        ray->origin = s->position;
        ray->origin_low = scale_add(s->geometric_normal, offset, s->position_low);
    }
#endif
}

#if GLINT_NORMAL_MAPS
// Finds unit vectors along u and v of a texture, at right angles to the unit vector `n`. Returns
// the hits that have them.
static inline mask find_tangents(const scene_buffers *scene, const closest *hit, mask met, real3 n,
                                 real3 *tangent, real3 *bitangent)
{
    const corner_values c = load_corners(scene, hit->place, met, TANGENTS_AT, 4);
    const real3 sum = real3_of(value_of_corners(&c, 0, hit->b1, hit->b2),
                               value_of_corners(&c, 1, hit->b1, hit->b2),
                               value_of_corners(&c, 2, hit->b1, hit->b2));
    // Corners whose tangents turn in different directions have no bitangent between them.
    const mask alike = (c.first[3] != R(0.0)) & (c.second_more[3] == R(0.0)) &
                       (c.third_more[3] == R(0.0));
    mask valid;
    *tangent = normalized(sum, &valid);
    *bitangent = scale(cross3(n, *tangent), c.first[3]);
    return met & alike & valid;
}

// The normal bent by a texture; `n` is a unit vector. Without a tangent or a bump it stays n.
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

#if GLINT_ROUGH || GLINT_FACETS
#if GLINT_BRUSHED
// The direction along which the texture is rougher; `own` is the normal as in the file. Without
// tangents a surface is not brushed.
static inline real3 brush_direction(const scene_buffers *scene, const closest *hit, real3 own,
                                    surface *s)
{
    real3 tangent, bitangent;
    const mask there =
        find_tangents(scene, hit, hit->place >= (lane_int)0, own, &tangent, &bitangent);
    s->anisotropy = SELECT(there, s->anisotropy, real_of(0));
    return scale_add(bitangent, s->brush_y, scale(tangent, s->brush_x));
}
#endif

#if GLINT_ROUGH
// Rule 11: finds the surfaces that reflect lobes.
static inline mask are_rough(const scene_buffers *scene, const surface *s)
{
    if (!HAS(ROUGH)) {
        return mask_none();
    }
    const lane_int smooth = GLINT_MATERIAL_SOLID | GLINT_MATERIAL_THIN | GLINT_MATERIAL_BLEND |
                            GLINT_MATERIAL_UNLIT;
    mask rough = s->roughness >= (scalar)GLINT_ROUGHNESS_LEAST;
#if GLINT_BRUSHED
    rough = rough | (s->anisotropy > R(0.0));
#endif
    return rough & ((s->flags & smooth) == (lane_int)0);
}
#endif

#if GLINT_FACETS
// Rule 12: finds the surfaces that have facets.
static inline mask are_faceted(const surface *s)
{
    const lane_int glass = GLINT_MATERIAL_SOLID | GLINT_MATERIAL_THIN;
    mask faceted = (s->roughness >= (scalar)GLINT_ROUGHNESS_LEAST) &
                   ((s->flags & glass) != (lane_int)0);
#if GLINT_ALPHA
    faceted = faceted & (s->coverage > R(0.0));
#endif
    return faceted;
}
#endif

// Finds surfaces that send light in many directions: lobes, sheen, facets.
static inline mask do_spread(const scene_buffers *scene, const surface *s)
{
    mask spread = mask_none();
#if GLINT_ROUGH
    spread = are_rough(scene, s);
#if GLINT_SHEEN
    const lane_int others = GLINT_MATERIAL_SOLID | GLINT_MATERIAL_THIN | GLINT_MATERIAL_BLEND |
                            GLINT_MATERIAL_UNLIT;
    if (HAS(SHEEN)) {
        spread = spread | ((largest3(s->sheen_color) > R(0.0)) &
                           ((s->flags & others) == (lane_int)0));
    }
#endif
#endif
#if GLINT_FACETS
    spread = HAS(FACETS) ? spread | are_faceted(s) : spread;
#endif
    return spread;
}

// The normal about which light is spread, on the viewer's side. A normal that points away is folded
// across the plane at right angles to v, as directions are. Unlike −n it does not jump there.
static inline real3 folded_to_viewer(real3 n, real3 v)
{
    return scale_add(v, R(-2.0) * dot3(n, v), n);
}

// Orients the normal for lobes, sheen and facets. The normals in `away` point away from the viewer.
static inline void orient_lobes(const scene_buffers *scene, const closest *hit, real3 own, real3 v,
                                mask away, surface *s)
{
#if GLINT_BRUSHED
    s->along = s->normal;
    if (HAS(BRUSHED)) {
        s->along = brush_direction(scene, hit, own, s);
    } else {
        s->anisotropy = s->along_cosine = real_of(0);
    }
#endif
    const mask folds = away & do_spread(scene, s);
    s->normal = select3(folds, folded_to_viewer(s->lit_normal, v), s->normal);
#if GLINT_BRUSHED
    if (HAS(BRUSHED)) {
        mask valid;
        s->along = normalized(scale_add(s->normal, -dot3(s->along, s->normal), s->along), &valid);
        s->anisotropy = SELECT(valid, s->anisotropy, real_of(0));
        s->along_cosine = dot3(s->along, v);
    }
#endif
}
#endif

#if GLINT_CLEARCOAT
// Orients the coat's normal; `own` is the normal as in the file.
static inline void orient_clearcoat(const scene_buffers *scene, const closest *hit, real3 own,
                                    real3 v, surface *s)
{
    real3 coat = own;
#if GLINT_NORMAL_MAPS
    if (HAS(CLEARCOAT) && HAS(NORMAL_MAPS)) {
        coat = bent_normal(scene, hit, hit->place >= (lane_int)0, own, s->clearcoat_bump);
    }
#endif
    coat = select3(s->outside, coat, negate(coat));
    const real up = dot3(coat, v);
    const mask away = up < R(0.0);
    s->clearcoat_normal = select3(away, negate(coat), coat);
    s->clearcoat_cosine = SMALLER(fabs(up), real_of(1));
#if GLINT_ROUGH
    const mask folds = away & (s->clearcoat_roughness >= (scalar)GLINT_ROUGHNESS_LEAST);
    s->clearcoat_normal =
        select3(HAS(ROUGH) ? folds : mask_none(), folded_to_viewer(coat, v), s->clearcoat_normal);
#endif
}
#endif

// Rule 1: the geometric normal alone decides the side, once for a triangle. From inside both normals
// are turned round. A shading normal that leans beyond the triangle's plane stays as it is.
static inline void orient_normals(const scene_buffers *scene, const triangle *t, const path *ray,
                                  const closest *hit, surface *s)
{
    real3 v = negate(ray->direction);
    real facing = dot3(s->geometric_normal, v);
    s->outside = facing > R(0.0);
#if HEEDS_CURVATURE
    s->curvature = real_of(0);
#endif
    // The shading normal as the file has it.
    real3 own = s->geometric_normal;
#if GLINT_SMOOTH_NORMALS
    const real3 *normals = t->normals;
    const mask given = normals_given(normals);
    mask valid;
    real3 n = normalized(interpolate(normals, hit->b1, hit->b2), &valid);
    own = select3(given & valid, n, own);
#endif
    // Textures bend it.
    real3 bent = own;
#if GLINT_NORMAL_MAPS
    if (HAS(NORMAL_MAPS)) {
        bent = bent_normal(scene, hit, hit->place >= (lane_int)0, own, s->bump);
    }
#endif
    // Turn both normals to the viewer's side.
    s->lit_normal = select3(s->outside, bent, negate(bent));
    s->geometric_normal = select3(s->outside, s->geometric_normal, negate(s->geometric_normal));
    // Turn the shading normal to the viewer.
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
#if GLINT_ROUGH || GLINT_FACETS
    orient_lobes(scene, hit, own, v, away, s);
#endif
#if GLINT_CLEARCOAT
    orient_clearcoat(scene, hit, own, v, s);
#endif
}

// Sets the material's values that the features need, for the rays in `yes`.
static inline void set_material(const scene_buffers *scene, surface *s, mask yes,
                                global const glint_material_record *m)
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
    s->roughness = SELECT(yes, real_of(m->roughness), s->roughness);
#if GLINT_SPECULAR
    if (HAS(SPECULAR)) {
        s->specular = SELECT(yes, real_of(m->specular), s->specular);
        s->specular_color.x = SELECT(yes, real_of(m->specular_color[0]), s->specular_color.x);
        s->specular_color.y = SELECT(yes, real_of(m->specular_color[1]), s->specular_color.y);
        s->specular_color.z = SELECT(yes, real_of(m->specular_color[2]), s->specular_color.z);
    }
#endif
#if GLINT_CLEARCOAT
    s->clearcoat = SELECT(yes, real_of(m->clearcoat), s->clearcoat);
    s->clearcoat_roughness =
        SELECT(yes, real_of(m->clearcoat_roughness), s->clearcoat_roughness);
#endif
#if GLINT_DIFFUSE_TRANSMISSION
    if (HAS(DIFFUSE_TRANSMISSION)) {
        s->through = SELECT(yes, real_of(m->diffuse_transmission), s->through);
        global const float *through = m->diffuse_transmission_color;
        s->through_color.x = SELECT(yes, real_of(through[0]), s->through_color.x);
        s->through_color.y = SELECT(yes, real_of(through[1]), s->through_color.y);
        s->through_color.z = SELECT(yes, real_of(through[2]), s->through_color.z);
    }
#endif
#if GLINT_SHEEN
    if (HAS(SHEEN)) {
        s->sheen_color.x = SELECT(yes, real_of(m->sheen_color[0]), s->sheen_color.x);
        s->sheen_color.y = SELECT(yes, real_of(m->sheen_color[1]), s->sheen_color.y);
        s->sheen_color.z = SELECT(yes, real_of(m->sheen_color[2]), s->sheen_color.z);
        s->sheen_roughness = SELECT(yes, real_of(m->sheen_roughness), s->sheen_roughness);
    }
#endif
#if GLINT_BRUSHED
    if (HAS(BRUSHED)) {
        s->anisotropy = SELECT(yes, real_of(m->anisotropy), s->anisotropy);
        s->brush_x = SELECT(yes, real_of(m->brush_direction[0]), s->brush_x);
        s->brush_y = SELECT(yes, real_of(m->brush_direction[1]), s->brush_y);
    }
#endif
#if GLINT_IRIDESCENCE
    if (HAS(IRIDESCENCE)) {
        s->film = SELECT(yes, real_of(m->iridescence), s->film);
        s->film_ior = SELECT(yes, real_of(m->iridescence_ior), s->film_ior);
        s->film_thickness = SELECT(yes, real_of(m->iridescence_thickness[1]), s->film_thickness);
    }
#endif
    s->blend = SELECT(yes, real_of(m->blend), s->blend);
    s->flags = SELECT(yes, int_of((lane_int)m->flags), s->flags);
    s->medium = SELECT(yes, int_of((lane_int)m->medium), s->medium);
}

static inline void load_materials(const scene_buffers *scene, const triangle *t, surface *s)
{
    set_material(scene, s, mask_all(), scene->materials);
#if GLINT_MANY_MATERIALS
    uint left = mask_bits(t->material != (lane_int)0);
    while (left != 0) {
        int number;
        mask here = next_alike(t->material, &left, &number);
        set_material(scene, s, here, scene->materials + number);
    }
#endif
}
