// Layouts of environment files: recognising them and making cube maps of them. See layouts.h.
//
// Which way things face is in DESIGN's conventions and in kernels/layout.h. Lat-long and OpenEXR's
// cube follow ImfEnvmap.h:
//   longitude = atan2(x, z), latitude = asin(y), u = ½ − longitude/2π, v = ½ − latitude/π,
// so that +Z is in the middle, +X a quarter in from the left edge and +Y at the top. Files with the
// envmap attribute have pixel (i, j) at u = i/(W − 1), v = j/(H − 1); all others at u = (i + ½)/W,
// v = (j + ½)/H. The same holds on the faces of a cube.
//
// How well the cube stands for a lat-long map: texel spacing h on the sphere, a map that is twice
// differentiable: reading it by one bilinear look-up and writing, then reading the cube by another,
// differ from the map by second-order terms in h each, except within half a texel of the cube's
// edges. There the border, copied from the neighbours' texels, stands up to half a texel from where
// the plane of the face would have it: up to 0.193 |∇E|/N away, at the ends of the edges (see
// tests/support/direction_maps.c). In exchange both faces agree on their common edge, exactly.
#include "environment/layouts.h"

#include "base/parallel.h"
#include "kernels/layout.h"

#include <math.h>
#include <string.h>

#define LATLONG_EDGE_MIN 256 // keeps second-order errors of tiny maps below 10⁻⁴
#define LATLONG_EDGE_MAX                                                                           \
    2048            // 0.4 GB of cube; maps of more than 3200 rows lose their finest detail
#define TAPS_MAX 16 // an axis; a cap for the few texels at the poles

// ---- Names and recognition ----------------------------------------------------------------------

static const struct {
    glint_layout layout;
    const char *name;
} names[] = {
    {GLINT_LAYOUT_CUBE, "cube"},
    {GLINT_LAYOUT_FACES, "faces"},
    {GLINT_LAYOUT_LATLONG, "latlong"},
    {GLINT_LAYOUT_STUDIO, "studio"},
};

const char *glint_layout_name(glint_layout layout)
{
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (names[i].layout == layout) {
            return names[i].name;
        }
    }
    return NULL;
}

glint_layout glint_layout_from_name(const char *name)
{
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(names[i].name, name) == 0) {
            return names[i].layout;
        }
    }
    return GLINT_LAYOUT_UNKNOWN;
}

static bool is_shape(const glint_image *image, int across, int down)
{
    return (long)image->width * down == (long)image->height * across;
}

static glint_status refuse_shape(const char *path, const glint_image *image, glint_error *error)
{
    static const struct {
        int across, down;
        const char *meaning;
    } later[] = {
        {4, 3, "a horizontal cross"},
        {3, 4, "a vertical cross"},
        {6, 1, "a strip of faces"},
        {1, 6, "a strip of faces"},
        {1, 1, "a mirror ball or angular map"},
    };
    for (size_t i = 0; i < sizeof later / sizeof later[0]; i++) {
        if (!is_shape(image, later[i].across, later[i].down)) {
            continue;
        }
        if (later[i].down == 6) {
            return glint_fail(
                error, GLINT_BAD_INPUT,
                "%s: %d × %d pixels are six faces above each other, in OpenEXR's order "
                "or another's (give --env-layout cube if it is OpenEXR's, or six "
                "files, or a lat-long map of 2:1)",
                path, image->width, image->height);
        }
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %d × %d pixels look like %s, which is not read (give a lat-long map "
                          "of 2:1, OpenEXR's cube, or six faces)",
                          path, image->width, image->height, later[i].meaning);
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: %d × %d pixels are the shape of no layout (a lat-long map is 2:1; "
                      "--env-layout latlong takes this one as such)",
                      path, image->width, image->height);
}

// Six squares above each other, of an edge that can be held.
static glint_status check_strip(const char *path, const glint_image *image, glint_error *error)
{
    if (!is_shape(image, 1, 6)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %d × %d pixels are not six squares above each other, as a cube is",
                          path, image->width, image->height);
    }
    if (image->width > GLINT_FACE_EDGE_MAX) {
        return glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: faces of %d pixels an edge, where %d is the most (make them smaller)", path,
            image->width, GLINT_FACE_EDGE_MAX);
    }
    return GLINT_OK;
}

