// A tile of pixels and the space in which its primary rays are traced.
//
// All primary rays come from one eye (or run alike), and their directions are affine in the pixel,
// so that the scene can be looked at in image coordinates, (x, y, h) with x/h and y/h the place on
// the image plane in pixels from its middle and z the depth (glint_frame_record). There a
// triangle's edge is an affine function of the pixel, and so is the key that orders surfaces by
// depth.
//
// A tile is TILE_COLUMNS × TILE_ROWS groups of pixels, each as many as a packet has lanes.
#define TILE_COLUMNS GLINT_TILE_SIDE(GLINT_TILES)
#define TILE_ROWS GLINT_TILE_SIDE(GLINT_TILES)
#define TILE_GROUPS (TILE_COLUMNS * TILE_ROWS)
#define TILE_PIXELS (TILE_GROUPS * GLINT_WIDTH)

// The primary rays of a frame in image coordinates.
typedef struct image_space {
    scalar origin[3];                      // where the middle ray starts, stored coordinates
#if LOCAL_RAYS
    scalar origin_low[3]; // what that lacks
#endif
    scalar rows[3][3];                     // x, y and z of a point relative to it
    scalar offset, slope;                  // h = offset + slope z
    scalar key_one, key_depth, key_normal; // see image_key
    scalar key_limit;                      // of the depth 0, where the rays start
    scalar slack;                          // what rounding may move a box's corner by
    scalar near_offset, far_offset; // what to add to z·corner for a depth, see tile_meets_boxes
    scalar end; // deeper than the scene goes; children that are not there lie beyond
} image_space;

// What a tile's rays have met so far, and what its traversal needs.
typedef struct tile {
    // Places on the image plane: of the pixels of each column and row of groups, of the groups'
    // centres and of the tile's; the largest magnitudes in the tile.
    real x[TILE_COLUMNS], y[TILE_ROWS];
    block center_x, center_y;
    scalar middle_x, middle_y;
    scalar largest_x, largest_y;
    scalar step;                           // from a pixel to its neighbour; no PIXEL_LIST
    scalar half_x, half_y;                 // with PIXEL_LIST: of what the tile's pixels take up
    scalar planes[4][3], plane_offsets[4]; // inside is ≥ 0
    real key[TILE_GROUPS];                 // of the nearest hit; see image_key
    lanes_int place[TILE_GROUPS];          // of the triangle hit, −1: none
    block farthest;                        // the least key of each group
    scalar least;                          // and of the tile
    scalar z_far;                          // no hit of the tile lies deeper
} tile;

static inline image_space make_image_space(const glint_frame_record *frame)
{
    image_space s;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        s.origin[k] = JOIN(frame->origin.high[k], frame->origin.low[k]);
#if LOCAL_RAYS
        s.origin_low[k] = frame->origin.low[k];
#endif
        s.rows[0][k] = JOIN(frame->image_x.high[k], frame->image_x.low[k]);
        s.rows[1][k] = JOIN(frame->image_y.high[k], frame->image_y.low[k]);
        s.rows[2][k] = JOIN(frame->image_z.high[k], frame->image_z.low[k]);
    }
    s.offset = JOIN(frame->image_offset[0], frame->image_offset[1]);
    s.slope = frame->image_slope;
    s.key_one = frame->key_is_inverse ? R(1.0) : R(0.0);
    s.key_depth = R(1.0) - s.key_one;
    s.key_normal = frame->key_is_inverse ? R(1.0) : s.offset;
    s.key_limit = frame->key_is_inverse ? HUGE : R(0.0);
    const scalar *o = s.origin, *z = s.rows[2];
    scalar distance = fabs(o[0]) + fabs(o[1]) + fabs(o[2]);
    s.slack = (distance + SCENE_REACH) * (R(64.0) * EPSILON);
    scalar start = z[0] * o[0] + z[1] * o[1] + z[2] * o[2];
    scalar slack = s.slack * (fabs(z[0]) + fabs(z[1]) + fabs(z[2]));
    s.near_offset = -start - slack;
    s.far_offset = start - slack;
    s.end = distance + R(2.0) * SCENE_REACH;
    return s;
}

// The key of a depth, larger for nearer: 1/h for an eye near the scene, else −z/h. Both are affine
// in the pixel on any plane; the second keeps its digits where the eye is far away or infinitely
// so.
static inline block image_key(const image_space *s, block z, block inverse_h)
{
    return (s->key_one - s->key_depth * z) * inverse_h;
}

// ---- The tile and the tree ---------------------------------------------------------------------

