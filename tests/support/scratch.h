// A folder for one test's files, and small things to do with files.
#ifndef GLINT_TESTS_SCRATCH_H
#define GLINT_TESTS_SCRATCH_H

#include <stddef.h>

// Makes a new empty folder; its path stays valid until the next call.
const char *scratch_make(void);

// Removes it and all that is in it.
void scratch_remove(void);

// The same as cmocka's setup and teardown of a test; *state is the folder's path.
int scratch_setup(void **state);
int scratch_teardown(void **state);

// The path of `name` in the folder, in one of eight buffers of this thread that take turns.
const char *scratch_path(const char *name);

// Writes bytes; a length of −1 takes the text's own.
void scratch_write(const char *name, const void *bytes, long length);

// Reads a whole file, NULL where there is none; released with free().
unsigned char *scratch_read(const char *name, size_t *length);

// How many entries the folder has.
int scratch_count(void);

#endif
