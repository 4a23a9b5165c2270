// Loads the corners' attributes, and looks up textures with them (layout.h, "Textures").
//
// A pixel's footprint on a surface is an ellipse: the cone of its ray (cones.cl), cut by the
// triangle's plane. The longer axis of the ellipse decides the level. With GLINT_ANISOTROPY the
// shorter axis decides it, and the result is the mean of several taps along the longer axis.

// The largest width of a tap, in shorter axes. A smaller width takes more taps: at 1.4 five
// textures take a sixth more time, and a floor's error is 7 to 30% less (bench/floor).
#define TAP_WIDTH R(2.0)

// Offsets of the corners' attributes, in the order of glint_attributes in host/scene/scene.h.
#define SECOND_TEXCOORDS_AT 2
#define COLORS_AT (2 * HAS(TEXTURES) + 2 * HAS(SECOND_TEXCOORDS))
#define TANGENTS_AT (COLORS_AT + 4 * HAS(COLORED_VERTICES))
#define CORNER_VALUES (TANGENTS_AT + 4 * HAS(NORMAL_MAPS))

#if GLINT_TEXTURES || GLINT_COLORED_VERTICES

// Some attributes of a triangle's first corner, and the differences of the other corners to it.
typedef struct corner_values {
    real first[4], second_more[4], third_more[4];
} corner_values;

// Loads `count` attributes from the offset `at` of each corner, for the rays in `met`.
static inline corner_values load_corners(const scene_buffers *scene, lanes_int places, mask met,
                                         int at, int count)
{
    corner_values c;
    for (int i = 0; i < count; i++) {
        c.first[i] = c.second_more[i] = c.third_more[i] = real_of(0);
    }
    for (uint left = mask_bits(met); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        const size_t number = (size_t)scene->numbers[LANE_INT(places, lane)];
        const int stride = CORNER_VALUES;
        global const float *values = scene->attributes + 3 * stride * number + at;
        for (int i = 0; i < count; i++) {
            const scalar first = (scalar)values[i];
            LANE(c.first[i], lane) = first;
            LANE(c.second_more[i], lane) = (scalar)values[stride + i] - first;
            LANE(c.third_more[i], lane) = (scalar)values[2 * stride + i] - first;
        }
    }
    return c;
}

static inline real value_of_corners(const corner_values *c, int i, real b1, real b2)
{
    return fused(b2, c->third_more[i], fused(b1, c->second_more[i], c->first[i]));
}

#endif

#if GLINT_TEXTURES

// The texture coordinates at a hit, and their changes along the two axes of the pixel's ellipse.
typedef struct texture_spot {
    real u, v, u_along, v_along, u_across, v_across;
} texture_spot;

// The axes of an ellipse on a triangle, as multiples of the two edges from its first corner.
typedef struct ellipse {
    real along[2], across[2];
} ellipse;

// Expresses a vector in the triangle's plane by multiples of its edges.
static inline void in_edges(const real3 edges[2], real3 normal, real3 vector, real parts[2])
{
    const real area = dot3(cross3(edges[0], edges[1]), normal);
    parts[0] = dot3(cross3(vector, edges[1]), normal) / area;
    parts[1] = dot3(cross3(edges[0], vector), normal) / area;
}

// The ellipse of a cone on a triangle. `width` is the cone's width at the triangle. `normal` is the
// geometric normal, a unit vector.
static inline ellipse ellipse_on(const real3 vertices[3], real3 normal, real3 direction, real width)
{
    const real3 edges[2] = {subtract(vertices[1], vertices[0]), subtract(vertices[2], vertices[0])};
    mask slants, valid;
    real3 across = normalized(cross3(normal, direction), &slants);
    across = select3(slants, across, normalized(edges[0], &valid));
    const real3 along = cross3(across, normal);
    const real cosine = LARGER(fabs(dot3(normal, direction)), real_of(R(1e-6)));
    ellipse e;
    in_edges(edges, normal, scale(along, width / cosine), e.along);
    in_edges(edges, normal, scale(across, width), e.across);
    return e;
}

