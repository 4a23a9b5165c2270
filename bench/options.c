// Values of options that the contests share. See options.h.
#include "options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

glint_status bench_parse_size(const char *text, int *width, int *height, glint_error *error)
{
    char rest;
    if (sscanf(text, "%dx%d%c", width, height, &rest) != 2 || *width < 16 || *height < 16 ||
        *width > 16384 || *height > 16384 || *width % 16 != 0 || *height % 16 != 0) {
        return glint_fail(error, GLINT_USAGE, "--size: '%s' (multiples of 16, as 1920x1088)", text);
    }
    return GLINT_OK;
}

glint_status bench_parse_count(const char *name, const char *text, double most, double *value,
                               glint_error *error)
{
    char *end;
    *value = strtod(text, &end);
    if (end == text || *end != '\0' || !(*value >= 1 && *value <= most)) {
        return glint_fail(error, GLINT_USAGE, "--%s: '%s' (1 to %.0f)", name, text, most);
    }
    return GLINT_OK;
}

glint_status bench_set_text(char **copy, const char *text, glint_error *error)
{
    free(*copy);
    *copy = strdup(text);
    return *copy != NULL ? GLINT_OK : glint_fail_memory(error, "the options");
}
