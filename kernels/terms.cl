// What a pixel is the sum of, for lighting it anew without tracing (GLINT_TERMS in layout.h): the
// directions that its paths leave along, and the normals of what the irradiance lights, with their
// weights; and what does not depend on the environment.
#if GLINT_TERMS

typedef struct terms {
    global float *stored;
    const glint_frame_record *frame;
    int column, row; // of the tile's first pixel
    float share;     // of a sample
    int count[TILE_PIXELS];
    float steady[3 * TILE_PIXELS]; // R, G, B: what does not depend on the environment
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

// The values of one of the tile's pixels, which lies inside the image: the header, and the terms.
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

// Where a pixel's next term goes: behind the others, or, where there is no room, in the place of
// the lightest if that is lighter, as all are than NaN; NULL where it is not.
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

// The rays in `wanted` bring what comes along their vectors, or what the surfaces with these
// normals receive, times their weights.
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

// Completes those of the tile's pixels that lie inside the image.
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
