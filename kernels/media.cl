// The stack of solids that each path is inside, packed into one whole number: GLINT_MEDIA_BITS bits
// an entry, the innermost lowest, GLINT_MEDIA_CAPACITY entries, 30 bits at most, so that the number
// is never negative. Entry 0 is empty space.

#define MEDIUM_MASK ((lane_int)((1 << GLINT_MEDIA_BITS) - 1))
#define MEDIA_MASK ((lane_int)((1 << (GLINT_MEDIA_BITS * GLINT_MEDIA_CAPACITY)) - 1))

static inline lanes_int medium_on_top(lanes_int media) { return media & MEDIUM_MASK; }

// The stack inside `medium` as well. Where it was full, its outermost entry is lost, and `lost`
// set.
static inline lanes_int enter_medium(lanes_int media, lanes_int medium, mask *lost)
{
    if (!GLINT_NESTED_MEDIA) {
        *lost = mask_none();
        return medium;
    }
    *lost = (media >> (lane_int)(GLINT_MEDIA_BITS * (GLINT_MEDIA_CAPACITY - 1))) != (lane_int)0;
    return ((media << (lane_int)GLINT_MEDIA_BITS) & MEDIA_MASK) | medium;
}

// The stack without the innermost entry that is `medium`; unchanged where there is none. Nearly
// always that is the first one.
static inline lanes_int leave_medium(lanes_int media, lanes_int medium)
{
    if (!GLINT_NESTED_MEDIA) {
        return SELECT(media == medium, int_of(0), media);
    }
    lanes_int left = media;
    mask searched = media != (lane_int)0;
    for (int k = 0; k < GLINT_MEDIA_CAPACITY && any_lane(searched); k++) {
        const lane_int below = k * GLINT_MEDIA_BITS, above = below + GLINT_MEDIA_BITS;
        mask here = searched & (((media >> below) & MEDIUM_MASK) == medium);
        lanes_int inner = media & (lane_int)((1 << below) - 1);
        left = SELECT(here, ((media >> above) << below) | inner, left);
        searched = searched & !here & ((media >> above) != (lane_int)0);
    }
    return left;
}

#if GLINT_OVERLAPS
// One path's stack is in order here: the highest medium is on top, whatever was entered last.
static inline lane_int top_medium(lane_int media) { return media & MEDIUM_MASK; }

// The stack inside `medium` as well; true if its lowest entry was lost, as it was full.
static inline bool insert_medium(lane_int *media, lane_int medium)
{
    const lane_int old = *media;
    int shift = 0;
    while (((old >> shift) & MEDIUM_MASK) > medium) {
        shift += GLINT_MEDIA_BITS;
    }
    const lane_int above = old & (((lane_int)1 << shift) - 1), below = old >> shift;
    *media = (((((below << GLINT_MEDIA_BITS) | medium) << shift) | above)) & MEDIA_MASK;
    return (old >> (GLINT_MEDIA_BITS * (GLINT_MEDIA_CAPACITY - 1))) != 0;
}

// The stack outside `medium`; false, and unchanged, if it was not in it.
static inline bool remove_medium(lane_int *media, lane_int medium)
{
    const lane_int old = *media;
    for (int shift = 0; (old >> shift) != 0; shift += GLINT_MEDIA_BITS) {
        if (((old >> shift) & MEDIUM_MASK) == medium) {
            const lane_int above = old & (((lane_int)1 << shift) - 1);
            *media = (((old >> shift) >> GLINT_MEDIA_BITS) << shift) | above;
            return true;
        }
    }
    return false;
}
#endif

// The index of refraction at a wavelength, of which `step` is the ior_step.
static inline real medium_ior(global const glint_medium_record *media, lanes_int medium,
                              scalar step)
{
    real ior = real_of(1);
    uint left = mask_bits(mask_all());
    while (left != 0) {
        int number;
        mask alike = next_alike(medium, &left, &number);
        scalar of_medium = media[number].ior;
#if GLINT_DISPERSION
        of_medium = max(of_medium + step * (scalar)media[number].dispersion, R(1.0));
#endif
        ior = SELECT(alike, real_of(of_medium), ior);
    }
    return ior;
}

// What is left of light after the distance s in a medium: exp(−σs), Beer and Lambert.
static inline real3 medium_transmittance(global const glint_medium_record *media, lanes_int medium,
                                         real s)
{
    real3 sigma = real3_of(real_of(0), real_of(0), real_of(0));
    uint left = mask_bits(mask_all());
    while (left != 0) {
        int number;
        mask alike = next_alike(medium, &left, &number);
        global const float *high = media[number].absorption_high,
                           *low = media[number].absorption_low;
        sigma.x = SELECT(alike, real_of(JOIN(high[0], low[0])), sigma.x);
        sigma.y = SELECT(alike, real_of(JOIN(high[1], low[1])), sigma.y);
        sigma.z = SELECT(alike, real_of(JOIN(high[2], low[2])), sigma.z);
    }
    return real3_of(exp_of_negative(-sigma.x * s), exp_of_negative(-sigma.y * s),
                    exp_of_negative(-sigma.z * s));
}
