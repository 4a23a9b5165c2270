// Shades vertices. See vertices.h.
#include "render/vertices.h"

#include "device/opencl_error.h"

size_t glint_vertices_bytes(const glint_plan *plan)
{
    static const size_t vectors[] = {
        [GLINT_SHADING_PIXEL] = 0,
        [GLINT_SHADING_VERTEX_DIRECTION] = GLINT_VERTEX_VECTORS,
        [GLINT_SHADING_VERTEX_COLOR] = GLINT_VERTEX_COLOR_VECTORS,
    };
    return vectors[plan->shading] * 3 * GLINT_CLUSTER_LANES * sizeof(float);
}

static glint_status set_arguments(const glint_launcher *l, const glint_frame_record *view,
                                  cl_int clusters, glint_error *error)
{
#define OF_SCENE(type, name) {sizeof(cl_mem), &l->scene.name},
    const glint_argument arguments[] = {GLINT_SCENE_ARGUMENTS(OF_SCENE){sizeof clusters, &clusters},
                                        {sizeof *view, view}};
#undef OF_SCENE
    return glint_arguments_set(l->device, l->kernels->vertices, arguments,
                               sizeof arguments / sizeof *arguments, error);
}

glint_status glint_vertices_shade(const glint_launcher *l, const glint_frame_record *view,
                                  size_t clusters, glint_error *error)
{
    if (l->kernels->vertices == NULL) {
        return GLINT_OK;
    }
    TRY(set_arguments(l, view, (cl_int)clusters, error));
    // Set the work-group size here: a driver that compiles for each size would take seconds.
    const size_t local = l->plan->kernel_width == 1 ? 16 : 1;
    const size_t global = (clusters / local + 1) * local;
    cl_event done;
    const cl_int code = clEnqueueNDRangeKernel(l->device->launches, l->kernels->vertices, 1, NULL,
                                               &global, &local, 0, NULL, &done);
    TRY(glint_check_opencl(error, l->device, "running the kernel for vertices", code));
    return glint_launch_wait(l->device, done, error);
}
