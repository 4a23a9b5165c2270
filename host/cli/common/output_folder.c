// Checks and creates folders for output files. See output_folder.h.
#include "cli/common/output_folder.h"

#include "image/output_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

char *glint_folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash == NULL ? strdup(".") : strndup(path, slash == path ? 1 : (size_t)(slash - path));
}

bool glint_is_folder(const char *path)
{
    struct stat facts;
    return stat(path, &facts) == 0 && S_ISDIR(facts.st_mode);
}

static glint_status refuse(const char *folder, int cause, glint_error *error)
{
    return glint_fail(error, GLINT_OUTPUT_FAILED,
                      "%s: no folder could be made there: %s (name another)", folder,
                      strerror(cause));
}

glint_status glint_folder_check(const char *folder, glint_error *error)
{
    struct stat facts;
    if (stat(folder, &facts) == 0) {
        return S_ISDIR(facts.st_mode) ? GLINT_OK : refuse(folder, ENOTDIR, error);
    }
    char *name = strdup(folder);
    if (name == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    for (size_t end = strlen(name); end > 1 && name[end - 1] == '/'; end--) {
        name[end - 1] = '\0';
    }
    glint_status status = glint_output_file_check(name, error);
    free(name);
    return status;
}

glint_status glint_folder_make(const char *folder, bool *is_new, glint_error *error)
{
    const bool is_made = mkdir(folder, 0777) == 0;
    const int cause = errno;
    if (is_new != NULL) {
        *is_new = is_made;
    }
    return is_made || glint_is_folder(folder) ? GLINT_OK : refuse(folder, cause, error);
}
