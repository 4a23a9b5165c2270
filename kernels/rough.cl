// Computes the light that rough surfaces reflect. Their microfacets follow GGX, α = roughness². The
// light is the integral of D V F E n·l over the directions l in front of the surface. It is summed
// over cells of the environment (layout.h): the integrand at a cell's centroid, times the cell's
// light. Where n·v is small, D is averaged over a cell's width across the plane of incidence, and
// the sum is scaled so that white light gives the albedo. Each ray chooses cells with small errors,
// independently of its neighbours in the packet.
#if GLINT_ROUGH

// v·h is the factor by which a lobe is narrower in l than in h, across the plane of incidence.
// STEEPEST is the smallest (v·h)² for which cells become smaller. Below SLANTED, cells may be wider
// than the lobe.
#define LOBE_STEEPEST R(0.0001)
#define LOBE_SLANTED R(0.15)
#define SHEEN_STEEPEST R(0.0225) // sheen is wide
// Lobes are scaled to their albedo where n·v is below SCALED, of wide ones a little later, and
// wholly where it is 1/SCALED_SLOPE less. Where lobes are wide, cells are small enough. Measured:
// sums err by more than 0.01 of white below, scaled ones where a lamp fills a part of a cell above.
#define LOBE_SCALED R(0.4)
#define LOBE_SCALED_SLOPE R(7.0)

// A rough surface, and the direction from which it is seen.
typedef struct lobe_shape {
    real3 normal;
    real cosine; // n·v
    real roughness;
#if GLINT_BRUSHED
    real3 along;     // direction of larger roughness; there α is α + (1 − α) anisotropy²
    real anisotropy; // 0: no such direction
#endif
#if GLINT_SHEEN
    bool is_sheen; // fibres instead of microfacets
#endif
} lobe_shape;

static inline lobe_shape shape_of_surface(const surface *s)
{
    lobe_shape shape;
    shape.normal = s->normal;
    shape.cosine = s->cosine;
    shape.roughness = s->roughness;
#if GLINT_BRUSHED
    shape.along = s->along;
    shape.anisotropy = s->anisotropy;
#endif
#if GLINT_SHEEN
    shape.is_sheen = false;
#endif
    return shape;
}

#if GLINT_SHEEN
static inline lobe_shape shape_of_sheen(const surface *s)
{
    lobe_shape shape = shape_of_surface(s);
    shape.roughness = s->sheen_roughness;
#if GLINT_BRUSHED
    shape.anisotropy = real_of(0);
#endif
    shape.is_sheen = true;
    return shape;
}
#endif

#if GLINT_CLEARCOAT
static inline lobe_shape shape_of_coat(const surface *s)
{
    lobe_shape shape = shape_of_surface(s);
    shape.normal = s->clearcoat_normal;
    shape.cosine = s->clearcoat_cosine;
    shape.roughness = s->clearcoat_roughness;
#if GLINT_BRUSHED
    shape.anisotropy = real_of(0);
#endif
    return shape;
}
#endif

// A lobe at a surface, in axes of the environment; n is the third axis.
typedef struct lobe {
    const scene_buffers *scene;
    real3 first, second, normal;
    // v along the first axis. If v lies in the plane of `first` and n, it is the sine of v's angle
    // to n.
    real sine;
    real cosine;        // of v's angle to n
    real alpha;         // α; of a brushed surface the smaller α, across
    real alpha_squared; // α², or the product of both α
#if GLINT_BRUSHED
    real beside;        // v along the second axis
    real alpha_along;
    real narrowed, widened; // α across over α along, and its inverse
#endif
    bool is_slanted; // v·h may be below LOBE_SLANTED
    bool is_scaled;  // some lobe is scaled to its albedo
    real widest;    // largest width, squared
    real smith;     // √(α² + (1 − α²) cos²)
    real largest;   // largest size of cells, as GLINT_CELL_LARGEST
    real tolerance; // tolerated error of a cell
#if GLINT_SHEEN
    bool is_sheen;
    sheen sheen; // set if is_sheen
#endif
} lobe;

