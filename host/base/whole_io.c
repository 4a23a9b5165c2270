// Reads and writes all bytes that were asked for. See whole_io.h.
#include "base/whole_io.h"

#include <errno.h>
#include <sys/types.h>
#include <unistd.h>

// Adds what a call returned to *sum. Returns false if no further call helps. `cause` is the errno
// of a call that did nothing.
static bool goes_on(ssize_t done, int cause, size_t *sum)
{
    if (done == 0) {
        errno = cause;
    } else if (done > 0) {
        *sum += (size_t)done;
    }
    return done > 0 || (done < 0 && errno == EINTR);
}

bool glint_read_all(int file, void *to, size_t bytes)
{
    size_t sum = 0;
    while (sum < bytes && goes_on(read(file, (char *)to + sum, bytes - sum), 0, &sum)) {
    }
    return sum == bytes;
}

bool glint_read_all_at(int file, uint64_t offset, void *to, size_t bytes)
{
    size_t sum = 0;
    while (sum < bytes &&
           goes_on(pread(file, (char *)to + sum, bytes - sum, (off_t)(offset + sum)), 0, &sum)) {
    }
    return sum == bytes;
}

bool glint_write_all(int file, const void *from, size_t bytes)
{
    size_t sum = 0;
    while (sum < bytes && goes_on(write(file, (const char *)from + sum, bytes - sum), EIO, &sum)) {
    }
    return sum == bytes;
}

bool glint_write_all_at(int file, uint64_t offset, const void *from, size_t bytes)
{
    size_t sum = 0;
    while (sum < bytes &&
           goes_on(pwrite(file, (const char *)from + sum, bytes - sum, (off_t)(offset + sum)), EIO,
                   &sum)) {
    }
    return sum == bytes;
}