static inline texture_spot spot_on(const corner_values *c, const ellipse *e, real b1, real b2)
{
    texture_spot s;
    s.u = value_of_corners(c, 0, b1, b2);
    s.v = value_of_corners(c, 1, b1, b2);
    s.u_along = fused(e->along[1], c->third_more[0], e->along[0] * c->second_more[0]);
    s.v_along = fused(e->along[1], c->third_more[1], e->along[0] * c->second_more[1]);
    s.u_across = fused(e->across[1], c->third_more[0], e->across[0] * c->second_more[0]);
    s.v_across = fused(e->across[1], c->third_more[1], e->across[0] * c->second_more[1]);
    return s;
}

// Applies KHR_texture_transform to the spot.
static inline texture_spot moved_spot(global const glint_texture_record *t, const texture_spot *s)
{
    const scalar uu = t->transform[0], uv = t->transform[1], vu = t->transform[3];
    const scalar vv = t->transform[4];
    texture_spot m;
    m.u = fused(real_of(uu), s->u, fused(real_of(uv), s->v, real_of(t->transform[2])));
    m.v = fused(real_of(vu), s->u, fused(real_of(vv), s->v, real_of(t->transform[5])));
    m.u_along = fused(real_of(uu), s->u_along, uv * s->v_along);
    m.v_along = fused(real_of(vu), s->u_along, vv * s->v_along);
    m.u_across = fused(real_of(uu), s->u_across, uv * s->v_across);
    m.v_across = fused(real_of(vu), s->u_across, vv * s->v_across);
    return m;
}

// A pixel's footprint on a texture, along the ellipse's longer axis.
typedef struct footprint {
    real width; // of a tap, in texels, 1 or more: it decides the level
#if GLINT_ANISOTROPY
    real length;         // in taps, 1 or more
    real u_step, v_step; // from tap to tap
#endif
} footprint;

// Finds the footprint. The spot's two axes are conjugate diameters of the ellipse, in texels (x, y)
// and (z, w). The longest and shortest axes follow from the matrix of their products.
static inline footprint footprint_of(const scene_buffers *scene,
                                     global const glint_texture_record *t, const texture_spot *s)
{
    const scalar width = (scalar)t->width, height = (scalar)t->height;
    const real x = s->u_along * width, y = s->v_along * height;
    const real z = s->u_across * width, w = s->v_across * height;
    const real uu = fused(x, x, z * z), uv = fused(x, y, z * w), vv = fused(y, y, w * w);
    const real half_difference = R(0.5) * (uu - vv);
    const real root = sqrt(fused(half_difference, half_difference, uv * uv));
    const real longer = sqrt(R(0.5) * (uu + vv) + root);
    footprint f;
    f.width = longer;
#if GLINT_ANISOTROPY
    const scalar most = t->flags & GLINT_TEXTURE_TRILINEAR ? (scalar)scene->anisotropy : R(1.0);
    const real shorter = fabs(fused(x, w, -(y * z))) / longer;
    f.width = LARGER(TAP_WIDTH * shorter, longer / most);
    f.width = SMALLER(f.width, longer);
#endif
    f.width = SELECT(f.width > R(1.0), f.width, real_of(1)); // NaN becomes 1
#if GLINT_ANISOTROPY
    // The longer axis has the direction of either column of the matrix minus its smaller
    // eigenvalue.
    const real column = fabs(half_difference) + root;
    const mask upright = half_difference < R(0.0);
    const real u = SELECT(upright, uv, column), v = SELECT(upright, column, uv);
    const real length = longer / f.width, one = real_of(1), zero = real_of(0);
    const mask several = length > R(1.0);
    f.length = SELECT(several, SMALLER(length, real_of(most)), one);
    const real step = longer / (f.length * sqrt(fused(u, u, v * v)));
    f.u_step = SELECT(several, step * u / width, zero);
    f.v_step = SELECT(several, step * v / height, zero);
#endif
    return f;
}

// choose_level for a texture: between powers of two, log2 is approximated as linear.
static inline level_choice choose_texture_level(global const glint_texture_record *t, real width)
{
    const real most = real_of((scalar)(1 << (t->levels - 1)));
    const real texels = SMALLER(width, most);
    level_choice choice;
    choice.level = exponent_of(texels);
    choice.blend = texels * inverse_exponent(texels) - R(1.0);
    if (t->flags & GLINT_TEXTURE_MIPS_NEAREST) {
        const mask up = choice.blend >= R(0.5);
        choice.level = SELECT(up, choice.level + (lane_int)1, choice.level);
        choice.blend = real_of(0);
    }
    return choice;
}

