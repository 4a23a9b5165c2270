// Makes the names of a sequence's files. See frame_name.h.
#include "cli/common/frame_name.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

// The length of the placeholder at `text`, and its number of digits; 0 if there is none.
static size_t place_length(const char *text, int *digits)
{
    if (text[0] == '#') {
        const size_t length = strspn(text, "#");
        *digits = length > DIGITS_MAX ? DIGITS_MAX + 1 : (int)length;
        return length;
    }
    return text[0] == '%' ? printf_place(text, digits) : 0;
}

// Appends `count` bytes to the path, whose end is *end.
static void append(char **end, const char *bytes, size_t count)
{
    memcpy(*end, bytes, count);
    *end += count;
}

// Copies the last part of `path`, which begins at `begin`, and finds the placeholder. Returns false
// if there are two.
static bool take_last_part(const char *path, size_t begin, glint_frame_name *name)
{
    const char *text = path + begin;
    char *end = name->path + begin;
    while (text[0] != '\0') {
        int digits = 0;
        const size_t escapes = strspn(text, "\\");
        const char *mark = text + escapes;
        const size_t length = place_length(mark, &digits);
        const size_t plain = escapes + (mark[0] != '\0' ? 1 : 0);
        if (length == 0) { // nothing to escape
            append(&end, text, plain);
            text += plain;
            continue;
        }
        append(&end, text, escapes / 2);
        if (escapes % 2 == 1) {
            append(&end, mark, 1);
            text = mark + 1;
            continue;
        }
        if (name->length > 0) {
            return false;
        }
        name->place = (size_t)(end - name->path);
        name->length = length;
        name->digits = digits;
        name->written_at = (size_t)(text - path);
        append(&end, mark, length);
        text = mark + length;
    }
    *end = '\0';
    return true;
}

glint_status glint_frame_name_parse(const char *path, glint_frame_name *name, glint_error *error)
{
    const char *slash = strrchr(path, '/');
    const size_t folder = slash != NULL ? (size_t)(slash + 1 - path) : 0;
    glint_frame_name found = {.path = strdup(path)};
    if (found.path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    glint_status status = GLINT_OK;
    if (!take_last_part(path, folder, &found)) {
        status = glint_fail(error, GLINT_USAGE,
                            "%s: two places for the frame's number (leave one, as in "
                            "frame.####.exr; \\# and \\%% are the signs themselves)",
                            path);
    } else if (found.digits > DIGITS_MAX) {
        status = glint_fail(error, GLINT_USAGE, "%s: numbers have %d digits at most (use ####)",
                            path, DIGITS_MAX);
    }
    if (status == GLINT_OK) {
        *name = found;
    } else {
        glint_frame_name_free(&found);
    }
    return status;
}

glint_status glint_frame_name_parse_input(const char *path, glint_frame_name *name,
                                          glint_error *error)
{
    if (access(path, F_OK) != 0) {
        return glint_frame_name_parse(path, name, error);
    }
    *name = (glint_frame_name){.path = strdup(path)};
    return name->path != NULL ? GLINT_OK : glint_fail_memory(error, "a file name");
}

void glint_frame_name_free(glint_frame_name *name)
{
    free(name->path);
    *name = (glint_frame_name){0};
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

glint_status glint_frame_name_refuse(const glint_frame_name *name, const char *way_out,
                                     glint_error *error)
{
    const char *place = name->path + name->place;
    return glint_fail(error, GLINT_USAGE,
                      "%s: which frames? (%.*s stands for the frame's number: %s; or write \\%c "
                      "for the sign itself)",
                      name->path, (int)name->length, place, way_out, place[0]);
}
