// Describes the machine and the date of a measurement.
#ifndef GLINT_REPORT_MACHINE_H
#define GLINT_REPORT_MACHINE_H

#include <stdint.h>

// What readers of a measurement must know about the machine.
typedef struct glint_machine {
    char cpu[128];    // model name; "" if not known
    char system[256]; // "Linux 6.1.0 x86_64"
    char host[65];    // network name; "" if not known
    int cores;        // usable by this process
    double load;   // load average of the last minute, processes that run or wait to; NaN: not known
    char date[32]; // UTC, ISO 8601: "2024-05-01T12:00:00Z"
} glint_machine;

// Describes this machine at this moment.
void glint_machine_describe(glint_machine *machine);

// The peak memory of this process so far, bytes; 0 if not known.
uint64_t glint_peak_resident_bytes(void);

#endif