// Light of both parts of Schlick's F = F0 (1 − m) + m with m = (1 − v·h)⁵: sums over cells, which
// stand for ∫ D V (1 − m) E n·l dl and ∫ D V m E n·l dl.
typedef struct lobe_light {
    real3 base, edge;
    real white_base, white_edge; // the same sums with E = 1, if the lobe is scaled
} lobe_light;

// Sets the axes. `across` is v without its part along n; `squared` is its squared length.
static inline void lobe_axes(const lobe_shape *shape, real3 v, lobe *l)
{
    const real3 normal = shape->normal;
    const real3 across = scale_add(normal, -shape->cosine, v);
    const real squared = dot3(across, across);
    const mask upright = !(squared > R(1e-12)); // then any axis serves
    const mask along_x = fabs(normal.x) > R(0.6);
    const real one = real_of(1), zero = real_of(0);
    const real3 axis = select3(along_x, real3_of(zero, one, zero), real3_of(one, zero, zero));
    mask valid;
    l->normal = normal;
    l->first = normalized(select3(upright, cross3(normal, axis), across), &valid);
    l->sine = SELECT(upright, zero, sqrt(squared));
#if GLINT_BRUSHED
    const mask brushed = shape->anisotropy > R(0.0);
    l->first = select3(brushed, shape->along, l->first);
    l->sine = SELECT(brushed, dot3(shape->along, v), l->sine);
#endif
    l->second = cross3(normal, l->first);
#if GLINT_BRUSHED
    l->beside = SELECT(brushed, dot3(l->second, v), zero);
#endif
    l->cosine = shape->cosine;
}

static inline void lobe_widths(const lobe_shape *shape, real roughness, lobe *l)
{
#if GLINT_SHEEN
    l->is_sheen = shape->is_sheen;
    if (l->is_sheen) {
        l->sheen = find_sheen(roughness, l->cosine);
    }
#endif
    l->alpha = roughness * roughness;
    l->alpha_squared = l->alpha * l->alpha;
#if GLINT_BRUSHED
    l->alpha_along = fused(R(1.0) - l->alpha, shape->anisotropy * shape->anisotropy, l->alpha);
    l->alpha_squared = l->alpha * l->alpha_along;
    l->narrowed = l->alpha / l->alpha_along;
    l->widened = l->alpha_along / l->alpha;
#endif
}

// √(α² + (1 − α²) cos²) of v; for brushed surfaces the same with both α.
static inline real lobe_root(const lobe *l)
{
#if GLINT_BRUSHED
    if (HAS_IN(l->scene, BRUSHED)) {
        const real x = l->alpha_along * l->sine, y = l->alpha * l->beside;
        return sqrt(fused(x, x, fused(y, y, l->cosine * l->cosine)));
    }
#endif
    return smith_root(l->alpha_squared, l->cosine);
}

// The lobes that are seen at a slant: n·v is below a limit. Only those of plain microfacets count.
static inline mask slanted_below(const lobe *l, real limit)
{
    mask slanted = l->cosine < limit;
#if GLINT_BRUSHED
    slanted = slanted & (l->widened == R(1.0));
#endif
#if GLINT_SHEEN
    slanted = l->is_sheen ? mask_none() : slanted;
#endif
    return slanted;
}

// Lobes for which v·h may be below LOBE_SLANTED: it is (n·l + n·v)/2 or more.
static inline mask are_slanted(const lobe *l)
{
    return slanted_below(l, real_of(R(2.0) * LOBE_SLANTED));
}

// How far a lobe is scaled to its albedo, from 0 to 1.
static inline real scaled_share(const lobe *l)
{
    const real limit = LOBE_SCALED - SMALLER(l->alpha, real_of(R(0.1)));
    const real share = SMALLER((limit - l->cosine) * LOBE_SCALED_SLOPE, real_of(1));
    return SELECT(slanted_below(l, limit), share, real_of(0));
}

