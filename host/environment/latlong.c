// Looks up lat-long maps and resamples them into a cube. See latlong.h. chart.c says which way they
// face.
//
// The cube's error is of second order in the spacing of texels: one bilinear look-up reads the map,
// another one reads the cube. The cube's border keeps this order over edges and corners (see
// cube.c).
//
// Resampling is fast because texels share their trigonometry. On the four faces around the horizon,
// 16 texels see the same latitude above or below the horizon and the same longitude from the
// nearest middle of a face, except for the sign. On the two faces at the poles, 8 texels do.
#include "environment/latlong.h"

#include "base/parallel.h"

#include <math.h>

#define LATLONG_EDGE_MIN 256 // keeps second-order errors of tiny maps below 10⁻⁴
#define LATLONG_EDGE_MAX                                                                           \
    2048            // 0.4 GB of cube; maps of more than 3200 rows lose their finest detail
#define TAPS_MAX 16 // along an axis; a cap for the few texels at the poles

int glint_latlong_edge(int height)
{
    // In the middle of a face, a texel of a cube of edge H spans 2/H and a row of the map π/H. So a
    // cube of edge 0.64 H has as many texels there as the map.
    if (height < LATLONG_EDGE_MIN) {
        return LATLONG_EDGE_MIN;
    }
    return height < LATLONG_EDGE_MAX ? height : LATLONG_EDGE_MAX;
}

// Rounds down a value above −1. (Without SSE4.1 the compiler emits a call for floor.)
static int round_down(double value)
{
    return (int)(value + 1.0) - 1;
}

// Looks up the map at column x, in [−½, 3/2 width), of row j, linearly between pixels. A row beyond
// a pole is the mirrored row on this side of it, half a turn away.
static void sample_row(const glint_image *image, int j, double x, double rgb[3])
{
    int width = image->width, height = image->height;
    if (j < 0 || j >= height) {
        j = j < 0 ? -1 - j : 2 * height - 1 - j;
        x += 0.5 * width;
    }
    int left = round_down(x);
    double weight = x - left;
    left = left < 0 ? left + width : (left >= width ? left - width : left);
    int right = left + 1 < width ? left + 1 : 0;
    double a[3], b[3];
    glint_image_rgb(image, left, j, a);
    glint_image_rgb(image, right, j, b);
    glint_rgb_mix(a, b, weight, rgb);
}

// Looks up the map at column x, `share` of the way from row j to the next one.
static void mix_rows(const glint_image *image, double x, int j, double share, double rgb[3])
{
    double above[3], below[3];
    sample_row(image, j, x, above);
    sample_row(image, j + 1, x, below);
    glint_rgb_mix(above, below, share, rgb);
}

// Places in the picture: x = u · across + left, y = v · down + top.
typedef struct scale {
    double across, left, down, top;
} scale;

static scale scale_of(const glint_image *image, bool on_edges)
{
    if (on_edges) {
        // u and v reach 1. There the fraction is 0, so the pixel beyond has no weight.
        return (scale){image->width - 1.0, 0.0, image->height - 1.0, 0.0};
    }
    return (scale){image->width, -0.5, image->height, -0.5};
}

void glint_latlong_sample(const glint_image *image, bool on_edges, glint_vec3 direction,
                          double rgb[3])
{
    double across = sqrt(direction.x * direction.x + direction.z * direction.z);
    // atan2(0, 0) is 0. At the poles every longitude is right.
    double longitude = atan2(direction.x, direction.z);
    double latitude = atan2(direction.y, across);
    const scale to = scale_of(image, on_edges);
    const double x = (0.5 - longitude / (2.0 * GLINT_PI)) * to.across + to.left;
    const double y = (0.5 - latitude / GLINT_PI) * to.down + to.top;
    const int upper = round_down(y);
    mix_rows(image, x, upper, y - upper, rgb);
}

// ---- Look-ups in double precision, for the resampling ------------------------------------------

// Two lanes fit the registers of every x86-64. Each lane is computed as a scalar would be.
typedef double pair __attribute__((vector_size(2 * sizeof(double))));

typedef struct color {
    pair red_green, blue; // the last lane is not used
} color;

