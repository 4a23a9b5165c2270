// Looks up pictures of any layout and resamples them. See sampler.h.
//
// The error of bilinear interpolation in a twice differentiable map is of second order in the
// spacing of texels, over the edges of a cube too (see cube.c).
#include "environment/sampler.h"

#include "base/parallel.h"
#include "environment/faces.h"
#include "environment/latlong.h"

#include <math.h>
#include <string.h>

// The most look-ups for a pixel, over both axes. In reductions to 1:512 every pixel of the source
// counts. At poles and rims a step may be any number of pixels long. The cap keeps the few pixels
// there from taking all the time.
#define TAPS_MAX (1 << 18)

const glint_turn glint_turn_none = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

glint_status glint_sampler_of_image(const glint_image *image, const glint_chart *chart,
                                    glint_sampler *sampler, glint_error *error)
{
    *sampler = (glint_sampler){.chart = *chart, .image = image};
    if (glint_layout_cells(chart->layout, NULL, NULL) == NULL || chart->on_edges) {
        return GLINT_OK;
    }
    sampler->owns_cube = true;
    return glint_cube_from_faces(image, chart, &sampler->cube, error);
}

glint_sampler glint_sampler_of_cube(const glint_cube *cube)
{
    return (glint_sampler){.chart = {.layout = GLINT_LAYOUT_CUBE,
                                     .width = cube->edge,
                                     .height = 6 * cube->edge,
                                     .distance = INFINITY},
                           .cube = *cube};
}

void glint_sampler_free(glint_sampler *sampler)
{
    if (sampler->owns_cube) {
        glint_cube_free(&sampler->cube);
    }
    *sampler = (glint_sampler){0};
}

// ---- Look-ups -----------------------------------------------------------------------------------

static void add_pixel(const glint_image *image, int i, int j, double weight, double sum[3])
{
    double rgb[3];
    glint_image_rgb(image, i, j, rgb);
    for (int c = 0; c < 3; c++) {
        sum[c] += weight * rgb[c];
    }
}

// Interpolates bilinearly at a place in a picture. A pixel counts if it is in the picture and its
// centre is inside the disc; the weights are normalised to 1. False if no pixel has weight.
static bool mix_pixels(const glint_image *image, const glint_chart *disc, double x, double y,
                       double rgb[3])
{
    const int left = (int)floor(x - 0.5), top = (int)floor(y - 0.5);
    const double right = x - 0.5 - left, down = y - 0.5 - top;
    double sum[3] = {0, 0, 0}, total = 0;
    for (int k = 0; k < 4; k++) {
        const int i = left + k % 2, j = top + k / 2;
        const double weight = (k % 2 ? right : 1 - right) * (k / 2 ? down : 1 - down);
        const bool is_in = i >= 0 && j >= 0 && i < image->width && j < image->height;
        const double out = hypot(i + 0.5 - disc->center[0], j + 0.5 - disc->center[1]);
        if (!is_in || weight == 0 || out > disc->radius) {
            continue;
        }
        add_pixel(image, i, j, weight, sum);
        total += weight;
    }
    for (int c = 0; c < 3 && total > 0; c++) {
        rgb[c] = sum[c] / total;
    }
    return total > 0;
}

// At the rim, possibly no pixel's centre is inside. Then the place moves inwards until there is
// one.
static void look_up_disc(const glint_sampler *sampler, glint_vec3 direction, double rgb[3])
{
    const glint_chart *chart = &sampler->chart;
    double place[2];
    glint_disc_place(chart, direction, place);
    const double out[2] = {place[0] - chart->center[0], place[1] - chart->center[1]};
    const double length = fmax(hypot(out[0], out[1]), 1e-9);
    for (int quarters = 0; quarters <= 4 * length + 4; quarters++) {
        const double share = fmax(0, 1 - 0.25 * quarters / length);
        if (mix_pixels(sampler->image, chart, chart->center[0] + share * out[0],
                       chart->center[1] + share * out[1], rgb)) {
            return;
        }
    }
    rgb[0] = rgb[1] = rgb[2] = 0; // a disc that holds no pixel's centre
}

void glint_sampler_look_up(const glint_sampler *sampler, glint_vec3 direction, double rgb[3])
{
    const glint_chart *chart = &sampler->chart;
    if (sampler->cube.texels != NULL) {
        glint_cube_sample(&sampler->cube, direction, rgb);
    } else if (chart->layout == GLINT_LAYOUT_LATLONG) {
        glint_latlong_sample(sampler->image, chart->on_edges, direction, rgb);
    } else if (chart->layout == GLINT_LAYOUT_CUBE) {
        double s, t;
        const int face = glint_cube_place(direction, &s, &t);
        glint_face_on_edges(sampler->image, face, s, t, rgb);
    } else {
        look_up_disc(sampler, direction, rgb);
    }
}

