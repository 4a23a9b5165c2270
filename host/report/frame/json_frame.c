// Writes the counts of a frame as JSON. See json.h.
#include "report/json.h"

json_t *glint_json_rays(const glint_ray_counts *rays)
{
    json_t *object = json_object();
    glint_json_put_count(object, "primary", rays->primary);
    glint_json_put_count(object, "reflected", rays->reflected);
    glint_json_put_count(object, "refracted_in", rays->refracted_in);
    glint_json_put_count(object, "refracted_out", rays->refracted_out);
    glint_json_put_count(object, "transmitted", rays->transmitted);
    glint_json_put_count(object, "shadow", rays->shadow);
    glint_json_put_count(object, "all", glint_ray_counts_all(rays));
    glint_json_put_count(object, "total_reflections", rays->total_reflections);
    return object;
}

json_t *glint_json_truncation(const glint_truncation *truncation)
{
    json_t *object = json_object();
    glint_json_put_real(object, "by_depth", truncation->by_depth);
    glint_json_put_real(object, "by_min_weight", truncation->by_min_weight);
    glint_json_put_real(object, "by_stack", truncation->by_stack);
    glint_json_put_real(object, "total", glint_truncation_total(truncation));
    glint_json_put_count(object, "media_overflows", truncation->media_overflows);
    return object;
}