// Prepares a lobe. n and v are unit vectors in axes of the environment, and the cosine is n·v.
// `weight` is the lobe's weight in the pixel.
static inline lobe find_lobe(const scene_buffers *scene, const lobe_shape *shape, real3 v,
                             real roughness, real weight)
{
    const cell_map *map = &scene->cells;
    lobe l;
    l.scene = scene;
    lobe_axes(shape, v, &l);
    lobe_widths(shape, roughness, &l);
    l.widest = fused(real_of(GLINT_LOBE_WIDEST * GLINT_LOBE_TAIL), R(1.0) / (l.alpha * l.alpha),
                     real_of(GLINT_LOBE_WIDEST));
    l.smith = lobe_root(&l);
    l.is_slanted = any_lane(are_slanted(&l));
    l.is_scaled = any_lane(scaled_share(&l) > R(0.0));
    const real inverse = R(1.0) / LARGER(weight, real_of(R(1e-4)));
    const real more = l.alpha * (sqrt(inverse) - R(1.0));
    const real usual = real_of(GLINT_CELL_LARGEST);
    l.largest = fused(usual, LARGER(more, real_of(0)), usual);
    l.tolerance = (map->tolerance * map->values[GLINT_LOBES_BRIGHTNESS]) * inverse *
                  SELECT(are_slanted(&l), real_of(R(0.5)), real_of(1));
    return l;
}

// A direction u, and the half vector's length and position: u + v = (x, ., c) with W = |u + v|².
typedef struct half_vector {
    real up;     // n·u
    real c;      // n·(u + v)
    real square; // |u + v|² − c²
    real whole;  // |u + v|²
#if GLINT_BRUSHED
    real bent;   // like `square`, with the first axis narrowed and the second widened
    real curled; // the same, narrowed and widened twice
    real tilted; // (α u)² along both axes
#endif
} half_vector;

static inline half_vector half_vector_towards(const lobe *l, real3 u)
{
    half_vector h;
    h.up = dot3(l->normal, u);
    h.c = h.up + l->cosine;
    const real first = dot3(l->first, u) + l->sine;
    real second = dot3(l->second, u);
#if GLINT_BRUSHED
    if (HAS_IN(l->scene, BRUSHED)) {
        const real across = l->alpha * second;
        second += l->beside;
        const real x = l->narrowed * first, y = l->widened * second;
        h.bent = fused(x, first, y * second);
        h.curled = fused(x, x, y * y);
        const real along = l->alpha_along * (first - l->sine);
        h.tilted = fused(along, along, across * across);
    }
#endif
    h.square = fused(first, first, second * second);
    h.whole = fused(h.c, h.c, h.square);
    return h;
}

static inline half_vector half_vector_of(const lobe *l, scalar8 cell)
{
    return half_vector_towards(l, real3_of(real_of(cell.s0), real_of(cell.s1), real_of(cell.s2)));
}

// The factor by which the spread of a cell's light about its centroid changes the weight, to second
// order. It averages D: half of the light's variance about the centroid, converted to h, times the
// Laplacian of D. The Laplacian is D (16 s² − 8 α²)/A² with A = α² + s², s = sin θ_h. `width` is
// A |u + v|², `inverse` is 1/width.
static inline real spread_factor(const lobe *l, const half_vector *h, real width, real variance,
                                 real inverse)
{
    const real turned = h->whole + SMALLER(R(50.0) * h->whole, real_of(4)); // 1 + 1/(v·h)², scaled
    real laplacian = fused(l->alpha_squared * R(-0.5), h->whole, h->square);
#if GLINT_BRUSHED
    if (HAS_IN(l->scene, BRUSHED)) {
        // With A = α1 α2 + a x² + b y²: D (24 (a² x² + b² y²) − 4 (a + b) A)/A².
        const real both = l->narrowed + l->widened;
        laplacian = fused(R(1.5) * h->curled, real_of(1), R(-0.25) * both * width);
    }
#endif
    const real curved = (laplacian * inverse) * (variance * turned);
    return LARGER(fused(curved, inverse, real_of(1)), real_of(R(0.1)));
}

