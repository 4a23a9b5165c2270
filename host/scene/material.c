// Which lobes a material has. See material.h.
#include "scene/material.h"

#include <math.h>

static bool is_white(const float color[3])
{
    return color[0] == 1 && color[1] == 1 && color[2] == 1;
}

static bool absorbs(const glint_material *m)
{
    const float *left = m->attenuation_color;
    return isfinite(m->attenuation_distance) && (left[0] < 1 || left[1] < 1 || left[2] < 1);
}

glint_lobes glint_material_lobes(const glint_material *m)
{
    glint_lobes lobes = {0};
    if (m->unlit) {
        lobes.unlit = true;
        return lobes;
    }
    lobes.emission = m->emission[0] > 0 || m->emission[1] > 0 || m->emission[2] > 0;
    if (m->mirror >= 0) {
        lobes.blend = true;
        lobes.blend_mirror = m->mirror > 0;
        return lobes;
    }
    const bool dielectric = m->metallic < 1;
    lobes.metal = m->metallic > 0;
    lobes.tint = lobes.metal && !is_white(m->base_color);
    lobes.glass = dielectric && m->transmission > 0;
    lobes.solid = lobes.glass && m->thickness > 0;
    lobes.absorption = lobes.solid && absorbs(m);
    lobes.thin = lobes.glass && !lobes.solid;
    lobes.paint = dielectric && m->transmission < 1;
    lobes.gloss = lobes.paint && !(m->roughness > 0);
    return lobes;
}
