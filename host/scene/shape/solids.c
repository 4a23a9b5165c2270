// Finds solids that touch or overlap, and ranks them. See solids.h.
#include "scene/shape/solids.h"

#include "base/memory.h"
#include "scene/shape/contacts.h"
#include "scene/shape/openings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// With more media, paths have too few entries for the solids that they are inside.
#define MEDIA_MAX 63

typedef struct ranked {
    double priority, volume;
    uint32_t component;  // the component with this volume
    uint32_t belongs_to; // itself; for a hollow, the solid around it
    uint32_t material;
} ranked;

// Sorts by rank: the solid that yields to all others first, hollows last. Of two equal solids the
// first in the file yields.
static int compare_ranks(const void *left, const void *right)
{
    const ranked *a = left;
    const ranked *b = right;
    const bool hollow = a->belongs_to != a->component;
    if (hollow != (b->belongs_to != b->component)) {
        return hollow ? 1 : -1;
    }
    if (a->priority != b->priority) {
        return a->priority < b->priority ? -1 : 1;
    }
    if (a->volume != b->volume) {
        return a->volume > b->volume ? -1 : 1;
    }
    return a->component < b->component ? -1 : a->component > b->component;
}

// The most pairs of hollows and solids to compare. With more, no hollow is looked for.
#define PAIRS_MAX ((size_t)64 * 1024 * 1024)

// True if the faces wind clockwise seen from outside, by more than rounding explains.
static bool is_turned(const glint_component *component)
{
    return component->volume < -component->volume_error;
}

// Finds the solid around a hollow. Of the solids of its material, or of one like it, whose bounds
// hold the hollow's bounds, this is the one of least volume. NULL: none.
static ranked *solid_around(const glint_scene *scene, const glint_topology *topology,
                            const ranked *hollow, ranked *upright, size_t count)
{
    const glint_material *materials = scene->materials;
    const glint_component *inner = &topology->components[hollow->component];
    ranked *around = NULL;
    for (size_t i = 0; i < count; i++) {
        const glint_component *outer = &topology->components[upright[i].component];
        bool holds = glint_material_media_are_alike(&materials[upright[i].material],
                                                    &materials[hollow->material]);
        for (int k = 0; k < 3; k++) {
            holds = holds && outer->low[k] <= inner->low[k] && outer->high[k] >= inner->high[k];
        }
        if (holds &&
            (around == NULL || outer->volume < topology->components[around->component].volume)) {
            around = &upright[i];
        }
    }
    return around;
}

// Appends the solids that are turned, or those that are not, to the `listed` ones. Returns how many
// there are then.
static size_t append_solids(const glint_scene *scene, const glint_topology *topology, bool turned,
                            ranked *all, size_t listed)
{
    for (size_t i = 0; i < topology->component_count; i++) {
        const glint_component *c = &topology->components[i];
        const glint_material *m = &scene->materials[c->material];
        if (is_turned(c) == turned && glint_material_lobes(m).solid) {
            all[listed++] = (ranked){.priority = (double)m->priority,
                                     .volume = fabs(c->volume),
                                     .component = (uint32_t)i,
                                     .belongs_to = (uint32_t)i,
                                     .material = c->material};
        }
    }
    return listed;
}

// Fills `all` with the solids, and assigns hollows to the solids around them. Counts those of
// several materials.
static size_t list_solids(const glint_scene *scene, const glint_topology *topology, ranked *all,
                          glint_solids *solids)
{
    const size_t upright = append_solids(scene, topology, false, all, 0);
    const size_t listed = append_solids(scene, topology, true, all, upright);
    for (size_t i = 0; i < listed; i++) {
        solids->mixed_count += topology->components[all[i].component].has_materials;
    }
    for (size_t i = upright; (listed - upright) * upright <= PAIRS_MAX && i < listed; i++) {
        ranked *around = solid_around(scene, topology, &all[i], all, upright);
        if (around != NULL) {
            all[i].belongs_to = around->component;
            solids->mixed_count += all[i].material != around->material;
            around->volume -= all[i].volume;
        }
    }
    return listed;
}

// Sorts the solids by rank, hollows last. Returns the number of solids without the hollows.
static size_t rank_solids(ranked *all, size_t listed)
{
    qsort(all, listed, sizeof *all, compare_ranks);
    size_t count = 0;
    while (count < listed && all[count].belongs_to == all[count].component) {
        count++;
    }
    return count;
}

// The number of media if only neighbours in the ranking share a medium.
static size_t count_runs(const ranked *all, size_t count)
{
    size_t runs = count > 0;
    for (size_t i = 1; i < count; i++) {
        runs += all[i].material != all[i - 1].material;
    }
    return runs;
}

