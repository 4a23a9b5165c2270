// Many pictures on one, each made small, with their numbers: a sequence at a glance.
#ifndef GLINT_REPORT_COMPARE_CONTACT_SHEET_H
#define GLINT_REPORT_COMPARE_CONTACT_SHEET_H

#include "base/status.h"
#include "image/image.h"

#include <stddef.h>

// Zero is valid: no sheet.
typedef struct glint_contact_sheet {
    int count;         // pictures
    int columns;       // in a row; 0 before it begins: about as many as rows
    int width, height; // each picture lies within, pixels
    glint_image image; // 3 channels, linear
} glint_contact_sheet;

// Makes the image of a sheet whose other members are set, and settles the columns. Errors:
// GLINT_USAGE where it would be too large, GLINT_OUT_OF_MEMORY.
glint_status glint_contact_sheet_begin(glint_contact_sheet *sheet, glint_error *error);
void glint_contact_sheet_free(glint_contact_sheet *sheet);

// Puts a picture of any size in its place, as large as fits, with `label` below: each pixel of the
// sheet is the mean of what it covers, over grey where that is transparent, and magenta where some
// of it is not finite. `picture` NULL: a box with a cross, for one that cannot be shown. Signs that
// the font has not are blank.
void glint_contact_sheet_put(glint_contact_sheet *sheet, int index, const glint_image *picture,
                             const char *label);

// What stands below an image of this path: the last number in its file's name, which is a frame's;
// where there is none, the name without its ending.
void glint_contact_label(const char *path, char *label, size_t capacity);

#endif