// A place between two pixels along an axis: `share` of the way from `first` to the next one.
typedef struct between {
    int first;
    double share;
} between;

static inline between split(double place)
{
    const int first = round_down(place);
    return (between){first, place - first};
}

static inline color load(const float *pixel, int step)
{
    return (color){{(double)pixel[0], (double)pixel[step]}, {(double)pixel[2 * step], 0.0}};
}

static inline color mix(color a, color b, double weight)
{
    return (color){a.red_green + weight * (b.red_green - a.red_green),
                   a.blue + weight * (b.blue - a.blue)};
}

static inline void add_look_up(const glint_image *image, between column, between row, color *sum)
{
    color found;
    const int channels = image->channels, step = channels >= 3;
    if (column.first < 0 || column.first + 1 >= image->width || row.first < 0 ||
        row.first + 1 >= image->height) { // over ±180° or a pole
        double rgb[3];
        mix_rows(image, column.first + column.share, row.first, row.share, rgb);
        found = (color){{rgb[0], rgb[1]}, {rgb[2], 0.0}};
    } else {
        const float *upper = glint_image_pixel(image, column.first, row.first);
        const float *lower = upper + (ptrdiff_t)image->width * channels;
        found = mix(mix(load(upper, step), load(upper + channels, step), column.share),
                    mix(load(lower, step), load(lower + channels, step), column.share), row.share);
    }
    sum->red_green += found.red_green;
    sum->blue += found.blue;
}

// ---- Resampling into a cube ---------------------------------------------------------------------

typedef struct resampling {
    const glint_image *image;
    glint_cube *cube;
    scale to;
} resampling;

static between column_of(const resampling *job, double u)
{
    u = u < 0.0 ? u + 1.0 : (u >= 1.0 ? u - 1.0 : u);
    return split(u * job->to.across + job->to.left);
}

static between row_of(const resampling *job, double v)
{
    return split(v * job->to.down + job->to.top);
}

// The number of look-ups along each axis for a texel: the longest side of its footprint in the map,
// in pixels, rounded. One bilinear look-up suffices for one and a half pixels.
static int count_taps(const resampling *job, glint_vec3 d)
{
    double length = sqrt(glint_vec3_dot(d, d));
    double size = 2.0 / job->cube->edge / length; // radians, or less
    // Meridians converge at the poles. Take the middle of the half nearer the equator.
    double from_axis = sqrt(d.x * d.x + d.z * d.z) / length + 0.25 * size;
    double rows = size * job->image->height / GLINT_PI;
    double columns = size * job->image->width / (2.0 * GLINT_PI * from_axis);
    double taps = ceil((rows > columns ? rows : columns) - 0.5);
    return taps < 1.0 ? 1 : (taps < TAPS_MAX ? (int)taps : TAPS_MAX);
}

// The look-ups of a texel: a square grid over it.
typedef struct texel {
    int i, j, taps;
    double s, t; // its middle
} texel;

static texel texel_at(const resampling *job, int face, int i, int j)
{
    const double edge = job->cube->edge;
    const double s = (2.0 * i + 1.0) / edge - 1.0, t = (2.0 * j + 1.0) / edge - 1.0;
    return (texel){i, j, count_taps(job, glint_cube_direction(face, s, t)), s, t};
}

static void tap_place(const resampling *job, const texel *of, int tap, double place[2])
{
    const double edge = job->cube->edge;
    const int column = tap % of->taps, row = tap / of->taps;
    place[0] = of->s + ((2.0 * column + 1.0) / of->taps - 1.0) / edge;
    place[1] = of->t + ((2.0 * row + 1.0) / of->taps - 1.0) / edge;
}

// Stores the mean of a texel's look-ups, mirrored along the axes of its face.
static void store_mean(const resampling *job, int face, const texel *of, int is_mirrored,
                       const color *sum)
{
    const int last = job->cube->edge - 1;
    const int i = is_mirrored & 1 ? last - of->i : of->i;
    const int j = is_mirrored & 2 ? last - of->j : of->j;
    const double count = of->taps * of->taps;
    const double rgb[3] = {sum->red_green[0] / count, sum->red_green[1] / count,
                           sum->blue[0] / count};
    glint_cube_store(job->cube, face, i, j, rgb);
}

