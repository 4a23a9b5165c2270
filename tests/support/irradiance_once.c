// Caches irradiance: computes the map of each environment once a program. Without the cache, tests
// that open the studio for every frame spent half of their time on it. The linker option
// --wrap=glint_irradiance_map replaces the real function in all tests that link glint_library.
// test_irradiance tests the real function.
#include "environment/irradiance.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

glint_status __real_glint_irradiance_map(const glint_cube *radiance, int edge,
                                         glint_cube *irradiance, glint_error *error);
glint_status __wrap_glint_irradiance_map(const glint_cube *radiance, int edge,
                                         glint_cube *irradiance, glint_error *error);

enum { MAPS_MAX = 32 };
static struct {
    XXH128_hash_t radiance;
    glint_cube irradiance;
} maps[MAPS_MAX];
static int map_count;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static void free_maps(void)
{
    while (map_count > 0) {
        glint_cube_free(&maps[--map_count].irradiance);
    }
}

static glint_status copy(const glint_cube *from, glint_cube *to, glint_error *error)
{
    TRY(glint_cube_create(from->edge, to, error));
    memcpy(to->texels, from->texels, glint_cube_size(from) * sizeof(float));
    return GLINT_OK;
}

static glint_status find_or_make(const glint_cube *radiance, int edge, glint_cube *irradiance,
                                 glint_error *error)
{
    const XXH128_hash_t key =
        XXH3_128bits(radiance->texels, glint_cube_size(radiance) * sizeof(float));
    for (int i = 0; i < map_count; i++) {
        if (XXH128_isEqual(maps[i].radiance, key) && maps[i].irradiance.edge == edge) {
            return copy(&maps[i].irradiance, irradiance, error);
        }
    }
    TRY(__real_glint_irradiance_map(radiance, edge, irradiance, error));
    if (map_count == 0) {
        atexit(free_maps);
    }
    if (map_count < MAPS_MAX && copy(irradiance, &maps[map_count].irradiance, NULL) == GLINT_OK) {
        maps[map_count++].radiance = key;
    }
    return GLINT_OK;
}

glint_status __wrap_glint_irradiance_map(const glint_cube *radiance, int edge,
                                         glint_cube *irradiance, glint_error *error)
{
    pthread_mutex_lock(&lock);
    const glint_status status = find_or_make(radiance, edge, irradiance, error);
    pthread_mutex_unlock(&lock);
    return status;
}
