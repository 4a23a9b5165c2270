// Parses lists of frames and walks their parts. See frame_list.h.
#include "cli/common/frame_list.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HOW_TO "(write frames as 7, 1-240 or 1-10,20-40x2)"

// ---- Ranges ------------------------------------------------------------------------------------

static int64_t last_of(const glint_frame_range *range)
{
    return range->first + (int64_t)(range->count - 1) * range->step;
}

static int64_t lowest_of(const glint_frame_range *range)
{
    return range->step > 0 ? range->first : last_of(range);
}

static int64_t highest_of(const glint_frame_range *range)
{
    return range->step > 0 ? last_of(range) : range->first;
}

static bool holds(const glint_frame_range *range, int64_t frame)
{
    return frame >= lowest_of(range) && frame <= highest_of(range) &&
           (frame - range->first) % range->step == 0;
}

static bool came_before(const glint_frame_list *list, size_t range, int64_t frame)
{
    for (size_t i = 0; i < range; i++) {
        if (holds(&list->ranges[i], frame)) {
            return true;
        }
    }
    return false;
}

static glint_status append(glint_frame_list *list, glint_frame_range range, glint_error *error)
{
    glint_frame_range *ranges =
        realloc(list->ranges, (list->range_count + 1) * sizeof *list->ranges);
    if (ranges == NULL) {
        return glint_fail_memory(error, "the list of frames");
    }
    list->ranges = ranges;
    for (size_t i = 0; i < list->range_count && !range.overlaps; i++) {
        range.overlaps = lowest_of(&range) <= highest_of(&ranges[i]) &&
                         highest_of(&range) >= lowest_of(&ranges[i]);
    }
    ranges[list->range_count++] = range;
    uint64_t fresh = range.count;
    if (range.overlaps) {
        fresh = 0;
        for (uint64_t i = 0; i < range.count; i++) {
            const int64_t frame = range.first + (int64_t)i * range.step;
            fresh += !came_before(list, list->range_count - 1, frame);
        }
    }
    list->count += fresh;
    return GLINT_OK;
}

// ---- Reading -----------------------------------------------------------------------------------

// Reads the number at *text and moves *text past it. Returns false if there is no number or if it
// is out of range.
static bool read_number(const char **text, int64_t *number)
{
    const char *digits = *text + (**text == '-');
    const size_t length = strspn(digits, "0123456789");
    if (length == 0 || length > 18) {
        return false;
    }
    *number = strtoll(*text, NULL, 10);
    *text = digits + length;
    return *number >= -GLINT_FRAME_MAX && *number <= GLINT_FRAME_MAX;
}

static glint_status fail_number(const char *text, const char *rest, glint_error *error)
{
    return glint_fail(error, GLINT_USAGE,
                      "frames '%s': a number from -%d to %d is expected at '%s' " HOW_TO, text,
                      GLINT_FRAME_MAX, GLINT_FRAME_MAX, rest);
}

static glint_status check_step(const char *text, const glint_frame_range *range, int64_t last,
                               glint_error *error)
{
    if (range->step == 0) {
        return glint_fail(error, GLINT_USAGE, "frames '%s': a step of 0 leads nowhere " HOW_TO,
                          text);
    }
    if (last != range->first && (last > range->first) != (range->step > 0)) {
        return glint_fail(error, GLINT_USAGE,
                          "frames '%s': steps of %lld from %lld never come to %lld (turn the range "
                          "or the step's sign)",
                          text, (long long)range->step, (long long)range->first, (long long)last);
    }
    return GLINT_OK;
}

// Reads one range at *rest and moves *rest past it.
static glint_status read_range(const char *text, const char **rest, glint_frame_range *range,
                               glint_error *error)
{
    *range = (glint_frame_range){.step = 1, .count = 1};
    if (!read_number(rest, &range->first)) {
        return fail_number(text, *rest, error);
    }
    int64_t last = range->first;
    if (**rest == '-') {
        ++*rest;
        if (!read_number(rest, &last)) {
            return fail_number(text, *rest, error);
        }
        range->step = last < range->first ? -1 : 1;
        if (**rest == 'x') {
            ++*rest;
            if (!read_number(rest, &range->step)) {
                return fail_number(text, *rest, error);
            }
        }
    }
    glint_status status = check_step(text, range, last, error);
    if (status == GLINT_OK) {
        range->count = (uint64_t)((last - range->first) / range->step) + 1;
    }
    return status;
}

