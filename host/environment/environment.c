// Environments: cube maps of what files hold. See environment.h.
#include "environment/environment.h"

#include "environment/latlong.h"
#include "environment/layouts.h"
#include "environment/sampler.h"
#include "environment/source.h"

#include <stdlib.h>
#include <string.h>

// A disc's cube: through a picture of one.
static glint_status make_cube_of_disc(const glint_source *source, glint_cube *cube,
                                      glint_error *error)
{
    glint_sampler sampler = {0};
    glint_image strip = {0};
    glint_chart faces;
    const int rows = (int)(2 * glint_chart_quarter_turn(&source->chart) + 0.5);
    glint_status status =
        glint_chart_make(GLINT_LAYOUT_CUBE, glint_latlong_edge(rows), false, &faces, error);
    if (status == GLINT_OK) {
        status = glint_sampler_of_image(&source->image, &source->chart, &sampler, error);
    }
    if (status == GLINT_OK) {
        status = glint_resample(&sampler, &glint_turn_none, &faces, &strip, error);
    }
    if (status == GLINT_OK) {
        status = glint_cube_from_faces(&strip, &faces, cube, error);
    }
    glint_image_free(&strip);
    glint_sampler_free(&sampler);
    return status;
}

static glint_status make_cube(const glint_source *source, glint_cube *cube, glint_error *error)
{
    const glint_chart *chart = &source->chart;
    if (chart->layout == GLINT_LAYOUT_LATLONG) {
        return glint_cube_from_latlong(&source->image, chart->on_edges,
                                       glint_latlong_edge(chart->height), cube, error);
    }
    if (glint_layout_cells(chart->layout, NULL, NULL) != NULL) {
        return glint_cube_from_faces(&source->image, chart, cube, error);
    }
    return make_cube_of_disc(source, cube, error);
}

// Makes a cube of the source, which is freed. Its loading ended with `status`.
static glint_status finish(const char *name, glint_status status, glint_source *source,
                           glint_environment *environment, glint_error *error)
{
    if (status == GLINT_OK) {
        status = make_cube(source, &environment->radiance, error);
    }
    if (status == GLINT_OK) {
        environment->name = strdup(name);
        status = environment->name != NULL ? GLINT_OK
                                           : glint_fail_memory(error, "an environment's name");
    }
    if (status == GLINT_OK) {
        environment->layout = source->chart.layout;
        environment->reason = source->reason;
        const bool is_set = environment->layout == GLINT_LAYOUT_FACES;
        environment->source_width = source->chart.width;
        environment->source_height = is_set ? source->chart.width : source->chart.height;
        environment->mended_texels = source->mended_texels;
    } else {
        glint_environment_free(environment);
    }
    glint_source_free(source);
    return status;
}

glint_status glint_environment_load(const char *path, const glint_layout_request *request,
                                    glint_environment *environment, glint_warnings *warnings,
                                    glint_error *error)
{
    *environment = (glint_environment){0};
    if (request != NULL && request->layout == GLINT_LAYOUT_STUDIO) {
        return glint_environment_studio(environment, error);
    }
    glint_source source;
    glint_status status = glint_source_load(path, request, &source, warnings, error);
    return finish(path, status, &source, environment, error);
}

glint_status glint_environment_from_image(const char *name, glint_image *image,
                                          const glint_layout_request *request,
                                          glint_environment *environment, glint_warnings *warnings,
                                          glint_error *error)
{
    static const glint_image_facts nothing_more = {0};
    *environment = (glint_environment){0};
    glint_source source;
    glint_status status =
        glint_source_take(name, image, &nothing_more, request, &source, warnings, error);
    return finish(name, status, &source, environment, error);
}

void glint_environment_free(glint_environment *environment)
{
    free(environment->name);
    glint_cube_free(&environment->radiance);
    *environment = (glint_environment){0};
}
