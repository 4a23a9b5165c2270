// Collects warnings about a file. Each names the first place that it concerns, and counts the
// others.
#ifndef GLINT_SCENE_GLTF_TALLY_H
#define GLINT_SCENE_GLTF_TALLY_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

// A warning, or a pair that was added once.
typedef struct glint_tally_entry {
    char *text, *where;   // owned
    size_t count, marked; // how often it was added; and that number at the last mark
} glint_tally_entry;

typedef struct glint_tally_list {
    glint_tally_entry **entries; // in the order of their first addition, owned
    size_t count, capacity, marked;
    void *tree; // finds an entry (search.h)
} glint_tally_list;

// Zero is valid and empty, but for `material`.
typedef struct glint_tally {
    glint_tally_list lines, once;
    int material;             // its index in the file: additions concern it; −1: no material
    uint64_t *lines_about;    // [material]: which of the first 64 lines concern it
    size_t about_count, lost; // lost: additions that found no memory
} glint_tally;

#define GLINT_TALLY_EMPTY ((glint_tally){.material = -1})

// Adds a warning. `text` says what was found and what is done about it. Only the first `where` is
// kept.
void glint_tally_add(glint_tally *tally, const char *text, const char *where);

// Adds a warning about a thing that several materials may share: counts each `where` once.
void glint_tally_add_once(glint_tally *tally, const char *text, const char *where);

// Returns which of the first 64 lines of the report concern a material: bit i for line i.
uint64_t glint_tally_lines_about(const glint_tally *tally, int material);

// Reports one line per warning, in the order of their first addition.
void glint_tally_report(const glint_tally *tally, const char *path, glint_warnings *warnings);

// Marks the present state; goes back to the last mark, or to an empty tally if there is none.
void glint_tally_mark(glint_tally *tally);
void glint_tally_rewind(glint_tally *tally);

void glint_tally_free(glint_tally *tally);

#endif