glint_status glint_frame_list_parse(const char *text, glint_frame_list *list, glint_error *error)
{
    *list = (glint_frame_list){0};
    const char *rest = text;
    glint_status status = GLINT_OK;
    while (status == GLINT_OK) {
        glint_frame_range range;
        status = read_range(text, &rest, &range, error);
        if (status == GLINT_OK && *rest != ',' && *rest != '\0') {
            status = glint_fail(error, GLINT_USAGE, "frames '%s': '%s' makes no sense " HOW_TO,
                                text, rest);
        }
        if (status == GLINT_OK) {
            status = append(list, range, error);
        }
        if (status == GLINT_OK && *rest++ == '\0') {
            return GLINT_OK;
        }
    }
    glint_frame_list_free(list);
    return status;
}

glint_status glint_frame_list_span(int first, int last, glint_frame_list *list, glint_error *error)
{
    *list = (glint_frame_list){0};
    const glint_frame_range range = {
        .first = first, .step = 1, .count = (uint64_t)((int64_t)last - first) + 1};
    return append(list, range, error);
}

void glint_frame_list_free(glint_frame_list *list)
{
    free(list->ranges);
    *list = (glint_frame_list){0};
}

bool glint_frame_list_holds(const glint_frame_list *list, int frame)
{
    return came_before(list, list->range_count, frame);
}

int glint_frame_list_highest(const glint_frame_list *list)
{
    int64_t highest = -GLINT_FRAME_MAX;
    for (size_t i = 0; i < list->range_count; i++) {
        const int64_t own = highest_of(&list->ranges[i]);
        highest = own > highest ? own : highest;
    }
    return (int)highest;
}

// ---- Parts -------------------------------------------------------------------------------------

glint_status glint_shard_parse(const char *text, glint_shard *shard, glint_error *error)
{
    int64_t index = 0, count = 0;
    const char *rest = text;
    if (!read_number(&rest, &index) || *rest++ != '/' || !read_number(&rest, &count) ||
        *rest != '\0' || count < 1 || index < 1 || index > count) {
        return glint_fail(error, GLINT_USAGE,
                          "shard '%s': part I of N is written I/N, with I from 1 to N (as 2/5)",
                          text);
    }
    *shard = (glint_shard){(uint32_t)index, (uint32_t)count};
    return GLINT_OK;
}

uint64_t glint_shard_size(glint_shard shard, uint64_t count)
{
    return count / shard.count + (count % shard.count >= shard.index ? 1 : 0);
}

bool glint_frame_next(glint_frame_cursor *cursor, int *frame)
{
    const glint_frame_list *list = cursor->list;
    for (; cursor->range < list->range_count; cursor->range++, cursor->index = 0) {
        const glint_frame_range *range = &list->ranges[cursor->range];
        while (cursor->index < range->count) {
            const int64_t number = range->first + (int64_t)cursor->index++ * range->step;
            if (range->overlaps && came_before(list, cursor->range, number)) {
                continue;
            }
            if (cursor->ordinal++ % cursor->shard.count == cursor->shard.index - 1) {
                *frame = (int)number;
                return true;
            }
        }
    }
    return false;
}

// ---- Writing -----------------------------------------------------------------------------------

static int compare_frames(const void *a, const void *b)
{
    const int first = *(const int *)a, second = *(const int *)b;
    return (first > second) - (first < second);
}

void glint_frame_list_print(int *frames, size_t count, char *text, size_t capacity)
{
    enum {
        RANGE = 24,
        MORE = 32
    }; // most characters of a range, and of the note about frames that
       // do not fit
    qsort(frames, count, sizeof *frames, compare_frames);
    size_t length = 0, i = 0;
    text[0] = '\0';
    while (i < count && length + RANGE + MORE < capacity) {
        size_t end = i + 1;
        while (end < count && frames[end] == frames[end - 1] + 1) {
            end++;
        }
        const char *comma = i > 0 ? "," : "";
        const int written =
            end > i + 1 ? snprintf(text + length, capacity - length, "%s%d-%d", comma, frames[i],
                                   frames[end - 1])
                        : snprintf(text + length, capacity - length, "%s%d", comma, frames[i]);
        length += (size_t)written;
        i = end;
    }
    if (i < count) {
        snprintf(text + length, capacity - length, " and %zu more", count - i);
    }
}
