// Traces both branches of glass by rtcIntersect1: a plain program, one ray after the other, with a
// stack of waiting branches. See tile.h.
#include "embree/cube.h"
#include "embree/tile.h"

#include <math.h>

// Reflected rays may graze the surface that they leave, so they start farther along than the rays
// in shade.c.
#define BRANCH_START 2e-5f
// One branch waits at each surface of the longest path, except the last.
#define WAITING_MAX (BENCH_GLASS_DEPTH + 1)

typedef struct vec3 {
    float x, y, z;
} vec3;

typedef struct branch {
    vec3 origin, direction; // the direction is a unit vector
    float weight;
    int met; // surfaces met so far
} branch;

typedef struct scattering {
    vec3 position, reflected, refracted;
    float reflectance;
} scattering;

static inline float dot3(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// a s + b
static inline vec3 scale_add3(vec3 a, float s, vec3 b)
{
    return (vec3){a.x * s + b.x, a.y * s + b.y, a.z * s + b.z};
}

static inline vec3 scale3(vec3 a, float s)
{
    return (vec3){a.x * s, a.y * s, a.z * s};
}

static inline vec3 unit3(vec3 a)
{
    return scale3(a, 1 / sqrtf(dot3(a, a)));
}

// Folds q to the side of the plane that the sign selects, see shade.c.
static inline vec3 fold3(vec3 q, vec3 geometric, float sign)
{
    float along = dot3(q, geometric);
    return along * sign < 0 ? scale_add3(geometric, -2 * along / dot3(geometric, geometric), q) : q;
}

static vec3 interpolated_normal(const float *normals, const struct RTCHit *hit)
{
    const float *m = normals + 9 * (size_t)hit->primID;
    return unit3((vec3){m[0] + hit->u * m[3] + hit->v * m[6], m[1] + hit->u * m[4] + hit->v * m[7],
                        m[2] + hit->u * m[5] + hit->v * m[8]});
}

// Applies Fresnel's equations and Snell's law at a hit.
static scattering scatter(const float *normals, const struct RTCRayHit *ray, vec3 d)
{
    const vec3 geometric = {ray->hit.Ng_x, ray->hit.Ng_y, ray->hit.Ng_z};
    const vec3 origin = {ray->ray.org_x, ray->ray.org_y, ray->ray.org_z};
    float facing = -dot3(d, geometric);
    vec3 n = interpolated_normal(normals, &ray->hit);
    float cosine = -dot3(n, d);
    n = cosine < 0 ? scale3(n, -1) : n;
    cosine = fminf(fabsf(cosine), 1);
    float eta = facing > 0 ? 1 / BENCH_IOR : BENCH_IOR;
    float squared = eta * cosine * (eta * cosine) + (1 - eta) * (1 + eta);
    scattering out = {.position = scale_add3(d, ray->ray.tfar, origin), .reflectance = 1};
    out.reflected = fold3(scale_add3(n, 2 * cosine, d), geometric, facing);
    if (squared >= 0) {
        float cosine_t = sqrtf(squared);
        float s = (eta * cosine - cosine_t) / (eta * cosine + cosine_t);
        float p = (cosine - eta * cosine_t) / (cosine + eta * cosine_t);
        out.reflectance = 0.5f * (s * s + p * p);
        out.refracted = scale_add3(n, eta * cosine - cosine_t, scale3(d, eta));
        out.refracted = fold3(out.refracted, geometric, -facing);
    }
    return out;
}

static quad look_up(const embree_program *program, vec3 d)
{
    const glint_cube *cube = program->inputs.environment;
    float ax = fabsf(d.x), ay = fabsf(d.y), az = fabsf(d.z), s, t, major;
    int face;
    if (ax >= ay && ax >= az) {
        face = d.x < 0, major = ax, s = d.x < 0 ? -d.z : d.z, t = -d.y;
    } else if (ay >= az) {
        face = 2 + (d.y < 0), major = ay, s = d.x, t = d.y < 0 ? d.z : -d.z;
    } else {
        face = 4 + (d.z < 0), major = az, s = d.z < 0 ? d.x : -d.x, t = -d.y;
    }
    const float half = 0.5f * (float)cube->edge;
    float column = s / major * half + half + 0.5f, row = t / major * half + half + 0.5f;
    int i = (int)column, j = (int)row, pitch = cube->edge + 2 * GLINT_CUBE_BORDER;
    return sample_floats(cube, (face * pitch + j) * pitch + i, column - (float)i, row - (float)j);
}

// Continues or ends a branch. A branch that has met all its surfaces, or has too little weight,
// takes the environment. A branch without weight ends. All others wait on the stack.
static void go_on(const embree_frame *frame, const branch *next, branch *stack, int *waiting,
                  quad *sum)
{
    if (!(next->weight > 0)) {
        return;
    }
    if (next->met >= frame->depth || next->weight < BENCH_GLASS_MIN_WEIGHT) {
        *sum += next->weight * look_up(frame->program, next->direction);
        return;
    }
    stack[(*waiting)++] = *next;
}

static quad follow(const embree_frame *frame, struct RTCIntersectContext *context, branch primary)
{
    branch stack[WAITING_MAX];
    int waiting = 0;
    quad sum = {0, 0, 0, 0};
    stack[waiting++] = primary;
    while (waiting > 0) {
        branch b = stack[--waiting];
        struct RTCRayHit ray = {
            .ray = {.org_x = b.origin.x,
                    .org_y = b.origin.y,
                    .org_z = b.origin.z,
                    .tnear = b.met > 0 ? BRANCH_START : 0,
                    .dir_x = b.direction.x,
                    .dir_y = b.direction.y,
                    .dir_z = b.direction.z,
                    .tfar = INFINITY,
                    .mask = UINT32_MAX},
            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .instID = {RTC_INVALID_GEOMETRY_ID}},
        };
        // Find the next surface; a miss takes the environment.
        rtcIntersect1(frame->scene, context, &ray);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            sum += b.weight * look_up(frame->program, b.direction);
            continue;
        }
        // Split the branch in two.
        scattering out = scatter(frame->program->normals, &ray, b.direction);
        const branch reflected = {out.position, out.reflected, b.weight * out.reflectance,
                                  b.met + 1};
        const branch refracted = {out.position, out.refracted, b.weight * (1 - out.reflectance),
                                  b.met + 1};
        go_on(frame, &reflected, stack, &waiting, &sum);
        go_on(frame, &refracted, stack, &waiting, &sum);
    }
    sum[3] = 1;
    return sum;
}

void embree_render_glass_tile(const embree_frame *frame, int x0, int y0)
{
    const embree_program *program = frame->program;
    const embree_view *view = &program->view;
    const float *d = view->direction, *dx = view->direction_x, *dy = view->direction_y;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = frame->mode->primary.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                  : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (int k = 0; k < TILE * TILE; k++) {
        int column = x0 + k % TILE, row = y0 + k / TILE;
        float x = (float)column + 0.5f - 0.5f * (float)program->inputs.width;
        float y = 0.5f * (float)program->inputs.height - (float)row - 0.5f;
        const branch primary = {
            .origin = {view->eye[0], view->eye[1], view->eye[2]},
            .direction = unit3((vec3){d[0] + x * dx[0] + y * dy[0], d[1] + x * dx[1] + y * dy[1],
                                      d[2] + x * dx[2] + y * dy[2]}),
            .weight = 1,
        };
        quad color = follow(frame, &context, primary);
        size_t pixel = (size_t)row * (size_t)program->inputs.width + (size_t)column;
        *(quad *)(program->pixels + 4 * pixel) = color;
    }
}
