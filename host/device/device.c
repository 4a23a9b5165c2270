// Lists and opens OpenCL devices. See device.h.
#include "device/device.h"

#include "device/driver_cache.h"
#include "device/opencl.h"
#include "device/opencl_error.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MAX_PLATFORMS 32
#define MAX_DEVICES 64 // of a platform

static void device_text(cl_device_id id, cl_device_info what, char *text, size_t capacity)
{
    text[0] = '\0';
    if (clGetDeviceInfo(id, what, capacity, text, NULL) != CL_SUCCESS) {
        snprintf(text, capacity, "?");
    }
    text[capacity - 1] = '\0';
}

static bool has_extension(cl_device_id id, const char *name)
{
    size_t size = 0;
    if (clGetDeviceInfo(id, CL_DEVICE_EXTENSIONS, 0, NULL, &size) != CL_SUCCESS || size == 0) {
        return false;
    }
    char *list = calloc(size + 1, 1);
    bool found = false;
    if (list != NULL && clGetDeviceInfo(id, CL_DEVICE_EXTENSIONS, size, list, NULL) == CL_SUCCESS) {
        size_t length = strlen(name);
        for (const char *at = list; (at = strstr(at, name)) != NULL; at += length) {
            bool starts = at == list || at[-1] == ' ';
            found = found || (starts && (at[length] == ' ' || at[length] == '\0'));
        }
    }
    free(list);
    return found;
}

static void describe(cl_platform_id platform, cl_device_id id, glint_capabilities *c)
{
    *c = (glint_capabilities){0};
    device_text(id, CL_DEVICE_NAME, c->name, sizeof c->name);
    device_text(id, CL_DRIVER_VERSION, c->driver, sizeof c->driver);
    device_text(id, CL_DEVICE_VERSION, c->opencl_version, sizeof c->opencl_version);
    if (clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof c->platform, c->platform, NULL) !=
        CL_SUCCESS) {
        snprintf(c->platform, sizeof c->platform, "?");
    }
    cl_device_type type = 0;
    cl_uint width = 0, units = 0;
    cl_ulong memory = 0, allocation = 0;
    cl_bool unified = CL_FALSE;
    clGetDeviceInfo(id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    clGetDeviceInfo(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof width, &width, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    clGetDeviceInfo(id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof allocation, &allocation, NULL);
    c->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    c->is_gpu = (type & CL_DEVICE_TYPE_GPU) != 0;
    clGetDeviceInfo(id, CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof unified, &unified, NULL);
    c->shares_memory = c->is_cpu && unified;
    c->has_double = has_extension(id, "cl_khr_fp64");
    c->native_float_width = width > 0 ? (int)width : 1;
    c->compute_units = units;
    c->memory_bytes = memory;
    c->largest_allocation_bytes = allocation;
}

typedef struct found_device {
    cl_device_id id;
    glint_capabilities capabilities;
} found_device;

// Sorts GPUs first, then CPUs, then others. Platforms keep the loader's order.
static int rank(const glint_capabilities *c)
{
    return c->is_gpu ? 0 : c->is_cpu ? 1 : 2;
}

static bool can_compile(cl_device_id id)
{
    cl_bool compiler = CL_FALSE;
    cl_int code =
        clGetDeviceInfo(id, CL_DEVICE_COMPILER_AVAILABLE, sizeof compiler, &compiler, NULL);
    return code == CL_SUCCESS && compiler == CL_TRUE;
}

static void sort_devices(found_device *devices, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        found_device moved = devices[i];
        size_t j = i;
        for (; j > 0 && rank(&devices[j - 1].capabilities) > rank(&moved.capabilities); j--) {
            devices[j] = devices[j - 1];
        }
        devices[j] = moved;
    }
    for (size_t i = 0; i < count; i++) {
        devices[i].capabilities.index = (int)i;
    }
}

// ---- Starting the drivers -----------------------------------------------------------------------

// Only the main thread uses these.
static pthread_t starter;
static bool is_starting, was_started;

