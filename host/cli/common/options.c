// Parses a command line with a command's option table. options_rows.c walks through the table,
// options_help.c prints the help.
#include "cli/common/options.h"

#include "cli/common/foreign_options.h"

#include <string.h>

// `dashes` are those that were typed.
static glint_status fail_unknown(const glint_command *command, const char *dashes, const char *name,
                                 glint_error *error)
{
    char text[256], nearest[64] = "";
    glint_option same;
    if (glint_options_find(command, name, &same)) {
        return glint_fail(error, GLINT_USAGE, "unknown option %s%s (did you mean --%s?)", dashes,
                          name, name);
    }
    if (glint_foreign_option_explain(command, name, text, sizeof text)) {
        return glint_fail(error, GLINT_USAGE, "unknown option %s%s (%s)", dashes, name, text);
    }
    size_t best = GLINT_WORD_IS_FAR;
    glint_option_cursor cursor = {.table = command->groups};
    const glint_option *option;
    while ((option = glint_option_next(&cursor)) != NULL) {
        const size_t distance =
            option->name != NULL ? glint_word_distance(name, option->name) : GLINT_WORD_IS_FAR;
        if (distance < best) {
            best = distance;
            snprintf(nearest, sizeof nearest, "%s", option->name);
        }
    }
    return best < GLINT_WORD_IS_FAR
               ? glint_fail(error, GLINT_USAGE, "unknown option %s%s (did you mean --%s?)", dashes,
                            name, nearest)
               : glint_fail(error, GLINT_USAGE, "unknown option %s%s (glint %s --help lists them)",
                            dashes, name, command->name);
}

// ---- The words ---------------------------------------------------------------------------------

// The state of parsing a command line.
typedef struct parsing {
    const glint_command *command;
    void *request;
    char **next, **end; // the words that are not parsed yet
    bool help;
} parsing;

// Stores an option. Its value is the rest of its own word or, if that is NULL, the next word.
static glint_status take(parsing *p, const glint_option *option, const char *value,
                         glint_error *error)
{
    char *destination = (char *)p->request + option->offset;
    if (option->kind == GLINT_OPTION_FLAG) {
        if (option->parse != NULL) {
            return option->parse(option, NULL, destination, error);
        }
        *(option->letter == GLINT_HELP_LETTER ? &p->help : (bool *)destination) = true;
        return GLINT_OK;
    }
    if (value == NULL && p->next == p->end) {
        return glint_fail(error, GLINT_USAGE, "--%s: %s is expected after it", option->name,
                          option->argument);
    }
    if (value == NULL) {
        value = *p->next++;
    }
    return glint_option_parse(option, value, destination, error);
}

// Parses "name" or "name=value", without the dashes.
static glint_status take_long(parsing *p, const char *word, glint_error *error)
{
    char name[64];
    glint_option option;
    const size_t length = strcspn(word, "=");
    snprintf(name, sizeof name, "%.*s", (int)length, word);
    const char *value = word[length] == '=' ? word + length + 1 : NULL;
    if (!glint_options_find(p->command, name, &option)) {
        return fail_unknown(p->command, "--", name, error);
    }
    const bool is_too_much = option.kind == GLINT_OPTION_FLAG && value != NULL;
    return is_too_much ? glint_option_parse(&option, value, NULL, error)
                       : take(p, &option, value, error);
}

// True for "size" and "spp" behind a single dash, which are no letters. "-help" gives help.
static bool is_long_name(const glint_command *command, const char *letters)
{
    char text[256];
    glint_option option;
    return strlen(letters) > 1 && strcmp(letters, "help") != 0 &&
           (glint_options_find(command, letters, &option) ||
            glint_foreign_option_explain(command, letters, text, sizeof text));
}

// Parses "abc": several flags. The last letter may take a value: the rest of the word ("ofile") or
// the next word.
static glint_status take_letters(parsing *p, const char *letters, glint_error *error)
{
    if (is_long_name(p->command, letters)) {
        return fail_unknown(p->command, "-", letters, error);
    }
    for (; *letters != '\0' && !p->help; letters++) {
        glint_option option;
        if (!glint_options_find_letter(p->command, *letters, &option)) {
            return fail_unknown(p->command, "-", (const char[]){*letters, '\0'}, error);
        }
        if (option.kind != GLINT_OPTION_FLAG) {
            return take(p, &option, letters[1] != '\0' ? letters + 1 : NULL, error);
        }
        TRY(take(p, &option, NULL, error));
    }
    return GLINT_OK;
}

// Parses a word that begins with a dash.
static glint_status take_word(parsing *p, const char *word, glint_error *error)
{
    return word[1] == '-' ? take_long(p, word + 2, error) : take_letters(p, word + 1, error);
}

// Moves `count` words at `words` to the front of the `waiting` words before them.
static void move_before(char **words, size_t waiting, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char *word = words[i];
        char **place = words + i - waiting;
        memmove(place + 1, place, waiting * sizeof *place);
        *place = word;
    }
}

static glint_status check_positionals(const glint_command *command,
                                      const glint_arguments *arguments, glint_error *error)
{
    const char *second = command->second_positional;
    int count = arguments->positional_count;
    int named = (command->positional != NULL) + (second != NULL);
    int most = command->takes_any_number ? count : named;
    if (count > most) {
        return glint_fail(error, GLINT_USAGE, "unexpected argument '%s' (usage: glint %s %s)",
                          arguments->positionals[most], command->name, command->synopsis);
    }
    // Find the first positional argument that is missing or empty.
    int at = 0;
    while (at < count && arguments->positionals[at][0] != '\0') {
        at++;
    }
    if (at < most) {
        const char *missing = at > 0 && second != NULL ? second : command->positional;
        return glint_fail(error, GLINT_USAGE, "%s is missing (usage: glint %s %s)", missing,
                          command->name, command->synopsis);
    }
    return GLINT_OK;
}

glint_status glint_options_parse(const glint_command *command, void *request,
                                 glint_arguments *arguments, glint_error *error)
{
    char **const end = arguments->words + arguments->word_count;
    parsing p = {.command = command, .request = request, .end = end};
    char **word = arguments->words + 1;
    size_t waiting = 0; // positional arguments found so far; they are kept just before `word`
    bool are_options = true;
    while (word < p.end && are_options && !p.help) {
        if ((*word)[0] != '-' || (*word)[1] == '\0') {
            waiting++;
            word++;
            continue;
        }
        p.next = word + 1;
        are_options = strcmp(*word, "--") != 0;
        if (are_options) {
            TRY(take_word(&p, *word, error));
        }
        // Move the option in front of the positional arguments before it.
        move_before(word, waiting, (size_t)(p.next - word));
        word = p.next;
    }
    arguments->help = p.help;
    arguments->positionals = word - waiting;
    arguments->positional_count = (int)(end - arguments->positionals);
    return p.help ? GLINT_OK : check_positionals(command, arguments, error);
}
