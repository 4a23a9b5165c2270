// Texts within XML and HTML.
#ifndef GLINT_REPORT_SPEED_ERROR_MARKUP_H
#define GLINT_REPORT_SPEED_ERROR_MARKUP_H

#include <stdio.h>

// Writes any bytes as text or within double quotes: what is markup is escaped; what is no UTF-8,
// and control characters, become '?'. NULL is nothing.
void glint_markup_text(FILE *out, const char *bytes);

#endif
