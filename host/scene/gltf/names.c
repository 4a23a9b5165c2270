// Names of a file's objects. See names.h.
#include "scene/gltf/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *glint_quote(const char *text, char quoted[GLINT_QUOTED])
{
    const size_t limit = 60;
    size_t end = strlen(text);
    const bool is_cut = end > limit;
    if (is_cut) {
        end = limit;
        while (end > 0 && ((unsigned char)text[end] & 0xc0) == 0x80) {
            end--; // not in the middle of a UTF-8 character
        }
    }
    (void)snprintf(quoted, GLINT_QUOTED, "\"%.*s%s\"", (int)end, text, is_cut ? "..." : "");
    return quoted;
}

char *glint_name_copy(const char *text, bool *is_short)
{
    char *copy = text[0] == '\0' ? NULL : strdup(text);
    *is_short = *is_short || (copy == NULL && text[0] != '\0');
    return copy;
}

const char *glint_name_place(const char *list, size_t index, const char *name,
                             char where[GLINT_WHERE])
{
    char quoted[GLINT_QUOTED];
    (void)snprintf(where, GLINT_WHERE, "%s[%zu]%s%s", list, index, name[0] == '\0' ? "" : " ",
                   name[0] == '\0' ? "" : glint_quote(name, quoted));
    return where;
}

static const char *name_of(const glint_named_rows *table, size_t i)
{
    glint_text text;
    memcpy(&text, (const char *)table->rows + i * table->row_bytes, sizeof text);
    return glint_document_text(table->document, text);
}

// Returns the index that a text says; `count` if it says none below.
static size_t read_index(const char *text, size_t count)
{
    char *end = NULL;
    const unsigned long index = strtoul(text, &end, 10); // would also accept a sign and spaces
    return text[0] >= '0' && text[0] <= '9' && *end == '\0' && index < count ? index : count;
}

glint_status glint_name_find(const glint_named_rows *table, const char *wanted, size_t *found,
                             glint_error *error)
{
    for (size_t i = 0; i < table->count; i++) {
        if (strcmp(name_of(table, i), wanted) == 0) {
            *found = i;
            return GLINT_OK;
        }
    }
    *found = read_index(wanted, table->count);
    if (*found < table->count) {
        return GLINT_OK;
    }
    char quoted[GLINT_QUOTED], list[512] = "";
    for (size_t i = 0; i < table->count; i++) {
        const char *name = name_of(table, i);
        glint_list_add(list, sizeof list, (long long)i, name[0] == '\0' ? NULL : name);
    }
    return table->count == 0
               ? glint_fail(error, GLINT_BAD_INPUT, "there is no %s %s (the file has none)",
                            table->noun, glint_quote(wanted, quoted))
               : glint_fail(error, GLINT_BAD_INPUT, "there is no %s %s (there is %s)", table->noun,
                            glint_quote(wanted, quoted), list);
}