// Numbers the media by rank, the yielding one first. Solids of one material share a medium if no
// other material ranks between them. If this makes too many media, all solids of a material share
// the rank of its largest solid. Sets `medium_of` each component to its medium's number, from 1.
static void rank_media(const ranked *all, size_t count, glint_solids *solids, uint32_t *medium_of)
{
    const bool by_solid = count_runs(all, count) <= MEDIA_MAX;
    for (size_t i = 0; i < count; i++) {
        size_t medium = solids->medium_count;
        if (by_solid) {
            medium -= medium > 0 && solids->material_of[medium - 1] == all[i].material;
        } else {
            for (medium = 0;
                 medium < solids->medium_count && solids->material_of[medium] != all[i].material;) {
                medium++;
            }
        }
        solids->material_of[medium] = all[i].material;
        solids->medium_count += medium == solids->medium_count;
        medium_of[all[i].component] = (uint32_t)medium + 1;
    }
}

static void count_fault(bool has_it, size_t component, glint_fault *fault)
{
    if (has_it) {
        fault->first = fault->count == 0 ? (uint32_t)component : fault->first;
        fault->count++;
    }
}

// Finds faults of the `listed` solids. Returns false if memory is short.
static bool find_faults(const glint_scene *scene, const glint_topology *topology, const ranked *all,
                        size_t listed, glint_solid_faults *faults)
{
    bool *is_open = glint_allocate(topology->component_count, sizeof *is_open);
    bool *is_inside_out = glint_allocate(topology->component_count, sizeof *is_inside_out);
    bool done = is_open != NULL && is_inside_out != NULL;
    bool any_open = false;
    for (size_t i = 0; done && i < listed; i++) {
        const glint_component *c = &topology->components[all[i].component];
        is_open[all[i].component] = !c->closed;
        is_inside_out[all[i].component] =
            c->closed && is_turned(c) && all[i].belongs_to == all[i].component;
        any_open = any_open || !c->closed;
    }
    done = done && (!any_open || glint_openings_judge(scene, topology, is_open));
    for (size_t i = 0; done && i < topology->component_count; i++) {
        count_fault(is_inside_out[i], i, &faults->inside_out);
        count_fault(is_open[i], i, &faults->open);
        count_fault(topology->components[i].has_media, i, &faults->mixed);
    }
    free(is_open);
    free(is_inside_out);
    return done;
}

static void record_triangles(const glint_scene *scene, const glint_topology *topology,
                             const uint32_t *medium_of, glint_solids *solids)
{
    for (size_t i = 0; i < scene->triangle_count; i++) {
        const uint32_t component = topology->component_of[i];
        const bool known = component < topology->component_count;
        solids->of_triangle[i] = (glint_solid_record){.component = known ? (int)component : -1,
                                                      .medium = known ? medium_of[component] : 0};
    }
}

static void settle_contacts(const glint_scene *scene, const glint_topology *topology,
                            const uint32_t *medium_of, glint_solids *solids)
{
    for (size_t i = 0; i < solids->contact_count; i++) {
        glint_contact *contact = &solids->contacts[i];
        const glint_material *of[2];
        for (int k = 0; k < 2; k++) {
            contact->instances[k] = topology->components[contact->components[k]].instance;
            of[k] = &scene->materials[topology->components[contact->components[k]].material];
        }
        contact->there =
            medium_of[contact->components[1]] > medium_of[contact->components[0]] ? 1 : 0;
        contact->is_guess = of[0] != of[1] && of[0]->priority == of[1]->priority;
    }
}

glint_status glint_solids_find(const glint_scene *scene, const glint_topology *topology,
                               glint_solids *solids, glint_error *error)
{
    *solids = (glint_solids){0};
    const size_t components = topology->component_count;
    ranked *all = glint_allocate(components, sizeof *all);
    uint32_t *medium_of = glint_allocate(components, sizeof *medium_of);
    solids->material_of = glint_allocate(components, sizeof *solids->material_of);
    solids->of_triangle = glint_allocate(scene->triangle_count, sizeof *solids->of_triangle);
    bool done = all != NULL && medium_of != NULL && solids->material_of != NULL &&
                solids->of_triangle != NULL;
    if (done) {
        const size_t listed = list_solids(scene, topology, all, solids);
        done = find_faults(scene, topology, all, listed, &solids->faults);
        const size_t count = rank_solids(all, listed);
        rank_media(all, count, solids, medium_of);
        for (size_t i = count; i < listed; i++) {
            medium_of[all[i].component] = medium_of[all[i].belongs_to];
        }
        solids->component_count = listed;
        record_triangles(scene, topology, medium_of, solids);
        done = done && glint_contacts_find(scene, topology, solids);
        settle_contacts(scene, topology, medium_of, solids);
    }
    free(all);
    free(medium_of);
    if (!done) {
        glint_solids_free(solids);
        return glint_fail_memory(error, "the solids of the scene");
    }
    return GLINT_OK;
}

