// Reports a crash of the OpenCL driver.
#ifndef GLINT_CLI_COMMON_DEATH_H
#define GLINT_CLI_COMMON_DEATH_H

// Installs handlers for fatal signals and for an exit that glint did not ask for. If one of these
// happens while the driver compiles or runs kernels, the process prints one line and ends with exit
// status 4. After a crash while compiling, it also marks the driver's cache for the next run
// (device/driver_cache.h).
void glint_death_install(void);

#endif
