// Applies textures, vertex colours and alpha to a surface that a ray meets.

#if GLINT_TEXTURES

#if GLINT_NORMAL_MAPS
static inline real3 bump_of(const texture_color *c, float normal_scale)
{
    const scalar across = R(2.0) * (scalar)normal_scale;
    return real3_of(across * (c->r - R(0.5)), across * (c->g - R(0.5)), R(2.0) * c->b - R(1.0));
}
#endif

#if GLINT_BRUSHED
// Applies an anisotropy texture: its direction turns the material's direction, its strength scales
// the material's.
static inline void brush_by(const texture_color *c, mask here, surface *s)
{
    const real x = fused(c->r, real_of(2), real_of(-1)), y = fused(c->g, real_of(2), real_of(-1));
    const real length = sqrt(fused(x, x, y * y));
    const mask there = length > R(1e-3);
    const real inverse = R(1.0) / SELECT(there, length, real_of(1));
    const real turned_x = fused(s->brush_x, x, -s->brush_y * y) * inverse;
    const real turned_y = fused(s->brush_x, y, s->brush_y * x) * inverse;
    s->brush_x = SELECT(here & there, turned_x, s->brush_x);
    s->brush_y = SELECT(here & there, turned_y, s->brush_y);
    s->anisotropy = SELECT(here, s->anisotropy * c->b, s->anisotropy);
}
#endif

// Applies one of a material's textures to the rays in `here`. Most textures multiply the material's
// value.
static inline void take_texture(int slot, const texture_color *c, mask here,
                                global const glint_material_record *m, surface *s)
{
    const real3 rgb = real3_of(c->r, c->g, c->b);
    switch (slot) {
    case GLINT_SLOT_BASE_COLOR:
        s->base_color = select3(here, multiply(s->base_color, rgb), s->base_color);
#if GLINT_ALPHA
        s->coverage = SELECT(here, s->coverage * c->a, s->coverage);
#endif
        break;
    case GLINT_SLOT_METALLIC_ROUGHNESS:
        s->metallic = SELECT(here, s->metallic * c->b, s->metallic);
        s->roughness = SELECT(here, s->roughness * c->g, s->roughness);
        break;
#if GLINT_NORMAL_MAPS
    case GLINT_SLOT_NORMAL:
        s->bump = select3(here, bump_of(c, m->normal_scale), s->bump);
        break;
#endif
    case GLINT_SLOT_OCCLUSION: {
        const real left = fused(real_of(m->occlusion_strength), c->r - R(1.0), real_of(1));
        s->occlusion = SELECT(here, left, s->occlusion);
        break;
    }
    case GLINT_SLOT_EMISSION:
        s->emission = select3(here, multiply(s->emission, rgb), s->emission);
        break;
#if GLINT_SPECULAR
    case GLINT_SLOT_SPECULAR:
        s->specular = SELECT(here, s->specular * c->a, s->specular);
        break;
    case GLINT_SLOT_SPECULAR_COLOR:
        s->specular_color =
            select3(here, multiply(s->specular_color, rgb), s->specular_color);
        break;
#endif
#if GLINT_CLEARCOAT
    case GLINT_SLOT_CLEARCOAT:
        s->clearcoat = SELECT(here, s->clearcoat * c->r, s->clearcoat);
        break;
    case GLINT_SLOT_CLEARCOAT_ROUGHNESS:
        s->clearcoat_roughness =
            SELECT(here, s->clearcoat_roughness * c->g, s->clearcoat_roughness);
        break;
#if GLINT_NORMAL_MAPS
    case GLINT_SLOT_CLEARCOAT_NORMAL:
        s->clearcoat_bump =
            select3(here, bump_of(c, m->clearcoat_normal_scale), s->clearcoat_bump);
        break;
#endif
#endif
#if GLINT_DIFFUSE_TRANSMISSION
    case GLINT_SLOT_DIFFUSE_TRANSMISSION:
        s->through = SELECT(here, s->through * c->a, s->through);
        break;
    case GLINT_SLOT_DIFFUSE_TRANSMISSION_COLOR:
        s->through_color = select3(here, multiply(s->through_color, rgb), s->through_color);
        break;
#endif
#if GLINT_SHEEN
    case GLINT_SLOT_SHEEN_COLOR:
        s->sheen_color = select3(here, multiply(s->sheen_color, rgb), s->sheen_color);
        break;
    case GLINT_SLOT_SHEEN_ROUGHNESS:
        s->sheen_roughness = SELECT(here, s->sheen_roughness * c->a, s->sheen_roughness);
        break;
#endif
#if GLINT_BRUSHED
    case GLINT_SLOT_ANISOTROPY:
        brush_by(c, here, s);
        break;
#endif
#if GLINT_IRIDESCENCE
    case GLINT_SLOT_IRIDESCENCE:
        s->film = SELECT(here, s->film * c->r, s->film);
        break;
    case GLINT_SLOT_IRIDESCENCE_THICKNESS: {
        const scalar least = m->iridescence_thickness[0], most = m->iridescence_thickness[1];
        s->film_thickness =
            SELECT(here, fused(c->g, real_of(most - least), real_of(least)), s->film_thickness);
        break;
    }
#endif
    case GLINT_SLOT_TRANSMISSION:
        s->transmission = SELECT(here, s->transmission * c->r, s->transmission);
        break;
    }
}

