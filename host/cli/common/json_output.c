// Writes the outputs of --json FILE|- and --stats FILE|-. See json_output.h.
#include "cli/common/json_output.h"

#include "report/json.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool glint_is_stdout(const char *path)
{
    return path != NULL && strcmp(path, "-") == 0;
}

glint_status glint_write_json(const char *path, json_t *root, glint_error *error)
{
    if (!glint_is_stdout(path)) {
        return glint_json_write(path, root, error);
    }
    char *text = NULL;
    TRY(glint_json_print(root, &text, error));
    fputs(text, stdout);
    free(text);
    return GLINT_OK;
}

glint_status glint_open_lines(const char *path, FILE **file, glint_error *error)
{
    // Duplicate the descriptor, so that fclose leaves standard output open.
    *file = glint_is_stdout(path) ? fdopen(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0), "w")
                                  : fopen(path, "we");
    return *file != NULL ? GLINT_OK
                         : glint_fail(error, GLINT_OUTPUT_FAILED,
                                      "%s: could not be written: %s (write elsewhere)", path,
                                      strerror(errno));
}
