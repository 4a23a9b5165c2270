// Declares the kernels' source, embedded at build time by kernels/embed.cmake.
#ifndef GLINT_DEVICE_KERNEL_SOURCES_H
#define GLINT_DEVICE_KERNEL_SOURCES_H

extern const char glint_kernel_source[]; // kernels/render.cl with all its includes and #line
extern const char glint_probe_source[];  // kernels/probes.cl, appended to it

#endif
