// Maps the pixels of a layout to directions, and back. See chart.h.
//
// kernels/layout.h defines which way faces and axes point.
//
// Six faces by name (posx …), crosses and strips follow the table of OpenGL, RenderMan and
// Direct3D. The table is left-handed: along world direction d = (x, y, z) it is asked for (x, y,
// −z). Its six lines then give layout.h's orientation for every face, with the two Z faces
// exchanged.
//
// Lat-long: longitude = atan2(x, z), latitude = asin(y), u = ½ − longitude/2π, v = ½ − latitude/π.
//
// Discs: +Z is in the centre. A direction at the angle θ from +Z is at p radii from the centre,
// towards (x, −y) in the picture (y runs downwards there).
//   Angular: p = θ/π.
//   Ball, seen from far away: the lecture's (s, t) = (x, y)/√(x² + y² + (z + 1)²) for a unit
//   direction, and OpenGL's sphere map: p = sin(θ/2). The surface faces half way, so that ψ = θ/2
//   is the angle of incidence, and p = sin ψ.
//
//   Ball, seen from D radii away along +Z by a camera that looks at its centre. A ray at γ from the
//   axis meets the ball at the angle of incidence ψ with sin ψ = D sin γ (law of sines). The
//   surface's normal there is at ψ − γ from the axis, so the ray is reflected to
//   θ = 2(ψ − γ) + γ = 2ψ − γ. The picture is flat: p = tan γ/tan α with sin α = 1/D. At the rim
//   ψ = 90° and θ = 180° − α. The picture does not show a cone of half angle α behind the ball.
#include "environment/chart.h"

#include "environment/cube.h"

#include <math.h>
#include <stddef.h>

// The largest sizes that glint can read again: 2^28 pixels.
#define LATLONG_HEIGHT_MAX 11585
#define DISC_SIZE_MAX 16384
#define QUARTER (GLINT_PI / 2)

// ---- Faces --------------------------------------------------------------------------------------

typedef struct face_picture {
    glint_layout layout;
    int across, down;
    glint_face_cell cells[6]; // +X −X +Y −Y +Z −Z of layout.h
} face_picture;

static const face_picture face_pictures[] = {
    {GLINT_LAYOUT_CUBE, 1, 6, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 4, 0}, {0, 5, 0}}},
    {GLINT_LAYOUT_FACES, 1, 6, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 5, 0}, {0, 4, 0}}},
    {GLINT_LAYOUT_VSTRIP, 1, 6, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 5, 0}, {0, 4, 0}}},
    {GLINT_LAYOUT_HSTRIP, 6, 1, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {5, 0, 0}, {4, 0, 0}}},
    {GLINT_LAYOUT_HCROSS, 4, 3, {{2, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 2, 0}, {3, 1, 0}, {1, 1, 0}}},
    {GLINT_LAYOUT_VCROSS, 3, 4, {{2, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 2, 0}, {1, 3, 1}, {1, 1, 0}}},
};

static const face_picture *find_picture(glint_layout layout)
{
    for (size_t k = 0; k < sizeof face_pictures / sizeof face_pictures[0]; k++) {
        if (face_pictures[k].layout == layout) {
            return &face_pictures[k];
        }
    }
    return NULL;
}

const glint_face_cell *glint_layout_cells(glint_layout layout, int *across, int *down)
{
    const face_picture *picture = find_picture(layout);
    if (picture == NULL) {
        return NULL;
    }
    if (across != NULL) {
        *across = picture->across;
    }
    if (down != NULL) {
        *down = picture->down;
    }
    return picture->cells;
}

// The place of a pixel along a face, from −1 to 1.
static double along_face(const glint_chart *chart, int edge, double pixels)
{
    if (chart->on_edges) {
        return 2.0 * (pixels - 0.5) / (edge - 1) - 1.0;
    }
    return 2.0 * pixels / edge - 1.0;
}

static bool face_direction(const glint_chart *chart, const face_picture *picture,
                           const glint_chart_place *at, glint_vec3 *direction)
{
    const int edge = chart->width / picture->across;
    for (int face = 0; face < 6; face++) {
        const glint_face_cell *cell = &picture->cells[face];
        if (at->i / edge == cell->column && at->j / edge == cell->row) {
            const double turn = cell->is_turned ? -1.0 : 1.0;
            const double s = along_face(chart, edge, at->i % edge + 0.5 + at->dx);
            const double t = along_face(chart, edge, at->j % edge + 0.5 + at->dy);
            *direction = glint_cube_direction(face, turn * s, turn * t);
            return true;
        }
    }
    return false;
}

// ---- Lat-long -----------------------------------------------------------------------------------