glint_status glint_layout_recognise(const char *path, const glint_image *image,
                                    const glint_image_facts *facts, glint_recognised *recognised,
                                    glint_error *error)
{
    glint_layout wanted = recognised->layout;
    bool has_latlong = facts->envmap == GLINT_ENVMAP_LATLONG;
    bool has_cube = facts->envmap == GLINT_ENVMAP_CUBE;
    const char *reason = wanted != GLINT_LAYOUT_UNKNOWN ? "as asked" : "envmap attribute";
    glint_recognised found = {GLINT_LAYOUT_UNKNOWN, reason, false};
    if (wanted == GLINT_LAYOUT_LATLONG || (wanted == GLINT_LAYOUT_UNKNOWN && has_latlong)) {
        found.layout = GLINT_LAYOUT_LATLONG;
        found.on_edges = has_latlong;
    } else if (wanted == GLINT_LAYOUT_CUBE || (wanted == GLINT_LAYOUT_UNKNOWN && has_cube)) {
        found.layout = GLINT_LAYOUT_CUBE;
        found.on_edges = has_cube;
    } else if (facts->is_direct3d_cube) {
        found.layout = GLINT_LAYOUT_FACES;
        found.reason = wanted == GLINT_LAYOUT_UNKNOWN ? "cube map of a DDS" : reason;
    } else if (wanted == GLINT_LAYOUT_FACES) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: one file, where the layout faces takes six (give their folder, or a "
                          "pattern with %%s)",
                          path);
    } else if (is_shape(image, 2, 1)) {
        found.layout = GLINT_LAYOUT_LATLONG;
        found.reason = "shape 2:1";
    } else {
        return refuse_shape(path, image, error);
    }
    *recognised = found;
    return found.layout == GLINT_LAYOUT_LATLONG ? GLINT_OK : check_strip(path, image, error);
}

// ---- Faces --------------------------------------------------------------------------------------

// Seen along world d = (x, y, z) the left-handed table is asked for (x, y, −z). Working that
// through its six lines gives layout.h's orientation for every face, with the two Z faces
// exchanged.
void glint_face_views_from_named(const glint_face_view named[6], glint_face_view views[6])
{
    static const int from[6] = {0, 1, 2, 3, 5, 4};
    for (int face = 0; face < 6; face++) {
        views[face] = named[from[face]];
    }
}

static void load_pixel(const glint_image *image, int x, int y, double rgb[3])
{
    const float *pixel = glint_image_pixel(image, x, y);
    int step = image->channels >= 3; // grey is repeated
    for (int c = 0; c < 3; c++) {
        rgb[c] = (double)pixel[c * step];
    }
}

static void store_texel(const double rgb[3], float *texel)
{
    for (int c = 0; c < 3; c++) {
        texel[c] = (float)rgb[c];
    }
    texel[3] = 1.0f;
}

static void mix(const double a[3], const double b[3], double weight, double mixed[3])
{
    for (int c = 0; c < 3; c++) {
        mixed[c] = a[c] + weight * (b[c] - a[c]);
    }
}

// A texel's centre in a face whose pixels lie on the edges: always inside, no neighbour is needed.
static void sample_on_edges(const glint_face_view *view, int i, int j, double rgb[3])
{
    int n = view->image->width;
    double x = (i + 0.5) / n * (n - 1), y = (j + 0.5) / n * (n - 1);
    int left = (int)x, upper = (int)y;
    int right = left + 1 < n ? left + 1 : left, lower = upper + 1 < n ? upper + 1 : upper;
    double corners[4][3], above[3], below[3];
    load_pixel(view->image, left, view->top + upper, corners[0]);
    load_pixel(view->image, right, view->top + upper, corners[1]);
    load_pixel(view->image, left, view->top + lower, corners[2]);
    load_pixel(view->image, right, view->top + lower, corners[3]);
    mix(corners[0], corners[1], x - left, above);
    mix(corners[2], corners[3], x - left, below);
    mix(above, below, y - upper, rgb);
}

