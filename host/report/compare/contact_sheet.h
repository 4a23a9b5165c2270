// Many pictures on one, each made small, with their numbers: a sequence at a glance.
#ifndef GLINT_REPORT_COMPARE_CONTACT_SHEET_H
#define GLINT_REPORT_COMPARE_CONTACT_SHEET_H

#include "base/status.h"
#include "image/image.h"

#include <stdbool.h>

// Zero is valid: no sheet.
typedef struct glint_contact_sheet {
    int columns, count;
    int width, height; // of a picture on the sheet, pixels
    glint_image image; // 3 channels, linear
} glint_contact_sheet;

// A sheet for `count` pictures, `columns` in a row (0: about as many as give the sheet the
// pictures' own shape), each within width × height. Errors: GLINT_USAGE where it would be too
// large, GLINT_DEVICE_FAILED.
glint_status glint_contact_sheet_create(int count, int columns, int width, int height,
                                        glint_contact_sheet *sheet, glint_error *error);
void glint_contact_sheet_free(glint_contact_sheet *sheet);

// Puts a picture of any size in its place, as large as fits, with `label` below: each pixel of the
// sheet is the mean of what it covers, over grey where that is transparent, and magenta where some
// of it is not finite. `picture` NULL: a box with a cross, for one that cannot be shown. Signs that
// the font has not are blank.
void glint_contact_sheet_put(glint_contact_sheet *sheet, int index, const glint_image *picture,
                             const char *label);

#endif