// Looks up the textures in slots of `*left` that differ only in texels from the first, and removes
// these slots. Slots with the same texture, often occlusion and metallic, share one look-up.
static inline void take_alike(const scene_buffers *scene, const texture_spot *spots, mask here,
                              global const glint_material_record *m, uint *left, surface *s)
{
    global const glint_texture_record *t = scene->textures + m->textures[lowest_bit(*left)];
    // Collect the slots that are looked up in the same way.
    texture_group g;
    int place[GLINT_MATERIAL_TEXTURES];
    uint taken = 0;
    g.count = 0;
    for (uint rest = *left; rest != 0; rest &= rest - 1) {
        const int slot = lowest_bit(rest), texture = m->textures[slot];
        if (scene->textures[texture].alike == t->alike) {
            if (g.count == 0 || texture != g.textures[g.count - 1]) {
                g.textures[g.count++] = texture;
            }
            place[slot] = g.count - 1;
            taken |= 1u << slot;
        }
    }
    *left &= ~taken;
    // Look up the textures, and apply each.
    const bool second = HAS(SECOND_TEXCOORDS) && (t->flags & GLINT_TEXTURE_SECOND);
    scalar4 found[GLINT_MATERIAL_TEXTURES][GLINT_WIDTH];
    look_up_textures(scene, &g, &spots[second], here, found);
    for (uint rest = taken; rest != 0; rest &= rest - 1) {
        const int slot = lowest_bit(rest);
        const texture_color color = color_of_lanes(found[place[slot]]);
        take_texture(slot, &color, here, m, s);
    }
}

static inline void take_textures(const scene_buffers *scene, const texture_spot *spots, mask here,
                                 global const glint_material_record *m, surface *s)
{
    uint left = 0;
    for (int slot = 0; slot < GLINT_MATERIAL_TEXTURES; slot++) {
        left |= m->textures[slot] >= 0 ? 1u << slot : 0;
    }
    while (left != 0) {
        take_alike(scene, spots, here, m, &left, s);
    }
}

// Sets the values of a surface without textures.
static inline void begin_textures(surface *s)
{
    s->occlusion = real_of(1);
#if GLINT_NORMAL_MAPS
    s->bump = real3_of(real_of(0), real_of(0), real_of(1));
#if GLINT_CLEARCOAT
    s->clearcoat_bump = s->bump;
#endif
#endif
}

