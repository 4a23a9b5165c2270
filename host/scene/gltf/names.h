// Names of a file's objects, for messages and on the command line.
#ifndef GLINT_SCENE_GLTF_NAMES_H
#define GLINT_SCENE_GLTF_NAMES_H

#include "scene/document.h"

enum { GLINT_QUOTED = 72, GLINT_WHERE = 128 };

// Writes a text in quotes, cut after a few dozen bytes, and returns `quoted`.
const char *glint_quote(const char *text, char quoted[GLINT_QUOTED]);

// Returns a malloc'd copy; NULL for an empty text. *is_short becomes true if memory is short.
char *glint_name_copy(const char *text, bool *is_short);

// Writes where an object stands, such as: nodes[3] "wheel". Returns `where`.
const char *glint_name_place(const char *list, size_t index, const char *name,
                             char where[GLINT_WHERE]);

// A table of a document whose rows begin with their name, and the word for one of them.
typedef struct glint_named_rows {
    const glint_document *document;
    const void *rows; // [count]
    size_t row_bytes, count;
    const char *noun;
} glint_named_rows;

#define GLINT_NAMED_ROWS(document, table, noun)                                                    \
    ((glint_named_rows){(document), (document)->table, sizeof *(document)->table,                  \
                        (document)->table##_count, (noun)})

// Finds a row by name, or else by index ("0"). Errors: GLINT_BAD_INPUT, with a list of the rows.
glint_status glint_name_find(const glint_named_rows *table, const char *wanted, size_t *found,
                             glint_error *error);

#endif
