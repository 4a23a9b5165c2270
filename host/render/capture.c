// Renders six views from one place. See capture.h.
#include "render/capture.h"

#include "render/renderer.h"

glint_settings glint_capture_settings(const glint_settings *settings, int edge)
{
    glint_settings square = *settings;
    square.width = square.height = edge;
    square.transparent = false;
    square.aovs = 0;
    square.terms = 0;
    square.proxy = false;
    square.grid_step = 0;
    square.list = NULL;
    square.shading = GLINT_SHADING_PIXEL;
    return square;
}

// The camera whose pixel (i, j) looks along texel (i, j) of a face: s to the right, t downwards.
static glint_camera face_camera(int face, glint_vec3 eye)
{
    const glint_vec3 middle = glint_cube_direction(face, 0, 0);
    const glint_vec3 right = glint_vec3_subtract(glint_cube_direction(face, 1, 0), middle);
    const glint_vec3 down = glint_vec3_subtract(glint_cube_direction(face, 0, 1), middle);
    return (glint_camera){.yfov = GLINT_PI / 2,
                          .eye = eye,
                          .right = right,
                          .up = glint_vec3_scale(down, -1),
                          .back = glint_vec3_scale(middle, -1)};
}

// The progress of one of the six views.
typedef struct view_steps {
    const glint_progress *all;
    int face;
} view_steps;

static bool step(void *context, uint64_t done, uint64_t total)
{
    const view_steps *steps = context;
    return steps->all == NULL ||
           steps->all->step(steps->all->context, (uint64_t)steps->face * total + done, 6 * total);
}

static void add_report(const glint_frame_report *view, glint_frame_report *sum)
{
    const double share = 1.0 / 6;
    glint_ray_counts_add(&sum->rays, &view->rays);
    sum->truncation.by_depth += share * view->truncation.by_depth;
    sum->truncation.by_min_weight += share * view->truncation.by_min_weight;
    sum->truncation.by_stack += share * view->truncation.by_stack;
    sum->truncation.media_overflows += view->truncation.media_overflows;
    sum->deepest = view->deepest > sum->deepest ? view->deepest : sum->deepest;
    sum->nonfinite_pixels += view->nonfinite_pixels;
    sum->mended_pixels += view->mended_pixels;
    sum->kernel_ms += view->kernel_ms;
    sum->readback_ms += view->readback_ms;
}

static void store_face(const glint_image *image, int face, glint_cube *cube)
{
    for (int j = 0; j < image->height; j++) {
        for (int i = 0; i < image->width; i++) {
            double rgb[3];
            glint_image_rgb(image, i, j, rgb);
            glint_cube_store(cube, face, i, j, rgb);
        }
    }
}

glint_status glint_capture(const glint_capture_request *request, glint_cube *cube,
                           glint_error *error)
{
    const glint_settings *settings = &request->renderer->settings;
    glint_frame_report sum = {0};
    glint_image image = {0};
    *cube = (glint_cube){0};
    if (settings->width != settings->height) {
        return glint_fail(error, GLINT_USAGE, "a captured view is square, not %dx%d",
                          settings->width, settings->height);
    }
    glint_status status;
    TRY_OR(cleanup, status, glint_cube_create(settings->width, cube, error));
    // Render the six faces.
    for (int face = 0; face < 6; face++) {
        const glint_camera camera = face_camera(face, request->at);
        view_steps steps = {request->progress, face};
        const glint_progress of_view = {step, &steps};
        glint_frame_report view;
        TRY_OR(cleanup, status,
               glint_renderer_frame(
                   &(glint_frame_request){request->renderer, &camera, &of_view, &image, &view},
                   error));
        add_report(&view, &sum);
        store_face(&image, face, cube);
    }
cleanup:
    glint_image_free(&image);
    // Complete the map, or leave it empty after a failure.
    if (status == GLINT_OK) {
        glint_cube_fill_border(cube);
    } else {
        glint_cube_free(cube);
    }
    if (request->report != NULL) {
        *request->report = sum;
    }
    return status;
}
