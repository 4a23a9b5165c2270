// Loads environments: makes cube maps from files. See environment.h.
#include "environment/environment.h"

#include "environment/cache.h"
#include "environment/faces.h"
#include "environment/latlong.h"
#include "environment/sampler.h"
#include "environment/source.h"
#include "environment/studio.h"

#include <stdlib.h>
#include <string.h>

// Makes a cube of a disc's picture. First resamples the disc into a picture of six faces.
static glint_status make_cube_of_disc(const glint_source *source, glint_cube *cube,
                                      glint_error *error)
{
    glint_sampler sampler = {0};
    glint_image strip = {0};
    glint_chart faces;
    glint_status status;
    const int rows = (int)(2 * glint_chart_quarter_turn(&source->chart) + 0.5);
    TRY(glint_chart_make(GLINT_LAYOUT_CUBE, glint_latlong_edge(rows), false, &faces, error));
    TRY_OR(cleanup, status,
           glint_sampler_of_image(&source->image, &source->chart, &sampler, error));
    TRY_OR(cleanup, status, glint_resample(&sampler, &glint_turn_none, &faces, &strip, error));
    TRY_OR(cleanup, status, glint_cube_from_faces(&strip, &faces, cube, error));
cleanup:
    glint_image_free(&strip);
    glint_sampler_free(&sampler);
    return status;
}

static glint_status make_cube(const glint_source *source, glint_cube *cube, glint_error *error)
{
    const glint_chart *chart = &source->chart;
    if (source->image.pixels == NULL) {
        return glint_cube_from_stored_faces(&source->stored, chart, cube, error);
    }
    if (chart->layout == GLINT_LAYOUT_LATLONG) {
        return glint_cube_from_latlong(&source->image, chart->on_edges,
                                       glint_latlong_edge(chart->height), cube, error);
    }
    if (glint_layout_cells(chart->layout, NULL, NULL) != NULL) {
        return glint_cube_from_faces(&source->image, chart, cube, error);
    }
    return make_cube_of_disc(source, cube, error);
}

// Integers end at white, however many bits they have.
static void warn_of_integers(const char *path, const glint_source *source, glint_warnings *warnings)
{
    if (source->facts.code_bits != 0) {
        glint_warn(
            warnings,
            "%s: its %d-bit integers hold no highlights above white, so lights in it are too "
            "weak (use .exr or .hdr)",
            path, source->facts.code_bits);
    }
}

static glint_status set_name(const char *name, glint_environment *environment, glint_error *error)
{
    environment->name = strdup(name);
    return environment->name != NULL ? GLINT_OK : glint_fail_memory(error, "an environment's name");
}

// Copies what is known about the source, except for its pixels.
static void describe(const glint_source *source, glint_environment *environment)
{
    const glint_chart *chart = &source->chart;
    const bool is_set = chart->layout == GLINT_LAYOUT_FACES;
    environment->layout = chart->layout;
    environment->reason = source->reason;
    environment->source_width = chart->width;
    environment->source_height = is_set ? chart->width : chart->height;
    environment->mended_texels = source->mended_texels;
}

// Makes a cube of the source.
static glint_status make(const char *name, const glint_source *source,
                         glint_environment *environment, glint_error *error)
{
    glint_status status;
    describe(source, environment);
    TRY_OR(cleanup, status, make_cube(source, &environment->radiance, error));
    TRY_OR(cleanup, status, set_name(name, environment, error));
cleanup:
    if (status != GLINT_OK) {
        glint_environment_free(environment);
    }
    return status;
}

// ---- The cache ----------------------------------------------------------------------------------

#define CACHED_EDGE_MIN 512 // smaller cubes are made in under 50 ms

