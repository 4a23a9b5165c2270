// The stack of solids that each path is inside, packed into one whole number: GLINT_MEDIA_BITS bits
// an entry, the innermost lowest, GLINT_MEDIA_CAPACITY entries, 30 bits at most, so that the number
// is never negative. Entry 0 is empty space.
#if GLINT_SOLID

#define MEDIUM_MASK ((lane_int)((1 << GLINT_MEDIA_BITS) - 1))
#define MEDIA_MASK ((lane_int)((1 << (GLINT_MEDIA_BITS * GLINT_MEDIA_CAPACITY)) - 1))

static inline lanes_int medium_on_top(lanes_int media) { return media & MEDIUM_MASK; }

// The stack inside `medium` as well. Where it was full, its outermost entry is lost, and `lost` set.
static inline lanes_int enter_medium(lanes_int media, lanes_int medium, mask *lost)
{
#if GLINT_NESTED_MEDIA
    *lost = (media >> (lane_int)(GLINT_MEDIA_BITS * (GLINT_MEDIA_CAPACITY - 1))) != (lane_int)0;
    return ((media << (lane_int)GLINT_MEDIA_BITS) & MEDIA_MASK) | medium;
#else
    *lost = mask_none();
    return medium;
#endif
}

// The stack without the innermost entry that is `medium`; unchanged where there is none.
static inline lanes_int leave_medium(lanes_int media, lanes_int medium)
{
#if GLINT_NESTED_MEDIA
    lanes_int left = media;
    mask found = mask_none();
    for (int k = 0; k < GLINT_MEDIA_CAPACITY; k++) {
        const lane_int below = k * GLINT_MEDIA_BITS, above = below + GLINT_MEDIA_BITS;
        mask here = !found & (((media >> below) & MEDIUM_MASK) == medium);
        lanes_int inner = media & (lane_int)((1 << below) - 1);
        left = SELECT(here, ((media >> above) << below) | inner, left);
        found |= here;
    }
    return left;
#else
    return SELECT(media == medium, int_of(0), media);
#endif
}

static inline real medium_ior(global const glint_medium_record *media, lanes_int medium)
{
    real ior;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE(ior, lane) = media[LANE_INT(medium, lane)].ior;
    }
    return ior;
}

#if GLINT_ABSORPTION
// What is left of light after the distance s in a medium: exp(−σs), Beer and Lambert.
static inline real3 medium_transmittance(global const glint_medium_record *media, lanes_int medium,
                                         real s)
{
    real3 sigma;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        global const glint_medium_record *record = media + LANE_INT(medium, lane);
        LANE(sigma.x, lane) = JOIN(record->absorption_high[0], record->absorption_low[0]);
        LANE(sigma.y, lane) = JOIN(record->absorption_high[1], record->absorption_low[1]);
        LANE(sigma.z, lane) = JOIN(record->absorption_high[2], record->absorption_low[2]);
    }
    return real3_of(exp_of_negative(-sigma.x * s), exp_of_negative(-sigma.y * s),
                    exp_of_negative(-sigma.z * s));
}
#endif

#endif