glint_status glint_cube_from_faces(const glint_face_view views[6], bool on_edges, glint_cube *cube,
                                   glint_error *error)
{
    int edge = views[0].image->width;
    glint_status status = glint_cube_create(edge, cube, error);
    if (status != GLINT_OK) {
        return status;
    }
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        for (int j = 0; j < edge; j++) {
            for (int i = 0; i < edge; i++) {
                double rgb[3];
                if (on_edges) {
                    sample_on_edges(&views[face], i, j, rgb);
                } else {
                    load_pixel(views[face].image, i, views[face].top + j, rgb);
                }
                store_texel(rgb, glint_cube_texel(cube, face, i, j));
            }
        }
    }
    glint_cube_fill_border(cube);
    return GLINT_OK;
}

// ---- Lat-long -----------------------------------------------------------------------------------

int glint_latlong_edge(int height)
{
    // At the middle of a face a texel of a cube with edge H spans 2/H, a row of the map π/H: a cube
    // of 0.64 H would already hold as many texels as the map has there.
    if (height < LATLONG_EDGE_MIN) {
        return LATLONG_EDGE_MIN;
    }
    return height < LATLONG_EDGE_MAX ? height : LATLONG_EDGE_MAX;
}

// Of a value above −1. (floor is a call where the processor is not told.)
static int round_down(double value)
{
    return (int)(value + 1.0) - 1;
}

// The map at column x, in [−½, 3/2 width), of row j, linear between pixels; a row beyond a pole is
// the row as far on this side of it, half a turn away.
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
    load_pixel(image, left, j, a);
    load_pixel(image, right, j, b);
    mix(a, b, weight, rgb);
}

static void sample_map(const glint_image *image, bool on_edges, double u, double v, double rgb[3])
{
    double x, y;
    if (on_edges) {
        // u and v reach 1, where the fraction is 0: what lies beyond is read and weighs nothing.
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
    mix(above, below, y - upper, rgb);
}

void glint_latlong_sample(const glint_image *image, bool on_edges, glint_vec3 direction,
                          double rgb[3])
{
    double across = sqrt(direction.x * direction.x + direction.z * direction.z);
    // atan2(0, 0) is 0: at the poles every longitude is right.
    double longitude = atan2(direction.x, direction.z);
    double latitude = atan2(direction.y, across);
    sample_map(image, on_edges, 0.5 - longitude / (2.0 * GLINT_PI), 0.5 - latitude / GLINT_PI, rgb);
}

typedef struct resampling {
    const glint_image *image;
    bool on_edges;
    glint_cube *cube;
} resampling;

// How many look-ups along each axis the texel at (s, t) takes: the longest side of its footprint in
// the map, in pixels, rounded. A bilinear look-up is good for one and a half.
static int count_taps(const resampling *job, glint_vec3 d)
{
    double length = sqrt(glint_vec3_dot(d, d));
    double size = 2.0 / job->cube->edge / length; // radians, or less
    // Meridians crowd towards the poles; the middle of the texel's half nearer the equator counts.
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
    store_texel(sum, glint_cube_texel(job->cube, face, i, j));
}

// One row of the four faces around the horizon. They see the same latitudes, and longitudes that
// differ by quarter turns: the trigonometry, which is most of the work, is done once for all four.
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
            store_texel(rgb, glint_cube_texel(job->cube, sides[side].face, i, j));
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
    glint_status status = glint_cube_create(edge, cube, error);
    if (status != GLINT_OK) {
        return status;
    }
    resampling job = {image, on_edges, cube};
    glint_parallel_for((size_t)edge * 3, resample_row, &job);
    glint_cube_fill_border(cube);
    return GLINT_OK;
}
