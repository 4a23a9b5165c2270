// Finds the files that a glTF file refers to. See find_file.h.
#include "scene/gltf/find_file.h"

#include "base/regular_file.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int hexadecimal(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

size_t glint_percent_decode(const char *text, size_t length, char *decoded)
{
    size_t count = 0;
    for (size_t i = 0; i < length; i++) {
        const int high = text[i] == '%' && i + 2 < length ? hexadecimal(text[i + 1]) : -1;
        const int low = high >= 0 ? hexadecimal(text[i + 2]) : -1;
        decoded[count++] = low >= 0 ? (char)(high * 16 + low) : text[i];
        i += low >= 0 ? 2 : 0;
    }
    return count;
}

// Returns the length of the scheme with its colon (RFC 3986); 0: there is none.
static size_t scheme_length(const char *uri)
{
    size_t i = 0;
    while (uri[i] != '\0' &&
           (isalnum((unsigned char)uri[i]) != 0 || strchr("+.-", uri[i]) != NULL)) {
        i++;
    }
    return i > 0 && uri[i] == ':' && isalpha((unsigned char)uri[0]) != 0 ? i + 1 : 0;
}

glint_status glint_find_folder(const char *file, char **folder, glint_error *error)
{
    const char *slash = strrchr(file, '/');
    char *given = slash == NULL ? strdup(".") : strndup(file, (size_t)(slash - file) + 1);
    if (given == NULL) {
        return glint_fail_memory(error, "a name");
    }
    *folder = realpath(given, NULL);
    free(given);
    return *folder != NULL ? GLINT_OK
                           : glint_fail(error, GLINT_BAD_INPUT, "its folder cannot be found: %s",
                                        strerror(errno));
}

// Returns the path of a name in the folder, with links resolved; NULL with errno if there is none.
static char *resolve(const char *folder, const char *name)
{
    char path[PATH_MAX];
    const size_t before = name[0] == '/' ? 0 : strlen(folder) + 1;
    if (before + strlen(name) >= sizeof path) {
        errno = ENAMETOOLONG;
        return NULL;
    }
    if (before > 0) {
        memcpy(path, folder, before - 1);
        path[before - 1] = '/';
    }
    memcpy(path + before, name, strlen(name) + 1);
    return realpath(path, NULL);
}

static char *find_candidate(const char *folder, const char *uri, char *decoded)
{
    int trouble = 0; // of the first name
    char *found = resolve(folder, decoded);
    if (found == NULL) {
        trouble = errno;
        found = resolve(folder, uri); // it only looks percent-encoded: "50%20.bin" on the disk
    }
    if (found == NULL) {
        for (char *c = decoded; *c != '\0'; c++) {
            *c = *c == '\\' ? '/' : *c; // as Windows writes paths
        }
        found = resolve(folder, decoded);
    }
    errno = trouble;
    return found;
}

static bool is_below(const char *path, const char *folder)
{
    const size_t length = strcmp(folder, "/") == 0 ? 0 : strlen(folder);
    return strncmp(path, folder, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

static glint_status check_regular(const char *path, glint_error *error)
{
    int file;
    uint64_t bytes;
    TRY(glint_regular_file_descriptor(path, &file, &bytes, error));
    (void)close(file);
    return GLINT_OK;
}

glint_status glint_find_file(const char *folder, const char *uri, char **path, glint_error *error)
{
    *path = NULL;
    const size_t scheme = scheme_length(uri), length = strlen(uri);
    if (scheme > 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%.*s is not read (put the file beside the scene, or use a data URI)",
                          (int)(scheme < 100 ? scheme : 100), uri);
    }
    char *decoded = malloc(length + 1);
    if (decoded == NULL) {
        return glint_fail_memory(error, "a name");
    }
    const size_t count = glint_percent_decode(uri, length, decoded);
    decoded[count] = '\0';
    const bool is_name = count > 0 && strlen(decoded) == count;
    char *found = is_name ? find_candidate(folder, uri, decoded) : NULL;
    const int trouble = errno;
    free(decoded);
    if (!is_name) {
        return glint_fail(error, GLINT_BAD_INPUT, "names no file");
    }
    if (found == NULL) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "cannot be opened: %s (put the file beside the scene)",
                          strerror(trouble));
    }
    const glint_status status =
        is_below(found, folder)
            ? check_regular(found, error)
            : glint_fail(error, GLINT_BAD_INPUT,
                         "lies outside the scene's folder (put the file beside the scene, or "
                         "below)");
    if (status != GLINT_OK) {
        free(found);
        return status;
    }
    *path = found;
    return GLINT_OK;
}