// The four planes through the tile's outermost rays, a little apart from them: x − X h ≥ 0 for the
// left one, as a function of the place in stored coordinates. What is added to its offset is more
// than rounding can take, here and where a corner (within ±SCENE_REACH) is put in.
static inline void bound_tile(const image_space *s, tile *t, int plane, int row, scalar at,
                              scalar sign)
{
#pragma unroll
    for (int k = 0; k < 3; k++) {
        t->planes[plane][k] = sign * (s->rows[row][k] - at * (s->slope * s->rows[2][k]));
    }
    const scalar *n = t->planes[plane], *o = s->origin;
    scalar offset = -at * s->offset;
    scalar slack =
        s->slack * (fabs(n[0]) + fabs(n[1]) + fabs(n[2])) + R(8.0) * EPSILON * fabs(offset);
    t->plane_offsets[plane] = sign * offset - (n[0] * o[0] + n[1] * o[1] + n[2] * o[2]) + slack;
}

// How far the outermost pixels of a group and of the tile lie from its middle.
#if GLINT_PIXEL_LIST
#define GROUP_HALF_X(t) ((t)->half_x)
#define GROUP_HALF_Y(t) ((t)->half_y)
#define TILE_HALF_X(t) ((t)->half_x)
#define TILE_HALF_Y(t) ((t)->half_y)
#else
#define GROUP_HALF_X(t) (R(0.5) * (scalar)(PACKET_WIDTH - 1) * (t)->step)
#define GROUP_HALF_Y(t) (R(0.5) * (scalar)(PACKET_HEIGHT - 1) * (t)->step)
#define TILE_HALF_X(t) (R(0.5) * (scalar)(PACKET_WIDTH * TILE_COLUMNS - 1) * (t)->step)
#define TILE_HALF_Y(t) (R(0.5) * (scalar)(PACKET_HEIGHT * TILE_ROWS - 1) * (t)->step)
#endif

// Columns and rows of a group's pixels, counted among those that are rendered.
static inline lanes_int group_columns(int tile_column, int group)
{
    return lane_numbers() % (lane_int)PACKET_WIDTH +
           (lane_int)(tile_column + group % TILE_COLUMNS * PACKET_WIDTH);
}
static inline lanes_int group_rows(int tile_row, int group)
{
    return lane_numbers() / (lane_int)PACKET_WIDTH +
           (lane_int)(tile_row + group / TILE_COLUMNS * PACKET_HEIGHT);
}

static inline mask group_in_image(const glint_frame_record *frame, int tile_column, int tile_row,
                                  int group)
{
    mask across = group_columns(tile_column, group) < (lane_int)frame->width;
    mask down = group_rows(tile_row, group) < (lane_int)frame->height;
    return across & down;
}

// A pixel's number, row by row: more than 2^31 of them are no mistake.
static inline size_t pixel_number(const glint_frame_record *frame, int column, int row)
{
    return (size_t)row * (size_t)frame->width + (size_t)column;
}

// Where its values begin in the frame.
static inline size_t pixel_place(const glint_frame_record *frame, int column, int row)
{
    return 4 * pixel_number(frame, column, row);
}

// Columns and rows of the image, of those that are rendered.
static inline lanes_int image_column(const glint_frame_record *frame, lanes_int columns)
{
    return columns * (lane_int)frame->step + (lane_int)frame->first_pixel;
}
static inline lanes_int image_row(const glint_frame_record *frame, lanes_int rows)
{
    return rows * (lane_int)frame->step + (lane_int)frame->first_pixel;
}

// The places on the image plane of samples that lie (right, down) from the upper left corner of
// their pixels. All but the last operation is exact: the same for every size of tiles, and for
// every choice of pixels that are rendered of the image (see glint_frame_record).
static inline real place_x(const glint_frame_record *frame, lanes_int columns, scalar right)
{
    return to_real(columns) - R(0.5) * (scalar)frame->image_width + right;
}
static inline real place_y(const glint_frame_record *frame, lanes_int rows, scalar down)
{
    return R(0.5) * (scalar)frame->image_height - to_real(rows) - down;
}

