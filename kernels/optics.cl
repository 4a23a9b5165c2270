// Optics at one surface: reflection, refraction, Fresnel's equations, absorption.
//
// v is the unit vector to the viewer and n the unit shading normal on the viewer's side;
// cosine = n·v, in [0, 1].

// The mirror direction r = 2n(n·v) − v.
static inline real3 reflect_direction(real3 v, real3 n, real cosine)
{
    return scale_add(n, R(2.0) * cosine, negate(v));
}

// cos² of the transmitted angle by Snell's law, eta = n_i/n_t; negative where all is reflected.
// 1 − η²(1 − cos²) is written as (1 − η)(1 + η) + (η cos)², which does not cancel near η = 1.
static inline real transmitted_cosine_squared(real cosine, real eta)
{
    real scaled = eta * cosine;
    return fused(scaled, scaled, (R(1.0) - eta) * (R(1.0) + eta));
}

// The refracted direction t = −η v + (η cos θi − cos θt) n.
static inline real3 refract_direction(real3 v, real3 n, real cosine, real eta, real cosine_t)
{
    return scale_add(n, fused(eta, cosine, -cosine_t), scale(v, -eta));
}

// The unpolarised reflectance of a dielectric interface (Fresnel): the mean of the squared
// amplitudes r_s = (η cos θi − cos θt)/(η cos θi + cos θt) and
// r_p = (cos θi − η cos θt)/(cos θi + η cos θt).
// The denominators vanish only where η = 1 at 90°, together with the numerators: the limit is 0.
static inline real dielectric_reflectance(real cosine, real cosine_t, real eta)
{
    const real tiny = real_of(R(1e-30));
    real s_sum = fused(eta, cosine, cosine_t);
    real p_sum = fused(eta, cosine_t, cosine);
    real s = fused(eta, cosine, -cosine_t) / LARGER(s_sum, tiny);
    real p = fused(-eta, cosine_t, cosine) / LARGER(p_sum, tiny);
    return R(0.5) * fused(s, s, p * p);
}

// The same for light that comes from empty space onto a surface of index `ior`.
static inline real surface_reflectance(real cosine, real ior)
{
    real eta = R(1.0) / ior;
    real squared = transmitted_cosine_squared(cosine, eta);
    // With η ≤ 1 there is no total reflection; rounding must not take the root of −0.0…1 either.
    real cosine_t = sqrt(LARGER(squared, real_of(0)));
    return dielectric_reflectance(cosine, cosine_t, eta);
}

// Schlick's approximation for metal, glTF 2.0: F0 + (1 − F0)(1 − cos θ)⁵; F0 if it does not rise.
static inline real3 metal_reflectance(real3 f0, real cosine, bool rises)
{
    if (!rises) {
        return f0;
    }
    real m = R(1.0) - cosine;
    real m2 = m * m;
    real m5 = m2 * m2 * m;
    return real3_of(fused(R(1.0) - f0.x, m5, f0.x), fused(R(1.0) - f0.y, m5, f0.y),
                    fused(R(1.0) - f0.z, m5, f0.z));
}

// √(α² + (1 − α²) cos²), of which Smith's shadowing by GGX's microfacets is made.
static inline real smith_root(real alpha_squared, real cosine)
{
    return sqrt(fused((R(1.0) - alpha_squared) * cosine, cosine, alpha_squared));
}

// A direction that ends on the wrong side of the surface is folded back across its plane:
// q − 2(q·n_g)n_g, which is continuous and keeps the length. `sign` is +1 where q belongs on the
// side of the geometric normal, −1 where on the other.
static inline real3 fold_to_side(real3 q, real3 geometric_normal, scalar sign)
{
    real side = dot3(q, geometric_normal);
    real3 folded = scale_add(geometric_normal, R(-2.0) * side, q);
    return select3(side * sign < R(0.0), folded, q);
}

// e^x for x ≤ 0, within about one unit in the last place. OpenCL's own exp() differs in its last
// bit between scalars and vectors, and a frame must not depend on the packet's width. x = k ln 2 +
// r with |r| ≤ ln(2)/2, and e^r is its Taylor sum up to where it no longer counts.
static inline real exp_of_negative(real x)
{
#if GLINT_DOUBLE
    const scalar least = -708.0; // beyond, the result is (nearly) denormal: 0
    const lane_int bias = 1023, mantissa_bits = 52;
    const int terms = 13;
#else
    const scalar least = -87.0f;
    const lane_int bias = 127, mantissa_bits = 23;
    const int terms = 7;
#endif
    mask vanishes = !(x > least);
    real bounded = SELECT(vanishes, real_of(least), x);
    lanes_int k = to_int_down(fused(bounded, real_of(R(1.4426950408889634)), real_of(R(0.5))));
    // ln 2 in two parts: k times the first is exact.
    real r = fused(-to_real(k), real_of(R(0.693145751953125)), bounded);
    r = fused(-to_real(k), real_of(R(1.42860682030941723212e-6)), r);
    real sum = real_of(1);
    for (int n = terms; n > 0; n--) {
        sum = fused(sum * r, real_of(R(1.0) / (scalar)n), real_of(1));
    }
    real power = real_from_bits((k + bias) << mantissa_bits);
    return SELECT(vanishes, real_of(0), sum * power);
}

#if GLINT_SHEEN
// ln x for normal x > 0, within 1e-7, for the same reason: x = m 2ᵏ with m in (√½, √2], and ln m =
// 2 artanh((m − 1)/(m + 1)), whose series converges fast.
static inline real natural_log(real x)
{
    const int terms = 3;
    real m = x * inverse_exponent(x);
    const mask high = m > R(1.4142135623730951);
    m = SELECT(high, R(0.5) * m, m);
    const real k = to_real(exponent_of(x)) + SELECT(high, real_of(1), real_of(0));
    const real s = (m - R(1.0)) / (m + R(1.0)), square = s * s;
    real sum = real_of(0);
    for (int n = terms; n >= 0; n--) {
        sum = fused(sum, square, real_of(R(2.0) / (scalar)(2 * n + 1)));
    }
    return fused(k, real_of(R(0.6931471805599453)), s * sum);
}

// x to the power p, for x in [0, 1] and p > 0.
static inline real power_of(real x, real p)
{
    return exp_of_negative(p * natural_log(LARGER(x, real_of(R(1e-30)))));
}
#endif
