// Finds where solids touch and overlap; only solids.c uses it.
#ifndef GLINT_SCENE_SHAPE_CONTACTS_H
#define GLINT_SCENE_SHAPE_CONTACTS_H

#include "scene/shape/solids.h"

// Fills solids->contacts, and marks the records of touching triangles with GLINT_SOLID_TOUCHES. The
// records are allocated already. Returns false if memory is short.
bool glint_contacts_find(const glint_scene *scene, const glint_topology *topology,
                         glint_solids *solids);

#endif
