// Escapes texts for XML and HTML. See markup.h.
#include "report/speed_error/markup.h"

#include "report/json.h"

void glint_markup_text(FILE *out, const char *bytes)
{
    json_t *valid = glint_json_text(bytes);
    const char *text = json_is_string(valid) ? json_string_value(valid) : "";
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        switch (c) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        case '\n':
            fputs("&#10;", out);
            break;
        default:
            fputc(c < 0x20 ? '?' : c, out);
        }
    }
    json_decref(valid);
}
