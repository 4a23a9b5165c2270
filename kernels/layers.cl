// Fills the diagnostic layers: records what happens to the paths of each of a tile's pixels
// (glint_layers_record in layout.h). A pixel's paths are recorded in their own fixed order. So the
// layers, like the image, are the same at every width and size of tiles.
#if GLINT_DIAGNOSTICS

typedef struct layers {
    glint_layers_record of_pixel[TILE_PIXELS];
    scalar heaviest[TILE_PIXELS]; // weight of the look-up whose face is stored; 0: none yet
    bool is_middle;               // this sample sets the first surface and the face
} layers;

static inline void begin_layers(layers *l)
{
    for (int i = 0; i < TILE_PIXELS; i++) {
        glint_layers_record *record = &l->of_pixel[i];
        record->surfaces = record->total_reflections = 0;
        record->truncated = 0;
        record->triangle = record->face = -1;
        record->z = INFINITY;
        for (int k = 0; k < 3; k++) {
            record->normal[k] = record->albedo[k] = 0;
        }
        l->heaviest[i] = 0;
    }
}

// Records that the rays in `met` have met a surface; `surface` is its number on the path.
static inline void note_surfaces(layers *l, const pixels *pixels, mask met, lanes_int surface)
{
    for (uint left = mask_bits(met); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        glint_layers_record *record = &l->of_pixel[pixel_of(*pixels, lane)];
        record->surfaces = max(record->surfaces, (int)LANE_INT(surface, lane));
    }
}

static inline void note_total_reflections(layers *l, const pixels *pixels, mask reflected)
{
    for (uint left = mask_bits(reflected); left != 0; left &= left - 1) {
        l->of_pixel[pixel_of(*pixels, lowest_bit(left))].total_reflections++;
    }
}

// Records the rays in `truncated`, which take the environment without being traced.
static inline void note_truncation(layers *l, const pixels *pixels, mask truncated, real3 weight)
{
    const real largest = largest3(weight);
    for (uint left = mask_bits(truncated); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        l->of_pixel[pixel_of(*pixels, lane)].truncated += (float)LANE(largest, lane);
    }
}

// Records the face that the rays in `wanted` look up. Of look-ups with equal weight the first is
// kept. A look-up without weight records nothing.
static inline void note_faces(layers *l, const pixels *pixels, mask wanted, real3 weight,
                              lanes_int face)
{
    const real largest = largest3(weight);
    for (uint left = l->is_middle ? mask_bits(wanted) : 0; left != 0; left &= left - 1) {
        const int lane = lowest_bit(left), pixel = pixel_of(*pixels, lane);
        if (LANE(largest, lane) > l->heaviest[pixel]) {
            l->heaviest[pixel] = LANE(largest, lane);
            l->of_pixel[pixel].face = (int)LANE_INT(face, lane);
        }
    }
}

// Writes the tile's pixels that lie inside the image.
static inline void store_layers(const layers *l, const glint_frame_record *frame, int column,
                                int row, global glint_layers_record *stored)
{
    for (int g = 0; g < TILE_GROUPS; g++) {
        const lanes_int columns = group_columns(column, g), rows = group_rows(row, g);
        uint left = mask_bits(group_in_image(frame, column, row, g));
        for (; left != 0; left &= left - 1) {
            const int lane = lowest_bit(left);
            const int x = (int)LANE_INT(columns, lane), y = (int)LANE_INT(rows, lane);
            stored[pixel_number(frame, x, y)] = l->of_pixel[g * GLINT_WIDTH + lane];
        }
    }
}

#endif
