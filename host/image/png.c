// Encodes PNG files. See png.h.
//
// The rows are cut into blocks. Threads convert and filter the blocks, then compress them. A block
// continues the one before: its compressor knows the last 32 KiB of that, and flushes at its own
// end. So the blocks are one stream for a reader, and each is an IDAT chunk.
#include "image/png.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "image/description.h"
#include "image/png_filter.h"

#include <limits.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#define BLOCK_BYTES ((size_t)256 << 10) // of filtered rows, about; costs 0.1 % of the file's size
#define WINDOW ((size_t)32 << 10)       // the distance that deflate looks back
#define LEVEL 2        // three times as fast as zlib's default; files are some percent larger
#define CHUNK_FRAME 12 // bytes of a chunk beside its data: length, type and checksum

// The compressed bytes of a block, as a chunk.
typedef struct block {
    unsigned char *chunk;
    size_t size;    // of the chunk
    uint32_t adler; // checksum of the filtered bytes
    size_t filtered_bytes;
} block;

typedef struct encoding {
    const glint_file_values *values;
    size_t row_bytes;  // of pixels
    size_t block_rows; // rows of a block; the last block may have fewer
    size_t block_count;
    int level;
    unsigned char *filtered; // [height][1 + row_bytes]
    block *blocks;
    atomic_bool is_short_of_memory;
} encoding;

static size_t rows_of(const encoding *e, size_t index)
{
    const size_t left = (size_t)e->values->image->height - index * e->block_rows;
    return left < e->block_rows ? left : e->block_rows;
}

// ---- Chunks -------------------------------------------------------------------------------------

static unsigned char *put_number(unsigned char *to, uint32_t number)
{
    for (int shift = 24; shift >= 0; shift -= 8) {
        *to++ = (unsigned char)(number >> shift);
    }
    return to;
}

// Completes a chunk whose data, `size` bytes, is at to + 8. Returns its end.
static unsigned char *finish_chunk(unsigned char *to, const char type[5], size_t size)
{
    put_number(to, (uint32_t)size);
    memcpy(to + 4, type, 4);
    const uint32_t checksum = (uint32_t)crc32(0, to + 4, (uInt)(4 + size));
    return put_number(to + 8 + size, checksum);
}

static unsigned char *put_chunk(unsigned char *to, const char type[5], const void *data,
                                size_t size)
{
    memcpy(to + 8, data, size);
    return finish_chunk(to, type, size);
}

// ---- Blocks -------------------------------------------------------------------------------------

// Converts a block's rows, with the row above them, and filters them.
static void filter_block(size_t index, void *context)
{
    encoding *e = context;
    const size_t first = index * e->block_rows, rows = rows_of(e, index);
    const size_t pixel_bytes = e->values->pixel_bytes, pitch = pixel_bytes + e->row_bytes;
    unsigned char *lines = glint_allocate(2, pitch);
    if (lines == NULL) {
        atomic_store(&e->is_short_of_memory, true);
        return;
    }
    unsigned char *above = lines, *line = lines + pitch;
    if (first > 0) {
        glint_file_values_fill(e->values, (int)first - 1, 1, above + pixel_bytes);
    }
    for (size_t row = first; row < first + rows; row++) {
        glint_file_values_fill(e->values, (int)row, 1, line + pixel_bytes);
        glint_png_filter(line, above, e->row_bytes, pixel_bytes,
                         e->filtered + row * (1 + e->row_bytes));
        unsigned char *done = above;
        above = line;
        line = done;
    }
    free(lines);
}

