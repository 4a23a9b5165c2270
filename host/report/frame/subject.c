// Words for what a report is about. See subject.h.
#include "report/frame/subject.h"

const char *glint_material_kind(const glint_material *material)
{
    if (material->unlit) {
        return "unlit";
    }
    if (material->mirror >= 0) {
        return "blend";
    }
    if (material->metallic >= 1) {
        return "metal";
    }
    if (material->metallic > 0 || (material->transmission > 0 && material->transmission < 1)) {
        return "mixture";
    }
    if (material->transmission >= 1) {
        return glint_material_is_solid(material) ? "solid glass" : "thin glass";
    }
    return material->roughness > 0 ? "matte paint" : "glossy paint";
}
