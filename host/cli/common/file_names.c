// Compares file names and reads their extensions. See file_names.h.
#include "cli/common/file_names.h"

#include <string.h>
#include <strings.h>
#include <sys/stat.h>

bool glint_has_extension(const char *path, const char *extension)
{
    size_t length = strlen(path);
    size_t wanted = strlen(extension);
    return length > wanted && strcasecmp(path + length - wanted, extension) == 0;
}

bool glint_same_file(const char *a, const char *b)
{
    struct stat first;
    struct stat second;
    if (a == NULL || b == NULL) {
        return false;
    }
    if (strcmp(a, b) == 0) {
        return true;
    }
    return stat(a, &first) == 0 && stat(b, &second) == 0 && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}
