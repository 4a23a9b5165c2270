// Draws contact sheets. See contact_sheet.h.
#include "report/compare/contact_sheet.h"

#include "report/compare/bitmap_font.h"
#include "report/compare/heat_scale.h"

#include <math.h>
#include <string.h>

// sRGB codes 32, 96 and 224, as linear light.
static const float background[3] = {0.0144F, 0.0144F, 0.0144F};
static const float behind[3] = {0.117F, 0.117F, 0.117F};
static const float ink[3] = {0.7454F, 0.7454F, 0.7454F};

enum { GAP = 8, LABEL = 2 * GLINT_FONT_HEIGHT + 6, UNIT = 2, SIDE_MAX = 32768 };

// ---- The sheet ---------------------------------------------------------------------------------

static int cell_width(const glint_contact_sheet *sheet)
{
    return sheet->width + GAP;
}

static int cell_height(const glint_contact_sheet *sheet)
{
    return sheet->height + LABEL + GAP;
}

glint_status glint_contact_sheet_begin(glint_contact_sheet *sheet, glint_error *error)
{
    const int count = sheet->count;
    sheet->columns = sheet->columns > 0 ? sheet->columns : (int)ceil(sqrt((double)count));
    sheet->columns = sheet->columns < count ? sheet->columns : count;
    const int rows = (count + sheet->columns - 1) / sheet->columns;
    const double sheet_width = (double)sheet->columns * cell_width(sheet) + GAP;
    const double sheet_height = (double)rows * cell_height(sheet) + GAP;
    if (sheet_width > SIDE_MAX || sheet_height > SIDE_MAX) {
        return glint_fail(error, GLINT_USAGE,
                          "%d pictures of %d pixels make a sheet of %.0fx%.0f, more than %d on a "
                          "side (give a smaller --width, or fewer)",
                          count, sheet->width, sheet_width, sheet_height, SIDE_MAX);
    }
    TRY(glint_image_create((int)sheet_width, (int)sheet_height, 3, &sheet->image, error));
    const int all[4] = {0, 0, (int)sheet_width, (int)sheet_height};
    glint_font_fill(&sheet->image, all, background);
    return GLINT_OK;
}

void glint_contact_sheet_free(glint_contact_sheet *sheet)
{
    glint_image_free(&sheet->image);
    *sheet = (glint_contact_sheet){0};
}

// ---- A picture ---------------------------------------------------------------------------------

// The colour of a pixel over grey. False if it is not finite.
static bool shown(const glint_image *picture, int x, int y, double color[3])
{
    const float *p = glint_image_pixel(picture, x, y);
    const bool is_grey = picture->channels < 3;
    const double alpha = glint_image_has_alpha(picture) ? (double)p[picture->channels - 1] : 1;
    for (int k = 0; k < 3; k++) {
        color[k] = (double)p[is_grey ? 0 : k] + (1 - alpha) * (double)behind[k];
    }
    return isfinite(color[0] + color[1] + color[2]);
}

// The length of the part of [from, to] that lies within pixel i.
static double overlap(double from, double to, int i)
{
    return fmin(to, i + 1) - fmax(from, i);
}

// The mean colour of a rectangle of the picture, in pixel units; magenta if any pixel is not
// finite.
static void mean(const glint_image *picture, const double low[2], const double high[2],
                 float color[3])
{
    double sum[3] = {0, 0, 0}, area = 0;
    const int last_x = (int)fmin(ceil(high[0]), picture->width);
    const int last_y = (int)fmin(ceil(high[1]), picture->height);
    for (int y = (int)low[1]; y < last_y; y++) {
        for (int x = (int)low[0]; x < last_x; x++) {
            double one[3];
            if (!shown(picture, x, y, one)) {
                memcpy(color, glint_heat_not_finite, 3 * sizeof *color);
                return;
            }
            const double share = overlap(low[0], high[0], x) * overlap(low[1], high[1], y);
            for (int k = 0; k < 3; k++) {
                sum[k] += share * one[k];
            }
            area += share;
        }
    }
    for (int k = 0; k < 3; k++) {
        color[k] = (float)(sum[k] / area);
    }
}

// Draws the picture as large as fits, centred in its place at (left, top).
static void draw_picture(glint_contact_sheet *sheet, int left, int top, const glint_image *picture)
{
    const double scale =
        fmin((double)sheet->width / picture->width, (double)sheet->height / picture->height);
    const int width = (int)fmax(1, round(scale * picture->width));
    const int height = (int)fmax(1, round(scale * picture->height));
    const int x0 = left + (sheet->width - width) / 2, y0 = top + (sheet->height - height) / 2;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const double low[2] = {(double)x * picture->width / width,
                                   (double)y * picture->height / height};
            const double high[2] = {(double)(x + 1) * picture->width / width,
                                    (double)(y + 1) * picture->height / height};
            mean(picture, low, high, glint_image_pixel(&sheet->image, x0 + x, y0 + y));
        }
    }
}

static void draw_cross(glint_contact_sheet *sheet, int left, int top)
{
    const int place[4] = {left, top, sheet->width, sheet->height};
    glint_font_fill(&sheet->image, place, behind);
    for (int x = 0; x < sheet->width; x++) {
        const int y = x * sheet->height / sheet->width;
        memcpy(glint_image_pixel(&sheet->image, left + x, top + y), ink, sizeof ink);
        memcpy(glint_image_pixel(&sheet->image, left + x, top + sheet->height - 1 - y), ink,
               sizeof ink);
    }
}

void glint_contact_sheet_put(glint_contact_sheet *sheet, int index, const glint_image *picture,
                             const char *label)
{
    const int left = GAP + index % sheet->columns * cell_width(sheet);
    const int top = GAP + index / sheet->columns * cell_height(sheet);
    if (picture != NULL) {
        draw_picture(sheet, left, top, picture);
    } else {
        draw_cross(sheet, left, top);
    }
    char text[64];
    // Number of characters that fit.
    const int room = (sheet->width / UNIT + 1) / GLINT_FONT_ADVANCE;
    const size_t length = strlen(label);
    const size_t shown_length = length < (size_t)room ? length : (size_t)room;
    if (shown_length < sizeof text) {
        memcpy(text, label + length - shown_length, shown_length + 1);
        const int at[2] = {left, top + sheet->height + 4};
        glint_font_draw(&sheet->image, at, UNIT, text, ink);
    }
}
