// Builds a figure with a skin, bent by its joints, and a morph target that makes it bulge.
#include "scenes.h"
#include "shapes.h"

#include <stdlib.h>

#define SECONDS 2.0
#define RADIUS 0.17
#define SEGMENT 0.5 // metres from joint to joint

// A tube up along +Y with round ends. The first joint is at the origin.
static void shape_worm(mesh *m)
{
    static const double foot[2] = {0, 0}, head[2] = {0, FLESH_JOINTS * SEGMENT - RADIUS};
    static const double below[2] = {-90, 0}, above[2] = {0, 90};
    profile outline = {0};
    profile_arc(&outline, foot, RADIUS, below, 6);
    for (int ring = 1; ring <= 24; ring++) {
        profile_line(&outline, RADIUS, head[1] * (ring - 1) / 24, RADIUS, head[1] * ring / 24);
    }
    profile_arc(&outline, head, RADIUS, above, 6);
    shape_revolve(m, &outline, 32);
}

// Joint weights at a height. They change evenly between the middles of neighbouring segments.
static void weigh(double height, double weights[FLESH_JOINTS])
{
    const double last = FLESH_JOINTS - 1;
    const double place = fmin(fmax(height / SEGMENT - 0.5, 0), last);
    const int below = (int)fmin(floor(place), last - 1);
    weights[below + 1] = mesh_snap(place - below);
    weights[below] = 1 - weights[below + 1];
}

// The morph target: the radius grows by a bell curve around one height.
static void bulge(glint_vec3 p, glint_vec3 normal, glint_vec3 deltas[2])
{
    const double middle = 1.1, width = 0.22, height = 0.16;
    const double from = (p.y - middle) / width;
    const double growth = height * exp(-from * from);
    const glint_vec3 out = glint_vec3_normalize((glint_vec3){p.x, 0, p.z});
    const double slope = -2 * from / width * growth; // slope of the radius over the height
    const glint_vec3 tilted =
        glint_vec3_normalize((glint_vec3){normal.x, normal.y - slope, normal.z});
    const glint_vec3 exact[2] = {glint_vec3_scale(out, growth),
                                 glint_vec3_subtract(tilted, normal)};
    for (int i = 0; i < 2; i++) {
        deltas[i] =
            (glint_vec3){mesh_snap(exact[i].x), mesh_snap(exact[i].y), mesh_snap(exact[i].z)};
    }
}

static void grow_flesh(mesh *m, flesh *f)
{
    f->bulge = calloc(m->vertex_count, sizeof *f->bulge);
    f->normal_bulge = calloc(m->vertex_count, sizeof *f->normal_bulge);
    f->weights = calloc(m->vertex_count, sizeof *f->weights);
    if (f->bulge == NULL || f->normal_bulge == NULL || f->weights == NULL) {
        m->failed = true;
        return;
    }
    for (size_t i = 0; i < m->vertex_count; i++) {
        glint_vec3 deltas[2];
        bulge(m->positions[i], m->normals[i], deltas);
        f->bulge[i] = deltas[0];
        f->normal_bulge[i] = deltas[1];
        weigh(m->positions[i].y, f->weights[i]);
    }
}

// Adds a chain of joints. All joints except the foot bend to one side and to the other, the upper
// joints later.
static void add_joints(model *scene, flesh *f, glint_vec3 foot)
{
    static const char *const names[FLESH_JOINTS] = {"foot", "hip", "chest", "head"};
    for (int joint = 0; joint < FLESH_JOINTS; joint++) {
        const glint_vec3 place = joint == 0 ? foot : (glint_vec3){0, SEGMENT, 0};
        node *bone =
            model_add_joint(scene, names[joint], joint == 0 ? -1 : f->joints[joint - 1], place);
        f->joints[joint] = (int)(bone - scene->nodes);
        f->rest[joint] = (glint_vec3){0, SEGMENT * joint, 0};
        if (joint == 0) {
            continue;
        }
        motion *bend = model_add_motion(scene, bone, "rotation", "LINEAR");
        for (int key = 0; key <= 8; key++) {
            double rotation[4];
            const double phase = 2 * GLINT_PI * (key / 8.0 - joint / 12.0);
            rotation_about((glint_vec3){0, 0, 1}, 32 * mesh_snap(sin(phase)), rotation);
            motion_add_key(bend, SECONDS * key / 8, rotation);
        }
    }
}

// A chrome worm on a mirror floor, between three painted balls: it sways and swallows. The worm's
// own node stands elsewhere; glTF ignores it because of the skin.
void build_worm(model *scene)
{
    static const double swallows[] = {0, 1, 0, 0};
    scene->clip = "sway";
    model_add_perspective(scene, "main", 36, (glint_vec3){0.8, 1.5, 5.6}, (glint_vec3){0, 0.95, 0});
    shape_box(model_add_geometry(scene, "floor"), (glint_vec3){0, -0.05, 0},
              (glint_vec3){2.2, 0.05, 2.2});
    material steel = material_metal("dark steel", 0.32, 0.33, 0.35);
    model_add_object(scene, "floor", model_add_material(scene, &steel), (glint_vec3){0, 0, 0});
    shape_sphere(model_add_geometry(scene, "ball"), 0.3, 5);
    static const double colors[3][3] = {{0.65, 0.06, 0.04}, {0.06, 0.35, 0.1}, {0.05, 0.1, 0.55}};
    static const char *const names[3] = {"red", "green", "blue"};
    for (int i = 0; i < 3; i++) {
        material paint = material_paint(names[i], colors[i][0], colors[i][1], colors[i][2], 1);
        model_add_object(scene, names[i], model_add_material(scene, &paint),
                         (glint_vec3){1.1 * (i - 1), 0.301, i == 1 ? -1 : 0.6});
    }
    mesh *body = model_add_geometry(scene, "worm");
    shape_worm(body);
    flesh *f = &scene->geometries[scene->geometry_count - 1].flesh;
    grow_flesh(body, f);
    material chrome = material_metal("chrome", 0.92, 0.92, 0.93);
    node *worm =
        model_add_object(scene, "worm", model_add_material(scene, &chrome), (glint_vec3){-5, 0, 0});
    motion *swallow = model_add_motion(scene, worm, "weights", "CUBICSPLINE");
    for (int key = 0; key < 4; key++) {
        motion_add_key(swallow, SECONDS * key / 4, &swallows[key]);
    }
    add_joints(scene, f, (glint_vec3){0, RADIUS + 0.001, 0});
}
