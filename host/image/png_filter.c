// Filters rows of a PNG. See png_filter.h.
#include "image/png_filter.h"

#include <stdint.h>
#include <stdlib.h>

typedef enum filter { NONE, SUB, UP, AVERAGE, PAETH, FILTERS } filter;

// Predicts a byte from its neighbours: the one that is nearest to left + above − corner. No
// branches, so that the compiler computes several bytes at once.
static inline int paeth(int left, int above, int corner)
{
    const int by_left = abs(above - corner), by_above = abs(left - corner);
    const int by_corner = abs(left + above - 2 * corner);
    const int of_two = by_above <= by_corner ? above : corner;
    return (by_left <= by_above) & (by_left <= by_corner) ? left : of_two;
}

static inline int predict(filter by, int left, int above, int corner)
{
    switch (by) {
    case SUB:
        return left;
    case UP:
        return above;
    case AVERAGE:
        return (left + above) >> 1;
    case PAETH:
        return paeth(left, above, corner);
    default:
        return 0;
    }
}

// A row with its neighbours.
typedef struct row {
    const unsigned char *at, *left, *above, *corner;
    size_t bytes;
} row;

// Sum of the filtered bytes' magnitudes as signed numbers.
static inline uint64_t sum_by(filter by, const row *r)
{
    uint64_t sum = 0;
    for (size_t begin = 0; begin < r->bytes; begin += 4096) {
        const size_t end = r->bytes - begin < 4096 ? r->bytes : begin + 4096;
        uint32_t part = 0;
        for (size_t i = begin; i < end; i++) {
            const int8_t value =
                (int8_t)(r->at[i] - predict(by, r->left[i], r->above[i], r->corner[i]));
            part += (uint32_t)abs(value);
        }
        sum += part;
    }
    return sum;
}

static inline void write_by(filter by, const row *r, unsigned char *restrict to)
{
    to[0] = (unsigned char)by;
    for (size_t i = 0; i < r->bytes; i++) {
        to[1 + i] = (unsigned char)(r->at[i] - predict(by, r->left[i], r->above[i], r->corner[i]));
    }
}

void glint_png_filter(const unsigned char *line, const unsigned char *line_above, size_t bytes,
                      size_t pixel_bytes, unsigned char *to)
{
    const row r = {line + pixel_bytes, line, line_above + pixel_bytes, line_above, bytes};
    // Calls with constants: each becomes a loop of its own.
    const uint64_t sums[FILTERS] = {sum_by(NONE, &r), sum_by(SUB, &r), sum_by(UP, &r),
                                    sum_by(AVERAGE, &r), sum_by(PAETH, &r)};
    filter best = NONE;
    for (filter by = SUB; by < FILTERS; by++) {
        best = sums[by] < sums[best] ? by : best;
    }
    switch (best) {
    case SUB:
        write_by(SUB, &r, to);
        break;
    case UP:
        write_by(UP, &r, to);
        break;
    case AVERAGE:
        write_by(AVERAGE, &r, to);
        break;
    case PAETH:
        write_by(PAETH, &r, to);
        break;
    default:
        write_by(NONE, &r, to);
    }
}
