// Converts colours of other primaries to linear Rec. 709. See primaries.h.
//
// The matrix from RGB to XYZ is SMPTE RP 177's. The adaptation is that of OpenEXR's AcesInputFile,
// the one place where OpenEXR itself converts a file's chromaticities: Bradford's, from the file's
// white to the target's. OpenEXR's Technical Introduction says how XYZ is stored: primaries (1, 0),
// (0, 1) and (0, 0), white (1/3, 1/3). This white is a convention, not the scene's.
#include "codec/primaries.h"

#include <math.h>

static const glint_primaries rec709 = {
    {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}};

// Lam 1985: XYZ to the responses of the cones.
static const glint_color_matrix bradford = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

static glint_color_matrix product(const glint_color_matrix *a, const glint_color_matrix *b)
{
    glint_color_matrix made;
    for (int i = 0; i < 9; i++) {
        const double *row = a->rows[i / 3];
        const int column = i % 3;
        made.rows[i / 3][column] =
            row[0] * b->rows[0][column] + row[1] * b->rows[1][column] + row[2] * b->rows[2][column];
    }
    return made;
}

static void transform(const glint_color_matrix *matrix, const double from[3], double to[3])
{
    for (int i = 0; i < 3; i++) {
        const double *row = matrix->rows[i];
        to[i] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
    }
}

// Multiplies a column.
static void scale_column(glint_color_matrix *matrix, int column, double factor)
{
    for (int row = 0; row < 3; row++) {
        matrix->rows[row][column] *= factor;
    }
}

// False if the matrix is singular or not finite. The entries are about 1, so an absolute limit
// serves.
static bool invert(const glint_color_matrix *matrix, glint_color_matrix *inverse)
{
    const double(*m)[3] = matrix->rows;
    for (int i = 0; i < 9; i++) {
        // The adjugate: the cofactor of the transposed place.
        const int r0 = (i % 3 + 1) % 3, r1 = (i % 3 + 2) % 3;
        const int c0 = (i / 3 + 1) % 3, c1 = (i / 3 + 2) % 3;
        inverse->rows[i / 3][i % 3] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    }
    const double determinant = m[0][0] * inverse->rows[0][0] + m[0][1] * inverse->rows[1][0] +
                               m[0][2] * inverse->rows[2][0];
    if (!(fabs(determinant) > 1e-6)) {
        return false;
    }
    for (int column = 0; column < 3; column++) {
        scale_column(inverse, column, 1 / determinant);
    }
    return true;
}

// The XYZ of white with Y = 1.
static void white_of(const glint_primaries *primaries, double white[3])
{
    const double x = primaries->xy[3][0], y = primaries->xy[3][1];
    white[0] = x / y;
    white[1] = 1;
    white[2] = (1 - x - y) / y;
}

// The matrix whose columns are the XYZ of red, green and blue, such that their sum is white.
static bool xyz_of_rgb(const glint_primaries *primaries, glint_color_matrix *matrix)
{
    glint_color_matrix inverse;
    double white[3], amounts[3];
    for (int c = 0; c < 3; c++) {
        const double x = primaries->xy[c][0], y = primaries->xy[c][1];
        matrix->rows[0][c] = x;
        matrix->rows[1][c] = y;
        matrix->rows[2][c] = 1 - x - y;
    }
    if (!invert(matrix, &inverse)) {
        return false;
    }
    white_of(primaries, white);
    transform(&inverse, white, amounts);
    for (int c = 0; c < 3; c++) {
        scale_column(matrix, c, amounts[c]);
    }
    return true;
}

// The von Kries scaling of cones that takes the white to Rec. 709's. False if it is no white.
static bool adaptation(const glint_primaries *primaries, glint_color_matrix *matrix)
{
    glint_color_matrix back;
    double from[3], to[3], cones_from[3], cones_to[3];
    white_of(primaries, from);
    white_of(&rec709, to);
    transform(&bradford, from, cones_from);
    transform(&bradford, to, cones_to);
    if (!invert(&bradford, &back)) {
        return false;
    }
    for (int c = 0; c < 3; c++) {
        if (!(cones_from[c] > 0)) {
            return false;
        }
        scale_column(&back, c, cones_to[c] / cones_from[c]);
    }
    *matrix = product(&back, &bradford);
    return true;
}

static bool are_close(const glint_primaries *a, const glint_primaries *b, int count)
{
    for (int i = 0; i < 2 * count; i++) {
        // Half of the fourth digit, and the rounding of a float. NaN fails the comparison.
        if (!(fabs(a->xy[i / 2][i % 2] - b->xy[i / 2][i % 2]) < 0.5001e-4)) {
            return false;
        }
    }
    return true;
}

bool glint_primaries_are_rec709(const glint_primaries *primaries)
{
    return are_close(primaries, &rec709, 4);
}

bool glint_primaries_to_rec709(const glint_primaries *primaries, glint_color_matrix *matrix)
{
    static const glint_primaries xyz = {{{1, 0}, {0, 1}, {0, 0}}};
    glint_color_matrix from, to, back, adapt;
    if (!(primaries->xy[3][1] > 0) || !xyz_of_rgb(primaries, &from) || !xyz_of_rgb(&rec709, &to) ||
        !invert(&to, &back)) {
        return false;
    }
    if (!are_close(primaries, &xyz, 3)) {
        if (!adaptation(primaries, &adapt)) {
            return false;
        }
        from = product(&adapt, &from);
    }
    *matrix = product(&back, &from);
    for (int i = 0; i < 9; i++) {
        if (!isfinite(matrix->rows[i / 3][i % 3])) {
            return false;
        }
    }
    return true;
}

void glint_color_matrix_apply(const glint_color_matrix *matrix, float *pixels, size_t count,
                              size_t stride)
{
    for (size_t p = 0; p < count; p++) {
        float *pixel = pixels + p * stride;
        const double color[3] = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
        double converted[3];
        if (!isfinite(color[0]) || !isfinite(color[1]) || !isfinite(color[2])) {
            continue;
        }
        transform(matrix, color, converted);
        for (int c = 0; c < 3; c++) {
            pixel[c] = (float)converted[c];
        }
    }
}
