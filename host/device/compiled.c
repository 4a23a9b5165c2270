// Stamps programs that PoCL's cache holds. See compiled.h.
#include "device/compiled.h"

#include "device/driver_cache.h"
#include "device/kernel_sources.h"

#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

static bool is_pocl(const struct glint_device *device)
{
    return strcmp(device->capabilities.platform, "Portable Computing Language") == 0;
}

// True if PoCL keeps what it compiles.
static bool is_cache_on(void)
{
    const char *use = getenv("POCL_KERNEL_CACHE");
    return use == NULL || strcmp(use, "0") != 0;
}

static void add(XXH3_state_t *state, const char *text)
{
    XXH3_128bits_update(state, text, strlen(text) + 1);
}

// Adds what the driver compiles for, and with: the version of its platform names the compiler.
static void add_driver(XXH3_state_t *state, const struct glint_device *device)
{
    cl_platform_id platform = NULL;
    char version[256] = "";
    if (clGetDeviceInfo(device->id, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL) ==
        CL_SUCCESS) {
        clGetPlatformInfo(platform, CL_PLATFORM_VERSION, sizeof version - 1, version, NULL);
    }
    add(state, version);
    add(state, device->capabilities.name);
    add(state, device->capabilities.driver);
    add(state, device->capabilities.opencl_version);
    const char *more = getenv("POCL_EXTRA_BUILD_FLAGS");
    add(state, more != NULL ? more : "");
}

// Writes the path of the stamp. False if there can be none.
static bool name_stamp(const struct glint_device *device, const glint_program_request *request,
                       char path[PATH_MAX])
{
    XXH3_state_t *state = NULL;
    if (request->kernel_dir != NULL || !is_pocl(device) || !is_cache_on() ||
        (state = XXH3_createState()) == NULL) {
        return false;
    }
    XXH3_128bits_reset(state);
    add(state, glint_kernel_source);
    add(state, request->options);
    add_driver(state, device);
    const XXH128_hash_t hash = XXH3_128bits_digest(state);
    XXH3_freeState(state);
    char name[48];
    snprintf(name, sizeof name, "%016" PRIx64 "%016" PRIx64, (uint64_t)hash.high64,
             (uint64_t)hash.low64);
    return glint_driver_cache_name_stamp(name, path, PATH_MAX);
}

bool glint_program_is_compiled(const struct glint_device *device,
                               const glint_program_request *request)
{
    char path[PATH_MAX];
    return name_stamp(device, request, path) && access(path, F_OK) == 0;
}

void glint_program_stamp_compiled(const struct glint_device *device,
                                  const glint_program_request *request)
{
    char path[PATH_MAX];
    if (name_stamp(device, request, path)) {
        const int stamp = open(path, O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (stamp >= 0) {
            close(stamp);
        }
    }
}

glint_status glint_programs_check_cache(const struct glint_device *device, glint_error *error)
{
    const char *fault = glint_driver_cache_fault();
    if (!is_pocl(device)) {
        return GLINT_OK;
    }
    if (!is_cache_on()) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "POCL_KERNEL_CACHE=0: PoCL keeps no kernels (unset it)");
    }
    if (fault != NULL) {
        return glint_fail(
            error, GLINT_OUTPUT_FAILED,
            "%s (let POCL_CACHE_DIR name another folder, with a short name, that can be "
            "written)",
            fault);
    }
    return GLINT_OK;
}