// (α² cos² θ_h + sin² θ_h) |u + v|².
static inline real width_of(const lobe *l, const half_vector *h)
{
#if GLINT_BRUSHED
    if (HAS_IN(l->scene, BRUSHED)) {
        return fused(l->alpha_squared * h->c, h->c, h->bent);
    }
#endif
    return fused(l->alpha_squared * h->c, h->c, h->square);
}

#if GLINT_SHEEN
// are_coarse for sheen. The curvature of D is n² cot² θ_h + n, n = 1/α. The curvature of the
// shadowing term is about 6/(n·l)²: measured, so that sheen has about the same error as other
// lobes. Λ(l) is at least about 0.5/n·l − 0.5.
static inline mask are_coarse_in_sheen(const lobe *l, const half_vector *h, scalar8 cell,
                                       mask these)
{
    const real n = l->sheen.power;
    const real inverse = R(1.0) / LARGER(h->whole, real_of(R(1e-6)));
    const real size = real_of(cell.s3 * cell.s3);
    // The squared size of the cell as seen by h, over 4.
    const real turned = R(0.0625) * size / LARGER(R(0.25) * h->whole, real_of(SHEEN_STEEPEST));
    const real sine_squared = h->square * inverse;
    const real slope = h->c * h->c * inverse / LARGER(sine_squared, real_of(R(1e-3)));
    const real above = LARGER(h->up, real_of(R(0.25) * cell.s3));
    const real ratio =
        fused(turned, fused(n, fused(n, slope, real_of(1)), real_of(1)),
              R(0.4) * size / (above * above));
    const real reach = LARGER(h->up, real_of(0)) + real_of(R(0.5) * cell.s3);
    const real weight = weigh_sheen(&l->sheen, sine_squared,
                                    LARGER(R(0.5) / reach - R(0.5), real_of(0)));
    const real brought = weight * (cell.s4 + cell.s5 + cell.s6) * ratio * ratio;
    return these & ((turned * n > l->largest) | (brought > l->tolerance));
}
#endif

// The rays among `these` for which a cell is too large, see GLINT_CELL_LARGEST. The test needs no
// division, and takes n·u as at least a quarter of the cell's size. If the products underflow, the
// cell counts as too large. The cell's contribution is estimated at its point nearest to the lobe's
// middle: a lamp away from the centroid may contribute more than the light at the centroid.
static inline mask are_coarse(const lobe *l, const half_vector *h, real width, scalar8 cell,
                              mask these)
{
#if GLINT_SHEEN
    if (l->is_sheen) {
        return are_coarse_in_sheen(l, h, cell, these);
    }
#endif
    // Find the limit of the cell's size.
    const real steep = LARGER(R(0.25) * h->whole, real_of(LOBE_STEEPEST));
    real across = h->square, stretched = real_of(1), narrowest = width;
#if GLINT_BRUSHED
    if (HAS_IN(l->scene, BRUSHED)) {
        across = h->bent;
        stretched = sqrt(l->widened);
        narrowest = width * l->narrowed;
    }
#endif
    const real far = sqrt(across);
    const real limit = SMALLER(narrowest, l->widest * h->whole) * steep;
    const real size = cell.s3 * cell.s3 * h->whole;
    const real above = LARGER(h->up, real_of(R(0.25) * cell.s3));
    const real shadowing =
        fused(above, l->smith, l->cosine * LARGER(above, l->alpha)); // √(a² + b²) ≈ max(a, b)
    // The point of the cell that is nearest to the lobe's middle.
    const real left = LARGER(far - R(0.5) * cell.s3 * stretched, real_of(0));
    const real nearest = fused(l->alpha_squared * h->c, h->c, left * left);
    // Compare size and contribution with their limits.
    const real root = h->whole * size;
    const real bright = (cell.s4 + cell.s5 + cell.s6) * R(0.15915494309189535);
    const real brought = l->alpha_squared * bright * above * root * root;
    const real allowed = nearest * limit;
    return these & ((size > l->largest * limit) |
                    (brought > l->tolerance * shadowing * allowed * allowed));
}

