// Tests whether solids may nest, by the bounds of their components. See topology.h.
#include "scene/shape/topology.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The bounds of a component. The axes are turned so that boxes spread most along the first axis.
typedef struct box {
    float low[3], high[3];
} box;

static int compare_boxes(const void *left, const void *right)
{
    const box *a = left;
    const box *b = right;
    return (a->low[0] > b->low[0]) - (a->low[0] < b->low[0]);
}

// Touching boxes overlap too: at a shared face, rounding decides the order of two hits.
static bool overlap(const box *a, const box *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) {
            return false;
        }
    }
    return true;
}

static int widest_axis(const box *boxes, size_t count)
{
    int widest = 0;
    float width = -1;
    for (int k = 0; k < 3; k++) {
        float low = INFINITY;
        float high = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            low = fminf(low, boxes[i].low[k]);
            high = fmaxf(high, boxes[i].low[k]);
        }
        if (high - low > width) {
            width = high - low;
            widest = k;
        }
    }
    return widest;
}

// Sweeps along the widest axis. If many boxes lie side by side across this axis, gives up and
// returns true: an expensive proof counts as no proof.
static bool may_overlap(box *boxes, size_t count)
{
    int axis = widest_axis(boxes, count);
    for (size_t i = 0; i < count && axis > 0; i++) {
        box turned = boxes[i];
        for (int k = 0; k < 3; k++) {
            turned.low[k] = boxes[i].low[(k + axis) % 3];
            turned.high[k] = boxes[i].high[(k + axis) % 3];
        }
        boxes[i] = turned;
    }
    qsort(boxes, count, sizeof *boxes, compare_boxes);
    size_t budget = 64 * 1024 * 1024;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = i + 1; j < count && boxes[j].low[0] <= boxes[i].high[0]; j++) {
            if (overlap(&boxes[i], &boxes[j]) || budget-- == 0) {
                return true;
            }
        }
    }
    return false;
}

bool glint_topology_solids_may_nest(const glint_scene *scene, const glint_topology *topology)
{
    box *boxes = glint_allocate(topology->component_count, sizeof *boxes);
    bool may_nest = boxes == NULL;
    size_t count = 0;
    for (size_t i = 0; i < topology->component_count && !may_nest; i++) {
        const glint_component *component = &topology->components[i];
        const glint_instance *instance = &scene->instances[component->instance];
        if (!glint_instance_is_solid(scene, instance)) {
            continue;
        }
        may_nest = !component->convex;
        memcpy(boxes[count].low, component->low, sizeof boxes->low);
        memcpy(boxes[count].high, component->high, sizeof boxes->high);
        count++;
    }
    may_nest = may_nest || may_overlap(boxes, count);
    free(boxes);
    return may_nest;
}
