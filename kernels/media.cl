// Keeps the stack of solids that each path is inside, packed into one whole number. It has
// `media_capacity` entries of `media_bits` bits each; the innermost solid is in the lowest bits. It
// has at most 30 bits, so the number is never negative. Entry 0 is empty space.

// The bits of the innermost entry, and of the whole stack.
static inline lane_int medium_mask(const scene_buffers *scene)
{
    return (1 << scene->media_bits) - 1;
}

static inline lane_int media_mask(const scene_buffers *scene)
{
    return (1 << (scene->media_bits * scene->media_capacity)) - 1;
}

// The first bit of the outermost entry.
static inline lane_int outermost_bit(const scene_buffers *scene)
{
    return scene->media_bits * (scene->media_capacity - 1);
}

static inline lanes_int medium_on_top(const scene_buffers *scene, lanes_int media)
{
    return media & medium_mask(scene);
}

// Pushes `medium` onto the stack. If the stack was full, it loses its outermost entry, and `lost`
// is set.
static inline lanes_int enter_medium(const scene_buffers *scene, lanes_int media, lanes_int medium,
                                     mask *lost)
{
    if (!GLINT_NESTED_MEDIA) {
        *lost = mask_none();
        return medium;
    }
    *lost = (media >> outermost_bit(scene)) != (lane_int)0;
    return ((media << (lane_int)scene->media_bits) & media_mask(scene)) | medium;
}

// Removes the innermost entry `medium` from the stack. Without such an entry the stack stays
// unchanged. Nearly always it is the first entry.
static inline lanes_int leave_medium(const scene_buffers *scene, lanes_int media, lanes_int medium)
{
    if (!GLINT_NESTED_MEDIA) {
        return SELECT(media == medium, int_of(0), media);
    }
    lanes_int left = media;
    mask searched = media != (lane_int)0;
    for (int k = 0; k < scene->media_capacity && any_lane(searched); k++) {
        const lane_int below = k * scene->media_bits, above = below + scene->media_bits;
        mask here = searched & (((media >> below) & medium_mask(scene)) == medium);
        lanes_int inner = media & (lane_int)((1 << below) - 1);
        left = SELECT(here, ((media >> above) << below) | inner, left);
        searched = searched & !here & ((media >> above) != (lane_int)0);
    }
    return left;
}

#if GLINT_OVERLAPS
// With OVERLAPS each stack is sorted: the highest medium is on top, whatever the path entered last.
static inline lane_int top_medium(const scene_buffers *scene, lane_int media)
{
    return media & medium_mask(scene);
}

// Inserts `medium` into the stack. True if the stack was full and lost its lowest entry.
static inline bool insert_medium(const scene_buffers *scene, lane_int *media, lane_int medium)
{
    const lane_int old = *media;
    int shift = 0;
    while (((old >> shift) & medium_mask(scene)) > medium) {
        shift += scene->media_bits;
    }
    const lane_int above = old & (((lane_int)1 << shift) - 1), below = old >> shift;
    *media = (((((below << scene->media_bits) | medium) << shift) | above)) & media_mask(scene);
    return (old >> outermost_bit(scene)) != 0;
}

// Removes `medium` from the stack. False if it was not in the stack.
static inline bool remove_medium(const scene_buffers *scene, lane_int *media, lane_int medium)
{
    const lane_int old = *media;
    for (int shift = 0; (old >> shift) != 0; shift += scene->media_bits) {
        if (((old >> shift) & medium_mask(scene)) == medium) {
            const lane_int above = old & (((lane_int)1 << shift) - 1);
            *media = (((old >> shift) >> scene->media_bits) << shift) | above;
            return true;
        }
    }
    return false;
}
#endif

// The index of refraction at a wavelength; `step` is the wavelength's ior_step.
static inline real medium_ior(const scene_buffers *scene, lanes_int medium, scalar step)
{
    real ior = real_of(1);
    uint left = mask_bits(mask_all());
    while (left != 0) {
        int number;
        mask alike = next_alike(medium, &left, &number);
        global const glint_medium_record *found = scene->media + number;
        scalar of_medium = found->ior;
        if (HAS(DISPERSION)) {
            of_medium = max(of_medium + step * (scalar)found->dispersion, R(1.0));
        }
        ior = SELECT(alike, real_of(of_medium), ior);
    }
    return ior;
}

// The transmittance of a medium over the distance s: exp(−σs), Beer and Lambert.
static inline real3 medium_transmittance(const scene_buffers *scene, lanes_int medium, real s)
{
    real3 sigma = real3_of(real_of(0), real_of(0), real_of(0));
    uint left = mask_bits(mask_all());
    while (left != 0) {
        int number;
        mask alike = next_alike(medium, &left, &number);
        global const float *high = scene->media[number].absorption_high;
        global const float *low = scene->media[number].absorption_low;
        sigma.x = SELECT(alike, real_of(JOIN(high[0], low[0])), sigma.x);
        sigma.y = SELECT(alike, real_of(JOIN(high[1], low[1])), sigma.y);
        sigma.z = SELECT(alike, real_of(JOIN(high[2], low[2])), sigma.z);
    }
    return real3_of(exp_of_negative(-sigma.x * s), exp_of_negative(-sigma.y * s),
                    exp_of_negative(-sigma.z * s));
}
