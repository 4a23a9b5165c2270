// Messages on stderr. See say.h.
#include "cli/common/say.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

void glint_say(const char *format, ...)
{
    char text[GLINT_MESSAGE_CAPACITY + 64];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fprintf(stderr, "glint: %s\n", text);
}

void glint_say_error(const glint_error *error)
{
    glint_say("%s", error->message[0] != '\0' ? error->message : "failed without a reason");
    const char *details = error->details;
    if (details != NULL) {
        const bool ends_line = details[0] != '\0' && details[strlen(details) - 1] == '\n';
        fprintf(stderr, "%s%s", details, ends_line ? "" : "\n");
    }
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
