// Escapes texts for XML and HTML.
#ifndef GLINT_REPORT_SPEED_ERROR_MARKUP_H
#define GLINT_REPORT_SPEED_ERROR_MARKUP_H

#include <stdio.h>

// Writes any bytes as text or within double quotes. Escapes markup; control characters and bytes
// that are not valid UTF-8 become '?'. NULL writes nothing.
void glint_markup_text(FILE *out, const char *bytes);

#endif
