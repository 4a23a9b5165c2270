// Counts events on a work-item's paths, and records facts about its tile's pixels.

// The reasons why paths are cut short.
enum cut { BY_DEPTH, BY_MIN_WEIGHT, BY_STACK, CUTS };

// A work-item's counts, which are added to the counters at its end, and its records.
typedef struct tally {
    ulong counts[GLINT_COUNTERS];
    lanes_int deepest; // largest number of surfaces that a path has met
#if GLINT_FACETS
    facet_choice facets;
    bool faceted[TILE_PIXELS]; // true if the pixel's paths met rough glass
#endif
#if GLINT_DISPERSION
    int wavelength;
    bool dispersed[TILE_PIXELS]; // true if the pixel's paths met a dispersive solid
#endif
#if HAS_ROUNDS
    scalar cut[CUTS][TILE_PIXELS]; // weight that truncation cut off the pixel's paths
#else
    real cut[CUTS]; // weight that truncation cut off paths
#endif
#if GLINT_TRUNCATION_SQUARES
    scalar truncated[TILE_PIXELS]; // weight that truncation cut off, by pixel
#endif
#if GLINT_DIAGNOSTICS
    layers *layers; // of the tile's pixels
#endif
#if GLINT_TERMS
    terms *terms; // of the tile's pixels
#endif
} tally;

static inline tally no_tally(void)
{
    tally t;
    for (int i = 0; i < GLINT_COUNTERS; i++) {
        t.counts[i] = 0;
    }
    t.deepest = int_of(0);
#if GLINT_DISPERSION
    t.wavelength = 0;
#endif
#if HAS_ROUNDS
    for (int i = 0; i < TILE_PIXELS; i++) {
#if GLINT_FACETS
        t.faceted[i] = false;
#endif
#if GLINT_DISPERSION
        t.dispersed[i] = false;
#endif
        t.cut[BY_DEPTH][i] = t.cut[BY_MIN_WEIGHT][i] = t.cut[BY_STACK][i] = 0;
    }
#else
    t.cut[BY_DEPTH] = t.cut[BY_MIN_WEIGHT] = t.cut[BY_STACK] = real_of(0);
#endif
#if GLINT_TRUNCATION_SQUARES
    for (int i = 0; i < TILE_PIXELS; i++) {
        t.truncated[i] = 0;
    }
#endif
    return t;
}

// Counts the rays in `these`: they take the environment untraced, for lack of depth, weight or
// room.
static inline void count_truncated(tally *tally, const pixels *pixels, mask these, real weight)
{
#if GLINT_TRUNCATION_SQUARES
    for (uint left = mask_bits(these); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        tally->truncated[pixel_of(*pixels, lane)] += LANE(weight, lane);
    }
#endif
}

// Counts the rays in `these` as cut short, for the given reason.
static inline void count_cut(tally *tally, const pixels *pixels, mask these, real weight,
                             enum cut by)
{
#if HAS_ROUNDS
    for (uint left = mask_bits(these); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        tally->cut[by][pixel_of(*pixels, lane)] += LANE(weight, lane);
    }
#else
    tally->cut[by] += SELECT(these, weight, real_of(0));
#endif
}

#if HAS_ROUNDS
// Records that the pixels of the rays in `these` need more rounds. Only the first wavelength
// decides, for all wavelengths, so that each adds the same number of rounds.
static inline void note_pixels(const tally *tally, const pixels *pixels, mask these,
                               bool of_tile[TILE_PIXELS])
{
#if GLINT_DISPERSION
    if (tally->wavelength > 0) {
        return;
    }
#endif
    for (uint left = mask_bits(these); left != 0; left &= left - 1) {
        of_tile[pixel_of(*pixels, lowest_bit(left))] = true;
    }
}

// The weight of one round in a pixel.
static inline scalar share_of_round(const tally *tally, const glint_frame_record *frame, int pixel)
{
    int rounds = 1;
#if GLINT_FACETS
    rounds *= tally->faceted[pixel] ? frame->facet_rounds : 1;
#endif
#if GLINT_DISPERSION
    rounds *= tally->dispersed[pixel] ? frame->wavelengths : 1;
#endif
    return R(1.0) / (scalar)rounds;
}
#else
#define share_of_round(tally, frame, pixel) R(1.0)
#endif
