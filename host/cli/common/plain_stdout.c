// Filters standard output to plain text. See plain_stdout.h.
#include "cli/common/plain_stdout.h"

#include "base/plain_text.h"
#include "base/whole_io.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static struct {
    char kept[4]; // an incomplete character; the next write continues it
    size_t kept_length;
    int fault; // errno of the first failed write
} output;

static bool write_bytes(const char *bytes, size_t length)
{
    if (!glint_write_all(STDOUT_FILENO, bytes, length)) {
        output.fault = output.fault != 0 ? output.fault : errno;
        return false;
    }
    return true;
}

// Copies from[length] to `to` with '?' for what is not plain. Returns the bytes written. *left is
// the length of an incomplete character at the end.
static size_t copy_plain(const char *from, size_t length, char *to, size_t *left)
{
    size_t written = 0;
    while (length > 0) {
        bool is_plain;
        const size_t taken = glint_character(from, length, &is_plain);
        if (taken == 0) {
            break;
        }
        if (is_plain || *from == '\n') {
            memcpy(to + written, from, taken);
            written += taken;
        } else {
            to[written++] = '?';
        }
        from += taken;
        length -= taken;
    }
    *left = length;
    return written;
}

static ssize_t write_plain(void *unused, const char *bytes, size_t length)
{
    (void)unused;
    char joined[4096], plain[4096];
    for (size_t done = 0; done < length;) {
        const size_t room = sizeof joined - output.kept_length;
        const size_t now = length - done < room ? length - done : room;
        memcpy(joined, output.kept, output.kept_length);
        memcpy(joined + output.kept_length, bytes + done, now);
        const size_t total = output.kept_length + now;
        const size_t written = copy_plain(joined, total, plain, &output.kept_length);
        memcpy(output.kept, joined + total - output.kept_length, output.kept_length);
        if (!write_bytes(plain, written)) {
            return 0; // stdio takes 0 as an error
        }
        done += now;
    }
    return (ssize_t)length;
}

void glint_plain_stdout_begin(void)
{
    FILE *plain = fopencookie(NULL, "w", (cookie_io_functions_t){.write = write_plain});
    if (plain != NULL) {
        setvbuf(plain, NULL, isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF, BUFSIZ);
        stdout = plain;
    }
}

glint_status glint_plain_stdout_end(glint_error *error)
{
    errno = 0;
    const bool is_written = fflush(stdout) == 0 && !ferror(stdout);
    const int fault = output.fault != 0 ? output.fault : errno;
    if (!is_written && fault != EPIPE) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "standard output: %s",
                          fault != 0 ? strerror(fault) : "it could not be written");
    }
    return GLINT_OK;
}
