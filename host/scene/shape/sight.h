// Proves how many surfaces a path of light can meet. A greater path depth changes nothing, so glint
// does not trace it.
#ifndef GLINT_SCENE_SHAPE_SIGHT_H
#define GLINT_SCENE_SHAPE_SIGHT_H

#include "scene/scene.h"
#include "scene/shape/topology.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Zero is valid: nothing is proved.
typedef struct glint_sight {
    int depth;         // the depth that is exact, 1 or 2; 0: nothing is proved
    bool from_outside; // holds only for paths that begin outside the scene's bounds
    bool exits_escape; // depth is 0, but light that leaves a solid meets nothing
    // Such as "a closed, convex mirror sees nothing but the environment"; for depth 0, the obstacle
    // to a proof.
    char reason[120];
} glint_sight;

// True if convexity could prove something about the scene, so that finding the topology pays.
// Visits each triangle at most once, and only a few of a body with hollows.
bool glint_sight_wants_topology(const glint_scene *scene, bool rough);

// Proves the depth. `rough`: rough surfaces reflect lobes, and a path follows a lobe's middle;
// otherwise rough paint reflects nothing. If `topology` is empty, convexity is unknown. Proofs hold
// up to roundings of the vertices (see convexity.h); bends of this size add up to 1/1024 at most.
//
// The proofs rest on three facts, for any vertex normals. A reflected direction is folded to the
// side of its triangle's plane that it comes from. A refracted direction is folded to the other
// side. A convex body lies behind each of its planes. Tracing in float may differ for slivers,
// whose planes turn by rounding. The proof then gives the correct picture.
glint_sight glint_sight_find(const glint_scene *scene, const glint_topology *topology, bool rough);

#ifdef __cplusplus
}
#endif

#endif
