// Opens regular files for reading. See regular_file.h.
#include "base/regular_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

glint_status glint_regular_file_descriptor(const char *path, int *file, uint64_t *size,
                                           glint_error *error)
{
    struct stat facts;
    // O_NONBLOCK: do not wait for a pipe's other end.
    const int opened = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    *file = -1;
    *size = 0;
    if (opened < 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s", strerror(errno));
    }
    const char *trouble = fstat(opened, &facts) != 0 ? strerror(errno)
                          : S_ISDIR(facts.st_mode)   ? "it is a folder, not a file"
                          : !S_ISREG(facts.st_mode)  ? "it is no regular file"
                                                     : NULL;
    if (trouble != NULL) {
        (void)close(opened);
        return glint_fail(error, GLINT_BAD_INPUT, "%s", trouble);
    }
    *file = opened;
    *size = (uint64_t)facts.st_size;
    return GLINT_OK;
}

glint_status glint_regular_file_open(const char *path, FILE **file, uint64_t *size,
                                     glint_error *error)
{
    glint_error reason = {0};
    uint64_t bytes;
    int descriptor;
    *file = NULL;
    if (glint_regular_file_descriptor(path, &descriptor, &bytes, &reason) != GLINT_OK) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (check the name and its permissions)",
                          path, reason.message);
    }
    *file = fdopen(descriptor, "rb");
    if (*file == NULL) {
        (void)close(descriptor);
        return glint_fail_memory(error, "a file");
    }
    if (size != NULL) {
        *size = bytes;
    }
    return GLINT_OK;
}
