// Draws contact sheets: many small pictures with labels on one image, to see a sequence at a
// glance.
#ifndef GLINT_REPORT_COMPARE_CONTACT_SHEET_H
#define GLINT_REPORT_COMPARE_CONTACT_SHEET_H

#include "base/status.h"
#include "image/image.h"

// A contact sheet. Zero is valid: no sheet.
typedef struct glint_contact_sheet {
    int count;         // number of pictures
    int columns;       // pictures per row; 0 before the sheet begins: about as many as rows
    int width, height; // largest size of a picture, pixels
    glint_image image; // 3 channels, linear
} glint_contact_sheet;

// Makes the image of a sheet and sets the columns. The other members must be set. Errors:
// GLINT_USAGE if the image would be too large, GLINT_OUT_OF_MEMORY.
glint_status glint_contact_sheet_begin(glint_contact_sheet *sheet, glint_error *error);
void glint_contact_sheet_free(glint_contact_sheet *sheet);

// Draws a picture of any size at its place, as large as fits, with `label` below. Each pixel of the
// sheet is the mean of the area that it covers. Transparent areas stand over grey. If the area
// holds a value that is not finite, the pixel is magenta. If `picture` is NULL, draws a crossed box
// instead. Characters that the font lacks are blank.
void glint_contact_sheet_put(glint_contact_sheet *sheet, int index, const glint_image *picture,
                             const char *label);

#endif