// Compresses `from` to `to`, which has room for `room` bytes. Returns the compressed bytes; 0
// without memory.
static size_t compress_block(const encoding *e, size_t index, unsigned char *to, size_t room)
{
    const size_t begin = index * e->block_rows * (1 + e->row_bytes);
    const size_t known = begin < WINDOW ? begin : WINDOW;
    z_stream stream = {0};
    // Without a header, which the whole stream has once
    if (deflateInit2(&stream, e->level, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        return 0;
    }
    if (known > 0) {
        deflateSetDictionary(&stream, e->filtered + begin - known, (uInt)known);
    }
    stream.next_in = e->filtered + begin;
    stream.avail_in = (uInt)e->blocks[index].filtered_bytes;
    stream.next_out = to;
    stream.avail_out = (uInt)room;
    const bool is_last = index + 1 == e->block_count;
    const int result = deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
    const bool is_done = result == (is_last ? Z_STREAM_END : Z_OK) && stream.avail_out > 0;
    deflateEnd(&stream);
    return is_done ? room - stream.avail_out : 0;
}

// Makes a block's chunk. The first begins with zlib's header. The last has room for its checksum.
static void make_chunk(size_t index, void *context)
{
    encoding *e = context;
    block *made = &e->blocks[index];
    made->filtered_bytes = rows_of(e, index) * (1 + e->row_bytes);
    const unsigned char *from = e->filtered + index * e->block_rows * (1 + e->row_bytes);
    const size_t header = index == 0 ? 2 : 0, trailer = index + 1 == e->block_count ? 4 : 0;
    const size_t room = deflateBound(NULL, made->filtered_bytes) + 16; // and a flush
    made->chunk = glint_allocate_unset(CHUNK_FRAME + header + room + trailer, 1);
    if (made->chunk == NULL) {
        atomic_store(&e->is_short_of_memory, true);
        return;
    }
    if (header > 0) {
        memcpy(made->chunk + 8, "\x78\x01", header); // a window of 32 KiB, fast compression
    }
    const size_t compressed = compress_block(e, index, made->chunk + 8 + header, room);
    if (compressed == 0) {
        atomic_store(&e->is_short_of_memory, true);
    }
    made->adler = (uint32_t)adler32(1, from, (uInt)made->filtered_bytes);
    made->size = CHUNK_FRAME + header + compressed + trailer;
    if (trailer == 0) {
        finish_chunk(made->chunk, "IDAT", header + compressed);
    }
}

// Writes the checksum of the whole stream to the last chunk.
static void finish_last_chunk(const encoding *e)
{
    block *last = &e->blocks[e->block_count - 1];
    uLong adler = 1;
    for (size_t i = 0; i < e->block_count; i++) {
        adler = adler32_combine(adler, e->blocks[i].adler, (z_off_t)e->blocks[i].filtered_bytes);
    }
    put_number(last->chunk + last->size - 8, (uint32_t)adler);
    finish_chunk(last->chunk, "IDAT", last->size - CHUNK_FRAME);
}

// ---- The file -----------------------------------------------------------------------------------

#define SIGNATURE "\x89PNG\r\n\x1a\n"
#define TITLE "Description"
#define HEAD_BYTES (8 + 4 * CHUNK_FRAME + 13 + 4 + 1 + 32)

static unsigned char *put_header(const glint_file_values *values, unsigned char *to)
{
    // The primaries of Rec. 709 and their white, x and y in 1/100000
    static const uint32_t primaries[8] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
    static const unsigned char color_types[5] = {0, 0, 4, 2, 6}; // by the number of channels
    unsigned char data[32];
    put_number(data, (uint32_t)values->image->width);
    put_number(data + 4, (uint32_t)values->image->height);
    const unsigned char rest[5] = {8, color_types[values->channels]};
    memcpy(data + 8, rest, sizeof rest);
    memcpy(to, SIGNATURE, 8);
    to = put_chunk(to + 8, "IHDR", data, 13);
    put_number(data, 45455); // 1/2.2, for readers that do not know sRGB
    to = put_chunk(to, "gAMA", data, 4);
    to = put_chunk(to, "sRGB", "\x03", 1);
    for (int i = 0; i < 8; i++) {
        put_number(data + 4 * i, primaries[i]);
    }
    return put_chunk(to, "cHRM", data, 32);
}

static glint_status assemble(const encoding *e, const char *description, glint_encoded *encoded,
                             glint_error *error)
{
    const size_t text_bytes = sizeof TITLE + strlen(description); // the title with its zero
    size_t size = HEAD_BYTES + CHUNK_FRAME + text_bytes + CHUNK_FRAME;
    for (size_t i = 0; i < e->block_count; i++) {
        size += e->blocks[i].size;
    }
    encoded->bytes = malloc(size);
    if (encoded->bytes == NULL) {
        return glint_fail_memory(error, "an encoded image");
    }
    unsigned char *to = put_header(e->values, encoded->bytes);
    if (description[0] != '\0') {
        memcpy(to + 8, TITLE, sizeof TITLE);
        memcpy(to + 8 + sizeof TITLE, description, strlen(description));
        to = finish_chunk(to, "tEXt", text_bytes);
    }
    for (size_t i = 0; i < e->block_count; i++) {
        memcpy(to, e->blocks[i].chunk, e->blocks[i].size);
        to += e->blocks[i].size;
    }
    to = put_chunk(to, "IEND", "", 0);
    encoded->size = (size_t)(to - encoded->bytes);
    return GLINT_OK;
}

// Makes the chunks of all blocks.
static bool compress_all(encoding *e, size_t threads)
{
    size_t bytes;
    if (!glint_multiply((size_t)e->values->image->height, 1 + e->row_bytes, &bytes)) {
        return false;
    }
    e->filtered = glint_allocate_unset(bytes, 1);
    e->blocks = glint_allocate(e->block_count, sizeof *e->blocks);
    if (e->filtered == NULL || e->blocks == NULL) {
        return false;
    }
    glint_parallel_for_on(threads, e->block_count, filter_block, e);
    if (!atomic_load(&e->is_short_of_memory)) {
        glint_parallel_for_on(threads, e->block_count, make_chunk, e);
    }
    if (atomic_load(&e->is_short_of_memory)) {
        return false;
    }
    finish_last_chunk(e);
    return true;
}

static void encoding_free(encoding *e)
{
    for (size_t i = 0; e->blocks != NULL && i < e->block_count; i++) {
        free(e->blocks[i].chunk);
    }
    free(e->blocks);
    free(e->filtered);
}

glint_status glint_png_encode(const char *path, const glint_file_values *values, size_t threads,
                              glint_encoded *encoded, glint_error *error)
{
    const char *level = values->options->compression;
    encoding e = {.values = values,
                  .row_bytes = (size_t)values->image->width * values->pixel_bytes,
                  .level = level != NULL ? atoi(level) : LEVEL};
    e.block_rows = BLOCK_BYTES / (1 + e.row_bytes) + 1;
    e.block_count = ((size_t)values->image->height + e.block_rows - 1) / e.block_rows;
    if (e.row_bytes > INT_MAX / 2) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: is too wide for a PNG (try .exr)", path);
    }
    char *description = glint_description_make(values->options);
    glint_status status = GLINT_OK;
    if (description == NULL || !compress_all(&e, threads)) {
        status = glint_fail(error, GLINT_OUTPUT_FAILED, "%s: not enough memory to encode it", path);
    } else {
        status = assemble(&e, description, encoded, error);
    }
    encoding_free(&e);
    free(description);
    return status;
}
