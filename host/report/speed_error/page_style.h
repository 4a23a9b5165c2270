// What the page looks like: on a screen, light or dark as its reader has it, and on paper.
#ifndef GLINT_REPORT_SPEED_ERROR_PAGE_STYLE_H
#define GLINT_REPORT_SPEED_ERROR_PAGE_STYLE_H

extern const char glint_page_style[]; // CSS

#endif
