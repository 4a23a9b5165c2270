// Text that is safe to show on a terminal, whatever a file or its name holds.
#ifndef GLINT_BASE_PLAIN_TEXT_H
#define GLINT_BASE_PLAIN_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// How many bytes the first character of `text` has: 1 to 4 of UTF-8, and 1 where they are not
// UTF-8. 0: more bytes than `length` are needed. *is_plain: whether a terminal shows it and does
// nothing else. Not plain are control characters (C0 with newline and tab, DEL, C1), characters
// that turn the direction of text or break lines, and what is not UTF-8.
size_t glint_character(const char *text, size_t length, bool *is_plain);

// Replaces what is not plain by '?', so that the text is one line.
void glint_make_plain(char *text);

// Whether all characters are plain, or newlines.
bool glint_is_plain(const char *text);

#ifdef __cplusplus
}
#endif

#endif
