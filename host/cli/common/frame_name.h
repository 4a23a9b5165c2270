// Makes the names of a sequence's files: "name.####.exr" stands for name.0001.exr, name.0002.exr, …
#ifndef GLINT_CLI_COMMON_FRAME_NAME_H
#define GLINT_CLI_COMMON_FRAME_NAME_H

#include "base/status.h"

#include <stddef.h>

// A path whose last part may hold one placeholder for the frame number. It is a run of '#', whose
// length is the least number of digits, or C's %d, %4d or %04d. All of them fill with zeros. A
// backslash escapes: "\#1" is "#1", "\%d" is "%d", and "\\#" a backslash before a placeholder.
// Elsewhere backslashes stand for themselves. Zero is valid: no name.
typedef struct glint_frame_name {
    char *path;           // without the backslashes that escape; owned
    size_t place, length; // of the placeholder in `path`; length 0: there is none
    int digits;
    size_t written_at; // where the placeholder, with its backslashes, stood in the parsed text
} glint_frame_name;

// Parses a path. *name must be empty. Errors: GLINT_USAGE if it has two placeholders,
// GLINT_OUT_OF_MEMORY.
glint_status glint_frame_name_parse(const char *path, glint_frame_name *name, glint_error *error);

// The same for an input: if a file of exactly this name exists, the name has no placeholder.
glint_status glint_frame_name_parse_input(const char *path, glint_frame_name *name,
                                          glint_error *error);

void glint_frame_name_free(glint_frame_name *name);

// The path of a frame, malloc'd; NULL if there is too little memory. The sign of a negative number
// stands before its zeros. Without a placeholder, returns a copy of the path.
char *glint_frame_name_make(const glint_frame_name *name, int frame);

// Fails with GLINT_USAGE, because a name has a placeholder and nothing says which frames to make.
// `way_out` is "name them with --frames 1-24".
glint_status glint_frame_name_refuse(const glint_frame_name *name, const char *way_out,
                                     glint_error *error);

#endif
