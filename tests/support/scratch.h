// Makes a folder for the files of one test, and reads and writes files in it.
#ifndef GLINT_TESTS_SCRATCH_H
#define GLINT_TESTS_SCRATCH_H

#include <stddef.h>

// Makes a new empty folder; its path stays valid until the next call.
const char *scratch_make(void);

// Removes the folder and its content.
void scratch_remove(void);

// scratch_make and scratch_remove as cmocka's setup and teardown; *state is the path of the folder.
int scratch_setup(void **state);
int scratch_teardown(void **state);

// Returns the path of `name` in the folder, in one of eight buffers that this thread uses in turn.
const char *scratch_path(const char *name);

// Writes bytes; with length −1 the length of the text.
void scratch_write(const char *name, const void *bytes, long length);

// Reads a whole file; NULL if there is none. Release it with free().
unsigned char *scratch_read(const char *name, size_t *length);

// Counts the entries of the folder.
int scratch_count(void);

#endif