static void latlong_direction(const glint_chart *chart, double x, double y, glint_vec3 *direction)
{
    const double u = chart->on_edges ? (x - 0.5) / (chart->width - 1) : x / chart->width;
    const double v = chart->on_edges ? (y - 0.5) / (chart->height - 1) : y / chart->height;
    const double longitude = (0.5 - u) * 2.0 * GLINT_PI, latitude = (0.5 - v) * GLINT_PI;
    // Beyond a pole the cosine is negative: the map continues half a turn away.
    *direction =
        (glint_vec3){sin(longitude) * cos(latitude), sin(latitude), cos(longitude) * cos(latitude)};
}

// ---- Discs --------------------------------------------------------------------------------------

// The angle from the axis at p ≤ 1 radii from the centre.
static double disc_angle(const glint_chart *chart, double p)
{
    if (chart->layout == GLINT_LAYOUT_ANGULAR) {
        return p * GLINT_PI;
    }
    if (isinf(chart->distance)) {
        return 2.0 * asin(p);
    }
    const double alpha = asin(1.0 / chart->distance), gamma = atan(p * tan(alpha));
    return 2.0 * asin(fmin(chart->distance * sin(gamma), 1.0)) - gamma;
}

// The angle of incidence at which a ball reflects the viewer's rays to θ: 2ψ − asin(sin ψ/D) = θ.
// The slope of the left side is between 1 and 2, and its curvature has one sign. So Newton's method
// converges in a few steps from ψ = θ/2, which is too small.
static double incidence(double distance, double theta)
{
    double psi = 0.5 * theta;
    for (int step = 0; step < 32; step++) {
        const double sine = sin(psi), cosine = cos(psi);
        const double excess = 2.0 * psi - asin(sine / distance) - theta;
        const double slope = 2.0 - cosine / sqrt(distance * distance - sine * sine);
        const double next = fmin(psi - excess / slope, QUARTER);
        if (next == psi || fabs(excess) < 1e-16) {
            break;
        }
        psi = next;
    }
    return psi;
}

// Radii from the centre at which a disc shows a direction at θ from the axis, at most the rim.
static double disc_radius(const glint_chart *chart, double theta)
{
    if (chart->layout == GLINT_LAYOUT_ANGULAR) {
        return theta / GLINT_PI;
    }
    const double d = chart->distance;
    if (isinf(d)) {
        return sin(0.5 * theta);
    }
    if (theta >= GLINT_PI - asin(1.0 / d)) {
        return 1.0;
    }
    const double sine = sin(incidence(d, theta));
    return sine * sqrt((d - 1.0) * (d + 1.0) / (d * d - sine * sine));
}

static bool disc_direction(const glint_chart *chart, double x, double y, glint_vec3 *direction)
{
    const double right = (x - chart->center[0]) / chart->radius;
    const double up = (chart->center[1] - y) / chart->radius;
    const double p = hypot(right, up);
    if (p > 1.0) {
        return false;
    }
    const double theta = disc_angle(chart, p);
    // At the centre the quotient is multiplied by 0, so any finite value will do.
    const double share = p > 0.0 ? sin(theta) / p : 0.0;
    *direction = (glint_vec3){right * share, up * share, cos(theta)};
    return true;
}

// atan2 keeps all digits near −Z, where the lecture's root cancels.
static double angle_from_axis(glint_vec3 d)
{
    return atan2(hypot(d.x, d.y), d.z);
}

void glint_disc_place(const glint_chart *chart, glint_vec3 d, double place[2])
{
    const double aside = hypot(d.x, d.y);
    const double p = disc_radius(chart, angle_from_axis(d));
    // For the direction straight behind, every point of the rim is right.
    const double right = aside > 0.0 ? d.x / aside : (p > 0.5 ? 1.0 : 0.0);
    const double up = aside > 0.0 ? d.y / aside : 0.0;
    place[0] = chart->center[0] + chart->radius * p * right;
    place[1] = chart->center[1] - chart->radius * p * up;
}

// A step along the axis scales with p's slope in θ, a step around the axis with p/sin θ.
static double disc_pixels(const glint_chart *chart, glint_vec3 d, glint_vec3 step)
{
    const double theta = angle_from_axis(d), aside = hypot(d.x, d.y);
    if (aside < 1e-6 && d.z > 0) { // in the middle both scales are equal
        return chart->radius * disc_radius(chart, 1e-6) / 1e-6 * glint_vec3_length(step);
    }
    const double right = aside > 0 ? d.x / aside : 1, up = aside > 0 ? d.y / aside : 0;
    const double outwards = (step.x * right + step.y * up) * d.z - step.z * aside;
    const double around = step.y * right - step.x * up;
    const double h = 1e-5, low = fmax(theta - h, 0), high = fmin(theta + h, GLINT_PI);
    const double slope = (disc_radius(chart, high) - disc_radius(chart, low)) / (high - low);
    const double per_turn = disc_radius(chart, theta) / fmax(aside, 1 / chart->radius);
    return chart->radius * hypot(outwards * slope, around * per_turn);
}

