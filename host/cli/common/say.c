// Prints messages on stderr. See say.h.
#include "cli/common/say.h"

#include "base/plain_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void glint_say(const char *format, ...)
{
    char text[GLINT_MESSAGE_CAPACITY + 64];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    glint_make_plain(text);
    fprintf(stderr, "glint: %s\n", text);
}

// Prints several lines, each made plain.
static void print_lines(char *text)
{
    for (char *line; (line = strsep(&text, "\n")) != NULL;) {
        if (text != NULL || *line != '\0') {
            glint_make_plain(line);
            fprintf(stderr, "%s\n", line);
        }
    }
}

void glint_say_error(const glint_error *error)
{
    glint_say("%s", error->message[0] != '\0' ? error->message : "failed without a reason");
    print_lines(error->details);
}

void glint_say_warnings(const glint_warnings *warnings, size_t first)
{
    for (size_t i = first; i < warnings->count; i++) {
        glint_say("warning: %s", warnings->texts[i]);
    }
    if (warnings->lost > 0) {
        glint_say("warning: %zu more warnings found no memory", warnings->lost);
    }
}