#if GLINT_SHEEN
// The curvature of the sheen's weight W = D g, g = 1/(1 + Λ(v) + Λ(l)): its Laplacian over the
// directions u, divided by W. With k = u·v, μ = n·u and t = cos θ_h = (μ + n·v)/√(2 + 2k), ∇μ·∇k is
// n·v − μk, and the Laplacians of μ and k are −2μ and −2k.
static inline real bend_of_sheen(const lobe *l, const half_vector *h, const sheen_cover *cover)
{
    const real n = l->sheen.power, up = h->up;
    const real inverse = R(1.0) / LARGER(h->whole, real_of(R(1e-4))), root = sqrt(inverse);
    const real k = fused(h->whole, real_of(R(0.5)), real_of(-1));
    const real across = fused(-k, k, real_of(1)), level = fused(-up, up, real_of(1));
    const real common = fused(-up, k, l->cosine), lean = h->c * inverse;
    const real t = h->c * root;
    // ∇t|², ∇t·∇μ and the Laplacian of t.
    const real steep =
        inverse * fused(lean * lean, across, fused(R(-2.0) * lean, common, level));
    const real along = root * fused(-lean, common, level);
    const real turned = root * fused(R(-2.0), up + inverse * common,
                                     lean * fused(R(3.0) * inverse, across, R(2.0) * k));
    // D = (1 − t²)^(n/2).
    const real sine = R(1.0) / LARGER(h->square * inverse, real_of(R(1e-3)));
    const real slope = -n * t * sine;
    const real bend = fused(slope, turned, n * sine * fused((n - R(2.0)) * t * t, sine,
                                                            real_of(-1)) * steep);
    const real share = cover->hidden / (l->sheen.of_view + cover->hidden);
    const real slope_of_g = -share * cover->slope;
    const real bend_of_g = fused(R(2.0) * slope_of_g, slope_of_g, -share * cover->bend);
    return bend + fused(level, bend_of_g, R(2.0) * slope_of_g * fused(slope, along, -up));
}

// weigh_direction for sheen, which has one part only.
static inline lobe_parts weigh_sheen_direction(const lobe *l, const half_vector *h, real variance,
                                               mask these)
{
    const real up = SMALLER(LARGER(h->up, real_of(0)), real_of(1));
    const sheen_cover cover = hidden_by_sheen(&l->sheen, up);
    const real sine_squared = h->square / LARGER(h->whole, real_of(R(1e-6)));
    const real weight = weigh_sheen(&l->sheen, sine_squared, cover.hidden);
    const real curved = bend_of_sheen(l, h, &cover) * (R(0.5) * variance);
    const real factor = SMALLER(LARGER(R(1.0) + curved, real_of(R(0.1))), real_of(2));
    lobe_parts parts;
    parts.base = SELECT(these & (h->up > R(0.0)), weight * factor, real_of(0));
    parts.edge = real_of(0);
    return parts;
}
#endif