// Makes the drivers find their devices. Whoever opens a device reports failures.
static void find_all(void)
{
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint count = 0, unread;
    if (clGetPlatformIDs(MAX_PLATFORMS, platforms, &count) != CL_SUCCESS) {
        return;
    }
    for (cl_uint p = 0; p < count && p < MAX_PLATFORMS; p++) {
        (void)clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, 0, NULL, &unread);
    }
}

// LLVM gives the thread that loads it a stack for signals. Take it back: AddressSanitizer frees the
// thread's stack when the thread ends, and takes LLVM's for its own.
static void *start_drivers(void *unused)
{
    stack_t before;
    const bool is_known = sigaltstack(NULL, &before) == 0;
    find_all();
    if (is_known) {
        (void)sigaltstack(&before, NULL);
    }
    return unused;
}

void glint_device_start_drivers(void)
{
    if (!was_started) {
        was_started = true;
        glint_driver_cache_prepare(); // may set an environment variable, so not on the thread
        is_starting = pthread_create(&starter, NULL, start_drivers, NULL) == 0;
    }
}

void glint_device_await_drivers(void)
{
    if (is_starting) {
        pthread_join(starter, NULL);
        is_starting = false;
    }
}

// ---- Finding devices ----------------------------------------------------------------------------

// Fails because there is no platform or no device.
static glint_status fail_none(const char *what, glint_error *error)
{
    const char *loss = glint_driver_cache_loss();
    return loss != NULL ? glint_fail(error, GLINT_DEVICE_FAILED, "%s", loss)
                        : glint_fail(error, GLINT_DEVICE_FAILED,
                                     "no OpenCL %s was found (install a driver; for the CPU, "
                                     "Debian's package pocl-opencl-icd)",
                                     what);
}

// Sets *devices to NULL if, and only if, it fails.
static glint_status find_devices(found_device **devices, size_t *count, glint_error *error)
{
    *devices = NULL;
    *count = 0;
    // Find the platforms.
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint platform_count = 0;
    glint_device_await_drivers();
    glint_driver_cache_prepare();
    cl_int code = clGetPlatformIDs(MAX_PLATFORMS, platforms, &platform_count);
    if (code != CL_SUCCESS || platform_count == 0) {
        return fail_none("platform", error);
    }
    platform_count = platform_count < MAX_PLATFORMS ? platform_count : MAX_PLATFORMS;
    found_device *list = calloc((size_t)platform_count * MAX_DEVICES, sizeof *list);
    if (list == NULL) {
        return glint_fail_memory(error, "the list of devices");
    }
    // List their devices that compile.
    size_t found = 0;
    for (cl_uint p = 0; p < platform_count; p++) {
        cl_device_id ids[MAX_DEVICES];
        cl_uint id_count = 0;
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, MAX_DEVICES, ids, &id_count) !=
            CL_SUCCESS) {
            continue; // a platform without devices
        }
        for (cl_uint d = 0; d < id_count && d < MAX_DEVICES; d++) {
            if (!can_compile(ids[d])) {
                continue;
            }
            list[found].id = ids[d];
            describe(platforms[p], ids[d], &list[found].capabilities);
            found++;
        }
    }
    if (found == 0) {
        free(list);
        return fail_none("device", error);
    }
    sort_devices(list, found);
    *devices = list;
    *count = found;
    return GLINT_OK;
}

glint_status glint_device_list(glint_capabilities **list, size_t *count, glint_error *error)
{
    *list = NULL;
    found_device *devices;
    TRY(find_devices(&devices, count, error));
    *list = calloc(*count, sizeof **list);
    if (*list == NULL) {
        free(devices);
        return glint_fail_memory(error, "the list of devices");
    }
    for (size_t i = 0; i < *count; i++) {
        (*list)[i] = devices[i].capabilities;
    }
    free(devices);
    return GLINT_OK;
}

static bool is_number(const char *text)
{
    return text[0] != '\0' && strspn(text, "0123456789") == strlen(text) && strlen(text) < 6;
}

static bool matches(const glint_capabilities *c, const char *selector)
{
    if (is_number(selector)) {
        return c->index == atoi(selector);
    }
    if (strcasecmp(selector, "gpu") == 0) {
        return c->is_gpu;
    }
    if (strcasecmp(selector, "cpu") == 0) {
        return c->is_cpu;
    }
    return strcasestr(c->name, selector) != NULL || strcasestr(c->platform, selector) != NULL;
}

