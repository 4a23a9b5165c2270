// Makes image files that broke decoders. See hostile_images.h.
#include "support/hostile_images.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static void put_repeated(image_bytes *file, const void *bytes, size_t length, int times)
{
    for (int i = 0; i < times; i++) {
        image_bytes_put(file, bytes, length);
    }
}

// ---- EXR ----------------------------------------------------------------------------------------

static float half(int channel, int x, int y, void *context)
{
    (void)channel, (void)x, (void)y, (void)context;
    return 0.5f;
}

static const char *const rgb[] = {"B", "G", "R"};

static exr_recipe one_pixel(void)
{
    return (exr_recipe){.names = rgb, .channels = 3, .envmap = -1, .value = half};
}

// One pixel in a display window of 16384 × 16384.
static image_bytes exr_display_window(void)
{
    exr_recipe recipe = one_pixel();
    recipe.display[2] = recipe.display[3] = 16383;
    return exr_bytes(&recipe);
}

// The header declares 16384 × 16384 pixels; the file holds one.
static image_bytes exr_data_window(void)
{
    exr_recipe recipe = one_pixel();
    image_bytes file = exr_bytes(&recipe);
    unsigned char *window = memmem(file.bytes, file.length, "dataWindow", 10);
    const unsigned char corner[] = {0xff, 0x3f, 0, 0, 0xff, 0x3f, 0, 0};
    memcpy(window + strlen("dataWindow") + 1 + strlen("box2i") + 1 + 4 + 8, corner, sizeof corner);
    return file;
}

// The first attribute is 0, and OpenImageIO divides by it.
static image_bytes exr_rows_per_strip(void)
{
    static const char attribute[] = "tiff:RowsPerStrip\0int\0\4\0\0\0\0\0\0";
    enum { VERSION = 8, ROW = 4 + 4 + 3 * 4, PLACE = 8 };
    exr_recipe recipe = one_pixel();
    image_bytes plain = exr_bytes(&recipe), file = {0};
    image_bytes_put(&file, plain.bytes, VERSION);
    image_bytes_put(&file, attribute, sizeof attribute);
    image_bytes_put(&file, plain.bytes + VERSION, plain.length - VERSION - ROW - PLACE);
    image_bytes_put_number(&file, file.length + PLACE, PLACE);
    image_bytes_put(&file, plain.bytes + plain.length - ROW, ROW);
    image_bytes_free(&plain);
    return file;
}

static image_bytes exr_channels(void)
{
    enum { CHANNELS = 60000, NAME = 16 };
    char(*texts)[NAME] = calloc(CHANNELS, sizeof *texts);
    const char **names = calloc(CHANNELS, sizeof *names);
    if (texts == NULL || names == NULL) {
        abort();
    }
    for (int i = 0; i < CHANNELS; i++) {
        snprintf(texts[i], NAME, "%05d.R", i);
        names[i] = texts[i];
    }
    exr_recipe recipe = one_pixel();
    recipe.names = names;
    recipe.channels = CHANNELS;
    image_bytes file = exr_bytes(&recipe);
    free(names);
    free(texts);
    return file;
}

// ---- DDS: Microsoft, "DDS_HEADER structure" -----------------------------------------------------

typedef struct dds_recipe {
    uint32_t flags, height, width, mip_levels, format_flags, bits, caps, caps2;
    const char *code; // four letters
} dds_recipe;

static image_bytes dds_bytes(const dds_recipe *recipe)
{
    image_bytes file = {0};
    const uint32_t fields[] = {124, recipe->flags,     recipe->height, recipe->width, 0,
                               0,   recipe->mip_levels};
    const uint32_t after[] = {recipe->bits, 0, 0, 0, 0, recipe->caps, recipe->caps2, 0, 0, 0};
    image_bytes_put(&file, "DDS ", 4);
    for (size_t i = 0; i < COUNT(fields); i++) {
        image_bytes_put_number(&file, fields[i], 4);
    }
    put_repeated(&file, "", 1, 44);
    image_bytes_put_number(&file, 32, 4);
    image_bytes_put_number(&file, recipe->format_flags, 4);
    image_bytes_put(&file, recipe->code, 4);
    for (size_t i = 0; i < COUNT(after); i++) {
        image_bytes_put_number(&file, after[i], 4);
    }
    put_repeated(&file, "", 1, 1536);
    return file;
}