// Weighs light from a direction, for the rays in `these`. `variance` is the spread of the light
// about it.
static inline lobe_parts weigh_direction(const lobe *l, const half_vector *h, real width,
                                         real variance, mask these)
{
#if GLINT_SHEEN
    if (l->is_sheen) {
        return weigh_sheen_direction(l, h, variance, these);
    }
#endif
    real root;
#if GLINT_BRUSHED
    if (HAS_IN(l->scene, BRUSHED)) {
        root = sqrt(fused(h->up, h->up, h->tilted));
    } else
#endif
    {
        root = smith_root(l->alpha_squared, h->up);
    }
    // Both divisors are positive in exact arithmetic. |u + v|² is nearly 0 where both directions lie
    // in the plane, opposite to each other.
    const real shadowing = LARGER(fused(h->up, l->smith, l->cosine * root), real_of(R(1e-12)));
    width = LARGER(width, real_of(R(1e-20)));
    const real both = R(1.0) / (width * shadowing), inverse = both * shadowing;
    const real ratio = h->whole * inverse;
    const real above = R(0.15915494309189535) * l->alpha_squared * h->up * (both * width);
    const real factor = spread_factor(l, h, width, variance, inverse);
    const real weight =
        SELECT(these & (h->up > R(0.0)), above * (ratio * ratio) * factor, real_of(0));
    const real m = fused(sqrt(h->whole), real_of(R(-0.5)), real_of(1)), m2 = m * m;
    lobe_parts parts;
    parts.edge = weight * (m2 * m2 * m);
    parts.base = weight - parts.edge;
    return parts;
}

// Averages D over a cell that is wider than the lobe, across the plane of incidence: along y, D is
// 1/(A + y²)², and its integral is π/2 A^(−3/2). Changes the cell's width and variance, and returns
// the factor that is left. Where v·h is LOBE_SLANTED or more, cells are small enough.
static inline real average_across(const lobe *l, const half_vector *h, scalar8 cell, real *width,
                                  real *variance)
{
    const real3 u = real3_of(real_of(cell.s0), real_of(cell.s1), real_of(cell.s2));
    const real first = dot3(l->first, u) + l->sine, y = fabs(dot3(l->second, u));
    const real steep = R(0.5) / LOBE_SLANTED * sqrt(h->whole);
    const real small = SELECT(are_slanted(l), SMALLER(steep, real_of(1)), real_of(1));
    const real half_size = R(0.5) * cell.s3 * (R(1.0) - small);
    const real left = LARGER(y - half_size, real_of(0));
    const real of_cell = fused(l->alpha_squared * h->c, h->c, fused(first, first, left * left));
    *width = SELECT(small < R(1.0), of_cell, *width);
    *variance *= small;
    return R(1.0) / fused(R(1.2732395447351628) * half_size,
                          R(1.0) / sqrt(LARGER(*width, real_of(R(1e-20)))), real_of(1));
}

// The solid angle of a cell, with its centroid as its middle.
static inline scalar angle_of(scalar8 cell)
{
    const scalar u = fmax(fmax(fabs(cell.s0), fabs(cell.s1)), fabs(cell.s2));
    const scalar squared = cell.s3 * cell.s3;
    return squared * u * fma(squared, R(0.375) - R(0.625) * u * u, R(1.0));
}

// Adds a cell's light for the rays in `these`.
static inline void add_cell(const lobe *l, const half_vector *h, real width, scalar8 cell,
                            mask these, lobe_light *sum)
{
    real variance = real_of(cell.s7);
    real factor = real_of(1);
    if (l->is_slanted) {
        factor = average_across(l, h, cell, &width, &variance);
    }
    lobe_parts parts = weigh_direction(l, h, width, variance, these);
    parts.base *= factor;
    parts.edge *= factor;
    const real3 light = real3_of(real_of(cell.s4), real_of(cell.s5), real_of(cell.s6));
    sum->base = scale_add(light, parts.base, sum->base);
    sum->edge = scale_add(light, parts.edge, sum->edge);
    if (l->is_scaled) {
        const real angle = real_of(angle_of(cell));
        sum->white_base = fused(parts.base, angle, sum->white_base);
        sum->white_edge = fused(parts.edge, angle, sum->white_edge);
    }
}

// Four neighbouring cells, and the rays that take them or their parts.
typedef struct cell_group {
    mask these;
    int level;
    uint first; // in the level
} cell_group;

// The number of waiting groups: three of each level, and four of the last, because the fourth is
// next.
#define GROUPS (3 * GLINT_CELLS_LEVELS + 1)

