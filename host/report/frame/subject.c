// Names the kinds of materials. See subject.h.
#include "report/frame/subject.h"

const char *glint_material_kind(const glint_material *material)
{
    const glint_lobes lobes = glint_material_lobes(material);
    if (lobes.metal + lobes.glass + lobes.paint > 1) {
        return "mixture";
    }
    return lobes.unlit   ? "unlit"
           : lobes.blend ? "blend"
           : lobes.metal ? "metal"
           : lobes.solid ? "solid glass"
           : lobes.thin  ? "thin glass"
           : lobes.gloss ? "glossy paint"
                         : "matte paint";
}
