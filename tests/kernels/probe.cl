// Calls single functions of the kernels on arrays, for tests/test_kernels.c. Each work-item takes
// one packet: element i of an array is lane i % GLINT_WIDTH. `in` and `out` hold 4 numbers an
// element.
#include "layout.h"
#include "path_state.h"
#define IS_COMPILED(name) GLINT_##name
#include "lanes.cl"
#include "cubemap.cl"
#include "optics.cl"
#define GLINT_MIP_LEVELS 1
#include "cones.cl"

static real load(global const scalar *in, int which)
{
    real value;
    size_t first = get_global_id(0) * GLINT_WIDTH;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE(value, lane) = in[4 * (first + lane) + which];
    }
    return value;
}

static void store(global scalar *out, int which, real value)
{
    size_t first = get_global_id(0) * GLINT_WIDTH;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        out[4 * (first + lane) + which] = LANE(value, lane);
    }
}

static void store3(global scalar *out, real3 v, real fourth)
{
    store(out, 0, v.x);
    store(out, 1, v.y);
    store(out, 2, v.z);
    store(out, 3, fourth);
}

// out: sizes and last offsets of the shared structs, in the order of test_kernels.c.
kernel void probe_layout(global const scalar *in, global scalar *out, global const void *texels,
                         int edge)
{
    glint_material_record m;
    glint_medium_record d;
    glint_frame_record f;
    glint_layers_record l;
    if (get_global_id(0) == 0) {
        out[0] = sizeof(glint_material_record);
        out[1] = (scalar)((private char *)&m.medium - (private char *)&m);
        out[2] = sizeof(glint_medium_record);
        out[3] = (scalar)((private char *)&d.ior - (private char *)&d);
        out[4] = sizeof(glint_split_vector);
        out[5] = sizeof(glint_frame_record);
        out[6] = (scalar)((private char *)&f.min_weight - (private char *)&f);
        out[7] = (scalar)((private char *)&f.first_band - (private char *)&f);
        out[8] = sizeof(glint_layers_record);
        out[9] = (scalar)((private char *)&l.truncated - (private char *)&l);
        out[10] = (scalar)((private char *)&l.triangle - (private char *)&l);
        out[11] = (scalar)((private char *)&l.face - (private char *)&l);
    }
}

// in: x ≤ 0. out: e^x.
kernel void probe_exponential(global const scalar *in, global scalar *out,
                              global const void *texels, int edge)
{
    store3(out, real3_of(exp_of_negative(load(in, 0)), real_of(0), real_of(0)), real_of(0));
}

// in: a direction. out: the map's colour along it.
kernel void probe_cube(global const scalar *in, global scalar *out, global const void *texels,
                       int edge)
{
    real3 d = real3_of(load(in, 0), load(in, 1), load(in, 2));
    const cube_map map = {texels, edge, GLINT_HALF_TEXELS};
    store3(out, sample_cube(&map, d, mask_all()), real_of(0));
}

// in: the radius of a sphere, the width of a beam 3 units before it, η, the spread of the beam.
// out: the curvature of a triangle of the sphere, then three focal distances of the beam along the
// normal: reflected from inside, refracted into the sphere, refracted into its other side.
kernel void probe_cones(global const scalar *in, global scalar *out, global const void *texels,
                        int edge)
{
    const real radius = load(in, 0), eta = load(in, 2), one = real_of(1), zero = real_of(0);
    real3 vertices[3], normals[3];
    normals[0] = real3_of(one, zero, zero);
    normals[1] = real3_of(real_of(R(0.96)), real_of(R(0.28)), zero);
    normals[2] = real3_of(real_of(R(0.8)), real_of(R(0.36)), real_of(R(0.48)));
    for (int k = 0; k < 3; k++) {
        vertices[k] = scale(normals[k], radius);
    }
    const real curvature = curvature_of(vertices, normals);
    cone beam;
    beam.width = load(in, 1);
    beam.spread = load(in, 3);
    const real width = width_after(&beam, real_of(3)), bend = eta - one;
    const cone reflected = leave_surface(width, beam.spread, one, real_of(2), -curvature);
    const cone entering = leave_surface(width, beam.spread, eta, bend, curvature);
    const cone beyond = leave_surface(width, beam.spread, eta, bend, -curvature);
    store3(out, real3_of(curvature, -width / reflected.spread, -width / entering.spread),
           -width / beyond.spread);
}

// in: a spread, and the largest component of a unit vector. out: the level for an edge of 64 texels
// with 7 levels, and the blend.
kernel void probe_levels(global const scalar *in, global scalar *out, global const void *texels,
                         int edge)
{
    cone c;
    c.width = real_of(0);
    c.spread = load(in, 0);
    const real3 d = real3_of(real_of(0), -load(in, 1), real_of(0));
    const level_choice choice = choose_level(c.spread, d, 64, 6);
    store3(out, real3_of(to_real(choice.level), choice.blend, real_of(0)), real_of(0));
}
