// What the frame says of directions, and what the environment sends to surfaces.

static inline real3 join_vector(const glint_split_vector *v)
{
    return real3_of(real_of(JOIN(v->high[0], v->low[0])), real_of(JOIN(v->high[1], v->low[1])),
                    real_of(JOIN(v->high[2], v->low[2])));
}

// The environment turned by the angle a about +Y is looked up along d turned by −a.
static inline real3 turn_into_environment(const glint_frame_record *frame, real3 d)
{
    if (!GLINT_ENV_ROTATION) {
        return d;
    }
    real c = real_of(JOIN(frame->env_rotation[0], frame->env_rotation[1]));
    real s = real_of(JOIN(frame->env_rotation[2], frame->env_rotation[3]));
    return real3_of(fused(c, d.x, -(s * d.z)), d.y, fused(s, d.x, c * d.z));
}

// The irradiance over π: from the map or, with IRRADIANCE_HARMONICS, the polynomial of layout.h.
// Where that is negative, which is a few percent of a single light's at most, there is no light.
static inline real3 find_irradiance(const scene_buffers *scene, real3 n, mask wanted)
{
    if (!GLINT_IRRADIANCE_HARMONICS) {
        return sample_cube(&scene->irradiance, n, wanted);
    }
    global const float *coefficients = scene->irradiance.texels;
    const real terms[GLINT_HARMONICS] = GLINT_HARMONIC_TERMS(n.x, n.y, n.z);
    real3 sum = real3_of(real_of(0), real_of(0), real_of(0));
    for (int k = 0; k < GLINT_HARMONICS; k++) {
        global const float *c = coefficients + 4 * k;
        sum = scale_add(real3_of(real_of(c[0]), real_of(c[1]), real_of(c[2])), terms[k], sum);
    }
    return real3_of(LARGER(sum.x, real_of(0)), LARGER(sum.y, real_of(0)),
                    LARGER(sum.z, real_of(0)));
}

// Where rays leave the proxy's box: the last of the slabs' far planes that they come to first, if
// they are then past the last near one. A ray in a slab's plane is in that slab: where 0 · ∞ is NaN
// the comparisons let the other planes decide.
static inline mask leave_box(real3 from_middle, real3 d, real3 half_extent, real *exit)
{
    const real p[3] = {from_middle.x, from_middle.y, from_middle.z}, v[3] = {d.x, d.y, d.z};
    const real half_of[3] = {half_extent.x, half_extent.y, half_extent.z};
    real enter = real_of(-INFINITY);
    *exit = real_of(INFINITY);
    for (int k = 0; k < 3; k++) {
        const real inverse = R(1.0) / v[k];
        const real one = (-half_of[k] - p[k]) * inverse, other = (half_of[k] - p[k]) * inverse;
        const real near = SMALLER(one, other), far = LARGER(one, other);
        enter = LARGER(near, enter);
        *exit = SMALLER(far, *exit);
    }
    return *exit > enter;
}

// Likewise the sphere. The distance of its middle to the ray is taken along what is left of the way
// there at right angles to it, which keeps its digits however far the ray begins.
static inline mask leave_sphere(real3 from_middle, real3 d, real radius, real *exit)
{
    const real along = dot3(from_middle, d);
    const real3 beside = scale_add(d, -along, from_middle);
    const real squared = fused(radius, radius, -dot3(beside, beside));
    *exit = sqrt(LARGER(squared, real_of(0))) - along;
    return squared > R(0.0);
}

// The directions in which the environment shows what rays come to that start at `origin`, `behind`
// further back at the eye, along the unit vectors d: from where it was seen to where they leave the
// proxy. What does not come to it is seen as if it were infinitely far away.
static inline real3 toward_proxy(const glint_frame_record *frame, real3 origin, real3 d,
                                 real behind)
{
    const real3 half_extent = join_vector(&frame->proxy_half);
    const real3 from_middle = subtract(origin, join_vector(&frame->proxy_middle));
    real exit;
    const mask leaves = frame->proxy_is_sphere ? leave_sphere(from_middle, d, half_extent.x, &exit)
                                               : leave_box(from_middle, d, half_extent, &exit);
    const mask ahead = leaves & (exit > -behind);
    const real3 seen = scale_add(d, exit, subtract(origin, join_vector(&frame->proxy_center)));
    return select3(ahead & !is_zero3(seen), seen, d);
}