// ds = d(x/z), and dt by the same rule; one unit is half a face's pixels.
static double face_pixels(double edge, glint_vec3 d, glint_vec3 step)
{
    const double x[3] = {d.x, d.y, d.z}, dx[3] = {step.x, step.y, step.z};
    const double a[3] = {fabs(d.x), fabs(d.y), fabs(d.z)};
    const int major = a[0] >= a[1] && a[0] >= a[2] ? 0 : a[1] >= a[2] ? 1 : 2;
    const int s = (major + 1) % 3, t = (major + 2) % 3;
    const double square = x[major] * x[major];
    const double ds = (dx[s] * x[major] - x[s] * dx[major]) / square;
    const double dt = (dx[t] * x[major] - x[t] * dx[major]) / square;
    return 0.5 * edge * hypot(ds, dt);
}

static double latlong_pixels(const glint_chart *chart, glint_vec3 d, glint_vec3 step)
{
    const double across = hypot(d.x, d.z);
    const double sine = across > 0 ? d.x / across : 0, cosine = across > 0 ? d.z / across : 1;
    const double east = step.x * cosine - step.z * sine;
    const double north = step.y * across - (step.x * sine + step.z * cosine) * d.y;
    const double columns = chart->width / (2 * GLINT_PI) / fmax(across, QUARTER / chart->height);
    return hypot(east * columns, north * chart->height / GLINT_PI);
}

// ---- All ----------------------------------------------------------------------------------------

static bool is_disc(glint_layout layout)
{
    return layout == GLINT_LAYOUT_BALL || layout == GLINT_LAYOUT_ANGULAR;
}

static int largest_size(glint_layout layout)
{
    return is_disc(layout)                  ? DISC_SIZE_MAX
           : layout == GLINT_LAYOUT_LATLONG ? LATLONG_HEIGHT_MAX
                                            : GLINT_FACE_EDGE_MAX;
}

glint_status glint_chart_make(glint_layout layout, int size, bool on_edges, glint_chart *chart,
                              glint_error *error)
{
    int across = 1, down = 1;
    const bool has_faces = glint_layout_cells(layout, &across, &down) != NULL;
    const int least = on_edges ? 2 : 1, most = largest_size(layout);
    if (size < least || size > most) {
        return glint_fail(error, GLINT_USAGE, "--size %d: %d to %d for the layout %s", size, least,
                          most, glint_layout_name(layout));
    }
    *chart = (glint_chart){.layout = layout, .on_edges = on_edges, .distance = INFINITY};
    chart->width = has_faces ? across * size : layout == GLINT_LAYOUT_LATLONG ? 2 * size : size;
    chart->height = has_faces ? down * size : size;
    chart->center[0] = 0.5 * chart->width;
    chart->center[1] = 0.5 * chart->height;
    chart->radius = 0.5 * size;
    return GLINT_OK;
}

bool glint_chart_direction(const glint_chart *chart, const glint_chart_place *at,
                           glint_vec3 *direction)
{
    const face_picture *picture = find_picture(chart->layout);
    if (picture != NULL) {
        return face_direction(chart, picture, at, direction);
    }
    const double x = at->i + 0.5 + at->dx, y = at->j + 0.5 + at->dy;
    if (is_disc(chart->layout)) {
        return disc_direction(chart, x, y, direction);
    }
    latlong_direction(chart, x, y, direction);
    return true;
}

double glint_chart_pixels(const glint_chart *chart, glint_vec3 direction, glint_vec3 step)
{
    int across;
    const glint_vec3 d = glint_vec3_normalize(direction);
    if (is_disc(chart->layout)) {
        return disc_pixels(chart, d, step);
    }
    if (glint_layout_cells(chart->layout, &across, NULL) != NULL) {
        return face_pixels((double)chart->width / across, d, step);
    }
    return latlong_pixels(chart, d, step);
}

double glint_chart_quarter_turn(const glint_chart *chart)
{
    int across;
    if (glint_layout_cells(chart->layout, &across, NULL) != NULL) {
        return (double)chart->width / across;
    }
    if (is_disc(chart->layout)) {
        return chart->radius * disc_radius(chart, QUARTER);
    }
    return fmax(0.25 * chart->width, 0.5 * chart->height);
}

int glint_chart_size_for(glint_layout layout, double quarter_turn)
{
    glint_chart one = {.layout = layout, .distance = INFINITY, .radius = 1.0};
    const double pixels = is_disc(layout) ? 2.0 * quarter_turn / disc_radius(&one, QUARTER)
                          : layout == GLINT_LAYOUT_LATLONG ? 2.0 * quarter_turn
                                                           : quarter_turn;
    return (int)fmin(fmax(1.0, round(pixels)), largest_size(layout));
}