// ---- Turns --------------------------------------------------------------------------------------

glint_turn glint_turn_of(double degrees, const char *flip)
{
    // The pixel asked for at d stood at d turned back and, before that, mirrored.
    const double angle = fmod(degrees, 360) * GLINT_PI / 180, c = cos(angle), s = sin(angle);
    glint_turn turn = {{{c, 0, -s}, {0, 1, 0}, {s, 0, c}}};
    for (int axis = 0; axis < 3; axis++) {
        if (flip != NULL && strchr(flip, "xyz"[axis]) != NULL) {
            turn.rows[axis] = glint_vec3_scale(turn.rows[axis], -1);
        }
    }
    return turn;
}

static glint_vec3 apply(const glint_turn *turn, glint_vec3 d)
{
    return (glint_vec3){glint_vec3_dot(turn->rows[0], d), glint_vec3_dot(turn->rows[1], d),
                        glint_vec3_dot(turn->rows[2], d)};
}

// ---- Resampling ---------------------------------------------------------------------------------

typedef struct resampling {
    const glint_sampler *from;
    const glint_turn *turn;
    const glint_chart *to;
    glint_image *image;
} resampling;

// The number of look-ups along one side of a pixel: the length of the side in pixels of the source,
// rounded. One bilinear look-up suffices for one and a half pixels. If one end of the side is
// outside the layout, the other half counts twice.
static int count_taps(const resampling *job, const glint_chart_place *high_at, glint_vec3 center)
{
    glint_vec3 low = center, high = center;
    const glint_chart_place low_at = {high_at->i, high_at->j, -high_at->dx, -high_at->dy};
    const bool has_low = glint_chart_direction(job->to, &low_at, &low);
    const bool has_high = glint_chart_direction(job->to, high_at, &high);
    const glint_vec3 step =
        glint_vec3_subtract(glint_vec3_normalize(high), glint_vec3_normalize(low));
    const double pixels =
        glint_chart_pixels(&job->from->chart, apply(job->turn, center), apply(job->turn, step)) *
        (has_low != has_high ? 2 : 1);
    return (int)fmin(fmax(1, ceil(pixels - 0.5)), TAPS_MAX);
}

static void resample_pixel(const resampling *job, int i, int j)
{
    glint_vec3 direction;
    float *pixel = glint_image_pixel(job->image, i, j);
    if (!glint_chart_direction(job->to, &(glint_chart_place){i, j, 0, 0}, &direction)) {
        return; // stays 0
    }
    int columns = count_taps(job, &(glint_chart_place){i, j, 0.5, 0}, direction);
    int rows = count_taps(job, &(glint_chart_place){i, j, 0, 0.5}, direction);
    if ((double)columns * rows > TAPS_MAX) {
        const double share = sqrt(TAPS_MAX / ((double)columns * rows));
        columns = (int)fmax(1, columns * share);
        rows = (int)fmax(1, fmin(rows * share, (double)TAPS_MAX / columns));
    }
    double sum[3] = {0, 0, 0};
    int count = 0;
    for (int tap = 0; tap < columns * rows; tap++) {
        const int column = tap % columns, row = tap / columns;
        const double dx = (column + 0.5) / columns - 0.5, dy = (row + 0.5) / rows - 0.5;
        double rgb[3];
        if (glint_chart_direction(job->to, &(glint_chart_place){i, j, dx, dy}, &direction)) {
            glint_sampler_look_up(job->from, apply(job->turn, direction), rgb);
            for (int c = 0; c < 3; c++) {
                sum[c] += rgb[c];
            }
            count++;
        }
    }
    for (int c = 0; c < 3 && count > 0; c++) {
        pixel[c] = (float)(sum[c] / count);
    }
}

static void resample_row(size_t j, void *context)
{
    const resampling *job = context;
    for (int i = 0; i < job->to->width; i++) {
        resample_pixel(job, i, (int)j);
    }
}

glint_status glint_resample(const glint_sampler *from, const glint_turn *turn,
                            const glint_chart *to, glint_image *image, glint_error *error)
{
    TRY(glint_image_create(to->width, to->height, 3, image, error));
    resampling job = {from, turn, to, image};
    glint_parallel_for((size_t)to->height, resample_row, &job);
    return GLINT_OK;
}
