// Defines a tile of pixels, and the space in which its primary rays are traced.
//
// All primary rays come from one eye, or are parallel, and their directions are affine in the
// pixel. So the scene can be traced in image coordinates (x, y, h). x/h and y/h are the position on
// the image plane, in pixels from its middle, and z is the depth (glint_frame_record). In these
// coordinates a triangle's edge is an affine function of the pixel. So is the key that orders
// surfaces by depth.
//
// A tile has TILE_COLUMNS × TILE_ROWS groups. A group has as many pixels as a packet has lanes.
#define TILE_COLUMNS GLINT_TILE_SIDE(GLINT_TILES)
#define TILE_ROWS GLINT_TILE_SIDE(GLINT_TILES)
#define TILE_GROUPS (TILE_COLUMNS * TILE_ROWS)
#define TILE_PIXELS (TILE_GROUPS * GLINT_WIDTH)

static inline real3 join_vector(const glint_split_vector *v)
{
    return real3_of(real_of(JOIN(v->high[0], v->low[0])), real_of(JOIN(v->high[1], v->low[1])),
                    real_of(JOIN(v->high[2], v->low[2])));
}

// The directions of the primary rays through points (x, y) of the image plane, see
// glint_frame_record. Their length is 1 or more.
static inline real3 primary_directions(const glint_frame_record *frame, real x, real y)
{
    return scale_add(
        join_vector(&frame->direction_y), y,
        scale_add(join_vector(&frame->direction_x), x, join_vector(&frame->direction)));
}

// The origins of the primary rays through points (x, y) of the image plane. With LOCAL_RAYS *low
// gets their low parts.
static inline real3 begin_at_eye(const glint_frame_record *frame, real x, real y, real3 *low)
{
    const glint_split_vector *o = &frame->origin;
#if LOCAL_RAYS
    *low = real3_of(real_of(0), real_of(0), real_of(0));
    if (HAS_IN(frame, LOCAL_ORIGINS)) {
        const real3 from_middle =
            scale_add(join_vector(&frame->origin_y), y, scale(join_vector(&frame->origin_x), x));
        const pair at_x = sum_of(real_of(o->high[0]), from_middle.x);
        const pair at_y = sum_of(real_of(o->high[1]), from_middle.y);
        const pair at_z = sum_of(real_of(o->high[2]), from_middle.z);
        *low = real3_of(at_x.low + o->low[0], at_y.low + o->low[1], at_z.low + o->low[2]);
        return real3_of(at_x.high, at_y.high, at_z.high);
    }
#endif
    return scale_add(join_vector(&frame->origin_y), y,
                     scale_add(join_vector(&frame->origin_x), x, join_vector(o)));
}

// The primary rays of a frame in image coordinates.
typedef struct image_space {
    scalar origin[3];                      // start of the middle ray, stored coordinates
#if LOCAL_RAYS
    scalar origin_low[3]; // the low parts of the origin
    const glint_frame_record *frame;
#endif
    scalar rows[3][3];                     // give x, y and z of a point relative to the origin
    scalar offset, slope;                  // h = offset + slope z
    scalar key_one, key_depth, key_normal; // see image_key
    scalar key_limit;                      // key of the depth 0, where the rays start
    scalar slack;                          // bound of the rounding error of a box's corner
    scalar near_offset, far_offset; // to add to z·corner for a depth, see tile_meets_boxes
    scalar end; // deeper than the whole scene; missing children lie beyond
} image_space;

// The nearest hits of a tile's rays so far, and the data for its traversal.
typedef struct tile {
    // Positions on the image plane: of the pixels of each column and row of groups, of the groups'
    // centres and of the tile's centre. Then the largest magnitudes in the tile.
    real x[TILE_COLUMNS], y[TILE_ROWS];
    block center_x, center_y;
    scalar middle_x, middle_y;
    scalar largest_x, largest_y;
    scalar step;                           // between neighbouring pixels; not with PIXEL_LIST
    scalar half_x, half_y; // half extents of the tile's pixels, with PIXEL_LIST: it is one group
    scalar planes[4][3], plane_offsets[4]; // ≥ 0 inside
    real key[TILE_GROUPS];                 // of the nearest hit; see image_key
    lanes_int place[TILE_GROUPS];          // of the triangle hit; −1: none
    block farthest;                        // the least key in each group
    scalar least;                          // the least key in the tile
    scalar z_far;                          // no hit of the tile lies deeper
} tile;

