// Lists the arguments of the kernels once. The kernels' parameters and the arguments that the host
// sets both come from this list (host/render/arguments.h). ARGUMENT takes the type in OpenCL C and
// the name. Every kernel takes the scene, then its own arguments, then the frame: a
// glint_frame_record. layout.h describes the buffers. A buffer that no compiled feature reads may
// have any size.
#ifndef GLINT_KERNELS_ARGUMENTS_H
#define GLINT_KERNELS_ARGUMENTS_H

#define GLINT_SCENE_ARGUMENTS(ARGUMENT)                                                            \
    ARGUMENT(global const float *, nodes)                                                          \
    ARGUMENT(global const float *, clusters)                                                       \
    ARGUMENT(global const float *, normals)                                                        \
    ARGUMENT(global const int *, numbers)                                                          \
    ARGUMENT(global const glint_material_record *, materials)                                      \
    ARGUMENT(global const glint_medium_record *, media)                                            \
    ARGUMENT(global const glint_solid_record *, solids) /* with GLINT_OVERLAPS */                  \
    ARGUMENT(global const float *, attributes)                                                     \
    ARGUMENT(global const glint_texture_record *, textures)                                        \
    ARGUMENT(global const ushort *, texels)                                                        \
    ARGUMENT(global const glint_light_record *, lights)                                            \
    ARGUMENT(global const void *, environment)                                                     \
    ARGUMENT(global const float *, irradiance)                                                     \
    ARGUMENT(global const float *, lobes) /* with GLINT_ROUGH: albedos and cells */                \
    ARGUMENT(global float *, vertices)    /* shade_vertices writes them, the others read */        \
    ARGUMENT(global const uint *, listed) /* pixels, with GLINT_PIXEL_LIST */

// The buffers that render_tiles writes: pixels [height][width][4] (R, G, B premultiplied, alpha);
// counters; layers [height][width]; terms.
#define GLINT_OUTPUT_ARGUMENTS(ARGUMENT)                                                           \
    ARGUMENT(global scalar *, pixels)                                                              \
    ARGUMENT(global uint *, counters)                                                              \
    ARGUMENT(global glint_layers_record *, layers)                                                 \
    ARGUMENT(global float *, terms)

// The buffers that the kernels of probes.cl read and write.
#define GLINT_PROBE_ARGUMENTS(ARGUMENT)                                                            \
    ARGUMENT(global const scalar *, in)                                                            \
    ARGUMENT(global scalar *, out)

#endif
