// Renders tiles of pixels: the entry point of the kernels. One work-item renders one tile, sample
// by sample. For each sample it finds the hits of all primary rays together. Then it follows every
// path to its end.
//
// The host compiles this file with every GLINT_<FEATURE> of features.h as 0 or 1, and GLINT_GENERAL,
// GLINT_WIDTH, GLINT_BVH_WIDTH, GLINT_DOUBLE, GLINT_HALF_TEXELS, GLINT_STACK_CAPACITY,
// GLINT_TRAVERSAL_STACK and GLINT_TILES.
#include "features.h"

// Checks needs and excludes of each feature. If a check fails, an array with the feature's name has
// a negative size, and the compiler refuses it. General kernels contain features that exclude each
// other; the plan never switches both on.
#define CHECK(name, meaning, needs, excludes, ...)                                                 \
    typedef char name##_lacks_what_it_needs[!GLINT_##name || (needs) ? 1 : -1];                    \
    typedef char                                                                                   \
        name##_is_beside_what_it_excludes[GLINT_GENERAL || !GLINT_##name || !(excludes) ? 1 : -1];
GLINT_FEATURES(CHECK)
#undef CHECK

#define NEEDS_IRRADIANCE (HAS(PAINT) || HAS(BLEND)) // the map exists only then
// Paths gather light besides the environment's look-ups.
#define GATHERS                                                                                    \
    (!GLINT_HITS &&                                                                                \
     (GLINT_PAINT || GLINT_BLEND || GLINT_UNLIT || GLINT_EMISSION || GLINT_TRANSPARENT ||          \
      GLINT_ROUGH || GLINT_VERTEX_COLOR))

