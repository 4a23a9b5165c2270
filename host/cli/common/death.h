// What is said where the OpenCL driver takes the process down while it compiles.
#ifndef GLINT_CLI_COMMON_DEATH_H
#define GLINT_CLI_COMMON_DEATH_H

// From here on a fatal signal, or an exit that is not glint's, while the driver compiles becomes
// one line and exit status 4, and a mark in the driver's cache for the next run
// (device/driver_cache.h).
void glint_death_install(void);

#endif
