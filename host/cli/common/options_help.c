// The help text of a command, made from its table, and the guess at what a wrong name meant.
#include "cli/common/options.h"

#include <string.h>

#define HELP_COLUMN 28 // where the explanations begin

// Prints `text` wrapped, its lines from column `indent` on; the cursor stands at `column` already.
// A '\n' in the text begins a new line.
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
    if (option->fallback != NULL) {
        snprintf(text, sizeof text, "%s [%s]", option->help, option->fallback);
    } else {
        snprintf(text, sizeof text, "%s", option->help);
    }
    print_wrapped(text, column, HELP_COLUMN, columns, out);
}

void glint_options_help(const glint_command *command, int columns, FILE *out)
{
    fprintf(out, "usage: glint %s %s\n\n", command->name, command->synopsis);
    print_wrapped(command->description, 0, 0, columns, out);
    for (const glint_option *const *group = command->groups; *group != NULL; group++) {
        for (const glint_option *option = *group; option->help != NULL; option++) {
            if (option->kind == GLINT_OPTION_HEADING) {
                fprintf(out, "\n%s\n", option->help);
            } else {
                print_option(option, columns, out);
            }
        }
    }
    fprintf(out, "\n  -h, --help                Print this.\n\n");
    print_wrapped("Defaults stand in brackets. Options may stand before and after the other "
                  "arguments; one that is given twice takes its last value; -- ends them.",
                  0, 0, columns, out);
    if (command->examples != NULL) {
        fprintf(out, "\nExamples\n%s", command->examples);
    }
}

// The number of letters to insert, delete or replace to get from `a` to `b` (Levenshtein 1966).
static size_t edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 63 };
    size_t row[LONGEST + 1];
    size_t length = strlen(b);
    if (length > LONGEST || strlen(a) > LONGEST) {
        return LONGEST;
    }
    for (size_t j = 0; j <= length; j++) {
        row[j] = j;
    }
    for (size_t i = 0; a[i] != '\0'; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < length; j++) {
            size_t replaced = diagonal + (a[i] != b[j]);
            size_t shorter = row[j] < row[j + 1] ? row[j] : row[j + 1];
            diagonal = row[j + 1];
            row[j + 1] = replaced < shorter + 1 ? replaced : shorter + 1;
        }
    }
    return row[length];
}

const char *glint_nearest_word(const char *text, const char *const *words)
{
    const char *nearest = NULL;
    size_t best = 3; // farther off than two letters, a guess is noise
    size_t length = strlen(text);
    for (; *words != NULL; words++) {
        // The beginning of a word counts as near: most wrong names are abbreviations.
        bool is_beginning = length >= 2 && strncmp(*words, text, length) == 0;
        size_t distance = is_beginning ? 1 : edit_distance(text, *words);
        if (distance < best && distance < length) {
            best = distance;
            nearest = *words;
        }
    }
    return nearest;
}