// Wraps a coordinate into [0, 1].
static inline real wrapped(real x, bool clamps, bool mirrors)
{
    x = SELECT(fabs(x) < R(1e9), x, real_of(0)); // NaN becomes 0
    if (clamps) {
        x = LARGER(x, real_of(0));
        return SMALLER(x, real_of(1));
    }
    if (mirrors) {
        x -= R(2.0) * floor(x * R(0.5));
        return SELECT(x > R(1.0), R(2.0) - x, x);
    }
    return x - floor(x);
}

// The first of two neighbouring texels of a row or column, and the position between them: 0 at the
// first, 1 at the second.
typedef struct neighbours {
    lanes_int first;
    real share;
} neighbours;

static inline neighbours neighbours_at(real x, lanes_int size, bool repeats, mask nearest)
{
    const real one = real_of(1), zero = real_of(0);
    real at = fused(x, to_real(size), real_of(R(-0.5)));
    if (!repeats) {
        at = LARGER(at, zero);
        at = SMALLER(at, to_real(size - (lane_int)1));
    }
    neighbours n;
    n.first = to_int_down(at);
    n.share = at - to_real(n.first);
    n.first = SELECT(n.first < (lane_int)0, n.first + size, n.first);
    n.share = SELECT(nearest, SELECT(n.share >= R(0.5), one, zero), n.share);
    return n;
}

// Four texels of a level: the upper left one, and the point's position between them.
typedef struct texel_square {
    lanes_int first, pitch; // in texels
    real across, down;
} texel_square;

static inline texel_square square_at(global const glint_texture_record *t, real u, real v,
                                     lanes_int level, mask nearest)
{
    const lanes_int one = int_of(1);
    const lanes_int width = max(int_of((lane_int)t->width) >> level, one);
    const lanes_int height = max(int_of((lane_int)t->height) >> level, one);
    const uint bounds_s = t->flags & (GLINT_TEXTURE_CLAMP_S | GLINT_TEXTURE_MIRROR_S);
    const uint bounds_t = t->flags & (GLINT_TEXTURE_CLAMP_T | GLINT_TEXTURE_MIRROR_T);
    const neighbours across = neighbours_at(u, width, bounds_s == 0, nearest);
    const neighbours down = neighbours_at(v, height, bounds_t == 0, nearest);
    texel_square square;
    square.pitch = width + (lane_int)GLINT_TEXTURE_BORDER;
    square.first = down.first * square.pitch + across.first;
    square.across = across.share;
    square.down = down.share;
    return square;
}

// One lane of a texel_square, with offsets in values.
typedef struct lane_square {
    size_t first, pitch;
    scalar across, down;
} lane_square;

static inline lane_square square_of_lane(const texel_square *s, int lane)
{
    lane_square of;
    of.first = 4 * (size_t)LANE_INT(s->first, lane);
    of.pitch = 4 * (size_t)LANE_INT(s->pitch, lane);
    of.across = LANE(s->across, lane);
    of.down = LANE(s->down, lane);
    return of;
}

// Interpolates four texels, in texels' units and in the same order as fetch_from_cube. `texels` are
// the texels of the level.
static inline scalar4 mean_of_square(global const ushort *texels, const lane_square *s)
{
    const scalar8 upper = TO_SCALAR8(vload8(0, texels + s->first));
    const scalar8 lower = TO_SCALAR8(vload8(0, texels + s->first + s->pitch));
    const scalar8 sides = fused((scalar8)s->down, lower - upper, upper);
    return fused((scalar4)s->across, sides.hi - sides.lo, sides.lo);
}

// Textures of a material that differ only in their texels.
typedef struct texture_group {
    int count, textures[GLINT_MATERIAL_TEXTURES];
} texture_group;

// A point of a texture, and how it is read there.
typedef struct tap {
    level_choice choice;
    mask nearest;
    real u, v, weight;
} tap;

