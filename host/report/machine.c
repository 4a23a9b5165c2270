// Describes the machine of a measurement. See machine.h.
#include "report/machine.h"

#include "base/parallel.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <time.h>

// Reads "model name : …" on x86 Linux; other processors have no such line.
static void find_cpu(char *text, size_t capacity)
{
    static const char key[] = "model name";
    char line[512];
    text[0] = '\0';
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file != NULL && text[0] == '\0' && fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (colon != NULL && strncmp(line, key, sizeof key - 1) == 0) {
            colon += 1 + strspn(colon + 1, " \t");
            snprintf(text, capacity, "%.*s", (int)strcspn(colon, "\n"), colon);
        }
    }
    if (file != NULL) {
        fclose(file);
    }
}

void glint_machine_describe(glint_machine *machine)
{
    *machine = (glint_machine){.cores = glint_usable_cores(), .load = NAN};
    find_cpu(machine->cpu, sizeof machine->cpu);
    struct utsname names;
    if (uname(&names) == 0) {
        snprintf(machine->system, sizeof machine->system, "%s %s %s", names.sysname, names.release,
                 names.machine);
        snprintf(machine->host, sizeof machine->host, "%s", names.nodename);
    }
    double load;
    if (getloadavg(&load, 1) == 1) {
        machine->load = load;
    }
    time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc) != NULL) {
        strftime(machine->date, sizeof machine->date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    }
}

uint64_t glint_peak_resident_bytes(void)
{
    struct rusage usage = {0};
    // Linux counts in KiB.
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}
