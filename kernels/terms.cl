// Stores the terms of each pixel's sum, so that the host can relight the pixels without tracing
// (GLINT_TERMS in layout.h). Terms are the directions in which paths leave the scene and the
// normals of surfaces lit by the irradiance, with their weights. The part that does not depend on
// the environment is stored beside them.
#if GLINT_TERMS

typedef struct terms {
    global float *stored;
    const glint_frame_record *frame;
    int column, row; // of the tile's first pixel
    float share;     // weight of one sample
    int count[TILE_PIXELS];
    float steady[3 * TILE_PIXELS]; // R, G, B: the part that does not depend on the environment
    float dropped[TILE_PIXELS];
} terms;

static inline void begin_terms(terms *t, global float *stored, const glint_frame_record *frame,
                               int column, int row)
{
    const int k = frame->samples_per_axis;
    t->stored = stored;
    t->frame = frame;
    t->column = column;
    t->row = row;
    t->share = 1.0f / (float)(k * k);
    for (int i = 0; i < TILE_PIXELS; i++) {
        t->count[i] = 0;
        t->steady[3 * i] = t->steady[3 * i + 1] = t->steady[3 * i + 2] = 0;
        t->dropped[i] = 0;
    }
}

// The values of a pixel of the tile that lies inside the image: the header, then the terms.
static inline global float *terms_of_pixel(const terms *t, int pixel)
{
    const int g = pixel / GLINT_WIDTH, lane = pixel % GLINT_WIDTH;
    const lanes_int columns = group_columns(t->column, g), rows = group_rows(t->row, g);
    const int x = (int)LANE_INT(columns, lane), y = (int)LANE_INT(rows, lane);
    return t->stored +
           pixel_number(t->frame, x, y) * (size_t)(GLINT_TERM_VALUES * (t->frame->terms + 1));
}

static inline float weight_of_term(global const float *term)
{
    return fmax(fmax(term[GLINT_TERM_WEIGHT], term[GLINT_TERM_WEIGHT + 1]),
                term[GLINT_TERM_WEIGHT + 2]);
}

// Finds the place of a pixel's next term. It follows the other terms. If there is no room, it
// replaces the lightest term, provided that this is lighter; NaN is heavier than all. NULL if the
// new term is dropped.
static inline global float *place_of_term(terms *t, int pixel, float weight)
{
    global float *first = terms_of_pixel(t, pixel) + GLINT_TERM_VALUES;
    if (t->count[pixel] < t->frame->terms) {
        return first + GLINT_TERM_VALUES * t->count[pixel]++;
    }
    global float *lightest = first;
    for (int k = 1; k < t->frame->terms; k++) {
        global float *other = first + GLINT_TERM_VALUES * k;
        lightest = weight_of_term(other) < weight_of_term(lightest) ? other : lightest;
    }
    const float least = weight_of_term(lightest);
    t->dropped[pixel] += weight <= least ? weight : least;
    return weight <= least ? 0 : lightest;
}

// Notes a term for each of the rays in `wanted`: the light along their vectors, or the irradiance
// of surfaces with these normals, times their weights.
static inline void note_terms(terms *t, const pixels *pixels, mask wanted, real3 vector, float kind,
                              real3 weight)
{
    const real largest = largest3(weight);
    for (uint left = mask_bits(wanted); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left), pixel = pixel_of(*pixels, lane);
        const float share = t->share;
        if (LANE(largest, lane) == R(0.0)) {
            continue;
        }
        global float *term = place_of_term(t, pixel, (float)LANE(largest, lane) * share);
        if (term == 0) {
            continue;
        }
        term[GLINT_TERM_VECTOR] = (float)LANE(vector.x, lane);
        term[GLINT_TERM_VECTOR + 1] = (float)LANE(vector.y, lane);
        term[GLINT_TERM_VECTOR + 2] = (float)LANE(vector.z, lane);
        term[GLINT_TERM_KIND] = kind;
        term[GLINT_TERM_WEIGHT] = (float)LANE(weight.x, lane) * share;
        term[GLINT_TERM_WEIGHT + 1] = (float)LANE(weight.y, lane) * share;
        term[GLINT_TERM_WEIGHT + 2] = (float)LANE(weight.z, lane) * share;
    }
}

static inline void note_constant(terms *t, const pixels *pixels, mask lit, real3 light)
{
    for (uint left = mask_bits(lit); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left), pixel = pixel_of(*pixels, lane);
        t->steady[3 * pixel] += (float)LANE(light.x, lane) * t->share;
        t->steady[3 * pixel + 1] += (float)LANE(light.y, lane) * t->share;
        t->steady[3 * pixel + 2] += (float)LANE(light.z, lane) * t->share;
    }
}

// Completes the tile's pixels that lie inside the image.
static inline void store_terms(const terms *t)
{
    for (int g = 0; g < TILE_GROUPS; g++) {
        uint left = mask_bits(group_in_image(t->frame, t->column, t->row, g));
        for (; left != 0; left &= left - 1) {
            const int pixel = g * GLINT_WIDTH + lowest_bit(left);
            global float *values = terms_of_pixel(t, pixel);
            values[0] = t->steady[3 * pixel];
            values[1] = t->steady[3 * pixel + 1];
            values[2] = t->steady[3 * pixel + 2];
            values[3] = t->dropped[pixel];
            values[4] = (float)t->count[pixel];
            values[5] = values[6] = values[7] = 0;
            for (int i = GLINT_TERM_VALUES * (t->count[pixel] + 1);
                 i < GLINT_TERM_VALUES * (t->frame->terms + 1); i++) {
                values[i] = 0;
            }
        }
    }
}

#endif