// A cube of 16 × 16 that declares two thousand million levels.
static image_bytes dds_mip_levels(void)
{
    return dds_bytes(&(dds_recipe){.flags = 0x21007,
                                   .height = 16,
                                   .width = 16,
                                   .mip_levels = 0x7c000001,
                                   .format_flags = 4,
                                   .caps = 0x1008,
                                   .caps2 = 0xfe00,
                                   .code = "DXT5"});
}

// Six levels of 16 × 1. The smaller levels have no rows, and OpenImageIO divides by the number of
// rows.
static image_bytes dds_no_rows(void)
{
    return dds_bytes(&(dds_recipe){.flags = 0x21007,
                                   .height = 1,
                                   .width = 16,
                                   .mip_levels = 6,
                                   .format_flags = 4,
                                   .caps = 0x401008,
                                   .code = "DXT4"});
}

// Uncompressed colours of zero bits.
static image_bytes dds_no_bits(void)
{
    return dds_bytes(&(dds_recipe){.flags = 0x1007,
                                   .height = 16,
                                   .width = 16,
                                   .format_flags = 0x40,
                                   .caps = 0x1000,
                                   .code = "\0\0\0"});
}

static image_bytes dds_bits(void)
{
    return dds_bytes(&(dds_recipe){.flags = 0x1007,
                                   .height = 16,
                                   .width = 16,
                                   .format_flags = 0x40,
                                   .bits = 0x99999999,
                                   .caps = 0x1000,
                                   .code = "\0\0\0"});
}

// ---- TIFF 6.0 -----------------------------------------------------------------------------------

// CMYK in tiles: OpenImageIO 2.4 writes beyond a buffer.
static image_bytes tiff_ink(void)
{
    enum { SHORT = 3, LONG = 4, ENTRIES = 13, TILES = 256, AFTER = 8 + 2 + 12 * ENTRIES + 4 };
    enum { OFFSETS = AFTER + 8, COUNTS = OFFSETS + 4 * TILES, DATA = COUNTS + 4 * TILES };
    static const uint32_t entries[ENTRIES][4] = {
        {256, SHORT, 1, 1024},      {257, SHORT, 1, 1024}, {258, SHORT, 4, AFTER},
        {259, SHORT, 1, 1},         {262, SHORT, 1, 5},    {274, SHORT, 1, 1},
        {277, SHORT, 1, 4},         {284, SHORT, 1, 1},    {317, SHORT, 1, 1},
        {322, SHORT, 1, 64},        {323, SHORT, 1, 64},   {324, LONG, TILES, OFFSETS},
        {325, LONG, TILES, COUNTS},
    };
    image_bytes file = {0};
    image_bytes_put(&file, "II*\0", 4);
    image_bytes_put_number(&file, 8, 4);
    image_bytes_put_number(&file, ENTRIES, 2);
    for (int i = 0; i < ENTRIES; i++) {
        image_bytes_put_number(&file, entries[i][0], 2);
        image_bytes_put_number(&file, entries[i][1], 2);
        image_bytes_put_number(&file, entries[i][2], 4);
        image_bytes_put_number(&file, entries[i][3], 4);
    }
    image_bytes_put_number(&file, 0, 4);
    put_repeated(&file, "\x08\0", 2, 4);
    for (int i = 0; i < TILES; i++) {
        image_bytes_put_number(&file, DATA, 4); // all pointers to the same data
    }
    for (int i = 0; i < TILES; i++) {
        image_bytes_put_number(&file, 64 * 64 * 4, 4);
    }
    put_repeated(&file, "\x7f", 1, 64 * 64 * 4);
    return file;
}

// An image of 30000 × 30000 with nearly all data missing.
static image_bytes tiff_large(void)
{
    static const uint16_t codes[3];
    image_bytes file = tiff_bytes(&(tiff_recipe){1, 1, 3, 16, 0, 1, codes});
    const unsigned char edge[] = {0x30, 0x75};
    memcpy(file.bytes + 8 + 2 + 8, edge, sizeof edge);
    memcpy(file.bytes + 8 + 2 + 12 + 8, edge, sizeof edge);
    put_repeated(&file, "", 1, 60000);
    return file;
}

// ---- JPEG: ITU-T T.81, annex B ------------------------------------------------------------------

