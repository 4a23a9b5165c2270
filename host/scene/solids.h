// Solids that touch or overlap, and which of them is there where several are.
//
// Priorities are those of Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images"
// (2002): where solids overlap the one of the highest priority is there and the others are not. Of
// equal priorities that of the least volume is: an ice cube in water, a bubble in the ice, and a
// thin glass around its wine. Surfaces that bound no solid are met before those of solids that they
// lie on: metal around a stone, or a table under a glass.
#ifndef GLINT_SCENE_SOLIDS_H
#define GLINT_SCENE_SOLIDS_H

#include "base/status.h"
#include "kernels/layout.h"
#include "scene/scene.h"
#include "scene/topology.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Two solids whose surfaces meet.
typedef struct glint_contact {
    uint32_t components[2]; // of the topology, the lower first; the same of one that touches itself
    uint32_t instances[2];  // of the scene, likewise
    bool overlap;           // the surfaces cross; else they only lie in each other's planes
    int there;              // which of the two is there where both are
    bool is_guess;          // by its volume: the materials differ, and their priorities do not
} glint_contact;

// Zero is valid: no solids.
typedef struct glint_solids {
    size_t contact_count;
    glint_contact *contacts; // in the order of their components
    bool touch_others;       // a surface that bounds no solid lies in one place with some solid's
    size_t component_count;  // of these solids
    size_t medium_count;     // from the one that gives way to all others on
    uint32_t *material_of;   // [medium]
    glint_solid_record *of_triangle; // [triangle of the scene]
} glint_solids;

// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_solids_find(const glint_scene *scene, const glint_topology *topology,
                               glint_solids *solids, glint_error *error);
void glint_solids_free(glint_solids *solids);

// Whether some solid's material has a priority of its own.
bool glint_solids_have_priorities(const glint_scene *scene);

#define GLINT_CONTACT_TEXT 400 // bytes that hold any text of a contact, and of guesses

// ""wine" (node 2, water) touches "bowl" (node 1, glass)" into `text`.
void glint_contact_describe(const glint_scene *scene, const glint_contact *contact, char *text,
                            size_t capacity);

// The same of the first contact that is a guess, and how many more there are; empty: none is.
void glint_solids_describe_guesses(const glint_scene *scene, const glint_solids *solids, char *text,
                                   size_t capacity);

// Adds what to do about these guesses to the warnings.
void glint_solids_warn(const glint_scene *scene, const char *guesses, glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
