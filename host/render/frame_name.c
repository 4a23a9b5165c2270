// Makes the names of a sequence's files. See frame_name.h.
#include "render/frame_name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DIGITS_MAX 64

// The length of "%d" or "%04d" at `text`, and its number of digits; 0 if there is no such
// placeholder.
static size_t printf_place(const char *text, int *digits)
{
    const size_t numerals = strspn(text + 1, "0123456789");
    if (numerals > 2 || text[1 + numerals] != 'd') {
        return 0;
    }
    *digits = numerals > 0 ? atoi(text + 1) : 1;
    return numerals + 2;
}

// Finds the next placeholder at or after `from`. Returns false if there is none.
static bool find_place(glint_frame_name *name, size_t from)
{
    const char *path = name->path;
    for (size_t i = from; path[i] != '\0'; i++) {
        name->place = i;
        if (path[i] == '#') {
            name->length = strspn(path + i, "#");
            name->digits = (int)name->length;
            return true;
        }
        name->length = path[i] == '%' ? printf_place(path + i, &name->digits) : 0;
        if (name->length > 0) {
            return true;
        }
    }
    return false;
}

glint_status glint_frame_name_parse(const char *path, glint_frame_name *name, glint_error *error)
{
    *name = (glint_frame_name){.path = path};
    const char *slash = strrchr(path, '/');
    if (!find_place(name, slash != NULL ? (size_t)(slash + 1 - path) : 0)) {
        name->length = 0;
        return GLINT_OK;
    }
    glint_frame_name second = *name;
    if (find_place(&second, name->place + name->length)) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: two places for the frame's number (leave one, as in frame.####.exr)",
                          path);
    }
    if (name->digits > DIGITS_MAX) {
        return glint_fail(error, GLINT_USAGE, "%s: numbers have %d digits at most (use ####)", path,
                          DIGITS_MAX);
    }
    return GLINT_OK;
}

char *glint_frame_name_make(const glint_frame_name *name, int frame)
{
    if (name->length == 0) {
        return strdup(name->path);
    }
    char *path = NULL;
    const int printed =
        asprintf(&path, "%.*s%s%0*d%s", (int)name->place, name->path, frame < 0 ? "-" : "",
                 name->digits, abs(frame), name->path + name->place + name->length);
    return printed < 0 ? NULL : path;
}
