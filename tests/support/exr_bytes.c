// Builds EXR files byte by byte, after openexr.com, "OpenEXR File Layout". See image_bytes.h.
#include "support/image_bytes.h"

#include <string.h>

static void put_float(image_bytes *file, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    image_bytes_put_number(file, bits, 4);
}

static void put_text(image_bytes *file, const char *text)
{
    image_bytes_put(file, text, strlen(text) + 1);
}

// ---- Headers ------------------------------------------------------------------------------------

static void put_attribute(image_bytes *file, const char *name, const char *type, uint32_t size)
{
    put_text(file, name);
    put_text(file, type);
    image_bytes_put_number(file, size, 4);
}

static void put_string(image_bytes *file, const char *name, const char *text)
{
    put_attribute(file, name, "string", (uint32_t)strlen(text));
    image_bytes_put(file, text, strlen(text));
}

static void put_window(image_bytes *file, const char *name, const int window[4])
{
    put_attribute(file, name, "box2i", 16);
    for (int i = 0; i < 4; i++) {
        image_bytes_put_number(file, (uint64_t)(int64_t)window[i], 4);
    }
}

static int step_of(const exr_recipe *recipe, int channel)
{
    return recipe->steps != NULL ? recipe->steps[channel] : 1;
}

static void put_channels(image_bytes *file, const exr_recipe *recipe)
{
    uint32_t size = 1;
    for (int c = 0; c < recipe->channels; c++) {
        size += (uint32_t)strlen(recipe->names[c]) + 1 + 16;
    }
    put_attribute(file, "channels", "chlist", size);
    for (int c = 0; c < recipe->channels; c++) {
        put_text(file, recipe->names[c]);
        image_bytes_put_number(file, 2, 4); // float
        image_bytes_put_number(file, 0, 4);
        image_bytes_put_number(file, (uint64_t)step_of(recipe, c), 4);
        image_bytes_put_number(file, (uint64_t)step_of(recipe, c), 4);
    }
    image_bytes_put_number(file, 0, 1);
}

static int rows_of(const exr_recipe *recipe)
{
    return recipe->data[3] - recipe->data[1] + 1;
}

static void put_header(image_bytes *file, const exr_recipe *recipe, bool is_part)
{
    put_channels(file, recipe);
    if (recipe->chromaticities != NULL) {
        put_attribute(file, "chromaticities", "chromaticities", 32);
        for (int i = 0; i < 8; i++) {
            put_float(file, recipe->chromaticities[i]);
        }
    }
    put_attribute(file, "compression", "compression", 1);
    image_bytes_put_number(file, 0, 1);
    put_window(file, "dataWindow", recipe->data);
    put_window(file, "displayWindow", recipe->display);
    if (recipe->envmap >= 0) {
        put_attribute(file, "envmap", "envmap", 1);
        image_bytes_put_number(file, (uint64_t)recipe->envmap, 1);
    }
    put_attribute(file, "lineOrder", "lineOrder", 1);
    image_bytes_put_number(file, 0, 1);
    put_attribute(file, "pixelAspectRatio", "float", 4);
    put_float(file, 1.0f);
    put_attribute(file, "screenWindowCenter", "v2f", 8);
    put_float(file, 0.0f);
    put_float(file, 0.0f);
    put_attribute(file, "screenWindowWidth", "float", 4);
    put_float(file, 1.0f);
    if (is_part) {
        put_attribute(file, "chunkCount", "int", 4);
        image_bytes_put_number(file, (uint64_t)rows_of(recipe), 4);
        put_string(file, "type", "scanlineimage");
    }
    if (recipe->part != NULL) {
        put_string(file, "name", recipe->part);
    }
    image_bytes_put_number(file, 0, 1);
}

// ---- Pixels -------------------------------------------------------------------------------------

// True if a channel has a value at this place of an axis.
static bool is_sampled(int at, int step)
{
    return at % step == 0;
}

static image_bytes row_bytes(const exr_recipe *recipe, int y)
{
    image_bytes row = {0};
    for (int c = 0; c < recipe->channels; c++) {
        const int step = step_of(recipe, c);
        for (int x = recipe->data[0]; x <= recipe->data[2] && is_sampled(y, step); x++) {
            if (is_sampled(x, step)) {
                put_float(&row, recipe->value(c, x, y, recipe->context));
            }
        }
    }
    return row;
}

// Appends one row as a chunk. `part` is the number of its part; −1: the file has one part.
static void put_row(image_bytes *file, const exr_recipe *recipe, int part, int row)
{
    image_bytes values = row_bytes(recipe, recipe->data[1] + row);
    if (part >= 0) {
        image_bytes_put_number(file, (uint64_t)part, 4);
    }
    image_bytes_put_number(file, (uint64_t)(int64_t)(recipe->data[1] + row), 4);
    image_bytes_put_number(file, values.length, 4);
    if (values.length > 0) {
        image_bytes_put(file, values.bytes, values.length);
    }
    image_bytes_free(&values);
}

// Appends the tables of offsets, then the rows of all parts.
static void put_rows(image_bytes *file, const exr_recipe *parts, int count, bool is_multipart)
{
    uint64_t table_rows = 0;
    for (int p = 0; p < count; p++) {
        table_rows += (uint64_t)rows_of(&parts[p]);
    }
    const uint64_t first = file->length + 8 * table_rows;
    image_bytes rows = {0};
    for (int p = 0; p < count; p++) {
        for (int row = 0; row < rows_of(&parts[p]); row++) {
            image_bytes_put_number(file, first + rows.length, 8);
            put_row(&rows, &parts[p], is_multipart ? p : -1, row);
        }
    }
    image_bytes_put(file, rows.bytes, rows.length);
    image_bytes_free(&rows);
}

image_bytes exr_bytes(const exr_recipe *recipe)
{
    image_bytes file = {0};
    image_bytes_put_number(&file, 20000630, 4);
    image_bytes_put_number(&file, 2, 4);
    put_header(&file, recipe, false);
    put_rows(&file, recipe, 1, false);
    return file;
}

image_bytes exr_parts_bytes(const exr_recipe *parts, int count)
{
    image_bytes file = {0};
    image_bytes_put_number(&file, 20000630, 4);
    image_bytes_put_number(&file, 2 | 0x1000, 4);
    for (int p = 0; p < count; p++) {
        put_header(&file, &parts[p], true);
    }
    image_bytes_put_number(&file, 0, 1);
    put_rows(&file, parts, count, true);
    return file;
}