// Adds the cells of a group to the rays that take them. If a cell is too large for some rays, the
// group of its parts waits for these rays.
static inline int visit_group(const cell_map *map, const lobe *l, const cell_group *group,
                              cell_group *waiting, int count, lobe_light *sum)
{
    const size_t number = GLINT_CELLS_FIRST(group->level) + group->first;
    scalar8 cells[4];
    half_vector h[4];
    mask lit[4];
#pragma unroll
    for (int k = 0; k < 4; k++) {
        cells[k] = TO_SCALAR8(vload8(number + k, map->values + GLINT_LOBES_CELLS));
        h[k] = half_vector_of(l, cells[k]);
        lit[k] = group->these & (h[k].up > -cells[k].s3);
    }
    if (!any_lane(lit[0] | lit[1] | lit[2] | lit[3])) {
        return count;
    }
    mask coarse[4];
#pragma unroll
    for (int k = 0; k < 4; k++) {
        const real width = width_of(l, &h[k]);
        coarse[k] = group->level < map->last
                        ? are_coarse(l, &h[k], width, cells[k], lit[k])
                        : mask_none();
        add_cell(l, &h[k], width, cells[k], lit[k] & !coarse[k], sum);
    }
#pragma unroll
    for (int k = 0; k < 4; k++) {
        if (any_lane(coarse[k])) {
            waiting[count].these = coarse[k];
            waiting[count].level = group->level + 1;
            waiting[count].first = 4 * (group->first + k);
            count++;
        }
    }
    return count;
}

// The light that the lobes of the rays in `wanted` take from the environment.
static inline lobe_light integrate_lobe(const scene_buffers *scene, const lobe *l, mask wanted)
{
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    lobe_light sum = {zero, zero, real_of(0), real_of(0)};
    cell_group waiting[GROUPS];
    for (uint root = 0; root < GLINT_CUBE_FACES * GLINT_CELLS_ROOT * GLINT_CELLS_ROOT; root += 4) {
        waiting[0].these = wanted;
        waiting[0].level = 0;
        waiting[0].first = root;
        for (int count = 1; count > 0;) {
            const cell_group group = waiting[--count];
            count = visit_group(&scene->cells, l, &group, waiting, count, &sum);
        }
    }
    return sum;
}

#if GLINT_LIGHTS
// Weighs the light of a punctual light. The lobe is at least as wide as at ROUGHNESS_NARROW;
// otherwise it would fall between pixels. v and `to_light` are unit vectors.
static inline lobe_parts weigh_light(const scene_buffers *scene, const lobe_shape *shape, real3 v,
                                     real3 to_light, mask these)
{
    lobe l;
    l.scene = scene;
    lobe_axes(shape, v, &l);
    lobe_widths(shape, LARGER(shape->roughness, real_of((scalar)GLINT_ROUGHNESS_NARROW)), &l);
    l.smith = lobe_root(&l);
    const half_vector h = half_vector_towards(&l, to_light);
    return weigh_direction(&l, &h, width_of(&l, &h), real_of(0), these);
}
#endif

// The share of the lobe's light; the rest is a mirror's light. Below ROUGHNESS_NARROW a lobe would
// be narrower than the cells. So the lobe of ROUGHNESS_NARROW is mixed with the mirror's look-up.
// The mix differs from the true lobe by about α^1.5.
static inline real share_of_lobe(const scene_buffers *scene, const lobe_shape *shape)
{
    real roughness = shape->roughness;
#if GLINT_BRUSHED
    if (HAS(BRUSHED)) { // the roughness along the brush direction counts
        const real alpha = roughness * roughness;
        const real squared = shape->anisotropy * shape->anisotropy;
        roughness = SELECT(shape->anisotropy > R(0.0),
                           sqrt(fused(R(1.0) - alpha, squared, alpha)), roughness);
    }
#endif
    const real x = roughness * ((scalar)1 / (scalar)GLINT_ROUGHNESS_NARROW);
    return SMALLER(x * x * x, real_of(1)); // α is x²
}

#endif