// Nothing is met yet. Pixels outside the image hide everything, even what has no depth: nothing is
// visited for them, and they meet nothing, which is what counting rests on.
static inline void clear_tile(const image_space *s, const glint_frame_record *frame, int column,
                              int row, tile *t)
{
    scalar nothing = s->key_one > 0 ? R(0.0) : -HUGE;
    t->farthest = SELECT(BLOCK_LANES < (scalar)TILE_GROUPS, block_of(nothing), block_of(HUGE));
    for (int g = 0; g < TILE_GROUPS; g++) {
        t->key[g] = real_of(nothing);
        t->place[g] = int_of(-1);
    }
    const bool cut = column + TILE_COLUMNS * PACKET_WIDTH > frame->width ||
                     row + TILE_ROWS * PACKET_HEIGHT > frame->height;
    for (int g = 0; g < TILE_GROUPS && cut; g++) {
        mask inside = group_in_image(frame, column, row, g);
        t->key[g] = SELECT(inside, real_of(nothing), real_of((scalar)INFINITY));
        ((scalar *)&t->farthest)[g] = smallest_lane(t->key[g]);
    }
    t->least = nothing;
    t->z_far = s->end;
}

// Where the tile's samples lie, and the bounds of them: low x, high x, low y and high y.
#if GLINT_PIXEL_LIST
static inline void place_tile(const glint_frame_record *frame, global const uint *listed, int column,
                              int row, scalar right, scalar down, tile *t, scalar bounds[4])
{
    lanes_int x, y;
    for (int i = 0; i < GLINT_WIDTH; i++) {
        const int c = column + i % PACKET_WIDTH, r = row + i / PACKET_WIDTH;
        const bool is_there = c < frame->width && r < frame->height;
        // Where there is none: at the tile's first one.
        const uint number = listed[pixel_number(frame, is_there ? c : column, is_there ? r : row)];
        LANE_INT(x, i) = (int)(number % (uint)frame->image_width);
        LANE_INT(y, i) = (int)(number / (uint)frame->image_width);
    }
    t->x[0] = place_x(frame, x, right);
    t->y[0] = place_y(frame, y, down);
    bounds[0] = smallest_lane(t->x[0]);
    bounds[1] = largest_lane(t->x[0]);
    bounds[2] = smallest_lane(t->y[0]);
    bounds[3] = largest_lane(t->y[0]);
    t->half_x = R(0.5) * (bounds[1] - bounds[0]);
    t->half_y = R(0.5) * (bounds[3] - bounds[2]);
    t->center_x = block_of(bounds[0] + t->half_x);
    t->center_y = block_of(bounds[3] - t->half_y);
}
#else
static inline void place_tile(const glint_frame_record *frame, global const uint *listed, int column,
                              int row, scalar right, scalar down, tile *t, scalar bounds[4])
{
    for (int i = 0; i < TILE_COLUMNS; i++) {
        t->x[i] = place_x(frame, image_column(frame, group_columns(column, i)), right);
    }
    for (int i = 0; i < TILE_ROWS; i++) {
        t->y[i] = place_y(frame, image_row(frame, group_rows(row, i * TILE_COLUMNS)), down);
    }
    t->step = (scalar)frame->step;
    bounds[0] = LANE(t->x[0], 0);
    bounds[1] = bounds[0] + R(2.0) * TILE_HALF_X(t);
    bounds[3] = LANE(t->y[0], 0);
    bounds[2] = bounds[3] - R(2.0) * TILE_HALF_Y(t);
    const block_mask groups = BLOCK_NUMBERS;
    t->center_x = to_block(groups % (lane_int)TILE_COLUMNS * (lane_int)PACKET_WIDTH);
    t->center_y = to_block(groups / (lane_int)TILE_COLUMNS * (lane_int)-PACKET_HEIGHT);
    t->center_x *= t->step;
    t->center_y *= t->step;
    t->center_x += bounds[0] + GROUP_HALF_X(t);
    t->center_y += bounds[3] - GROUP_HALF_Y(t);
}
#endif

// `column` and `row` name the tile's first pixel.
static inline void begin_tile(const image_space *s, const glint_frame_record *frame,
                              global const uint *listed, int column, int row, scalar right,
                              scalar down, tile *t)
{
    scalar bounds[4];
    place_tile(frame, listed, column, row, right, down, t, bounds);
    t->middle_x = bounds[0] + TILE_HALF_X(t);
    t->middle_y = bounds[3] - TILE_HALF_Y(t);
    t->largest_x = LARGER(fabs(bounds[0]), fabs(bounds[1]));
    t->largest_y = LARGER(fabs(bounds[2]), fabs(bounds[3]));
    bound_tile(s, t, 0, 0, bounds[0], R(1.0));
    bound_tile(s, t, 1, 0, bounds[1], R(-1.0));
    bound_tile(s, t, 2, 1, bounds[2], R(1.0));
    bound_tile(s, t, 3, 1, bounds[3], R(-1.0));
    clear_tile(s, frame, column, row, t);
}
