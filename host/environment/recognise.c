// Recognises the layout of an environment file. See recognise.h.
#include "environment/recognise.h"

#include <math.h>

// True if the picture is across × down whole squares.
static bool is_shape(const glint_image *image, int across, int down)
{
    return (long)image->width * down == (long)image->height * across && image->width % across == 0;
}

// The layout if the shape alone decides it.
static glint_layout layout_of_shape(const glint_image *image, const char **reason)
{
    static const struct {
        int across, down;
        glint_layout layout;
        const char *reason;
    } shapes[] = {
        {2, 1, GLINT_LAYOUT_LATLONG, "shape 2:1"},
        {4, 3, GLINT_LAYOUT_HCROSS, "shape 4:3"},
        {3, 4, GLINT_LAYOUT_VCROSS, "shape 3:4"},
        {6, 1, GLINT_LAYOUT_HSTRIP, "shape 6:1"},
    };
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        if (is_shape(image, shapes[i].across, shapes[i].down)) {
            *reason = shapes[i].reason;
            return shapes[i].layout;
        }
    }
    return GLINT_LAYOUT_UNKNOWN;
}

static glint_status refuse_shape(const char *path, const glint_image *image, glint_error *error)
{
    const char *meaning = "the shape of no layout (a lat-long map is 2:1, a cross 4:3 or 3:4, a "
                          "strip 6:1; --env-layout latlong or ball takes this one as such)";
    if (is_shape(image, 1, 6)) {
        meaning = "six faces above each other, in OpenEXR's order or that of OpenGL and Direct3D "
                  "(give --env-layout cube for the first, vstrip for the other)";
    } else if (is_shape(image, 1, 1)) {
        meaning = "square, as a mirror ball and an angular map are (give --env-layout ball or "
                  "angular; a single face of a cube is not enough)";
    }
    return glint_fail(error, GLINT_BAD_INPUT, "%s: %d × %d pixels are %s", path, image->width,
                      image->height, meaning);
}

// Checks that the picture has as many squares as the layout, and that their edge is not too large.
static glint_status check_faces(const char *path, const glint_image *image, glint_layout layout,
                                glint_error *error)
{
    int across, down;
    glint_layout_cells(layout, &across, &down);
    if (!is_shape(image, across, down)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %d × %d pixels are not %d × %d squares, as the layout %s has", path,
                          image->width, image->height, across, down, glint_layout_name(layout));
    }
    const int edge = image->width / across;
    if (edge > GLINT_FACE_EDGE_MAX) {
        return glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: faces of %d pixels an edge, where %d is the most (make them smaller)", path, edge,
            GLINT_FACE_EDGE_MAX);
    }
    return GLINT_OK;
}

// Places the disc that the user gave, or the disc that touches the picture's nearer sides.
static glint_status place_disc(const char *path, const glint_layout_request *request,
                               glint_chart *chart, glint_error *error)
{
    const double width = chart->width, height = chart->height;
    const double *circle = request->circle;
    chart->center[0] = 0.5 * width;
    chart->center[1] = 0.5 * height;
    chart->radius = 0.5 * fmin(width, height);
    if (circle[2] > 0) {
        chart->center[0] = circle[0];
        chart->center[1] = circle[1];
        chart->radius = circle[2];
    }
    const double left = chart->center[0] - chart->radius, top = chart->center[1] - chart->radius;
    const double slack = 0.5; // half a pixel: users measure circles by eye
    if (!(left >= -slack && top >= -slack && left + 2 * chart->radius <= width + slack &&
          top + 2 * chart->radius <= height + slack)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: --ball-circle %g,%g,%g leaves the picture of %d × %d pixels (give "
                          "x,y,r of a circle within it)",
                          path, circle[0], circle[1], circle[2], chart->width, chart->height);
    }
    if (request->ball_distance > 0) {
        chart->distance = request->ball_distance;
    } else if (request->ball_fov > 0) {
        // The rim appears at the angle α with sin α = 1/distance.
        const double half = request->ball_fov * GLINT_PI / 360;
        const double tangent = tan(half) * chart->radius / (0.5 * height);
        chart->distance = sqrt(1 + 1 / (tangent * tangent));
    }
    return GLINT_OK;
}

// The layout that the user asked for, or else that the file names. UNKNOWN if neither does.
static glint_layout layout_of_facts(const glint_image *image, const glint_image_facts *facts,
                                    glint_layout asked, const char **reason)
{
    *reason = "as asked";
    if (asked != GLINT_LAYOUT_UNKNOWN) {
        return asked;
    }
    if (facts->is_direct3d_cube) {
        *reason = "cube map of a DDS";
        return GLINT_LAYOUT_FACES;
    }
    // OpenImageIO also stores the attribute under another name. Programs that do not know it copy
    // it from their input, so it may be wrong. Then the shape decides.
    *reason = "envmap attribute";
    return facts->envmap == GLINT_ENVMAP_NONE                             ? GLINT_LAYOUT_UNKNOWN
           : is_shape(image, 1, 6)                                        ? GLINT_LAYOUT_CUBE
           : facts->envmap == GLINT_ENVMAP_CUBE && !is_shape(image, 2, 1) ? GLINT_LAYOUT_CUBE
                                                                          : GLINT_LAYOUT_LATLONG;
}

glint_status glint_layout_recognise(const glint_image_file *file,
                                    const glint_layout_request *request,
                                    glint_recognised *recognised, glint_error *error)
{
    const char *path = file->name;
    const glint_image *image = &file->image;
    const glint_image_facts *facts = &file->facts;
    const char *reason;
    glint_layout layout = layout_of_facts(image, facts, request->layout, &reason);
    if (layout == GLINT_LAYOUT_UNKNOWN) {
        layout = layout_of_shape(image, &reason);
    }
    if (layout == GLINT_LAYOUT_UNKNOWN) {
        return refuse_shape(path, image, error);
    }
    if (layout == GLINT_LAYOUT_FACES && !facts->is_direct3d_cube) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: one file, where the layout faces takes six (give their folder, or a "
                          "pattern with %%s)",
                          path);
    }
    glint_chart chart = {
        .layout = layout, .width = image->width, .height = image->height, .distance = INFINITY};
    chart.on_edges = facts->envmap != GLINT_ENVMAP_NONE &&
                     (layout == GLINT_LAYOUT_LATLONG || layout == GLINT_LAYOUT_CUBE);
    *recognised = (glint_recognised){chart, reason};
    if (layout == GLINT_LAYOUT_BALL || layout == GLINT_LAYOUT_ANGULAR) {
        return place_disc(path, request, &recognised->chart, error);
    }
    return layout == GLINT_LAYOUT_LATLONG ? GLINT_OK : check_faces(path, image, layout, error);
}
