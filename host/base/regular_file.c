// Opens regular files for reading. See regular_file.h.
#include "base/regular_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static glint_status check(const char *path, int descriptor, uint64_t *size, glint_error *error)
{
    struct stat facts;
    if (fstat(descriptor, &facts) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (check the name)", path, strerror(errno));
    }
    if (S_ISDIR(facts.st_mode)) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: is a folder (name a file)", path);
    }
    if (!S_ISREG(facts.st_mode)) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: is no regular file (name a file)", path);
    }
    if (size != NULL) {
        *size = (uint64_t)facts.st_size;
    }
    return GLINT_OK;
}

glint_status glint_regular_file_open(const char *path, FILE **file, uint64_t *size,
                                     glint_error *error)
{
    *file = NULL;
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (check the name and its permissions)",
                          path, strerror(errno));
    }
    glint_status status = check(path, descriptor, size, error);
    if (status == GLINT_OK) {
        *file = fdopen(descriptor, "rb");
        status = *file != NULL ? GLINT_OK : glint_fail_memory(error, "a file");
    }
    if (*file == NULL) {
        close(descriptor);
    }
    return status;
}
