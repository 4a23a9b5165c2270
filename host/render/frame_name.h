// Makes the names of a sequence's files: "name.####.exr" stands for name.0001.exr, name.0002.exr, …
#ifndef GLINT_RENDER_FRAME_NAME_H
#define GLINT_RENDER_FRAME_NAME_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

// A path whose last part may hold one placeholder for the frame number. It is a run of '#', whose
// length is the least number of digits, or C's %d, %4d or %04d. All of them fill with zeros.
typedef struct glint_frame_name {
    const char *path;     // borrowed
    size_t place, length; // of the placeholder; length 0: there is none
    int digits;
} glint_frame_name;

// Parses a path. Errors: GLINT_USAGE if it has two placeholders.
glint_status glint_frame_name_parse(const char *path, glint_frame_name *name, glint_error *error);

// The path of a frame, malloc'd; NULL if there is too little memory. The sign of a negative number
// stands before its zeros. Without a placeholder, returns a copy of the path.
char *glint_frame_name_make(const glint_frame_name *name, int frame);

#endif
