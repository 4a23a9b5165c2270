// Makes text safe to show. See plain_text.h.
#include "base/plain_text.h"

#include <stdint.h>
#include <string.h>

// Characters that no terminal should get: control characters, direction marks (Unicode's
// bidirectional algorithm, UAX #9), separators of lines and paragraphs, annotations, surrogates.
static const uint32_t forbidden[][2] = {
    {0x00, 0x1f},     {0x7f, 0x9f},     {0x061c, 0x061c}, {0x200e, 0x200f},
    {0x2028, 0x202e}, {0x2066, 0x2069}, {0xd800, 0xdfff}, {0xfff9, 0xfffb},
};

static bool is_forbidden(uint32_t character)
{
    for (size_t i = 0; i < sizeof forbidden / sizeof forbidden[0]; i++) {
        if (character >= forbidden[i][0] && character <= forbidden[i][1]) {
            return true;
        }
    }
    return false;
}

// The length of a UTF-8 character by its first byte; 0: no character begins with this byte.
static size_t length_of(unsigned char first)
{
    return first < 0x80                    ? 1
           : first >= 0xc2 && first < 0xe0 ? 2
           : first >= 0xe0 && first < 0xf0 ? 3
           : first >= 0xf0 && first < 0xf5 ? 4
                                           : 0;
}

size_t glint_character(const char *text, size_t length, bool *is_plain)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000}; // below: overlong, refused
    *is_plain = false;
    if (length == 0) {
        return 0;
    }
    const unsigned char *bytes = (const unsigned char *)text;
    const size_t wanted = length_of(bytes[0]);
    if (wanted < 2) {
        *is_plain = wanted == 1 && !is_forbidden(bytes[0]);
        return 1;
    }
    uint32_t character = bytes[0] & (0x7fu >> wanted);
    for (size_t i = 1; i < wanted; i++) {
        if (i == length) {
            return 0;
        }
        if ((bytes[i] & 0xc0) != 0x80) {
            return 1;
        }
        character = character << 6 | (bytes[i] & 0x3fu);
    }
    if (character < least[wanted] || character > 0x10ffff) {
        return 1;
    }
    *is_plain = !is_forbidden(character);
    return wanted;
}

void glint_make_plain(char *text)
{
    char *to = text;
    for (size_t left = strlen(text); left > 0;) {
        bool is_plain;
        size_t length = glint_character(text, left, &is_plain);
        length = length > 0 ? length : 1;
        if (is_plain) {
            memmove(to, text, length);
            to += length;
        } else {
            *to++ = '?';
        }
        text += length;
        left -= length;
    }
    *to = '\0';
}

bool glint_is_plain(const char *text)
{
    for (size_t left = strlen(text); left > 0;) {
        bool is_plain;
        const size_t length = glint_character(text, left, &is_plain);
        if (length == 0 || (!is_plain && *text != '\n')) {
            return false;
        }
        text += length;
        left -= length;
    }
    return true;
}
