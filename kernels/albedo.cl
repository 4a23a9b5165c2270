// Finds the share of a white environment that lobes reflect, from a table (layout.h, Lobes). For
// surfaces that are rougher along a direction, sums over facets find it.
#if GLINT_ROUGH

// ∫ D V (1 − m) n·l dl and ∫ D V m n·l dl; for a single direction, their integrands.
typedef struct lobe_parts {
    real base, edge;
} lobe_parts;

// Reads both values from a table, at a place from 0 to 1 down and to the right.
static inline lobe_parts read_albedo(global const float *table, real down, real right, mask wanted)
{
    down *= (scalar)(GLINT_ALBEDO_ROUGHNESSES - 1);
    right *= (scalar)(GLINT_ALBEDO_COSINES - 1);
    const lanes_int last_row = int_of(GLINT_ALBEDO_ROUGHNESSES - 2);
    const lanes_int last_column = int_of(GLINT_ALBEDO_COSINES - 2);
    const lanes_int row = min(to_int_down(down), last_row);
    const lanes_int column = min(to_int_down(right), last_column);
    const real below = down - to_real(row), beside = right - to_real(column);
    lobe_parts albedo = {real_of(0), real_of(0)};
    for (uint left = mask_bits(wanted); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        const size_t first =
            (size_t)(LANE_INT(row, lane) * GLINT_ALBEDO_COSINES + LANE_INT(column, lane));
        global const float *lower = table + 2 * (first + GLINT_ALBEDO_COSINES);
        const scalar4 a = TO_SCALAR4(vload4(0, table + 2 * first));
        const scalar4 b = TO_SCALAR4(vload4(0, lower));
        const scalar4 sides = fused((scalar4)LANE(below, lane), b - a, a);
        const scalar share = LANE(beside, lane);
        LANE(albedo.base, lane) = fused(share, sides.z - sides.x, sides.x);
        LANE(albedo.edge, lane) = fused(share, sides.w - sides.y, sides.y);
    }
    return albedo;
}

// The share of a white environment that a lobe reflects.
static inline lobe_parts find_albedo(const scene_buffers *scene, real cosine, real roughness,
                                     mask wanted)
{
    const real t = sqrt(cosine);
    const real near = t / LARGER(t + roughness, real_of(R(1e-6)));
    const real right = R(0.5) * fused(near, roughness, t + near);
    return read_albedo(scene->cells.values, roughness, right, wanted);
}

#if GLINT_BRUSHED
// The albedo of a surface that is rougher along a direction. It is the mean over visible facets
// (see facets.cl) of the share of light that no other facet blocks. The facets that are seen
// flattest, where this changes fastest, stand closer and count less. `along` is v along the
// direction of larger roughness.
#define BRUSHED_FACETS 128
static inline lobe_parts brushed_albedo(real cosine, real along, real roughness, real anisotropy)
{
    const real alpha = roughness * roughness;
    const real longer = fused(R(1.0) - alpha, anisotropy * anisotropy, alpha);
    const real aside = sqrt(LARGER(R(1.0) - cosine * cosine - along * along, real_of(0)));
    const real x = longer * along, y = alpha * aside;
    const real root = sqrt(fused(x, x, fused(y, y, cosine * cosine)));
    const real shrink = R(1.0) / root;
    const real vx = x * shrink, vy = y * shrink, vz = cosine * shrink;
    lobe_parts sum = {real_of(0), real_of(0)};
    scalar c = R(1.0), s = R(0.0); // of the facet's turn, which advances by the golden section
    for (int i = 0; i < BRUSHED_FACETS; i++) {
        const scalar rest = R(1.0) - ((scalar)i + R(0.5)) / (scalar)BRUSHED_FACETS;
        const real z = fused(real_of(rest * rest - R(1.0)), R(1.0) + vz, real_of(1));
        const real ring = sqrt(LARGER((R(1.0) - z) * (R(1.0) + z), real_of(0)));
        const real hx = longer * fused(ring, real_of(c), vx), hy = alpha * fused(ring, real_of(s), vy);
        const real up = z + vz;
        const real inverse = R(1.0) / sqrt(fused(hx, hx, fused(hy, hy, up * up)) + R(1e-12));
        const real toward = fused(along, hx, fused(aside, hy, cosine * up)) * inverse;
        const real twice = R(2.0) * toward * inverse;
        const real away = fused(twice, up, -cosine);
        const real lx = longer * fused(twice, hx, -along), ly = alpha * fused(twice, hy, -aside);
        const real root_of_l = sqrt(fused(lx, lx, fused(ly, ly, away * away)));
        const real open = away * (cosine + root) / fused(away, root, cosine * root_of_l);
        const real weight = SELECT(away > R(0.0), open * (R(2.0) * rest), real_of(0));
        // Sum Schlick's two parts, and turn on.
        const real m = LARGER(R(1.0) - toward, real_of(0)), m2 = m * m;
        const real edge = weight * (m2 * m2 * m);
        sum.edge += edge;
        sum.base += weight - edge;
        const scalar turned = c * R(-0.7373688780783197) - s * R(0.6754902942615238);
        s = c * R(0.6754902942615238) + s * R(-0.7373688780783197);
        c = turned;
    }
    sum.edge *= (scalar)1 / BRUSHED_FACETS;
    sum.base *= (scalar)1 / BRUSHED_FACETS;
    return sum;
}
#endif

#endif
