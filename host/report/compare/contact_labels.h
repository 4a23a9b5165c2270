// Names the images of a contact sheet: by their frames' numbers, or by their names.
#ifndef GLINT_REPORT_COMPARE_CONTACT_LABELS_H
#define GLINT_REPORT_COMPARE_CONTACT_LABELS_H

#include "base/status.h"

#include <stddef.h>

#define GLINT_CONTACT_LABEL 64 // bytes

// Makes the labels of `count` image files. A label is the last part of the path without its
// extension, or the frame's number in it. These numbers are frames' numbers:
//
// - the only number of a name that differs from another name of the list ("turn_0001.png" beside
//   "turn_0002.png", as for "turn_####.png");
// - otherwise, a number between a dot and the extension ("turn.0001.png").
//
// If two different names would get the same number, both labels are the names. Errors:
// GLINT_OUT_OF_MEMORY.
glint_status glint_contact_labels(const char *const *paths, size_t count,
                                  char (*labels)[GLINT_CONTACT_LABEL], glint_error *error);

#endif
