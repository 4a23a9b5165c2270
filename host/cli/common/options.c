// Parses a command line with a command's option table. options_help.c prints the help.
#include "cli/common/options.h"

#include <string.h>

// ---- The rows ----------------------------------------------------------------------------------

static const glint_option help_row = {GLINT_OPTION_FLAG, .letter = 'h', .name = "help",
                                      .help = "Print this."};

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

// Finds an option by its letter or, if `letter` is 0, by its name of `length` bytes. False if there
// is none.
static bool find(const glint_command *command, char letter, const char *name, size_t length,
                 glint_option *found)
{
    glint_option_cursor cursor = {.table = command->groups};
    const glint_option *option;
    while ((option = glint_option_next(&cursor)) != NULL) {
        const bool is_it = letter != 0
                               ? option->letter == letter
                               : option->name != NULL && strncmp(option->name, name, length) == 0 &&
                                     option->name[length] == '\0';
        if (is_it) {
            *found = *option;
            return true;
        }
    }
    return false;
}

static glint_status fail_unknown(const glint_command *command, const char *name, glint_error *error)
{
    char nearest[64] = "";
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
               ? glint_fail(error, GLINT_USAGE, "unknown option --%s (did you mean --%s?)", name,
                            nearest)
               : glint_fail(error, GLINT_USAGE, "unknown option --%s (glint %s --help lists them)",
                            name, command->name);
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
        *(option->letter == help_row.letter ? &p->help : (bool *)destination) = true;
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
    if (!find(p->command, 0, word, length, &option)) {
        return fail_unknown(p->command, name, error);
    }
    const bool is_too_much = option.kind == GLINT_OPTION_FLAG && value != NULL;
    return is_too_much ? glint_option_parse(&option, value, NULL, error)
                       : take(p, &option, value, error);
}

// Parses "abc": several flags. The last letter may take a value: the rest of the word ("ofile") or
// the next word.
static glint_status take_letters(parsing *p, const char *letters, glint_error *error)
{
    for (; *letters != '\0' && !p->help; letters++) {
        glint_option option;
        if (!find(p->command, *letters, "", 0, &option)) {
            return glint_fail(error, GLINT_USAGE, "unknown option -%c (glint %s --help lists them)",
                              *letters, p->command->name);
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
