// Makes memory files: files without a name, in memory, that glint shares with its codec.
#ifndef GLINT_IMAGE_MEMORY_FILE_H
#define GLINT_IMAGE_MEMORY_FILE_H

#include <stdbool.h>
#include <stddef.h>

// A memory file with its mapping. It cannot be made shorter, so the mapping stays valid whatever
// another process does with the file.
typedef struct glint_memory_file {
    int file;
    size_t bytes; // of the mapping
    unsigned char *at;
} glint_memory_file;

// Takes a file of at least this size. Its contents are arbitrary. Uses a file that was given back
// if it is large enough, because making a file takes as long as filling it. False: failed, errno
// says why.
bool glint_memory_file_take(size_t bytes, glint_memory_file *taken);

// Gives the file back for the next use. No other process may still write to it. At most 16 files
// wait; they stay in memory until the process ends.
void glint_memory_file_give_back(const glint_memory_file *taken);

// Frees a file that was taken, instead of giving it back.
void glint_memory_file_free(const glint_memory_file *taken);

#endif
