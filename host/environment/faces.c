// Makes cube maps from pictures of faces. See faces.h.
#include "environment/faces.h"

#include "kernels/layout.h"

#include <math.h>

void glint_face_on_edges(const glint_image *image, int face, double s, double t, double rgb[3])
{
    const int n = image->width, top = face * n;
    const double x = fmin(fmax(0.5 * (s + 1.0), 0.0), 1.0) * (n - 1);
    const double y = fmin(fmax(0.5 * (t + 1.0), 0.0), 1.0) * (n - 1);
    int left = (int)x, upper = (int)y;
    int right = left + 1 < n ? left + 1 : left, lower = upper + 1 < n ? upper + 1 : upper;
    double corners[4][3], above[3], below[3];
    glint_image_rgb(image, left, top + upper, corners[0]);
    glint_image_rgb(image, right, top + upper, corners[1]);
    glint_image_rgb(image, left, top + lower, corners[2]);
    glint_image_rgb(image, right, top + lower, corners[3]);
    glint_rgb_mix(corners[0], corners[1], x - left, above);
    glint_rgb_mix(corners[2], corners[3], x - left, below);
    glint_rgb_mix(above, below, y - upper, rgb);
}

glint_status glint_cube_from_faces(const glint_image *image, const glint_chart *chart,
                                   glint_cube *cube, glint_error *error)
{
    int across;
    const glint_face_cell *cells = glint_layout_cells(chart->layout, &across, NULL);
    const int edge = image->width / across;
    TRY(glint_cube_create(edge, cube, error));
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        const int left = cells[face].column * edge, top = cells[face].row * edge;
        for (int k = 0; k < edge * edge; k++) {
            const int i = k % edge, j = k / edge;
            double rgb[3];
            if (chart->on_edges) {
                glint_face_on_edges(image, face, (2.0 * i + 1.0) / edge - 1.0,
                                    (2.0 * j + 1.0) / edge - 1.0, rgb);
            } else if (cells[face].is_turned) {
                glint_image_rgb(image, left + edge - 1 - i, top + edge - 1 - j, rgb);
            } else {
                glint_image_rgb(image, left + i, top + j, rgb);
            }
            glint_cube_store(cube, face, i, j, rgb);
        }
    }
    glint_cube_fill_border(cube);
    return GLINT_OK;
}
