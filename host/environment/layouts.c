// Holds the names of layouts. See layouts.h.
#include "environment/layouts.h"

#include <stddef.h>
#include <string.h>

static const struct {
    glint_layout layout;
    const char *name;
} names[] = {
    {GLINT_LAYOUT_CUBE, "cube"},       {GLINT_LAYOUT_FACES, "faces"},
    {GLINT_LAYOUT_HCROSS, "hcross"},   {GLINT_LAYOUT_VCROSS, "vcross"},
    {GLINT_LAYOUT_VSTRIP, "vstrip"},   {GLINT_LAYOUT_HSTRIP, "hstrip"},
    {GLINT_LAYOUT_LATLONG, "latlong"}, {GLINT_LAYOUT_BALL, "ball"},
    {GLINT_LAYOUT_ANGULAR, "angular"}, {GLINT_LAYOUT_STUDIO, "studio"},
};

const char *glint_layout_name(glint_layout layout)
{
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (names[i].layout == layout) {
            return names[i].name;
        }
    }
    return NULL;
}

glint_layout glint_layout_from_name(const char *name)
{
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(names[i].name, name) == 0) {
            return names[i].layout;
        }
    }
    return GLINT_LAYOUT_UNKNOWN;
}
