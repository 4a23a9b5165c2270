// Writes the JSON of glint compare --json. See compare_json.h.
#include "report/compare/compare_json.h"

static json_t *file_object(const glint_compared_file *file, const glint_defects *defects)
{
    json_t *object = json_object();
    glint_json_put_text(object, "file", file->name);
    glint_json_put_count(object, "channels", (uint64_t)file->image->channels);
    glint_json_put_flag(object, "alpha", glint_image_has_alpha(file->image));
    glint_json_put_count(object, "nan_pixels", defects->nan);
    glint_json_put_count(object, "infinite_pixels", defects->infinite);
    return object;
}

static json_t *components(const float rgb[3])
{
    json_t *list = json_array();
    for (int k = 0; k < 3; k++) {
        (void)json_array_append_new(list, json_real((double)rgb[k]));
    }
    return list;
}

// The pixel with the largest difference; null if all compared pixels are equal.
static json_t *worst_object(const glint_metrics *metrics)
{
    if (metrics->largest == 0) {
        return json_null();
    }
    json_t *object = json_object();
    glint_json_put_count(object, "x", (uint64_t)metrics->worst_x);
    glint_json_put_count(object, "y", (uint64_t)metrics->worst_y);
    glint_json_put(object, "image", components(metrics->worst_image));
    glint_json_put(object, "reference", components(metrics->worst_reference));
    return object;
}

static json_t *error_object(const glint_metrics *metrics)
{
    json_t *object = glint_json_metrics(metrics);
    glint_json_put_count(object, "nan_pixels", metrics->in_either.nan);
    glint_json_put_count(object, "infinite_pixels", metrics->in_either.infinite);
    glint_json_put(object, "alpha",
                   metrics->compared > 0 ? json_real(metrics->alpha) : json_null());
    glint_json_put(object, "worst_pixel", worst_object(metrics));
    return object;
}

static json_t *bounds_list(const glint_compare_result *result)
{
    json_t *list = json_array();
    for (int i = 0; i < GLINT_FIGURE_COUNT; i++) {
        const glint_figure figure = (glint_figure)i;
        if (result->bounds->is_set[i]) {
            json_t *bound = json_object();
            glint_json_put_text(bound, "metric", glint_figure_names[i]);
            glint_json_put_text(bound, "fails",
                                glint_figure_is_better_high(figure) ? "below" : "above");
            glint_json_put_real(bound, "limit", result->bounds->limit[i]);
            glint_json_put_real(bound, "value", glint_figure_value(figure, result->metrics));
            glint_json_put_flag(bound, "kept",
                                glint_bound_is_kept(result->bounds, figure, result->metrics));
            (void)json_array_append_new(list, bound);
        }
    }
    return list;
}

json_t *glint_compare_json(const glint_compare_result *result)
{
    const glint_metrics *metrics = result->metrics;
    json_t *document = json_object();
    glint_json_put_text(document, "format", "glint compare");
    glint_json_put(document, "schema", json_integer(GLINT_COMPARE_SCHEMA));
    glint_json_put_text(document, "glint", GLINT_VERSION);
    glint_json_put_count(document, "width", (uint64_t)result->reference.image->width);
    glint_json_put_count(document, "height", (uint64_t)result->reference.image->height);
    glint_json_put(document, "image", file_object(&result->image, &metrics->in_image));
    glint_json_put(document, "reference", file_object(&result->reference, &metrics->in_reference));
    glint_json_put(document, "error", error_object(metrics));
    glint_json_put(document, "bounds", bounds_list(result));
    return document;
}
