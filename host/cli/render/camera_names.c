// Turns cameras into parts of file names. See camera_names.h.
#include "cli/render/camera_names.h"

#include "base/memory.h"
#include "base/plain_text.h"
#include "cli/common/frame_name.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define NAME_BYTES 64 // maximum length of a camera's name in a file name

// Keeps letters and digits of any language, '.', '-' and '_'; replaces the rest by '_'. Other
// characters could name another folder, look like the place of a frame number, or need quotes in a
// shell.
static char *name_in_file(const char *name)
{
    char *text = strdup(name);
    if (text == NULL) {
        return NULL;
    }
    glint_make_plain(text);
    size_t length = 0;
    while (text[length] != '\0') {
        bool is_plain;
        const size_t bytes = glint_character(text + length, strlen(text + length), &is_plain);
        if (bytes == 0 || length + bytes > NAME_BYTES) {
            break;
        }
        const unsigned char first = (unsigned char)text[length];
        if (first < 0x80 && !isalnum(first) && strchr(".-_", first) == NULL) {
            text[length] = '_';
        }
        length += bytes;
    }
    text[length] = '\0';
    return text;
}

static char *index_name(size_t index)
{
    char *text = NULL;
    return asprintf(&text, "%zu", index) < 0 ? NULL : text;
}

typedef struct named_camera {
    char **name; // borrowed
    size_t index;
} named_camera;

static int by_name(const void *a, const void *b)
{
    const named_camera *first = a, *second = b;
    return strcasecmp(*first->name, *second->name);
}

// Replaces names that several cameras share by the index of each camera. *count_doubles is the
// number of replaced names.
static glint_status rename_doubles(named_camera *sorted, size_t count, size_t *count_doubles,
                                   glint_error *error)
{
    qsort(sorted, count, sizeof *sorted, by_name);
    *count_doubles = 0;
    for (size_t first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && by_name(&sorted[first], &sorted[end]) == 0; end++) {
        }
        for (size_t i = first; i < end && end - first > 1; i++) {
            free(*sorted[i].name);
            *sorted[i].name = index_name(sorted[i].index);
            if (*sorted[i].name == NULL) {
                return glint_fail_memory(error, "a camera's name");
            }
            ++*count_doubles;
        }
    }
    return GLINT_OK;
}

glint_status render_camera_names(const glint_camera *cameras, size_t count, char **names,
                                 glint_error *error)
{
    for (size_t i = 0; i < count; i++) {
        const char *own = cameras[i].name;
        names[i] = own != NULL && own[0] != '\0' ? name_in_file(own) : index_name(i);
        if (names[i] == NULL) {
            return glint_fail_memory(error, "a camera's name");
        }
    }
    named_camera *sorted = glint_allocate(count, sizeof *sorted);
    if (sorted == NULL) {
        return glint_fail_memory(error, "the cameras' names");
    }
    for (size_t i = 0; i < count; i++) {
        sorted[i] = (named_camera){&names[i], i};
    }
    // An index may equal another camera's own name. Repeat until all names differ.
    glint_status status;
    size_t doubles;
    do {
        status = rename_doubles(sorted, count, &doubles, error);
    } while (status == GLINT_OK && doubles > 0);
    free(sorted);
    return status;
}

char *render_camera_path(const char *path, const char *name)
{
    glint_frame_name frames = {0};
    glint_error unused = {0};
    const bool has_place =
        glint_frame_name_parse(path, &frames, &unused) == GLINT_OK && frames.length > 0;
    const size_t place = frames.written_at;
    glint_frame_name_free(&frames);
    glint_error_free(&unused);
    const char *slash = strrchr(path, '/');
    const size_t last = slash != NULL ? (size_t)(slash + 1 - path) : 0;
    const char *dot = strrchr(path + last, '.');
    const size_t extension = dot != NULL ? (size_t)(dot - path) : strlen(path);
    const size_t at = has_place ? place : extension;
    const bool is_apart = at == last || strchr(".-_", path[at - 1]) != NULL;
    char *made = NULL;
    const int printed = asprintf(&made, "%.*s%s%s%s%s", (int)at, path, is_apart ? "" : ".", name,
                                 has_place ? "." : "", path + at);
    return printed < 0 ? NULL : made;
}
