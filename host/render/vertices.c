// Shading at vertices. See vertices.h.
#include "render/vertices.h"

#include "device/opencl_error.h"

size_t glint_vertices_bytes(const glint_plan *plan, size_t clusters)
{
    static const size_t vectors[] = {
        [GLINT_SHADING_PIXEL] = 0,
        [GLINT_SHADING_VERTEX_DIRECTION] = GLINT_VERTEX_VECTORS,
        [GLINT_SHADING_VERTEX_COLOR] = GLINT_VERTEX_COLOR_VECTORS,
    };
    return clusters * vectors[plan->shading] * 3 * GLINT_CLUSTER_LANES * sizeof(float);
}

glint_status glint_vertices_allocate(glint_renderer *r, glint_error *error)
{
    glint_buffer_release(r->vertices);
    r->vertices = NULL;
    return glint_buffer_create(r->device, "the vertices",
                               glint_vertices_bytes(&r->plan, r->shown.bvh.cluster_count), NULL,
                               &r->vertices, error);
}

// Launches the kernel for the first `count` clusters.
static glint_status launch(const glint_renderer *r, const glint_frame_record *view, size_t count,
                           glint_error *error)
{
    const cl_int clusters = (cl_int)count;
    const struct {
        size_t size;
        const void *value;
    } arguments[] = {
        {sizeof(cl_mem), &r->geometry.clusters},
        {sizeof(cl_mem), &r->geometry.normals},
        {sizeof(cl_mem), &r->geometry.materials},
        {sizeof(cl_mem), &r->geometry.media},
        {sizeof(cl_mem), &r->light.environment},
        {sizeof(cl_mem), &r->light.irradiance},
        {sizeof(cl_mem), &r->vertices},
        {sizeof clusters, &clusters},
        {sizeof *view, view},
    };
    cl_int code = CL_SUCCESS;
    for (cl_uint i = 0; code == CL_SUCCESS && i < sizeof arguments / sizeof *arguments; i++) {
        code = clSetKernelArg(r->vertex_kernel, i, arguments[i].size, arguments[i].value);
    }
    if (code != CL_SUCCESS) {
        return glint_fail_opencl(error, r->device, "setting a kernel's argument", code);
    }
    // Not left to the driver: one that compiles for each size of work-groups would take seconds.
    const size_t local = r->plan.kernel_width == 1 ? 16 : 1;
    const size_t global = (count / local + 1) * local;
    cl_event done;
    code = clEnqueueNDRangeKernel(r->device->launches, r->vertex_kernel, 1, NULL, &global, &local,
                                  0, NULL, &done);
    return code == CL_SUCCESS
               ? glint_renderer_wait(r, done, error)
               : glint_fail_opencl(error, r->device, "running the kernel for vertices", code);
}

glint_status glint_vertices_warm_up(const glint_renderer *r, glint_error *error)
{
    const glint_frame_record nothing = {0};
    return r->vertex_kernel == NULL ? GLINT_OK : launch(r, &nothing, 0, error);
}

glint_status glint_vertices_shade(const glint_renderer *r, const glint_frame_record *view,
                                  glint_error *error)
{
    return r->vertex_kernel == NULL ? GLINT_OK : launch(r, view, r->shown.bvh.cluster_count, error);
}
