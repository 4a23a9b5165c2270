// Where solids touch and overlap: for solids.c alone.
#ifndef GLINT_SCENE_CONTACTS_H
#define GLINT_SCENE_CONTACTS_H

#include "scene/solids.h"

// Fills solids->contacts, and marks the records of triangles, which stand ready, with
// GLINT_SOLID_TOUCHES. False where memory is short.
bool glint_contacts_find(const glint_scene *scene, const glint_topology *topology,
                         glint_solids *solids);

#endif
