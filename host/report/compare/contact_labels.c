// Finds frames' numbers in the names of images. See contact_labels.h.
#include "report/compare/contact_labels.h"

#include "base/memory.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Numbers -----------------------------------------------------------------------------------

// The last part of a path.
typedef struct image_name {
    const char *text;
    size_t stem; // length without the extension
} image_name;

// A number in a name, with its sign.
typedef struct number {
    const char *name;
    size_t image; // index in the list
    size_t begin, length;
    bool differs; // another name is the same but for this number
} number;

static image_name name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *text = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(text, '.');
    return (image_name){text, dot != NULL && dot != text ? (size_t)(dot - text) : strlen(text)};
}

// Finds the next number of the name at or after `from`. A dash is its sign if no letter and no
// digit stands before the dash. False if there is none.
static bool next_number(const image_name *name, size_t from, number *found)
{
    size_t digits = from;
    while (digits < name->stem && !isdigit((unsigned char)name->text[digits])) {
        digits++;
    }
    if (digits == name->stem) {
        return false;
    }
    size_t end = digits;
    while (end < name->stem && isdigit((unsigned char)name->text[end])) {
        end++;
    }
    const bool has_dash = digits > from && name->text[digits - 1] == '-';
    const bool is_sign =
        has_dash && (digits == 1 || !isalnum((unsigned char)name->text[digits - 2]));
    found->begin = digits - (is_sign ? 1 : 0);
    found->length = end - found->begin;
    return true;
}

// Lists the numbers of all names in `numbers`, or only counts them if that is NULL.
static size_t list_numbers(const char *const *paths, size_t count, number *numbers)
{
    size_t listed = 0;
    for (size_t i = 0; i < count; i++) {
        const image_name name = name_of(paths[i]);
        number found = {.name = name.text, .image = i};
        for (size_t from = 0; next_number(&name, from, &found); from = found.begin + found.length) {
            if (numbers != NULL) {
                numbers[listed] = found;
            }
            listed++;
        }
    }
    return listed;
}

// Compares what stands before and behind two numbers.
static int compare_places(const number *a, const number *b)
{
    if (a->begin != b->begin) {
        return a->begin < b->begin ? -1 : 1;
    }
    const int before = memcmp(a->name, b->name, a->begin);
    return before != 0 ? before
                       : strcmp(a->name + a->begin + a->length, b->name + b->begin + b->length);
}

static int by_place(const void *a, const void *b)
{
    const number *first = a, *second = b;
    const int place = compare_places(first, second);
    return place != 0 ? place : strcmp(first->name, second->name);
}

static int by_image(const void *a, const void *b)
{
    const number *first = a, *second = b;
    return first->image != second->image  ? (first->image < second->image ? -1 : 1)
           : first->begin < second->begin ? -1
                                          : 1;
}

// Marks the numbers by which names differ.
static void mark_differing(number *numbers, size_t count)
{
    qsort(numbers, count, sizeof *numbers, by_place);
    for (size_t first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && compare_places(&numbers[first], &numbers[end]) == 0;
             end++) {
        }
        // Equal names are neighbours.
        const bool differ = strcmp(numbers[first].name, numbers[end - 1].name) != 0;
        for (size_t i = first; i < end; i++) {
            numbers[i].differs = differ;
        }
    }
    qsort(numbers, count, sizeof *numbers, by_image);
}

// The frame's number among the numbers of one name; NULL if there is none.
static const number *frame_number(const number *numbers, size_t count, const image_name *name)
{
    const number *differing = NULL;
    for (size_t i = 0; i < count; i++) {
        if (numbers[i].differs && differing != NULL) {
            return NULL;
        }
        differing = numbers[i].differs ? &numbers[i] : differing;
    }
    if (differing != NULL || count == 0) {
        return differing;
    }
    const number *last = &numbers[count - 1];
    const bool is_between = last->begin + last->length == name->stem &&
                            (last->begin == 0 || name->text[last->begin - 1] == '.');
    return is_between ? last : NULL;
}

// ---- Labels ------------------------------------------------------------------------------------

typedef struct labelled {
    const char *name;
    char *label; // owned
    bool is_shared;
} labelled;

static int by_label(const void *a, const void *b)
{
    const labelled *first = a, *second = b;
    const int labels = strcmp(first->label, second->label);
    return labels != 0 ? labels : strcmp(first->name, second->name);
}

static void put_name(const char *text, char label[GLINT_CONTACT_LABEL])
{
    const image_name name = name_of(text);
    snprintf(label, GLINT_CONTACT_LABEL, "%.*s", (int)name.stem, name.text);
}

// Replaces numbers that different names share by the names.
static void name_shared(labelled *list, size_t count)
{
    qsort(list, count, sizeof *list, by_label);
    for (size_t first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && strcmp(list[first].label, list[end].label) == 0;
             end++) {
        }
        list[first].is_shared = strcmp(list[first].name, list[end - 1].name) != 0;
        for (size_t i = first; i < end; i++) {
            list[i].is_shared = list[first].is_shared;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (list[i].is_shared) {
            put_name(list[i].name, list[i].label);
        }
    }
}

glint_status glint_contact_labels(const char *const *paths, size_t count,
                                  char (*labels)[GLINT_CONTACT_LABEL], glint_error *error)
{
    const size_t number_count = list_numbers(paths, count, NULL);
    number *numbers = glint_allocate(number_count, sizeof *numbers);
    labelled *numbered = glint_allocate(count, sizeof *numbered);
    if (numbers == NULL || numbered == NULL) {
        free(numbers);
        free(numbered);
        return glint_fail_memory(error, "the labels");
    }
    list_numbers(paths, count, numbers);
    mark_differing(numbers, number_count);
    size_t with_number = 0;
    for (size_t i = 0, first = 0, end; i < count; i++, first = end) {
        for (end = first; end < number_count && numbers[end].image == i; end++) {
        }
        const image_name name = name_of(paths[i]);
        const number *frame = frame_number(numbers + first, end - first, &name);
        put_name(name.text, labels[i]);
        if (frame != NULL) {
            snprintf(labels[i], sizeof labels[i], "%.*s", (int)frame->length,
                     name.text + frame->begin);
            numbered[with_number++] = (labelled){.name = name.text, .label = labels[i]};
        }
    }
    name_shared(numbered, with_number);
    free(numbers);
    free(numbered);
    return GLINT_OK;
}
