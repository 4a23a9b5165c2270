// Reads plates and puts them behind frames. See plate.h.
#include "cli/render/plate.h"

#include <stdlib.h>

static glint_status make_path(const render_request *request, int frame, char **path,
                              glint_error *error)
{
    *path = glint_frame_name_make(&request->plate_name, frame);
    return *path != NULL ? GLINT_OK : glint_fail_memory(error, "a file name");
}

glint_status render_plate_fingerprint(const render_request *request, int frame,
                                      glint_fingerprint *is, glint_error *error)
{
    *is = (glint_fingerprint){0};
    if (request->plate == NULL) {
        return GLINT_OK;
    }
    char *path;
    TRY(make_path(request, frame, &path, error));
    glint_status status = glint_fingerprint_file(path, is, error);
    free(path);
    return status;
}

static glint_status read_plate(const char *path, int width, int height, glint_image *plate,
                               glint_error *error)
{
    TRY(glint_image_read(path, plate, NULL, error));
    if (plate->width != width || plate->height != height) {
        glint_fail(error, GLINT_BAD_INPUT,
                   "%s: the plate has %dx%d pixels, the frame %dx%d (give --size %dx%d, or "
                   "another plate)",
                   path, plate->width, plate->height, width, height, plate->width, plate->height);
        glint_image_free(plate);
        return GLINT_BAD_INPUT;
    }
    return GLINT_OK;
}

glint_status render_plate_check(const render_request *request, int frame, glint_error *error)
{
    const glint_settings *settings = &request->inputs.settings;
    if (request->plate == NULL) {
        return GLINT_OK;
    }
    char *path;
    glint_image plate = {0};
    TRY(make_path(request, frame, &path, error));
    glint_status status = read_plate(path, settings->width, settings->height, &plate, error);
    glint_image_free(&plate);
    free(path);
    return status;
}

glint_status render_plate_put_behind(const char *path, glint_image *image, glint_error *error)
{
    glint_image plate = {0};
    TRY(read_plate(path, image->width, image->height, &plate, error));
    glint_image_put_behind(image, &plate);
    glint_image_free(&plate);
    return GLINT_OK;
}
