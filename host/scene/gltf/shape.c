// Deforms primitives for one time. See shape.h.
#include "scene/gltf/shape.h"

#include "base/free_memory.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <stdlib.h>

static const size_t elements_per_task = 2048;
static const double most_cost = 0x1p34; // some minutes of one core

static size_t element_count(const glint_shape *shape)
{
    return shape->is_per_corner ? 3 * shape->primitive->triangles
                                : shape->primitive->positions.count;
}

static size_t vertex_of(const glint_shape *shape, size_t element)
{
    return shape->is_per_corner ? glint_primitive_vertex(shape->primitive, element / 3, element % 3)
                                : element;
}

bool glint_shape_init(glint_shape *shape, const glint_primitive *primitive, const double *weights,
                      size_t weight_count, const glint_bones *bones)
{
    *shape = (glint_shape){.primitive = primitive, .box = GLINT_BOUNDS_EMPTY};
    shape->bones = primitive->influences.count > 0 ? bones : NULL;
    shape->is_per_corner = primitive->positions.count / 3 > primitive->triangles;
    return glint_morph_init(&shape->morph, primitive->targets, primitive->target_count, weights,
                            weight_count);
}

void glint_shape_free(glint_shape *shape)
{
    glint_morph_free(&shape->morph);
    free(shape->positions);
    free(shape->normals);
    free(shape->orientations);
    *shape = (glint_shape){0};
}

bool glint_shape_is_mirrored(const glint_shape *shape, size_t t)
{
    int sum = 0;
    for (size_t c = 0; shape->bones != NULL && c < 3; c++) {
        sum += shape->orientations[glint_shape_element(shape, t, c)];
    }
    return sum < 0;
}

double glint_shape_cost(const glint_shape *shape)
{
    const size_t each = 1 + shape->morph.counts[GLINT_MORPH_POSITION] +
                        shape->morph.counts[GLINT_MORPH_NORMAL] +
                        4 * shape->primitive->influences.count;
    return (double)element_count(shape) * (double)each;
}

// ---- One element
// ----------------------------------------------------------------------------------

// Returns −1 or 1, the determinant's sign; 0 if the matrix flattens, because then rounding decides
// the sign.
static signed char orientation_of(const glint_mat4 *matrix)
{
    // Relative to the box of the rows' lengths. This is far above the rounding of sums of doubles
    // and far below the precision of the file's floats.
    const double flat = 1e-12;
    const double determinant = glint_mat4_determinant3(matrix);
    double squares = flat * flat;
    for (int row = 0; row < 3; row++) {
        const glint_vec3 r = {matrix->m[row][0], matrix->m[row][1], matrix->m[row][2]};
        squares *= glint_vec3_dot(r, r);
    }
    return determinant * determinant <= squares ? 0 : determinant < 0 ? -1 : 1;
}

static glint_vec3 morphed(const glint_shape *shape, const glint_array *array,
                          glint_morph_attribute attribute, size_t vertex)
{
    double v[3];
    glint_array_numbers(array, vertex, 3, v);
    glint_morph_add(&shape->morph, attribute, vertex, v);
    return (glint_vec3){v[0], v[1], v[2]};
}

static glint_weighting deform_element(glint_shape *shape, size_t element)
{
    const glint_primitive *primitive = shape->primitive;
    const size_t vertex = vertex_of(shape, element);
    glint_vec3 *position = &shape->positions[element];
    *position = morphed(shape, &primitive->positions, GLINT_MORPH_POSITION, vertex);
    if (shape->normals != NULL) {
        shape->normals[element] = morphed(shape, &primitive->normals, GLINT_MORPH_NORMAL, vertex);
    }
    if (shape->bones == NULL) {
        return GLINT_WEIGHTS_GOOD;
    }
    glint_mat4 blend;
    const glint_weighting weighting =
        glint_joints_blend(&primitive->influences, vertex, shape->bones, &blend);
    if (glint_weighting_is_fault(weighting)) {
        return weighting;
    }
    *position = glint_mat4_point(&blend, *position);
    shape->orientations[element] = orientation_of(&blend);
    if (shape->normals != NULL) {
        const glint_vec3 turned = glint_mat4_normal(&blend, shape->normals[element]);
        // A flattened mesh keeps the side of a determinant of +0.
        const bool undo = shape->orientations[element] == 0 && glint_mat4_determinant3(&blend) < 0;
        shape->normals[element] = glint_vec3_scale(turned, undo ? -1 : 1);
    }
    return weighting;
}

// ---- All
// ------------------------------------------------------------------------------------------

// Some elements of a shape, and the verdicts on their weights.
typedef struct task {
    glint_shape *shape;
    size_t first, end;
    bool met[GLINT_WEIGHTINGS];
} task;