// True if the kernel has the feature. A general kernel asks the frame for the features that it does
// not run always; IN is the frame record, or the scene, which repeats it.
#if GLINT_GENERAL
#define HAS_IN(in, name)                                                                           \
    (GLINT_##name && ((in)->features[GLINT_FEATURE_##name / 32] >> GLINT_FEATURE_##name % 32 & 1u))
#else
#define HAS_IN(in, name) GLINT_##name
#endif
#define HAS(name) HAS_IN(scene, name)
#define IS_COMPILED(name) GLINT_##name

// Some pixels are rendered in several rounds.
#define HAS_ROUNDS (GLINT_FACETS || GLINT_DISPERSION)

// PoCL makes three functions of a kernel, and compiles three times what is inlined into them. It
// inlines all functions that ask for the work-item's number. So kernels ask for it themselves, and
// call functions that are not inlined. GPUs inline all.
#if GLINT_WIDTH > 1
#define NOT_INLINED __attribute__((noinline))
#else
#define NOT_INLINED
#endif

#include "layout.h"
#include "arguments.h"
#include "path_state.h"
#include "lanes.cl"
#include "blocks.cl"
#include "cubemap.cl"
#include "stack.cl"
#include "places.cl"
#include "optics.cl"
#include "media.cl"
#include "frustum.cl"
#include "intersect.cl"
#include "bundle.cl"
#include "triangles.cl"
#include "tile.cl"
#include "traverse_tile.cl"
#include "light.cl"
#include "cones.cl"
#include "path.cl"
#include "textures.cl"
#include "surface.cl"
#include "shade.cl"
#include "sheen.cl"
#include "albedo.cl"
#include "rough.cl"
#include "facets.cl"
#include "film.cl"
#include "models.cl"
#include "coats.cl"
#include "scatter.cl"
#include "branches.cl"
#include "lookups.cl"
#include "stream.cl"
#include "traverse_together.cl"
#include "overlaps.cl"
#include "shadows.cl"
#include "punctual.cl"
#include "layers.cl"
#include "terms.cl"
#include "corners.cl"
#include "lobes.cl"
#include "tally.cl"
#include "leaving.cl"
#include "primary.cl"
#include "paths.cl"
#include "beginnings.cl"
#include "vertices.cl"
#include "mirrors.cl"
#include "first_surfaces.cl"

#define SAMPLES_PER_AXIS(frame) (GLINT_SUPERSAMPLING ? (frame)->samples_per_axis : 1)

// Adds to a counter of 64 bits in two words, because devices need not have 64-bit atomics.
static inline void add_to_counter(global uint *counter, ulong amount)
{
    uint low = (uint)amount, high = (uint)(amount >> 32);
    uint before = low != 0 ? atomic_add(counter, low) : 0;
    high += before + low < before ? 1 : 0;
    if (high != 0) {
        atomic_add(counter + 1, high);
    }
}

// The weight that truncation cut off paths, in the counters' unit.
static inline ulong cut_units(const tally *tally, const glint_frame_record *frame, enum cut by)
{
#if HAS_ROUNDS
    scalar sum = 0;
    for (int i = 0; i < TILE_PIXELS; i++) {
        sum += tally->cut[by][i] * share_of_round(tally, frame, i);
    }
#else
    const scalar sum = sum_of_lanes(tally->cut[by]);
#endif
    return (ulong)(sum * (scalar)(1UL << GLINT_WEIGHT_BITS));
}

#if GLINT_TRUNCATION_SQUARES
// Rounds pixel by pixel, so that the sum does not depend on which pixels share a tile.
static inline ulong squared_truncation(const tally *tally, const glint_frame_record *frame)
{
    const int k = SAMPLES_PER_AXIS(frame);
    const scalar share = R(1.0) / (scalar)(k * k);
    ulong sum = 0;
    for (int i = 0; i < TILE_PIXELS; i++) {
        const scalar weight = tally->truncated[i] * (share * share_of_round(tally, frame, i));
        sum += (ulong)(weight * weight * (scalar)(1UL << GLINT_SQUARE_BITS) + R(0.5));
    }
    return sum;
}
#endif

// Adds the work-item's counts to the counters; `slot` is the work-item's number.
static inline void report(tally *tally, const glint_frame_record *frame, uint slot,
                          global uint *counters)
{
    ulong *counts = tally->counts;
    counts[GLINT_COUNT_DEEPEST] = (ulong)largest_lane(to_real(tally->deepest));
    counts[GLINT_COUNT_WEIGHT_BY_DEPTH] = cut_units(tally, frame, BY_DEPTH);
    counts[GLINT_COUNT_WEIGHT_BY_MIN_WEIGHT] = cut_units(tally, frame, BY_MIN_WEIGHT);
    counts[GLINT_COUNT_WEIGHT_BY_STACK] = cut_units(tally, frame, BY_STACK);
#if GLINT_TRUNCATION_SQUARES
    counts[GLINT_COUNT_TRUNCATION_SQUARES] = squared_truncation(tally, frame);
#endif
    global uint *mine = counters + 2 * GLINT_COUNTERS * (slot % GLINT_COUNTER_SLOTS);
    for (int i = 0; i < GLINT_COUNTERS; i++) {
        if (counts[i] == 0) {
            continue;
        }
        if (i == GLINT_COUNT_DEEPEST) {
            atomic_max(mine + 2 * i, (uint)counts[i]);
        } else {
            add_to_counter(mine + 2 * i, counts[i]);
        }
    }
}

// The light that a tile's pixels have gathered so far without the environment, sample by sample.
// Only used with GATHERS.
typedef struct gathered {
    real3 color[TILE_GROUPS];
    real alpha[TILE_GROUPS];
} gathered;

#if GLINT_HITS
// Writes hits instead of colours: distance, barycentric weights, and the triangle's number as
// alpha.
static inline void describe_hits(const scene_buffers *scene, const glint_frame_record *frame,
                                 const image_space *image, const tile *t, scalar *sums)
{
    for (int g = 0; g < TILE_GROUPS; g++) {
        primary first = primary_of(t, g);
        mask met = first.places >= (lane_int)0;
        closest hit = no_hit();
        hit.t = real_of(0);
        real number = real_of(-1);
        if (any_lane(met)) {
            const triangle triangles = load_triangles(scene, first.places, met);
            primary_rays(frame, &first); // for their length
            measure_hits(image, &triangles, first.x, first.y, first.length, met, &hit);
            const real zero = real_of(0);
            hit.t = SELECT(met, hit.t, zero);
            hit.b1 = SELECT(met, hit.b1, zero);
            hit.b2 = SELECT(met, hit.b2, zero);
            number = triangles.number;
        }
        to_pixels(hit.t, hit.b1, hit.b2, number, sums + g * PIXEL_VALUES);
    }
}
#elif ONE_LOOKUP
static inline void add_sample(const scene_buffers *scene, const glint_frame_record *frame,
                              const image_space *image, const tile *t, bool is_first, scalar *sums,
                              tally *tally)
{
    sights all;
    for (int g = 0; g < TILE_GROUPS; g++) {
        const primary first = primary_of(t, g);
        find_sights(scene, frame, image, &first, g, &all, tally);
    }
    add_sights(scene, &all, is_first, sums);
}
#else
// Adds one sample of each pixel, from the hits of the primary rays.
static inline void add_sample(const scene_buffers *scene, const glint_frame_record *frame,
                              const image_space *image, const tile *t, const mask *inside,
                              gathered *sum, lookups *later, tally *tally)
{
    paths all;
    primary first[PATH_GROUPS];
    for (int first_group = 0; first_group < TILE_GROUPS; first_group += PATH_GROUPS) {
        for (int i = 0; i < PATH_GROUPS; i++) {
            const int g = first_group + i;
            first[SLOT(i)] = primary_of(t, g);
            begin_paths(frame, &first[SLOT(i)], SLOT(i), g, inside[g], &all);
        }
#if GLINT_INSIDE
        if (HAS(INSIDE)) {
            find_beginnings(scene, &all, first);
        }
#endif
        follow_paths(scene, frame, image, first, &all, later, tally);
#if GATHERS
        for (int i = 0; i < PATH_GROUPS; i++) {
            const int g = first_group + i;
            mask seen =
                HAS(TRANSPARENT) ? first[SLOT(i)].places >= (lane_int)0 : mask_all();
#if HAS_ROUNDS
            seen = seen & inside[g];
#endif
            sum->color[g] = add(sum->color[g], all.radiance[SLOT(i)]);
            sum->alpha[g] += SELECT(seen, real_of(1), real_of(0));
#if SEES_THROUGH
            sum->alpha[g] -= all.uncovered[SLOT(i)];
#endif
        }
#endif
    }
}
#endif

// Adds the light that a group's pixels have gathered to the light from look-ups.
static inline void add_gathered(const gathered *sum, int group, scalar *sums)
{
    const real3 color = sum->color[group];
    scalar values[PIXEL_VALUES];
    to_pixels(color.x, color.y, color.z, sum->alpha[group], values);
    for (int j = 0; j < PACKET_HEIGHT; j++) {
        pixel_row light = without_alpha(load_pixel_row(j, sums));
        store_pixel_row(load_pixel_row(j, values) + light, j, sums);
    }
}

// Writes the pixels of a group that lie inside the image. They are the sums of samples, each with
// the weight `share`.
static inline void store_group(global scalar *pixels, const glint_frame_record *frame, int x0,
                               int y0, const scalar *sums, scalar share)
{
    const bool aligned = frame->width % PACKET_WIDTH == 0;
    for (int j = 0; j < PACKET_HEIGHT && y0 + j < frame->height; j++) {
        pixel_row means = load_pixel_row(j, sums) * (pixel_row)share;
        means = HAS_IN(frame, TRANSPARENT) || GLINT_HITS ? means : opaque(means);
        global scalar *row = pixels + pixel_place(frame, x0, y0 + j);
        if (x0 + PACKET_WIDTH <= frame->width) {
            if (aligned) {
                stream_pixel_row(means, row);
            } else {
                store_pixel_row(means, 0, row);
            }
        } else {
            for (int i = 0; i < 4 * (frame->width - x0); i++) {
                row[i] = ((scalar *)&means)[i];
            }
        }
    }
}

#define FOLLOWS_PATHS (!GLINT_HITS && !ONE_LOOKUP)

#define FACET_ROUNDS(frame) (HAS_IN(frame, FACETS) ? (frame)->facet_rounds : 1)
#define ROUNDS(frame) (FACET_ROUNDS(frame) * (HAS_IN(frame, DISPERSION) ? (frame)->wavelengths : 1))

#if HAS_ROUNDS
// Begins a round: sets its wavelength and marks the pixels that need the round in `inside`. All
// facet rounds of one wavelength follow each other. False if no pixel needs the round.
static inline bool begin_round(const glint_frame_record *frame, int round, const mask *in_image,
                               tally *tally, mask *inside)
{
#if GLINT_DISPERSION
    tally->wavelength = round / FACET_ROUNDS(frame);
#endif
    bool any = false;
    for (int g = 0; g < TILE_GROUPS; g++) {
        lanes_int needed = int_of(1);
        for (int lane = 0; lane < GLINT_WIDTH; lane++) {
            bool is_needed = true;
#if GLINT_FACETS
            is_needed &= round % FACET_ROUNDS(frame) == 0 || tally->faceted[g * GLINT_WIDTH + lane];
#endif
#if GLINT_DISPERSION
            is_needed &= tally->wavelength == 0 || tally->dispersed[g * GLINT_WIDTH + lane];
#endif
            LANE_INT(needed, lane) = is_needed;
        }
        inside[g] = in_image[g] & (needed != (lane_int)0);
        any |= any_lane(inside[g]);
    }
    return any;
}

// Scales the sums over rounds to their mean, pixel by pixel.
static inline void level_rounds(const tally *tally, const glint_frame_record *frame, scalar *sums,
                                gathered *sum)
{
    for (int i = 0; i < TILE_PIXELS; i++) {
        const scalar share = share_of_round(tally, frame, i);
        const int g = i / GLINT_WIDTH, lane = i % GLINT_WIDTH;
        vstore4(vload4(i, sums) * share, i, sums);
        if (GATHERS) {
            LANE(sum->color[g].x, lane) *= share;
            LANE(sum->color[g].y, lane) *= share;
            LANE(sum->color[g].z, lane) *= share;
            LANE(sum->alpha[g], lane) *= share;
        }
#if GLINT_DIAGNOSTICS
        if (HAS_IN(frame, DIAGNOSTICS)) {
            glint_layers_record *record = &tally->layers->of_pixel[i];
            record->truncated *= (float)share;
            record->total_reflections =
                (int)((scalar)record->total_reflections * share + R(0.5));
        }
#endif
    }
}
#endif

// Adds up the samples of a tile's pixels: look-ups add to `sums`, all other light to `sum`.
static inline void sample_tile(const scene_buffers *scene, const glint_frame_record *frame,
                               int column, int row, scalar *sums, gathered *sum, tally *tally)
{
    const image_space image = make_image_space(frame);
    // Clear the gathered light, and find the pixels inside the image.
#if FOLLOWS_PATHS
    mask in_image[TILE_GROUPS];
    for (int g = 0; g < TILE_GROUPS; g++) {
        if (GATHERS) {
            const real zero = real_of(0);
            sum->color[g] = real3_of(zero, zero, zero);
            sum->alpha[g] = zero;
        }
        in_image[g] = group_in_image(frame, column, row, g);
    }
#if HAS_ROUNDS
    mask inside[TILE_GROUPS];
#else
    const mask *inside = in_image;
#endif
    lookups later;
    begin_lookups(&later, scene, sums);
#endif
    const int k = SAMPLES_PER_AXIS(frame), count = k * k;
    tile t;
    for (int i = 0; i < ROUNDS(frame) * count; i++) {
        const int sample = i % count;
#if HAS_ROUNDS
        if (sample == 0 && !begin_round(frame, i / count, in_image, tally, inside)) {
            const int left = FACET_ROUNDS(frame) - i / count % FACET_ROUNDS(frame);
            i += left * count - 1; // skip to the next wavelength
            continue;
        }
#endif
#if GLINT_FACETS
        const int facets = FACET_ROUNDS(frame) * count;
        tally->facets = choose_facets(i % facets, facets);
#endif
        // Trace the primary rays through the sample's position in each pixel.
        const scalar right = ((scalar)(sample % k) + R(0.5)) / (scalar)k;
        const scalar down = ((scalar)(sample / k) + R(0.5)) / (scalar)k;
        if (count > 1 ? true : i == 0) { // else the hits stay the same
            begin_tile(&image, frame, scene->pixels, column, row, right, down, &t);
            if (HAS(GEOMETRY)) {
                trace_tile(&image, &t, scene);
            }
        }
#if GLINT_DIAGNOSTICS
        if (HAS(DIAGNOSTICS)) {
            tally->layers->is_middle = i == k / 2 * (k + 1);
            note_first_surfaces(tally->layers, scene, frame, &image, &t);
        }
#endif
        // Add the sample to the pixels.
#if GLINT_HITS
        describe_hits(scene, frame, &image, &t, sums);
#elif ONE_LOOKUP
        add_sample(scene, frame, &image, &t, sample == 0, sums, tally);
#else
        add_sample(scene, frame, &image, &t, inside, sum, &later, tally);
#endif
    }
#if FOLLOWS_PATHS
    finish_lookups(&later, &scene->environment);
#endif
#if HAS_ROUNDS
    level_rounds(tally, frame, sums, sum);
#endif
}

typedef struct outputs {
    GLINT_OUTPUT_ARGUMENTS(MEMBER)
    uint slot; // the work-item's number, for the counters
} outputs;

// Renders the tile whose first pixel is in the given column and row.
static NOT_INLINED void render_tile(const scene_buffers *scene, const glint_frame_record *frame,
                               int column, int row, const outputs *out)
{
    tally tally = no_tally();
#if GLINT_DIAGNOSTICS
    layers layers;
    tally.layers = &layers;
    if (HAS(DIAGNOSTICS)) {
        begin_layers(&layers);
    }
#endif
#if GLINT_TERMS
    terms terms;
    begin_terms(&terms, out->terms, frame, column, row);
    tally.terms = &terms;
#endif
    gathered sum;
    scalar sums[TILE_GROUPS * PIXEL_VALUES];
    sample_tile(scene, frame, column, row, sums, &sum, &tally);
    // Report before storing the pixels: an atomic operation waits for all earlier stores.
    report(&tally, frame, out->slot, out->counters);
#if GLINT_DIAGNOSTICS
    if (HAS(DIAGNOSTICS)) {
        store_layers(&layers, frame, column, row, out->layers);
    }
#endif
#if GLINT_TERMS
    store_terms(&terms);
#endif
    const int k = SAMPLES_PER_AXIS(frame);
    scalar share = R(1.0) / (scalar)(k * k);
    for (int g = 0; g < TILE_GROUPS; g++) {
        if (GATHERS) {
            add_gathered(&sum, g, sums + PIXEL_VALUES * g);
        }
        store_group(out->pixels, frame, column + g % TILE_COLUMNS * PACKET_WIDTH,
                    row + g / TILE_COLUMNS * PACKET_HEIGHT, sums + PIXEL_VALUES * g, share);
    }
}

// Finds the first pixel of the tile that work-item (across, down) of the global range renders: tile
// `across` of band first_band + down. (An offset of the range itself would make PoCL compile the
// kernel again.)
static inline void find_tile(const glint_frame_record *frame, int across, int down, int *column,
                             int *row)
{
    const int band = frame->band;
    *column = across / band * PACKET_WIDTH * TILE_COLUMNS;
    *row = ((down + frame->first_band) * band + across % band) * PACKET_HEIGHT * TILE_ROWS;
}

// Renders one tile per work-item.
kernel void render_tiles(GLINT_SCENE_ARGUMENTS(PARAMETER) GLINT_OUTPUT_ARGUMENTS(PARAMETER)
                             const glint_frame_record frame)
{
    const scene_buffers scene = SCENE_OF_ARGUMENTS;
    int column, row;
    find_tile(&frame, (int)get_global_id(0), (int)get_global_id(1), &column, &row);
    if (column >= frame.width || row >= frame.height) {
        return;
    }
    const uint slot = (uint)(get_global_id(1) * get_global_size(0) + get_global_id(0));
    const outputs out = {pixels, counters, layers, terms, slot};
    render_tile(&scene, &frame, column, row, &out);
}
