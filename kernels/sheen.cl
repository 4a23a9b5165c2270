// Computes sheen (KHR_materials_sheen): the light of fibres that stand on a surface, as on velvet.
// The distribution of their half vectors is D = (2 + 1/α) sin^(1/α) θ_h/2π with α = roughness². The
// shadowing term Λ, by which fibres hide each other, is a fit (Estevez and Kulla, Production
// Friendly Microfacet Sheen BRDF, 2017).
#if GLINT_SHEEN

// Fibres of one roughness, seen from one direction.
typedef struct sheen {
    real power;         // 1/α
    real a, b, c, d, e; // parameters of the fit
    real twice_middle;  // 2 L(½)
    real scale;         // (2 + 1/α)/(2π 4 n·v)
    real of_view;       // 1 + Λ(v)
} sheen;

// The amount Λ by which fibres hide light. Then its first and second derivatives with respect to
// the cosine to the normal, over Λ.
typedef struct sheen_cover {
    real hidden, slope, bend;
} sheen_cover;

// L of the fit and its derivatives, for x in [0, ½].
static inline sheen_cover fit_of_sheen(const sheen *f, real x)
{
    const real at = LARGER(x, real_of(R(1e-6))), inverse = R(1.0) / at;
    const real power = f->b * power_of(at, f->c), below = R(1.0) / (R(1.0) + power);
    const real changed = f->a * f->c * power * below * below * inverse;
    const real curved = R(1.0) - f->c + R(2.0) * f->c * power * below;
    const sheen_cover fit = {fused(f->d, x, f->e) + f->a * below, f->d - changed,
                             changed * curved * inverse};
    return fit;
}

// Λ at a cosine in [0, 1]: e^L(x), mirrored about ½. L is less than 24.
static inline sheen_cover hidden_by_sheen(const sheen *f, real cosine)
{
    const mask high = cosine >= R(0.5);
    const sheen_cover fit = fit_of_sheen(f, SELECT(high, R(1.0) - cosine, cosine));
    const real exponent = SELECT(high, f->twice_middle - fit.hidden, fit.hidden);
    sheen_cover cover;
    cover.hidden = exp_of_negative(exponent - R(24.0)) * R(26489122129.84347);
    cover.slope = fit.slope;
    cover.bend = fused(fit.slope, fit.slope, SELECT(high, -fit.bend, fit.bend));
    return cover;
}

static inline sheen find_sheen(real roughness, real cosine)
{
    sheen f;
    const real alpha = roughness * roughness, rest = (R(1.0) - alpha) * (R(1.0) - alpha);
    f.power = R(1.0) / alpha;
    f.a = fused(rest, real_of(R(25.3245) - R(21.5473)), real_of(R(21.5473)));
    f.b = fused(rest, real_of(R(3.32435) - R(3.82987)), real_of(R(3.82987)));
    f.c = fused(rest, real_of(R(0.16801) - R(0.19823)), real_of(R(0.19823)));
    f.d = fused(rest, real_of(R(-1.27393) - R(-1.97760)), real_of(R(-1.97760)));
    f.e = fused(rest, real_of(R(-4.85967) - R(-4.32054)), real_of(R(-4.32054)));
    f.twice_middle = R(2.0) * fit_of_sheen(&f, real_of(R(0.5))).hidden;
    cosine = LARGER(cosine, real_of(R(1e-4)));
    f.scale = (R(2.0) + f.power) * R(0.03978873577297384) / cosine;
    f.of_view = R(1.0) + hidden_by_sheen(&f, cosine).hidden;
    return f;
}

// D V n·l towards a direction l. `sine_squared` is the squared sine of the half vector to the
// normal; `hidden` is Λ(l). The cosine n·l cancels in V = 1/(4 n·v n·l (1 + Λ(v) + Λ(l))).
static inline real weigh_sheen(const sheen *f, real sine_squared, real hidden)
{
    return f->scale * power_of(sine_squared, R(0.5) * f->power) / (f->of_view + hidden);
}

#endif
