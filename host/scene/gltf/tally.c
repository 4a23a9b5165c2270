// Collects warnings about a file. See tally.h.
#include "scene/gltf/tally.h"

#include "base/memory.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

enum { LINES_ABOUT = 64 }; // bits of lines_about

static int compare_texts(const void *a, const void *b)
{
    const glint_tally_entry *one = a, *other = b;
    return strcmp(one->text, other->text);
}

static int compare_pairs(const void *a, const void *b)
{
    const glint_tally_entry *one = a, *other = b;
    const int texts = compare_texts(a, b);
    return texts != 0 ? texts : strcmp(one->where, other->where);
}

static void free_entry(glint_tally_entry *entry)
{
    if (entry != NULL) {
        free(entry->text);
        free(entry->where);
        free(entry);
    }
}

static glint_tally_entry *new_entry(const char *text, const char *where)
{
    glint_tally_entry *entry = calloc(1, sizeof *entry);
    if (entry != NULL) {
        entry->text = strdup(text);
        entry->where = strdup(where);
    }
    if (entry == NULL || entry->text == NULL || entry->where == NULL) {
        free_entry(entry);
        return NULL;
    }
    return entry;
}

// Returns the entry, added if it is not there; NULL if memory is short.
static glint_tally_entry *find_or_add(glint_tally_list *list, const char *text, const char *where,
                                      int (*compare)(const void *, const void *))
{
    glint_tally_entry sought = {.text = (char *)text, .where = (char *)where};
    glint_tally_entry **found = tfind(&sought, &list->tree, compare);
    if (found != NULL) {
        return *found;
    }
    const bool has_room = glint_make_room((void **)&list->entries, list->count, &list->capacity,
                                          sizeof *list->entries);
    glint_tally_entry *entry = has_room ? new_entry(text, where) : NULL;
    if (entry == NULL || tsearch(entry, &list->tree, compare) == NULL) {
        free_entry(entry);
        return NULL;
    }
    list->entries[list->count++] = entry;
    return entry;
}

// Notes that a line concerns the present material.
static void note_material(glint_tally *tally, size_t line)
{
    const size_t material = (size_t)tally->material;
    if (material >= tally->about_count) {
        const size_t count = 2 * material + 16;
        uint64_t *grown = realloc(tally->lines_about, count * sizeof *grown);
        if (grown == NULL) {
            tally->lost++;
            return;
        }
        memset(grown + tally->about_count, 0, (count - tally->about_count) * sizeof *grown);
        tally->lines_about = grown;
        tally->about_count = count;
    }
    tally->lines_about[material] |= UINT64_C(1) << line;
}

static glint_tally_entry *add(glint_tally *tally, const char *text, const char *where)
{
    glint_tally_entry *entry = find_or_add(&tally->lines, text, where, compare_texts);
    if (entry == NULL) {
        tally->lost++;
        return NULL;
    }
    for (size_t i = 0; tally->material >= 0 && i < tally->lines.count && i < LINES_ABOUT; i++) {
        if (tally->lines.entries[i] == entry) {
            note_material(tally, i);
        }
    }
    return entry;
}

void glint_tally_add(glint_tally *tally, const char *text, const char *where)
{
    glint_tally_entry *entry = add(tally, text, where);
    if (entry != NULL) {
        entry->count++;
    }
}

void glint_tally_add_once(glint_tally *tally, const char *text, const char *where)
{
    const size_t before = tally->once.count;
    glint_tally_entry *pair = find_or_add(&tally->once, text, where, compare_pairs);
    glint_tally_entry *entry = add(tally, text, where);
    if (entry != NULL && (pair == NULL || tally->once.count > before)) {
        entry->count++;
    }
}

uint64_t glint_tally_lines_about(const glint_tally *tally, int material)
{
    return material >= 0 && (size_t)material < tally->about_count ? tally->lines_about[material]
                                                                  : 0;
}

void glint_tally_report(const glint_tally *tally, const char *path, glint_warnings *warnings)
{
    for (size_t i = 0; i < tally->lines.count; i++) {
        const glint_tally_entry *entry = tally->lines.entries[i];
        if (entry->count > 1) {
            glint_warn(warnings, "%s: %s and %zu more: %s", path, entry->where, entry->count - 1,
                       entry->text);
        } else {
            glint_warn(warnings, "%s: %s: %s", path, entry->where, entry->text);
        }
    }
    if (warnings != NULL) {
        warnings->lost += tally->lost;
    }
}

static void mark(glint_tally_list *list)
{
    for (size_t i = 0; i < list->count; i++) {
        list->entries[i]->marked = list->entries[i]->count;
    }
    list->marked = list->count;
}

static void rewind_list(glint_tally_list *list, int (*compare)(const void *, const void *))
{
    while (list->count > list->marked) {
        glint_tally_entry *entry = list->entries[--list->count];
        tdelete(entry, &list->tree, compare);
        free_entry(entry);
    }
    for (size_t i = 0; i < list->count; i++) {
        list->entries[i]->count = list->entries[i]->marked;
    }
}

void glint_tally_mark(glint_tally *tally)
{
    mark(&tally->lines);
    mark(&tally->once);
}

void glint_tally_rewind(glint_tally *tally)
{
    rewind_list(&tally->lines, compare_texts);
    rewind_list(&tally->once, compare_pairs);
    const size_t kept = tally->lines.count;
    const uint64_t bits = kept < LINES_ABOUT ? (UINT64_C(1) << kept) - 1 : UINT64_MAX;
    for (size_t i = 0; i < tally->about_count; i++) {
        tally->lines_about[i] &= bits;
    }
}

void glint_tally_free(glint_tally *tally)
{
    tally->lines.marked = tally->once.marked = 0;
    glint_tally_rewind(tally);
    free(tally->lines.entries);
    free(tally->once.entries);
    free(tally->lines_about);
    *tally = GLINT_TALLY_EMPTY;
}
