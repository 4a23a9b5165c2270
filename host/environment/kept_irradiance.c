// Keeps irradiance maps in the cache of environments. See kept_irradiance.h.
#include "environment/kept_irradiance.h"

#include "environment/irradiance.h"
#include "environment/kept.h"

glint_status glint_irradiance_map_kept(const glint_cube *radiance, int edge, glint_cube *irradiance,
                                       glint_error *error)
{
    glint_kept_key key;
    glint_kept_facts facts = {0};
    const bool has_key = radiance->edge <= GLINT_KEPT_IRRADIANCE_EDGE && glint_kept_is_on() &&
                         glint_kept_key_of_cube(radiance, edge, &key);
    if (has_key && glint_kept_take(&key, &facts, irradiance)) {
        if (irradiance->edge == edge) {
            return GLINT_OK;
        }
        glint_cube_free(irradiance);
    }
    TRY(glint_irradiance_map(radiance, edge, irradiance, error));
    if (has_key) {
        glint_kept_settle(glint_kept_begin(&key, &facts, irradiance));
    }
    return GLINT_OK;
}