static void run_task(size_t index, void *context)
{
    task *one = &((task *)context)[index];
    for (; one->first < one->end; one->first++) {
        const glint_weighting weighting = deform_element(one->shape, one->first);
        one->met[weighting] = true;
        if (glint_weighting_is_fault(weighting)) {
            return; // `first` is the faulty element
        }
    }
}

static glint_status check_cost(glint_shape *const *shapes, size_t count, bool with_normals,
                               glint_error *error)
{
    const size_t bytes = sizeof(glint_vec3) * (with_normals ? 2 : 1) + 1;
    size_t elements = 0;
    double cost = 0;
    for (size_t i = 0; i < count; i++) {
        elements += element_count(shapes[i]);
        cost += glint_shape_cost(shapes[i]);
    }
    if (cost > most_cost) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "its skins and morph targets move %.9g vectors a frame, more than %.9g "
                          "(split the scene)",
                          cost, most_cost);
    }
    if (elements > glint_free_memory() / bytes) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY,
                          "%zu vertices of skins and morph targets do not fit into the free memory "
                          "(render a part with --only)",
                          elements);
    }
    return GLINT_OK;
}

static bool allocate(glint_shape *shape, bool with_normals)
{
    const size_t count = element_count(shape);
    free(shape->positions);
    free(shape->normals);
    free(shape->orientations);
    shape->positions = glint_allocate(count, sizeof(glint_vec3));
    shape->normals = with_normals && shape->primitive->normals.count > 0
                         ? glint_allocate(count, sizeof(glint_vec3))
                         : NULL;
    shape->orientations = shape->bones != NULL ? glint_allocate(count, 1) : NULL;
    return shape->positions != NULL && (shape->bones == NULL || shape->orientations != NULL) &&
           (!with_normals || shape->primitive->normals.count == 0 || shape->normals != NULL);
}

// Allocates the shapes' memory and divides the work. NULL if memory is short.
static task *divide(glint_shape *const *shapes, size_t count, bool with_normals, size_t *task_count)
{
    size_t total = 0;
    for (size_t i = 0; i < count; i++) {
        if (!allocate(shapes[i], with_normals)) {
            return NULL;
        }
        total += (element_count(shapes[i]) + elements_per_task - 1) / elements_per_task;
    }
    task *tasks = glint_allocate(total, sizeof *tasks);
    *task_count = 0;
    for (size_t i = 0; i < count && tasks != NULL; i++) {
        const size_t elements = element_count(shapes[i]);
        for (size_t first = 0; first < elements; first += elements_per_task) {
            const size_t left = elements - first;
            tasks[(*task_count)++] =
                (task){shapes[i],
                       first,
                       first + (left < elements_per_task ? left : elements_per_task),
                       {false}};
        }
    }
    return tasks;
}

// Refuses what is faulty; tallies, once a shape, what is repaired.
static glint_status judge(const task *tasks, size_t count, glint_tally *tally, glint_error *error)
{
    static const struct {
        glint_weighting met;
        const char *said;
    } repairs[] = {
        {GLINT_WEIGHTS_NOT_ONE, "joint weights do not sum to 1 and are normalised"},
        {GLINT_WEIGHTS_NONE,
         "vertices without a joint weight follow the first joint that they name"},
    };
    const glint_shape *said[2] = {NULL, NULL};
    char place[GLINT_PRIMITIVE_PLACE];
    for (size_t i = 0; i < count; i++) {
        const glint_shape *shape = tasks[i].shape;
        (void)glint_primitive_place(shape->primitive, place);
        if (tasks[i].met[GLINT_WEIGHTS_FAULTY] || tasks[i].met[GLINT_JOINT_FAULTY]) {
            return glint_joints_refuse(&shape->primitive->influences,
                                       vertex_of(shape, tasks[i].first), shape->bones->count, place,
                                       error);
        }
        for (int k = 0; k < 2; k++) {
            if (tasks[i].met[repairs[k].met] && said[k] != shape) {
                glint_tally_add(tally, repairs[k].said, place);
                said[k] = shape;
            }
        }
    }
    return GLINT_OK;
}

glint_status glint_shapes_deform(glint_shape *const *shapes, size_t count, bool with_normals,
                                 glint_tally *tally, glint_error *error)
{
    TRY(check_cost(shapes, count, with_normals, error));
    size_t task_count = 0;
    task *tasks = divide(shapes, count, with_normals, &task_count);
    if (tasks == NULL) {
        return glint_fail_memory(error, "skins and morph targets");
    }
    glint_parallel_for(task_count, run_task, tasks);
    const glint_status status = judge(tasks, task_count, tally, error);
    free(tasks);
    return status;
}
