// Makes and reads memory files: files without a name, in memory, that glint shares with its codec.
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

// Takes a file of at least this size, one that was given back if there is one: making one takes as
// long as filling it. Its contents are arbitrary. False: failed, errno says why.
bool glint_memory_file_take(size_t bytes, glint_memory_file *taken);

// Gives the file back for the next use. No other process may still write to it.
void glint_memory_file_give_back(const glint_memory_file *taken);

void glint_memory_file_free(const glint_memory_file *taken);

// Reads `bytes` bytes from `offset` on. False if the file is too short.
bool glint_memory_file_read(int file, size_t offset, void *to, size_t bytes);

#endif
