// Finds solids that touch or overlap, and decides which solid is present where several overlap.
//
// Priorities follow Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images" (2002).
// Where solids overlap, only the solid of the highest priority is present. Of equal priorities, the
// solid of the least volume is present: an ice cube in water, a bubble in the ice, a thin glass
// around its wine. If a surface that bounds no solid lies on a solid's surface, light meets it
// first: metal around a stone, or a table under a glass.
#ifndef GLINT_SCENE_SHAPE_SOLIDS_H
#define GLINT_SCENE_SHAPE_SOLIDS_H

#include "base/status.h"
#include "kernels/layout.h"
#include "scene/scene.h"
#include "scene/shape/topology.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Two solids whose surfaces meet.
typedef struct glint_contact {
    uint32_t components[2]; // of the topology, lower first; both equal if a solid touches itself
    uint32_t instances[2];  // of the scene, in the same order
    bool overlap;           // the surfaces cross; false: they only lie in one plane
    int there;              // 0 or 1: the solid that is present where both are
    bool is_guess;          // the volumes decided: the materials differ, their priorities do not
} glint_contact;

// Solids of one kind of fault.
typedef struct glint_fault {
    size_t count;
    uint32_t first; // component
} glint_fault;

// Faults of solids that change the picture, though a file may have them.
typedef struct glint_solid_faults {
    glint_fault inside_out; // closed, with faces that wind clockwise seen from outside
    glint_fault open;       // light may leave it without meeting its surface
    glint_fault mixed;      // its surfaces disagree about the medium inside
} glint_solid_faults;

// Zero is valid: no solids.
typedef struct glint_solids {
    size_t contact_count;
    glint_contact *contacts; // sorted by their components
    bool touch_others;       // a surface that bounds no solid coincides with a solid's surface
    size_t component_count;  // components that bound solids, hollows included
    size_t mixed_count;      // components at whose solids' surfaces there are several materials
    glint_solid_faults faults;
    size_t medium_count;             // media by rank: the first yields to all others
    uint32_t *material_of;           // [medium]
    glint_solid_record *of_triangle; // [triangle of the scene]
} glint_solids;

// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_solids_find(const glint_scene *scene, const glint_topology *topology,
                               glint_solids *solids, glint_error *error);
void glint_solids_free(glint_solids *solids);

// True if some solid's material has a priority of its own.
bool glint_solids_have_priorities(const glint_scene *scene);

#define GLINT_CONTACT_TEXT 400 // enough bytes for the text of any contact or guess

// Writes a contact to `text`, such as ""wine" (node 2, water) touches "bowl" (node 1, glass)".
void glint_contact_describe(const glint_scene *scene, const glint_contact *contact, char *text,
                            size_t capacity);

// What is to say about a scene's solids. Empty texts: nothing.
typedef struct glint_solids_remarks {
    char guesses[GLINT_CONTACT_TEXT]; // the first contact that is a guess, and how many more
    char inside_out[GLINT_CONTACT_TEXT], open[GLINT_CONTACT_TEXT], mixed[GLINT_CONTACT_TEXT];
} glint_solids_remarks;

void glint_solids_remark(const glint_scene *scene, const glint_topology *topology,
                         const glint_solids *solids, glint_solids_remarks *remarks);

// Adds warnings that tell how to settle these remarks.
void glint_solids_warn(const glint_scene *scene, const glint_solids_remarks *remarks,
                       glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
