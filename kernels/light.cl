// What the frame says of directions, and what the environment sends to surfaces.

static inline real3 join_vector(const glint_split_vector *v)
{
    return real3_of(real_of(JOIN(v->high[0], v->low[0])), real_of(JOIN(v->high[1], v->low[1])),
                    real_of(JOIN(v->high[2], v->low[2])));
}

#if GLINT_ENV_ROTATION
// The environment turned by the angle a about +Y is looked up along d turned by −a.
static inline real3 turn_into_environment(const glint_frame_record *frame, real3 d)
{
    real c = real_of(JOIN(frame->env_rotation[0], frame->env_rotation[1]));
    real s = real_of(JOIN(frame->env_rotation[2], frame->env_rotation[3]));
    return real3_of(fused(c, d.x, -(s * d.z)), d.y, fused(s, d.x, c * d.z));
}
#else
static inline real3 turn_into_environment(const glint_frame_record *frame, real3 d) { return d; }
#endif

#if GLINT_IRRADIANCE_HARMONICS
// The polynomial of layout.h; where it is negative, which is a few percent of a single light's at
// most, there is no light.
static inline real3 find_irradiance(const scene_buffers *scene, real3 n, mask wanted)
{
    global const float *coefficients = scene->irradiance.texels;
    const real terms[GLINT_HARMONICS] = GLINT_HARMONIC_TERMS(n.x, n.y, n.z);
    real3 sum = real3_of(real_of(0), real_of(0), real_of(0));
    (void)wanted;
    for (int k = 0; k < GLINT_HARMONICS; k++) {
        global const float *c = coefficients + 4 * k;
        sum = scale_add(real3_of(real_of(c[0]), real_of(c[1]), real_of(c[2])), terms[k], sum);
    }
    return real3_of(LARGER(sum.x, real_of(0)), LARGER(sum.y, real_of(0)),
                    LARGER(sum.z, real_of(0)));
}
#elif NEEDS_IRRADIANCE
static inline real3 find_irradiance(const scene_buffers *scene, real3 n, mask wanted)
{
    return sample_cube(&scene->irradiance, n, wanted);
}
#endif