// The faces around the horizon, with u in their middle.
static const struct {
    int face;
    double middle;
} sides[4] = {{4, 0.5}, {1, 0.75}, {5, 0.0}, {0, 0.25}};

// Resamples 16 texels: one texel and its mirror images, on the four faces.
static void resample_sides(const resampling *job, const texel *of)
{
    color sums[4][4] = {{{{0}, {0}}}}; // [side][mirrored along s, t]
    for (int tap = 0; tap < of->taps * of->taps; tap++) {
        double at[2];
        tap_place(job, of, tap, at);
        const double turn = atan(at[0]) / (2.0 * GLINT_PI);
        const double rise = atan(at[1] / sqrt(1.0 + at[0] * at[0])) / GLINT_PI;
        const between rows[2] = {row_of(job, 0.5 + rise), row_of(job, 0.5 - rise)};
        for (int k = 0; k < 8; k++) {
            const int side = k / 2, mirrored = k % 2;
            const between column = column_of(job, sides[side].middle + (mirrored ? -turn : turn));
            add_look_up(job->image, column, rows[0], &sums[side][mirrored]);
            add_look_up(job->image, column, rows[1], &sums[side][mirrored + 2]);
        }
    }
    for (int k = 0; k < 16; k++) {
        store_mean(job, sides[k / 4].face, of, k % 4, &sums[k / 4][k % 4]);
    }
}

enum { TOP = 2, BOTTOM = 3 }; // +Y, −Y

// Resamples 8 texels: a texel of face TOP and its mirror images, and the texels below them.
static void resample_poles(const resampling *job, const texel *of)
{
    const glint_vec3 upper = glint_cube_direction(TOP, 1, 1);
    const glint_vec3 lower = glint_cube_direction(BOTTOM, 1, 1);
    const int below = (upper.x != lower.x ? 1 : 0) + (upper.z != lower.z ? 2 : 0);
    color sums[2][4] = {{{{0}, {0}}}}; // [TOP, BOTTOM][mirrored along s, t]
    for (int tap = 0; tap < of->taps * of->taps; tap++) {
        double at[2];
        tap_place(job, of, tap, at);
        const glint_vec3 d = glint_cube_direction(TOP, at[0], at[1]);
        const double turn = atan2(d.x, d.z) / (2.0 * GLINT_PI);
        const double fall = atan(sqrt(d.x * d.x + d.z * d.z)) / GLINT_PI;
        const between rows[2] = {row_of(job, fall), row_of(job, 1.0 - fall)};
        // Mirrored along s: x changes its sign. Along t: z does.
        const double u[4] = {0.5 - turn, 0.5 + turn, turn, 1.0 - turn};
        for (int k = 0; k < 4; k++) {
            const between column = column_of(job, u[k]);
            add_look_up(job->image, column, rows[0], &sums[0][k]);
            add_look_up(job->image, column, rows[1], &sums[1][k ^ below]);
        }
    }
    for (int k = 0; k < 8; k++) {
        store_mean(job, k < 4 ? TOP : BOTTOM, of, k % 4, &sums[k / 4][k % 4]);
    }
}

// Resamples row j of the upper half of the faces, and its mirror image. Texels in the middle of an
// odd edge are their own mirror images.
static void resample_row(size_t index, void *context)
{
    const resampling *job = context;
    const int half = (job->cube->edge + 1) / 2, j = (int)index % half;
    const bool is_pole = index < (size_t)half;
    for (int i = 0; i < half; i++) {
        const texel of = texel_at(job, is_pole ? TOP : sides[0].face, i, j);
        if (is_pole) {
            resample_poles(job, &of);
        } else {
            resample_sides(job, &of);
        }
    }
}

glint_status glint_cube_from_latlong(const glint_image *image, bool on_edges, int edge,
                                     glint_cube *cube, glint_error *error)
{
    TRY(glint_cube_create_unset(edge, cube, error));
    resampling job = {image, cube, scale_of(image, on_edges)};
    glint_parallel_for(((size_t)edge + 1) / 2 * 2, resample_row, &job);
    glint_cube_fill_border(cube);
    return GLINT_OK;
}
