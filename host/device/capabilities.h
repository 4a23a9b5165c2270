// Describes a device as plain data. The plan is made from it and calls no OpenCL.
#ifndef GLINT_DEVICE_CAPABILITIES_H
#define GLINT_DEVICE_CAPABILITIES_H

#include <stdbool.h>
#include <stdint.h>

typedef struct glint_capabilities {
    int index; // in glint_device_list
    char name[256];
    char platform[256];
    char driver[128];
    char opencl_version[128];
    bool is_cpu, is_gpu;
    bool shares_memory;     // a CPU: buffers may be the host's own memory
    bool has_double;        // cl_khr_fp64
    int native_float_width; // lanes of the widest float vector; 1 if the device has none
    uint32_t compute_units;
    uint64_t memory_bytes;
    uint64_t largest_allocation_bytes; // one buffer's limit
} glint_capabilities;

#endif
