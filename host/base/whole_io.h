// Reads and writes all bytes that were asked for: read() and write() may stop early, or at a
// signal.
#ifndef GLINT_BASE_WHOLE_IO_H
#define GLINT_BASE_WHOLE_IO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Each returns false if not all bytes could be read or written; errno says why (0: the file ends
// before). Those with an offset leave the file's position as it is.
bool glint_read_all(int file, void *to, size_t bytes);
bool glint_read_all_at(int file, uint64_t offset, void *to, size_t bytes);
bool glint_write_all(int file, const void *from, size_t bytes);
bool glint_write_all_at(int file, uint64_t offset, const void *from, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
