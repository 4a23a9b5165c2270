// The machine that a measurement is made on, and when: what a reader of the figures has to know.
#ifndef GLINT_REPORT_MACHINE_H
#define GLINT_REPORT_MACHINE_H

#include <stdint.h>

typedef struct glint_machine {
    char cpu[128];    // the model's name; "" where it is not known
    char system[256]; // "Linux 6.1.0 x86_64"
    char host[65];    // its name in the network; "" where it is not known
    int cores;        // that this process may use
    double load;      // processes that ran or waited to, mean of the last minute; NaN: not known
    char date[32];    // UTC, ISO 8601: "2024-05-01T12:00:00Z"
} glint_machine;

// As it is now.
void glint_machine_describe(glint_machine *machine);

// The most memory that this process has held so far, 0 where it is not known.
uint64_t glint_peak_resident_bytes(void);

#endif