// Lists the devices by name, for messages: "0: A, 1: B".
static void list_names(const found_device *devices, size_t count, char *text, size_t capacity)
{
    text[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        size_t used = strlen(text);
        snprintf(text + used, capacity - used, "%s%zu: %s", i > 0 ? ", " : "", i,
                 devices[i].capabilities.name);
    }
}

// Chooses the device that the selector names. "cpu" and "gpu" take the first of their kind; a name
// must fit only one device.
static glint_status choose(const found_device *devices, size_t count, const char *selector,
                           size_t *chosen, glint_error *error)
{
    *chosen = 0; // without a selector the first device is right
    if (selector == NULL) {
        return GLINT_OK;
    }
    size_t found = 0;
    for (size_t i = count; i-- > 0;) {
        if (matches(&devices[i].capabilities, selector)) {
            *chosen = i;
            found++;
        }
    }
    bool by_kind = strcasecmp(selector, "gpu") == 0 || strcasecmp(selector, "cpu") == 0;
    if (found == 1 || (found > 1 && by_kind)) {
        return GLINT_OK;
    }
    char names[600];
    list_names(devices, count, names, sizeof names);
    return glint_fail(error, GLINT_DEVICE_FAILED, "device '%s': %s (there is %s)", selector,
                      found == 0 ? "there is none such" : "more than one has that in its name",
                      names);
}

static cl_int create_queues(glint_device *device)
{
    cl_command_queue_properties can = 0;
    cl_int code = clGetDeviceInfo(device->id, CL_DEVICE_QUEUE_PROPERTIES, sizeof can, &can, NULL);
    if (code == CL_SUCCESS) {
        device->queue = clCreateCommandQueue(device->context, device->id, 0, &code);
    }
    if (code == CL_SUCCESS) {
        device->launches = clCreateCommandQueue(
            device->context, device->id, can & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, &code);
    }
    return code;
}

static glint_status create_context_and_queues(glint_device *device, glint_error *error)
{
    cl_int code;
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &code);
    TRY(glint_check_opencl(error, device, "creating a context", code));
    return glint_check_opencl(error, device, "creating a queue", create_queues(device));
}

static glint_status open_device(const found_device *found, glint_device **device,
                                glint_error *error)
{
    glint_device *opened = calloc(1, sizeof *opened);
    if (opened == NULL) {
        return glint_fail_memory(error, "the device");
    }
    opened->id = found->id;
    opened->capabilities = found->capabilities;
    glint_driver_cache_set_device(found->capabilities.name);
    const glint_status status = create_context_and_queues(opened, error);
    if (status != GLINT_OK) {
        glint_device_close(opened);
        return status;
    }
    *device = opened;
    return GLINT_OK;
}

glint_status glint_device_open(const char *selector, glint_device **device, glint_error *error)
{
    *device = NULL;
    found_device *devices;
    size_t count, chosen;
    glint_status status = find_devices(&devices, &count, error);
    if (devices == NULL) { // tells static analysis what a failure is
        return status;
    }
    status = choose(devices, count, selector, &chosen, error);
    if (status == GLINT_OK) {
        status = open_device(&devices[chosen], device, error);
    }
    free(devices);
    return status;
}

const glint_capabilities *glint_device_capabilities(const glint_device *device)
{
    return &device->capabilities;
}

static void release_programs(glint_built_program *first)
{
    while (first != NULL) {
        glint_built_program *next = first->next;
        clReleaseProgram(first->program);
        free(first->options);
        free(first);
        first = next;
    }
}

void glint_device_close(glint_device *device)
{
    if (device == NULL) {
        return;
    }
    release_programs(device->programs);
    if (device->launches != NULL) {
        clReleaseCommandQueue(device->launches);
    }
    if (device->queue != NULL) {
        clReleaseCommandQueue(device->queue);
    }
    if (device->context != NULL) {
        clReleaseContext(device->context);
    }
    free(device);
}