// Adds a tap. `sums` holds R, G, B, A of each ray, for each texture of the group.
static inline void add_tap(const scene_buffers *scene, const texture_group *g, const tap *p,
                           mask wanted, scalar4 sums[][GLINT_WIDTH])
{
    global const glint_texture_record *t = scene->textures + g->textures[0];
    const real u =
        wrapped(p->u, t->flags & GLINT_TEXTURE_CLAMP_S, t->flags & GLINT_TEXTURE_MIRROR_S);
    const real v =
        wrapped(p->v, t->flags & GLINT_TEXTURE_CLAMP_T, t->flags & GLINT_TEXTURE_MIRROR_T);
    const texel_square fines = square_at(t, u, v, p->choice.level, p->nearest);
    const texel_square coarses = square_at(t, u, v, p->choice.level + (lane_int)1, p->nearest);
    for (uint left = mask_bits(wanted); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left), level = (int)LANE_INT(p->choice.level, lane);
        const scalar blend = LANE(p->choice.blend, lane), weight = LANE(p->weight, lane);
        const lane_square fine = square_of_lane(&fines, lane);
        const lane_square coarse = square_of_lane(&coarses, lane);
        for (int i = 0; i < g->count; i++) {
            global const uint *first = scene->textures[g->textures[i]].first + level;
            scalar4 value = mean_of_square(scene->texels + 4 * (size_t)first[0], &fine);
            if (blend > R(0.0)) {
                const scalar4 next = mean_of_square(scene->texels + 4 * (size_t)first[1], &coarse);
                value = fused((scalar4)blend, next - value, value);
            }
            sums[i][lane] = fused((scalar4)weight, value, sums[i][lane]);
        }
    }
}

// Adds pairs of taps about the middle. The outermost pair counts in part. Below a length of 2, the
// two taps of the only pair move together. So the result does not jump when the number of taps
// changes.
static inline void add_taps(const scene_buffers *scene, const texture_group *g,
                            const texture_spot *spot, const footprint *f, tap *p, mask wanted,
                            scalar4 sums[][GLINT_WIDTH])
{
#if GLINT_ANISOTROPY
    const real unit = p->weight / f->length;
    const mask several = f->length > R(1.0);
    const real pairs = SELECT(several, R(0.5) * f->length, real_of(1));
    const real apart = SMALLER(f->length - R(1.0), real_of(1));
    for (int i = 0;; i++) {
        const scalar pair = (scalar)(i / 2), side = i % 2 == 0 ? R(1.0) : R(-1.0);
        const real share = pairs - pair;
        const mask here = wanted & (share > R(0.0)) & (i == 1 ? several : mask_all());
        if (mask_bits(here) == 0) {
            return;
        }
        const real offset = side * (pair + R(0.5)) * apart;
        p->u = fused(offset, f->u_step, spot->u);
        p->v = fused(offset, f->v_step, spot->v);
        p->weight = SMALLER(share, real_of(1)) * unit;
        add_tap(scene, g, p, here, sums);
    }
#else
    p->u = spot->u;
    p->v = spot->v;
    add_tap(scene, g, p, wanted, sums);
#endif
}

static inline void look_up_textures(const scene_buffers *scene, const texture_group *g,
                                    const texture_spot *unmoved, mask wanted,
                                    scalar4 sums[][GLINT_WIDTH])
{
    global const glint_texture_record *t = scene->textures + g->textures[0];
    const texture_spot spot = moved_spot(t, unmoved);
    const footprint seen = footprint_of(scene, t, &spot);
    const mask yes = mask_all(), no = mask_none();
    tap p;
    p.choice = choose_texture_level(t, seen.width);
    p.nearest = SELECT(seen.width > R(1.0), t->flags & GLINT_TEXTURE_MINIFIED_NEAREST ? yes : no,
                       t->flags & GLINT_TEXTURE_MAGNIFIED_NEAREST ? yes : no);
    p.weight = real_of(R(1.0) / R(65535.0));
    for (int i = 0; i < g->count; i++) {
        for (int lane = 0; lane < GLINT_WIDTH; lane++) {
            sums[i][lane] = (scalar4)R(0.0);
        }
    }
    add_taps(scene, g, &spot, &seen, &p, wanted, sums);
}

// The colour of a texture that rays see: R, G, B, A.
typedef struct texture_color {
    real r, g, b, a;
} texture_color;

static inline texture_color color_of_lanes(const scalar4 values[GLINT_WIDTH])
{
    texture_color c;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE(c.r, lane) = values[lane].x;
        LANE(c.g, lane) = values[lane].y;
        LANE(c.b, lane) = values[lane].z;
        LANE(c.a, lane) = values[lane].w;
    }
    return c;
}

#endif
