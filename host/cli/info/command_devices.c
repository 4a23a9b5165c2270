// Implements glint devices: lists the OpenCL devices.
#include "cli/commands.h"
#include "cli/common/options.h"

#include "device/device.h"
#include "report/frame/inventory.h"

#include <stdio.h>
#include <stdlib.h>

// The options of glint devices.
typedef struct devices_request {
    bool json;
} devices_request;

static const glint_option options[] = {
    {GLINT_OPTION_HEADING, .help = "Options"},
    {GLINT_OPTION_FLAG, .name = "json", .help = "Print JSON instead of a table.",
     .offset = offsetof(devices_request, json)},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {options, NULL};

static void print_table(const glint_capabilities *devices, size_t count)
{
    int name_width = 4;
    int platform_width = 8;
    for (size_t i = 0; i < count; i++) {
        int name = snprintf(NULL, 0, "%s", devices[i].name);
        int platform = snprintf(NULL, 0, "%s", devices[i].platform);
        name_width = name > name_width ? name : name_width;
        platform_width = platform > platform_width ? platform : platform_width;
    }
    printf("index  type   %-*s  %-*s  units  width  memory     fp64  driver\n", name_width, "name",
           platform_width, "platform");
    for (size_t i = 0; i < count; i++) {
        const glint_capabilities *device = &devices[i];
        const char *type = device->is_gpu ? "gpu" : device->is_cpu ? "cpu" : "other";
        printf("%5d  %-5s  %-*s  %-*s  %5u  %5d  %6.1f GiB  %-4s  %s\n", device->index, type,
               name_width, device->name, platform_width, device->platform, device->compute_units,
               device->native_float_width, (double)device->memory_bytes / 0x1p30,
               device->has_double ? "yes" : "no", device->driver);
    }
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    (void)arguments;
    const devices_request *request = context;
    glint_capabilities *devices = NULL;
    char *text = NULL;
    size_t count = 0;
    glint_status status;
    TRY_OR(cleanup, status, glint_device_list(&devices, &count, error));
    if (request->json) {
        TRY_OR(cleanup, status, glint_devices_json(devices, count, &text, error));
    }
    if (request->json) {
        fputs(text, stdout);
    } else {
        print_table(devices, count);
    }
cleanup:
    free(text);
    free(devices);
    return status;
}

const glint_command glint_command_devices = {
    .name = "devices",
    .summary = "list the OpenCL devices",
    .synopsis = "[options]",
    .description = "Lists the OpenCL devices in the order of their index, which --device takes.",
    .examples = "  glint devices\n"
                "  glint render scene.gltf -o frame.exr --device 0\n",
    .groups = groups,
    .request_size = sizeof(devices_request),
    .run = run,
};
