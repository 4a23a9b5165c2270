// Fills errors and the list of warnings. See status.h.
#include "base/status.h"

#include "base/plain_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

glint_status glint_fail(glint_error *error, glint_status code, const char *format, ...)
{
    if (error == NULL) {
        return code;
    }
    error->code = code;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    glint_make_plain(error->message);
    return code;
}

void glint_error_free(glint_error *error)
{
    free(error->details);
    *error = (glint_error){0};
}

static int already_said(const glint_warnings *warnings, const char *text)
{
    for (size_t i = 0; i < warnings->count; i++) {
        if (strcmp(warnings->texts[i], text) == 0) {
            return 1;
        }
    }
    return 0;
}

void glint_list_add(char *list, size_t capacity, long long index, const char *name)
{
    static const char more[] = ", ...";
    const size_t used = strlen(list);
    if (used + 1 >= sizeof more && strcmp(list + used + 1 - sizeof more, more) == 0) {
        return;
    }
    const size_t room = capacity - used - (sizeof more - 1); // keep room for ", ..."
    const char *quote = name != NULL ? "\"" : "";
    const int length = snprintf(list + used, room, "%s%lld%s%s%s%s", used > 0 ? ", " : "", index,
                                name != NULL ? " " : "", quote, name != NULL ? name : "", quote);
    if (length < 0 || (size_t)length >= room) {
        memcpy(list + used, more, sizeof more);
    }
}

void glint_warn(glint_warnings *warnings, const char *format, ...)
{
    if (warnings == NULL) {
        return;
    }
    char text[GLINT_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    glint_make_plain(text);
    if (already_said(warnings, text)) {
        return;
    }
    if (warnings->count == warnings->capacity) {
        size_t capacity = warnings->capacity ? 2 * warnings->capacity : 8;
        char **texts = realloc(warnings->texts, capacity * sizeof *texts);
        if (texts == NULL) {
            warnings->lost++;
            return;
        }
        warnings->texts = texts;
        warnings->capacity = capacity;
    }
    char *copy = strdup(text);
    if (copy == NULL) {
        warnings->lost++;
        return;
    }
    warnings->texts[warnings->count++] = copy;
}

void glint_warning_extend(glint_warnings *warnings, size_t number, const char *more)
{
    const size_t length = strlen(warnings->texts[number]), added = strlen(more) + 1;
    char *text = realloc(warnings->texts[number], length + added);
    if (text != NULL) {
        memcpy(text + length, more, added);
        warnings->texts[number] = text;
    }
}

void glint_warnings_free(glint_warnings *warnings)
{
    for (size_t i = 0; i < warnings->count; i++) {
        free(warnings->texts[i]);
    }
    free(warnings->texts);
    *warnings = (glint_warnings){0};
}