static inline image_space make_image_space(const glint_frame_record *frame)
{
    image_space s;
#if LOCAL_RAYS
    s.frame = frame;
#endif
#pragma unroll
    for (int k = 0; k < 3; k++) {
        s.origin[k] = JOIN(frame->origin.high[k], frame->origin.low[k]);
#if LOCAL_RAYS
        s.origin_low[k] = HAS_IN(frame, LOCAL_ORIGINS) ? frame->origin.low[k] : R(0.0);
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

// The key of a depth; nearer points have larger keys. It is 1/h for an eye near the scene, else
// −z/h. On every plane both are affine in the pixel. The second keeps its digits if the eye is far
// away or infinitely far.
static inline block image_key(const image_space *s, block z, block inverse_h)
{
    return (s->key_one - s->key_depth * z) * inverse_h;
}

// ---- The tile and the tree ---------------------------------------------------------------------

// Makes one of the four planes through the tile's outermost rays, slightly outside of them. The
// left plane is x − X h ≥ 0, as a function of the position in stored coordinates. The amount added
// to its offset exceeds all rounding errors, here and in the tests of corners (within
// ±SCENE_REACH).
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

// Distance of the outermost pixels of a group, and of the tile, from its middle.
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

// Columns and rows of a group's pixels, counted among the rendered pixels.
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

// A pixel's number, row by row. Images may have more than 2^31 pixels.
static inline size_t pixel_number(const glint_frame_record *frame, int column, int row)
{
    return (size_t)row * (size_t)frame->width + (size_t)column;
}

// The index of the pixel's first value in the frame.
static inline size_t pixel_place(const glint_frame_record *frame, int column, int row)
{
    return 4 * pixel_number(frame, column, row);
}

// Converts columns and rows of rendered pixels to columns and rows of the image.
static inline lanes_int image_column(const glint_frame_record *frame, lanes_int columns)
{
    return columns * (lane_int)frame->step + (lane_int)frame->first_pixel;
}
static inline lanes_int image_row(const glint_frame_record *frame, lanes_int rows)
{
    return rows * (lane_int)frame->step + (lane_int)frame->first_pixel;
}

// The positions on the image plane of samples that lie (right, down) from the upper left corner of
// their pixels. All operations but the last are exact. So the results are the same for every size
// of tiles and for every choice of rendered pixels (see glint_frame_record).
static inline real place_x(const glint_frame_record *frame, lanes_int columns, scalar right)
{
    return to_real(columns) - R(0.5) * (scalar)frame->image_width + right;
}
static inline real place_y(const glint_frame_record *frame, lanes_int rows, scalar down)
{
    return R(0.5) * (scalar)frame->image_height - to_real(rows) - down;
}

// Sets all pixels to "no hit yet". Pixels outside the image hide everything, even surfaces without
// a depth. So the traversal visits nothing for them, and they hit nothing; counting relies on it.
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

// Sets the positions of the tile's samples, and their bounds: low x, high x, low y and high y.
#if GLINT_PIXEL_LIST
static inline void place_list(const glint_frame_record *frame, global const uint *listed, int column,
                              int row, scalar right, scalar down, tile *t, scalar bounds[4])
{
    lanes_int x, y;
    for (int i = 0; i < GLINT_WIDTH; i++) {
        const int c = column + i % PACKET_WIDTH, r = row + i / PACKET_WIDTH;
        const bool is_there = c < frame->width && r < frame->height;
        // Unused entries repeat the tile's first pixel.
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
#endif

static inline void place_tile(const glint_frame_record *frame, global const uint *listed, int column,
                              int row, scalar right, scalar down, tile *t, scalar bounds[4])
{
#if GLINT_PIXEL_LIST
    if (HAS_IN(frame, PIXEL_LIST)) {
        place_list(frame, listed, column, row, right, down, t, bounds);
        return;
    }
#endif
    for (int i = 0; i < TILE_COLUMNS; i++) {
        t->x[i] = place_x(frame, image_column(frame, group_columns(column, i)), right);
    }
    for (int i = 0; i < TILE_ROWS; i++) {
        t->y[i] = place_y(frame, image_row(frame, group_rows(row, i * TILE_COLUMNS)), down);
    }
    t->step = (scalar)frame->step;
#if GLINT_PIXEL_LIST
    t->half_x = R(0.5) * (scalar)(PACKET_WIDTH - 1) * t->step;
    t->half_y = R(0.5) * (scalar)(PACKET_HEIGHT - 1) * t->step;
#endif
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

// Prepares a tile for tracing; `column` and `row` name its first pixel.
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