// Applies a material's textures to the surfaces that rays have met.
static inline void texture_surface(const scene_buffers *scene, const path *ray, const closest *hit,
                                   const triangle *t, surface *s)
{
    const mask met = hit->place >= (lane_int)0;
    // Find the pixel's footprint on the triangle, and the texture coordinates.
    real width = fabs(width_after(&ray->cone, hit->t));
#if GLINT_FACETS
    width = joined_width(width, width_after(&ray->lobe, hit->t));
#endif
    const ellipse seen =
        ellipse_on(t->vertices, s->geometric_normal, ray->direction, width);
    texture_spot spots[1 + GLINT_SECOND_TEXCOORDS];
    for (int set = 0; set <= HAS(SECOND_TEXCOORDS); set++) {
        const corner_values c =
            load_corners(scene, hit->place, met, set * SECOND_TEXCOORDS_AT, 2);
        spots[set] = spot_on(&c, &seen, hit->b1, hit->b2);
    }
    // Apply the textures, material by material.
    uint left = mask_bits(met);
    while (left != 0) {
        int material = 0;
        mask here = met;
#if GLINT_MANY_MATERIALS
        here = met & next_alike(t->material, &left, &material);
#else
        left = 0;
#endif
        take_textures(scene, spots, here, scene->materials + material, s);
    }
}

#endif

#if GLINT_COLORED_VERTICES
// Multiplies the base colour and its alpha by the vertices' colours and alpha.
static inline void color_surface(const scene_buffers *scene, const closest *hit, surface *s)
{
    const mask met = hit->place >= (lane_int)0;
    const corner_values c = load_corners(scene, hit->place, met, COLORS_AT, 4);
    const real3 rgb = real3_of(value_of_corners(&c, 0, hit->b1, hit->b2),
                               value_of_corners(&c, 1, hit->b1, hit->b2),
                               value_of_corners(&c, 2, hit->b1, hit->b2));
    s->base_color = select3(met, multiply(s->base_color, rgb), s->base_color);
#if GLINT_ALPHA
    const real alpha = value_of_corners(&c, 3, hit->b1, hit->b2);
    s->coverage = SELECT(met, s->coverage * alpha, s->coverage);
#endif
}
#endif

#if GLINT_ALPHA
// Finds the coverage of the surface from its alpha.
static inline void cover_surface(surface *s)
{
    const real one = real_of(1), zero = real_of(0);
    const real there = SELECT(s->coverage >= s->alpha_cutoff, one, zero);
    s->coverage = SELECT(HAS_FLAG(*s, GLINT_MATERIAL_MASK), there,
                         SELECT(HAS_FLAG(*s, GLINT_MATERIAL_COVER), s->coverage, one));
}
#endif

static inline surface find_surface(const scene_buffers *scene, const path *ray, const closest *hit,
                                   const triangle *t)
{
    surface s;
    const real3 *vertices = t->vertices;
    mask valid;
    s.geometric_normal = normalized(normal_of(vertices), &valid);
    // A sliver whose edges are parallel in this precision has no normal; it faces the viewer.
    s.geometric_normal = select3(valid, s.geometric_normal, negate(ray->direction));
    if (HAS_PLACES) {
        place_on_triangle(scene, t, ray, hit, &s);
    }
    load_materials(scene, t, &s);
#if GLINT_FACETS
    s.facet.there = mask_none();
#endif
#if GLINT_LIGHTS
    s.direct = real3_of(real_of(0), real_of(0), real_of(0));
#if GLINT_ROUGH
    s.shine_base = s.shine_edge = s.direct;
#if GLINT_CLEARCOAT
    s.clearcoat_shine = s.direct;
#endif
#if GLINT_SHEEN
    s.sheen_shine = s.direct;
#endif
#endif
#endif
    // Apply vertex colours, textures and alpha.
#if GLINT_COLORED_VERTICES
    if (HAS(COLORED_VERTICES)) {
        color_surface(scene, hit, &s);
    }
#endif
#if GLINT_TEXTURES
    begin_textures(&s);
    if (HAS(TEXTURES)) {
        texture_surface(scene, ray, hit, t, &s);
    }
#endif
#if GLINT_ALPHA
    cover_surface(&s);
#endif
    // Orient the normals. From within a solid no clear coat is visible.
    orient_normals(scene, t, ray, hit, &s);
#if GLINT_CLEARCOAT
    const mask within = HAS_FLAG(s, GLINT_MATERIAL_SOLID) & !s.outside;
    s.clearcoat = SELECT(within, real_of(0), s.clearcoat);
#endif
    return s;
}
