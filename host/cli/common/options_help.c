// Prints the help text of a command from its option table.
#include "cli/common/options.h"

#include <string.h>

#define HELP_COLUMN 28 // column of the explanations

// Prints wrapped text that begins at column `indent`. The cursor already stands at `column`. A '\n'
// in the text begins a new line.
static void print_wrapped(const char *text, int column, int indent, int columns, FILE *out)
{
    bool line_is_empty = true;
    while (*text != '\0') {
        size_t length = strcspn(text, " \n");
        bool fits = column + (line_is_empty ? 0 : 1) + (int)length <= columns;
        if (!line_is_empty && !fits) {
            fputc('\n', out);
            column = 0;
            line_is_empty = true;
        }
        if (line_is_empty) {
            fprintf(out, "%*s", indent > column ? indent - column : 0, "");
            column = indent > column ? indent : column;
        } else {
            fputc(' ', out);
            column++;
        }
        fprintf(out, "%.*s", (int)length, text);
        column += (int)length;
        line_is_empty = false;
        text += length;
        if (*text == '\n') {
            fputc('\n', out);
            column = 0;
            line_is_empty = true;
        }
        text += *text != '\0';
    }
    fputc('\n', out);
}

// Writes the settings that have one of the roles: " In place of --depth, --mend."
static size_t list_settings(unsigned roles, char *text, size_t capacity)
{
    size_t length = 0;
    const char *between = " In place of";
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if ((setting->roles & roles) != 0) {
            length += (size_t)snprintf(text + length, capacity - length, "%s --%s", between,
                                       setting->option.name);
            between = ",";
        }
    }
    return length + (size_t)snprintf(text + length, capacity - length, ".");
}

static void print_option(const glint_option *option, int columns, FILE *out)
{
    char letter[8] = "    ";
    if (option->letter != 0) {
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    }
    int column =
        fprintf(out, "  %s--%s%s%s", letter, option->name, option->argument != NULL ? " " : "",
                option->argument != NULL ? option->argument : "");
    if (column > HELP_COLUMN - 2) {
        fputc('\n', out);
        column = 0;
    }
    char text[1024];
    size_t length = (size_t)snprintf(text, sizeof text, "%s", option->help);
    if (option->instead_of != 0) {
        length += list_settings(option->instead_of, text + length, sizeof text - length);
    }
    if (option->fallback != NULL) {
        snprintf(text + length, sizeof text - length, " [%s]", option->fallback);
    }
    print_wrapped(text, column, HELP_COLUMN, columns, out);
}

void glint_options_help(const glint_command *command, int columns, FILE *out)
{
    fprintf(out, "usage: glint %s %s\n\n", command->name, command->synopsis);
    print_wrapped(command->description, 0, 0, columns, out);
    glint_option_cursor cursor = {.table = command->groups};
    for (const glint_option *option; (option = glint_option_next(&cursor)) != NULL;) {
        if (option->kind == GLINT_OPTION_HEADING) {
            fprintf(out, "\n%s\n", option->help);
        } else {
            fputs(cursor.is_at_end ? "\n" : "", out); // a blank line before --help
            print_option(option, columns, out);
        }
    }
    fputc('\n', out);
    print_wrapped("Defaults stand in brackets. Options may stand before and after the other "
                  "arguments; one that is given twice takes its last value; -- ends them.",
                  0, 0, columns, out);
    if (command->examples != NULL) {
        fprintf(out, "\nExamples\n%s", command->examples);
    }
}