// Takes the environment from the cache. Returns false if it is not there.
static bool take_cached(const char *path, const glint_layout_request *request,
                        const glint_env_cache_key *key, glint_environment *environment,
                        glint_warnings *warnings)
{
    glint_env_cache_facts facts;
    if (!glint_env_cache_take(key, &facts, &environment->radiance)) {
        return false;
    }
    glint_source source = {.image = {facts.width, facts.height, facts.channels, NULL},
                           .facts = {.envmap = (glint_envmap)facts.envmap,
                                     .is_direct3d_cube = facts.is_direct3d_cube != 0,
                                     .code_bits = facts.code_bits}};
    if (glint_source_recall(path, request, key->kind, &source, NULL) != GLINT_OK ||
        set_name(path, environment, NULL) != GLINT_OK) {
        glint_environment_free(environment);
        return false;
    }
    describe(&source, environment);
    warn_of_integers(path, &source, warnings);
    return true;
}

// Begins to write an environment to the cache, unless it was warned of: each run shall warn.
static void begin_write(const glint_env_cache_key *key, const glint_source *source,
                        glint_environment *environment)
{
    const glint_image *image = &source->image;
    if (environment->radiance.edge < CACHED_EDGE_MIN || source->is_warned ||
        !glint_env_cache_key_holds(environment->name, key)) {
        return;
    }
    const glint_env_cache_facts facts = {.width = image->width,
                                         .height = image->height,
                                         .channels = image->channels,
                                         .envmap = source->facts.envmap,
                                         .is_direct3d_cube = source->facts.is_direct3d_cube,
                                         .code_bits = source->facts.code_bits};
    environment->write = glint_env_cache_begin_write(key, &facts, &environment->radiance);
}

void glint_environment_end_write(glint_environment *environment)
{
    glint_env_cache_end_write(environment->write);
    environment->write = NULL;
}

// ---- Loading ------------------------------------------------------------------------------------

glint_status glint_environment_load(const char *path, const glint_layout_request *request,
                                    glint_environment *environment, glint_warnings *warnings,
                                    glint_error *error)
{
    *environment = (glint_environment){0};
    if (request != NULL && request->layout == GLINT_LAYOUT_STUDIO) {
        return glint_environment_studio(environment, error);
    }
    glint_env_cache_key key;
    const bool has_key = glint_env_cache_is_on() && glint_env_cache_key_make(path, request, &key);
    if (has_key && take_cached(path, request, &key, environment, warnings)) {
        return GLINT_OK;
    }
    glint_source source;
    TRY(glint_source_open(path, request, &source, warnings, error));
    warn_of_integers(path, &source, warnings);
    const glint_status status = make(path, &source, environment, error);
    if (has_key && status == GLINT_OK) {
        begin_write(&key, &source, environment);
    }
    glint_source_free(&source);
    return status;
}

glint_status glint_environment_from_image(const char *name, glint_image *image,
                                          const glint_layout_request *request,
                                          glint_environment *environment, glint_error *error)
{
    const glint_image_file file = {.name = name, .image = *image};
    *environment = (glint_environment){0};
    *image = (glint_image){0};
    glint_source source;
    TRY(glint_source_take(&file, request, &source, NULL, error));
    const glint_status status = make(name, &source, environment, error);
    glint_source_free(&source);
    return status;
}

glint_status glint_environment_studio(glint_environment *environment, glint_error *error)
{
    *environment = (glint_environment){.layout = GLINT_LAYOUT_STUDIO, .reason = "built in"};
    glint_status status;
    TRY_OR(cleanup, status, glint_studio_cube(&environment->radiance, error));
    TRY_OR(cleanup, status, set_name("studio", environment, error));
    environment->source_width = environment->radiance.edge;
    environment->source_height = 6 * environment->radiance.edge;
cleanup:
    if (status != GLINT_OK) {
        glint_environment_free(environment);
    }
    return status;
}

void glint_environment_free(glint_environment *environment)
{
    glint_environment_end_write(environment);
    free(environment->name);
    glint_cube_free(&environment->radiance);
    *environment = (glint_environment){0};
}
