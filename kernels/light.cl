// Finds the light that the environment sends to surfaces.

// If the environment is turned by the angle a about +Y, it is looked up along d turned by −a.
static inline real3 turn_into_environment(const glint_frame_record *frame, real3 d)
{
    if (!HAS_IN(frame, ENV_ROTATION)) {
        return d;
    }
    real c = real_of(JOIN(frame->env_rotation[0], frame->env_rotation[1]));
    real s = real_of(JOIN(frame->env_rotation[2], frame->env_rotation[3]));
    return real3_of(fused(c, d.x, -(s * d.z)), d.y, fused(s, d.x, c * d.z));
}

// The irradiance over π: from the map or, with IRRADIANCE_HARMONICS, from the polynomial of
// layout.h. Negative values of the polynomial become 0. With a single light they are at most a few
// percent.
static inline real3 find_irradiance(const scene_buffers *scene, real3 n, mask wanted)
{
    if (!HAS(IRRADIANCE_HARMONICS)) {
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

// The distance at which rays leave the proxy's box: the nearest of the slabs' far planes. A ray
// leaves the box only if this plane lies behind the last near plane. A ray in the plane of a slab
// is inside that slab: there 0 · ∞ is NaN, and the comparisons let the other planes decide.
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

// The same distance for a sphere. The distance from its middle to the ray is the length of the part
// of the vector `from_middle` at right angles to d. It keeps its digits for any distance of the
// ray's start.
static inline mask leave_sphere(real3 from_middle, real3 d, real radius, real *exit)
{
    const real along = dot3(from_middle, d);
    const real3 beside = scale_add(d, -along, from_middle);
    const real squared = fused(radius, radius, -dot3(beside, beside));
    *exit = sqrt(LARGER(squared, real_of(0))) - along;
    return squared > R(0.0);
}

// Returns the directions in which the environment shows the points that rays reach. The rays start
// at `origin` along the unit vectors d; the eye is `behind` further back. Each direction leads from
// the point where the environment was seen to the point where the ray leaves the proxy. A ray that
// misses the proxy sees the environment infinitely far away.
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
