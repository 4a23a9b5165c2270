// Makes the diagnostic layers of a frame. See layers.h.
#include "render/layers.h"

#include "base/memory.h"
#include "base/option.h"
#include "kernels/layout.h"
#include "render/owners.h"
#include "render/settings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// A channel's name before the dot is the layer's name, as programs show it. The part after the dot
// is the name that programs expect for vectors and colours. Channels of numbers must not be called
// R, G, B, Y, RY or BY: DWA treats these as colour and compresses them with loss. Compositing
// programs look for the distance only under Z.
static const struct {
    const char *name;
    const char *channels[4]; // NULL at the end
} known[GLINT_AOV_COUNT] = {
    [GLINT_AOV_SURFACES] = {"surfaces", {"surfaces.count"}},
    [GLINT_AOV_TIR] = {"tir", {"tir.count"}},
    [GLINT_AOV_TRUNCATED] = {"truncated", {"truncated.weight"}},
    [GLINT_AOV_TRIANGLE] = {"triangle", {"triangle.index"}},
    [GLINT_AOV_MATERIAL] = {"material", {"material.index"}},
    [GLINT_AOV_OBJECT] = {"object", {"object.index"}},
    [GLINT_AOV_FACE] = {"face", {"face.index"}},
    [GLINT_AOV_Z] = {"Z", {"Z"}},
    [GLINT_AOV_NORMAL] = {"normal", {"normal.X", "normal.Y", "normal.Z"}},
    [GLINT_AOV_ALBEDO] = {"albedo", {"albedo.R", "albedo.G", "albedo.B"}},
    [GLINT_AOV_DEPTH] = {"depth", {"depth.surfaces"}},
};

const char *glint_aov_name(glint_aov aov)
{
    return known[aov].name;
}

// ---- Sets of layers ----------------------------------------------------------------------------

static uint32_t aov_by_name(const char *name)
{
    if (strcmp(name, "all") == 0) {
        return GLINT_AOV_ALL;
    }
    for (int i = 0; i < GLINT_AOV_COUNT; i++) {
        if (strcasecmp(name, known[i].name) == 0) {
            return GLINT_AOV_BIT(i);
        }
    }
    return 0;
}

static glint_status fail_unknown(const char *option, const char *name, glint_error *error)
{
    const char *words[GLINT_AOV_COUNT + 2] = {"all"};
    char list[128] = "all";
    for (int i = 0; (GLINT_AOV_ALL & GLINT_AOV_BIT(i)) != 0; i++) {
        const size_t length = strlen(list);
        words[i + 1] = known[i].name;
        snprintf(list + length, sizeof list - length, ", %s", known[i].name);
    }
    const char *nearest = glint_nearest_word(name, words);
    return nearest != NULL
               ? glint_fail(error, GLINT_USAGE, "--%s: there is no layer '%s' (did you mean %s?)",
                            option, name, nearest)
               : glint_fail(error, GLINT_USAGE, "--%s: there is no layer '%s' (there are %s)",
                            option, name, list);
}

glint_status glint_aovs_parse(const char *option, const char *text, uint32_t *aovs,
                              glint_error *error)
{
    uint32_t set = 0;
    for (const char *at = text; at != NULL;) {
        char name[32];
        const char *comma = strchr(at, ',');
        const size_t length = comma != NULL ? (size_t)(comma - at) : strlen(at);
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        const uint32_t found = aov_by_name(name);
        if (found == 0) {
            return fail_unknown(option, name, error);
        }
        set |= found;
        at = comma != NULL ? comma + 1 : NULL;
    }
    *aovs = set;
    return GLINT_OK;
}

void glint_aovs_print(uint32_t aovs, char *text, size_t capacity)
{
    size_t length = 0;
    snprintf(text, capacity, "%s", aovs > GLINT_AOV_VALID ? "unknown" : "");
    for (int i = 0; i < GLINT_AOV_COUNT && aovs <= GLINT_AOV_VALID && length < capacity; i++) {
        if ((aovs & GLINT_AOV_BIT(i)) != 0) {
            length += (size_t)snprintf(text + length, capacity - length, "%s%s",
                                       length > 0 ? "," : "", known[i].name);
        }
    }
}

// ---- Making them -------------------------------------------------------------------------------

void glint_layers_free(glint_layers *layers)
{
    free(layers->values);
    free(layers->term_values);
    free(layers->names);
    *layers = (glint_layers){0};
}

// Channel `k` of the layer.
static float value_of(const glint_layers_inputs *in, size_t pixel, glint_aov aov, int k)
{
    const glint_layers_record *record = &in->records[pixel];
    const int samples = in->settings->samples_per_axis * in->settings->samples_per_axis;
    switch (aov) {
    case GLINT_AOV_SURFACES:
    case GLINT_AOV_DEPTH:
        return (float)record->surfaces;
    case GLINT_AOV_TIR:
        return (float)((double)record->total_reflections / samples);
    case GLINT_AOV_TRUNCATED:
        return (float)((double)record->truncated / samples);
    case GLINT_AOV_TRIANGLE:
        return (float)record->triangle;
    case GLINT_AOV_MATERIAL:
        return (float)glint_owner_of(in->owners, record->triangle).material;
    case GLINT_AOV_OBJECT:
        return (float)glint_owner_of(in->owners, record->triangle).node;
    case GLINT_AOV_FACE:
        return (float)record->face;
    case GLINT_AOV_Z:
        return record->z;
    case GLINT_AOV_NORMAL:
        return record->normal[k];
    case GLINT_AOV_ALBEDO:
        return record->albedo[k];
    case GLINT_AOV_COUNT:
        break;
    }
    return 0;
}

// The number of channels of the layer if it is in the set, else 0.
static int channel_count(uint32_t aovs, int aov)
{
    int count = 0;
    while ((aovs & GLINT_AOV_BIT(aov)) != 0 && known[aov].channels[count] != NULL) {
        count++;
    }
    return count;
}

size_t glint_layers_channels(uint32_t aovs)
{
    size_t count = 0;
    for (int i = 0; i < GLINT_AOV_COUNT; i++) {
        count += (size_t)channel_count(aovs, i);
    }
    return count;
}

glint_status glint_layers_make(const glint_layers_inputs *in, glint_layers *layers,
                               glint_error *error)
{
    const uint32_t aovs = in->settings->aovs;
    *layers = (glint_layers){0};
    float *values =
        glint_allocate_unset(in->pixel_count, glint_layers_channels(aovs) * sizeof *values);
    if (values == NULL) {
        return glint_fail_memory(error, "the layers");
    }
    layers->values = values;
    for (int i = 0; i < GLINT_AOV_COUNT; i++) {
        for (int k = 0; k < channel_count(aovs, i); k++) {
            for (size_t p = 0; p < in->pixel_count; p++) {
                values[p] = value_of(in, p, (glint_aov)i, k);
            }
            layers->channels[layers->count++] = (glint_channel){known[i].channels[k], values};
            values += in->pixel_count;
        }
    }
    return GLINT_OK;
}
