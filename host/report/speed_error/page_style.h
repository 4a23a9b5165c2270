// Declares the style sheet of the page: for light and dark screens, as the reader prefers, and for
// paper.
#ifndef GLINT_REPORT_SPEED_ERROR_PAGE_STYLE_H
#define GLINT_REPORT_SPEED_ERROR_PAGE_STYLE_H

extern const char glint_page_style[]; // CSS

#endif