// A progressive JPEG of 65500 × 65500: the decoder keeps all coefficients.
static image_bytes jpeg_progressive(void)
{
    image_bytes file = {0};
    static const unsigned char frame[] = {0xff, 0xc2, 0, 17, 8,    0xff, 0xdc, 0xff, 0xdc, 3,
                                          1,    0x11, 0, 2,  0x11, 0,    3,    0x11, 0};
    static const unsigned char scan[] = {0xff, 0xda, 0, 12, 3, 1, 0, 2, 0, 3, 0, 0, 0, 0};
    image_bytes_put(&file, "\xff\xd8\xff\xdb\0\x43\0", 7);
    put_repeated(&file, "\1", 1, 64);
    image_bytes_put(&file, frame, sizeof frame);
    image_bytes_put(&file, "\xff\xc4\0\x14\0\1", 6);
    put_repeated(&file, "", 1, 16);
    image_bytes_put(&file, scan, sizeof scan);
    put_repeated(&file, "", 1, 400);
    image_bytes_put(&file, "\xff\xd9", 2);
    return file;
}

// ---- PNG: W3C, third edition --------------------------------------------------------------------

static uint32_t crc(const unsigned char *bytes, size_t length)
{
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < length; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) {
            sum = sum >> 1 ^ ((sum & 1) != 0 ? UINT32_C(0xedb88320) : 0);
        }
    }
    return ~sum;
}

static void put_chunk(image_bytes *file, const char *type, const image_bytes *data)
{
    image_bytes_put_big(file, data->length, 4);
    const size_t begin = file->length;
    image_bytes_put(file, type, 4);
    image_bytes_put(file, data->length > 0 ? (const void *)data->bytes : "", data->length);
    image_bytes_put_big(file, crc(file->bytes + begin, file->length - begin), 4);
}

// Two mebibytes of metadata in one-letter pieces: OpenImageIO's time grows with the square of their
// number.
static image_bytes png_metadata(void)
{
    image_bytes file = {0}, head = {0}, text = {0}, data = {0}, nothing = {0};
    image_bytes_put(&file, "\x89PNG\r\n\x1a\n", 8);
    image_bytes_put_big(&head, 2, 4);
    image_bytes_put_big(&head, 1, 4);
    image_bytes_put(&head, "\x08\x02\0\0\0", 5);
    put_chunk(&file, "IHDR", &head);
    static const char begin[] = "XML:com.adobe.xmp\0\0\0\0\0<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
                                "<rdf:RDF><rdf:Description>";
    image_bytes_put(&text, begin, sizeof begin - 1);
    for (int i = 0; i < 90000; i++) {
        char piece[64];
        const int length = snprintf(piece, sizeof piece, "<a:k%d>x</a:k%d>", i, i);
        image_bytes_put(&text, piece, (size_t)length);
    }
    static const char end[] = "</rdf:Description></rdf:RDF></x:xmpmeta>";
    image_bytes_put(&text, end, sizeof end - 1);
    put_chunk(&file, "iTXt", &text);
    // A stored block of seven bytes: no filter, and two pixels.
    image_bytes_put(&data, "\x78\x01\x01\x07\0\xf8\xff\0\0\0\0\0\0\0\0\x07\0\x01", 18);
    put_chunk(&file, "IDAT", &data);
    put_chunk(&file, "IEND", &nothing);
    image_bytes_free(&head);
    image_bytes_free(&text);
    image_bytes_free(&data);
    return file;
}

const hostile_image hostile_images[] = {
    {"display.exr", exr_display_window, "16384 × 16384 pixels take"},
    {"data.exr", exr_data_window, "("},
    {"strip.exr", exr_rows_per_strip, "the decoder failed on it"},
    {"channels.exr", exr_channels, "60000 channels"},
    {"levels.dds", dds_mip_levels, "to decode"},
    {"rows.dds", dds_no_rows, "the decoder failed on it"},
    {"no_bits.dds", dds_no_bits, "to decode"},
    {"bits.dds", dds_bits, "("},
    {"ink.tif", tiff_ink, "the decoder failed on it"},
    {"large.tif", tiff_large, "30000 × 30000 pixels"},
    {"progressive.jpg", jpeg_progressive, "("},
    {"metadata.png", png_metadata, "to decode"},
};
const size_t hostile_image_count = COUNT(hostile_images);