void glint_solids_free(glint_solids *solids)
{
    free(solids->contacts);
    free(solids->material_of);
    free(solids->of_triangle);
    *solids = (glint_solids){0};
}

bool glint_solids_have_priorities(const glint_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        const glint_material *m = &scene->materials[i];
        if (m->priority != 0 && glint_material_lobes(m).solid) {
            return true;
        }
    }
    return false;
}

// Names a solid. Most nodes have names; the node's number distinguishes equal names.
static void name_solid(const glint_scene *scene, uint32_t number, char *text, size_t capacity)
{
    const glint_instance *instance = &scene->instances[number];
    const char *material = scene->materials[instance->material].name;
    snprintf(text, capacity, "%s%s%s (node %d, %s)", instance->node != NULL ? "\"" : "",
             instance->node != NULL ? instance->node : "a solid",
             instance->node != NULL ? "\"" : "", instance->node_index,
             material != NULL ? material : "a material without a name");
}

void glint_contact_describe(const glint_scene *scene, const glint_contact *contact, char *text,
                            size_t capacity)
{
    char first[160];
    char second[160];
    name_solid(scene, contact->instances[0], first, sizeof first);
    name_solid(scene, contact->instances[1], second, sizeof second);
    if (contact->components[0] == contact->components[1]) {
        snprintf(text, capacity, "%s touches itself", first);
    } else {
        snprintf(text, capacity, "%s %s %s", first, contact->overlap ? "overlaps" : "touches",
                 second);
    }
}

static void remark_guesses(const glint_scene *scene, const glint_solids *solids, char *text)
{
    const glint_contact *first = NULL;
    size_t guesses = 0;
    for (size_t i = 0; i < solids->contact_count; i++) {
        guesses += solids->contacts[i].is_guess;
        first = first == NULL && solids->contacts[i].is_guess ? &solids->contacts[i] : first;
    }
    if (first != NULL) {
        char pair[GLINT_CONTACT_TEXT - 40];
        char more[40] = "";
        glint_contact_describe(scene, first, pair, sizeof pair);
        if (guesses > 1) {
            snprintf(more, sizeof more, ", and %zu more pair%s", guesses - 1,
                     guesses == 2 ? "" : "s");
        }
        snprintf(text, GLINT_CONTACT_TEXT, "%s%s", pair, more);
    }
}

// Writes such as ""ball" (node 1, glass) and 2 more solids are".
static void remark_fault(const glint_scene *scene, const glint_topology *topology,
                         const glint_fault *fault, char *text)
{
    char first[160];
    if (fault->count > 0) {
        name_solid(scene, topology->components[fault->first].instance, first, sizeof first);
    }
    if (fault->count == 1) {
        snprintf(text, GLINT_CONTACT_TEXT, "%s is", first);
    } else if (fault->count > 1) {
        snprintf(text, GLINT_CONTACT_TEXT, "%s and %zu more solid%s are", first, fault->count - 1,
                 fault->count == 2 ? "" : "s");
    }
}

void glint_solids_remark(const glint_scene *scene, const glint_topology *topology,
                         const glint_solids *solids, glint_solids_remarks *remarks)
{
    *remarks = (glint_solids_remarks){{0}, {0}, {0}, {0}};
    remark_guesses(scene, solids, remarks->guesses);
    remark_fault(scene, topology, &solids->faults.inside_out, remarks->inside_out);
    remark_fault(scene, topology, &solids->faults.open, remarks->open);
    remark_fault(scene, topology, &solids->faults.mixed, remarks->mixed);
}

void glint_solids_warn(const glint_scene *scene, const glint_solids_remarks *remarks,
                       glint_warnings *warnings)
{
    const char *path = scene->path != NULL ? scene->path : "the scene";
    if (remarks->guesses[0] != '\0') {
        glint_warn(warnings,
                   "%s: %s: where both are, the one of less volume is taken to be there (say which "
                   "by extras {\"glint\": {\"priority\": 1}} of its material)",
                   path, remarks->guesses);
    }
    if (remarks->inside_out[0] != '\0') {
        glint_warn(warnings,
                   "%s: %s inside out: light refracts as if glass were all around, and air inside "
                   "(flip the faces)",
                   path, remarks->inside_out);
    }
    if (remarks->open[0] != '\0') {
        glint_warn(warnings,
                   "%s: %s open: light that enters and passes the opening stays inside (close the "
                   "mesh, or set the thickness to 0 for a thin wall)",
                   path, remarks->open);
    }
    if (remarks->mixed[0] != '\0') {
        glint_warn(warnings,
                   "%s: %s bounded by materials in which light travels differently: the one of the "
                   "highest priority counts, else the first (give them one index and one "
                   "attenuation)",
                   path, remarks->mixed);
    }
}
