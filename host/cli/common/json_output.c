// Where a command's --json FILE|- goes. See json_output.h.
#include "cli/common/json_output.h"

#include "report/json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
