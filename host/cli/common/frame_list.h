// Parses and walks the lists of frames to render, and divides them between machines.
#ifndef GLINT_CLI_COMMON_FRAME_LIST_H
#define GLINT_CLI_COMMON_FRAME_LIST_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_FRAME_MAX 999999999 // frames are numbered from −this to this

// The frames first, first + step, …: `count` frames.
typedef struct glint_frame_range {
    int64_t first, step;
    uint64_t count;
    bool overlaps; // an earlier range of the list may hold some of these frames
} glint_frame_range;

// Frames in the requested order, each once. Takes memory for ranges, not for frames. Zero is valid
// and empty.
typedef struct glint_frame_list {
    size_t range_count;
    glint_frame_range *ranges; // owned
    uint64_t count;            // number of different frames
} glint_frame_list;

// Parses a list, separated by commas, of frames "7", ranges "1-240", and ranges with steps
// "20-40x2", "48-1x-1". A range without a step may run down. Numbers may be negative: "-5--1".
// Errors: GLINT_USAGE; the list is then empty.
glint_status glint_frame_list_parse(const char *text, glint_frame_list *list, glint_error *error);

// Makes a list of the frames from `first` to `last`.
glint_status glint_frame_list_span(int first, int last, glint_frame_list *list, glint_error *error);

void glint_frame_list_free(glint_frame_list *list);

bool glint_frame_list_holds(const glint_frame_list *list, int frame);

// The highest frame of a list that is not empty.
int glint_frame_list_highest(const glint_frame_list *list);

// Part `index` of `count` parts, counted from 1: every count-th frame of the list. So neighbours,
// which take about the same time, go to different parts. {1, 1} is the whole list.
typedef struct glint_shard {
    uint32_t index, count;
} glint_shard;

// Parses a part, written as "2/5". Errors: GLINT_USAGE.
glint_status glint_shard_parse(const char *text, glint_shard *shard, glint_error *error);

// The number of frames in a part of a list of `count` frames.
uint64_t glint_shard_size(glint_shard shard, uint64_t count);

// A walk over one part of a list. The caller sets list and shard; the rest is zero.
typedef struct glint_frame_cursor {
    const glint_frame_list *list;
    glint_shard shard;
    size_t range;
    uint64_t index;   // in the range
    uint64_t ordinal; // number of different frames so far, in all parts
} glint_frame_cursor;

// Sets *frame to the next frame. Returns false at the end.
bool glint_frame_next(glint_frame_cursor *cursor, int *frame);

// Writes the frames, sorted in place, into `text` as a list like "3,7-9,20". Counts the frames that
// do not fit: "3,7-9 and 12 more".
void glint_frame_list_print(int *frames, size_t count, char *text, size_t capacity);

#endif
