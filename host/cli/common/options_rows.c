// Walks through a command's option table. See options.h.
#include "cli/common/options.h"

#include <string.h>

static const glint_option help_row = {GLINT_OPTION_FLAG, .letter = GLINT_HELP_LETTER,
                                      .name = "help", .help = "Print this."};

// The next setting of the row's group; NULL at the end of the group.
static const glint_option *next_setting(glint_option_cursor *cursor, const glint_option *row)
{
    if (!glint_settings_option((glint_settings_group)row->group, cursor->setting++, row->offset,
                               &cursor->made, cursor->fallback)) {
        cursor->setting = 0;
        cursor->row++;
        return NULL;
    }
    if (row->fallback != NULL) {
        cursor->made.fallback = row->fallback;
    }
    return &cursor->made;
}

const glint_option *glint_option_next(glint_option_cursor *cursor)
{
    while (*cursor->table != NULL) {
        const glint_option *row = &(*cursor->table)[cursor->row];
        if (row->kind == GLINT_OPTION_LAST) {
            cursor->table++;
            cursor->row = 0;
        } else if (row->kind == GLINT_OPTION_SETTINGS) {
            const glint_option *setting = next_setting(cursor, row);
            if (setting != NULL) {
                return setting;
            }
        } else {
            cursor->row++;
            return row;
        }
    }
    const bool was_at_end = cursor->is_at_end;
    cursor->is_at_end = true;
    return was_at_end ? NULL : &help_row;
}

// Copies the option without its fallback, which may lie in the cursor.
static void copy(const glint_option *option, glint_option *found)
{
    *found = *option;
    found->fallback = NULL;
}

bool glint_options_find(const glint_command *command, const char *name, glint_option *found)
{
    glint_option_cursor cursor = {.table = command->groups};
    const glint_option *option;
    while ((option = glint_option_next(&cursor)) != NULL) {
        if (option->name != NULL && strcmp(option->name, name) == 0) {
            copy(option, found);
            return true;
        }
    }
    return false;
}

bool glint_options_find_letter(const glint_command *command, char letter, glint_option *found)
{
    glint_option_cursor cursor = {.table = command->groups};
    const glint_option *option;
    while ((option = glint_option_next(&cursor)) != NULL) {
        if (option->letter == letter) {
            copy(option, found);
            return true;
        }
    }
    return false;
}
