// Looks up lat-long maps and resamples them into a cube. See latlong.h. chart.c says which way they
// face.
//
// The cube's error is of second order in the spacing of texels: one bilinear look-up reads the map,
// another one reads the cube. The cube's border keeps this order over edges and corners (see
// cube.c).
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

static void sample_map(const glint_image *image, bool on_edges, double u, double v, double rgb[3])
{
    double x, y;
    if (on_edges) {
        // u and v reach 1. There the fraction is 0, so the pixel beyond has no weight.
        x = u * (image->width - 1);
        y = v * (image->height - 1);
    } else {
        x = u * image->width - 0.5;
        y = v * image->height - 0.5;
    }
    int upper = round_down(y);
    double above[3], below[3];
    sample_row(image, upper, x, above);
    sample_row(image, upper + 1, x, below);
    glint_rgb_mix(above, below, y - upper, rgb);
}

void glint_latlong_sample(const glint_image *image, bool on_edges, glint_vec3 direction,
                          double rgb[3])
{
    double across = sqrt(direction.x * direction.x + direction.z * direction.z);
    // atan2(0, 0) is 0. At the poles every longitude is right.
    double longitude = atan2(direction.x, direction.z);
    double latitude = atan2(direction.y, across);
    sample_map(image, on_edges, 0.5 - longitude / (2.0 * GLINT_PI), 0.5 - latitude / GLINT_PI, rgb);
}

typedef struct resampling {
    const glint_image *image;
    bool on_edges;
    glint_cube *cube;
} resampling;

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

static void resample_texel(const resampling *job, int face, int i, int j, int taps)
{
    double edge = job->cube->edge, sum[3] = {0.0, 0.0, 0.0};
    double s = (2.0 * i + 1.0) / edge - 1.0, t = (2.0 * j + 1.0) / edge - 1.0;
    for (int tap = 0; tap < taps * taps; tap++) {
        int column = tap % taps, row = tap / taps;
        double across = (2.0 * column + 1.0) / taps - 1.0;
        double down = (2.0 * row + 1.0) / taps - 1.0;
        double rgb[3];
        glint_latlong_sample(job->image, job->on_edges,
                             glint_cube_direction(face, s + across / edge, t + down / edge), rgb);
        for (int c = 0; c < 3; c++) {
            sum[c] += rgb[c] / (taps * taps);
        }
    }
    glint_cube_store(job->cube, face, i, j, sum);
}

// Resamples one row of the four faces around the horizon. They see the same latitudes, and their
// longitudes differ by quarter turns. So all four share the trigonometry, which is most of the
// work.
static void resample_sides(const resampling *job, int j)
{
    static const struct {
        int face;
        double middle; // u at s = 0
    } sides[] = {{4, 0.5}, {1, 0.75}, {5, 0.0}, {0, 0.25}};
    int edge = job->cube->edge;
    double t = (2.0 * j + 1.0) / edge - 1.0;
    for (int i = 0; i < edge; i++) {
        double s = (2.0 * i + 1.0) / edge - 1.0;
        int taps = count_taps(job, glint_cube_direction(sides[0].face, s, t));
        double turn = atan(s) / (2.0 * GLINT_PI);
        double v = 0.5 + atan(t / sqrt(1.0 + s * s)) / GLINT_PI;
        for (int side = 0; side < 4; side++) {
            if (taps > 1) {
                resample_texel(job, sides[side].face, i, j, taps);
                continue;
            }
            double u = sides[side].middle + turn, rgb[3];
            sample_map(job->image, job->on_edges, u < 0.0 ? u + 1.0 : u, v, rgb);
            glint_cube_store(job->cube, sides[side].face, i, j, rgb);
        }
    }
}

static void resample_row(size_t index, void *context)
{
    const resampling *job = context;
    int edge = job->cube->edge, j = (int)index % edge;
    if (index < (size_t)edge) {
        resample_sides(job, j);
        return;
    }
    int face = 1 + (int)index / edge; // +Y, then −Y
    for (int i = 0; i < edge; i++) {
        double s = (2.0 * i + 1.0) / edge - 1.0, t = (2.0 * j + 1.0) / edge - 1.0;
        int taps = count_taps(job, glint_cube_direction(face, s, t));
        resample_texel(job, face, i, j, taps);
    }
}

glint_status glint_cube_from_latlong(const glint_image *image, bool on_edges, int edge,
                                     glint_cube *cube, glint_error *error)
{
    TRY(glint_cube_create(edge, cube, error));
    resampling job = {image, on_edges, cube};
    glint_parallel_for((size_t)edge * 3, resample_row, &job);
    glint_cube_fill_border(cube);
    return GLINT_OK;
}
