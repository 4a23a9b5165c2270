// Makes text safe to show on a terminal: a file or its name may hold any bytes.
#ifndef GLINT_BASE_PLAIN_TEXT_H
#define GLINT_BASE_PLAIN_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns the length in bytes of the first character of `text`: 1 to 4 for UTF-8, 1 for a byte that
// is not UTF-8. 0: the character needs more than `length` bytes. *is_plain: a terminal shows the
// character and does nothing else. Not plain: control characters (C0 with newline and tab, DEL,
// C1), characters that change the direction of text or break lines, and bytes that are not UTF-8.
size_t glint_character(const char *text, size_t length, bool *is_plain);

// Replaces each character that is not plain by '?', so that the text is one line.
void glint_make_plain(char *text);

// True if every character is plain or a newline.
bool glint_is_plain(const char *text);

#ifdef __cplusplus
}
#endif

#endif
