// Names of a sequence's files: "name.####.exr" stands for name.0001.exr, name.0002.exr, …
#ifndef GLINT_RENDER_FRAME_NAME_H
#define GLINT_RENDER_FRAME_NAME_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

// A path whose last part holds one place for the frame's number: a run of '#', as many as there
// are digits at least, or C's %d, %4d or %04d (zeros fill either).
typedef struct glint_frame_name {
    const char *path;     // borrowed
    size_t place, length; // of the number's place; length 0: the path has none
    int digits;
} glint_frame_name;

// Errors: GLINT_USAGE where there are two places.
glint_status glint_frame_name_parse(const char *path, glint_frame_name *name, glint_error *error);

// The path of a frame, malloc'd; NULL where memory is short. The sign of a negative number stands
// before its zeros. Without a place: the path itself.
char *glint_frame_name_make(const glint_frame_name *name, int frame);

#endif
