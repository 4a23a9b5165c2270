// Keeps irradiance maps in the cache of cube maps. See cached_irradiance.h.
#include "environment/cached_irradiance.h"

#include "environment/cache.h"
#include "environment/irradiance.h"

glint_status glint_irradiance_map_cached(const glint_cube *radiance, int edge,
                                         glint_cube *irradiance, glint_error *error)
{
    glint_env_cache_key key;
    glint_env_cache_facts facts = {0};
    const bool has_key = radiance->edge <= GLINT_CACHED_IRRADIANCE_EDGE &&
                         glint_env_cache_is_on() &&
                         glint_env_cache_key_of_cube(radiance, edge, &key);
    if (has_key && glint_env_cache_take(&key, &facts, irradiance)) {
        return GLINT_OK;
    }
    TRY(glint_irradiance_map(radiance, edge, irradiance, error));
    if (has_key) {
        glint_env_cache_end_write(glint_env_cache_begin_write(&key, &facts, irradiance));
    }
    return GLINT_OK;
}
