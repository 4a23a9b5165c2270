// How many surfaces a path of light can meet, where that can be proved: at a greater depth nothing
// changes, so that nothing needs to be traced.
#ifndef GLINT_SCENE_SIGHT_H
#define GLINT_SCENE_SIGHT_H

#include "scene/scene.h"
#include "scene/topology.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Zero is valid: nothing is proved.
typedef struct glint_sight {
    int depth;         // that is exact, 1 or 2; 0: none is proved
    bool from_outside; // for paths that begin outside of the scene's bounds alone
    bool exits_escape; // what leaves a solid, refracted or reflected, meets nothing; without depth
    char reason[120];  // "a closed, convex mirror sees nothing but the environment"; without a
                       // depth what stands in the way
} glint_sight;

// Whether convexity could prove anything of the scene: then the topology is worth its time. Looks
// at every triangle at most, and for a body with hollows at a few.
bool glint_sight_wants_topology(const glint_scene *scene, bool rough);

// `rough`: rough surfaces reflect lobes, of which the middle is a path; else rough paint reflects
// nothing. `topology` may be empty: then nothing is known of convexity. Proofs hold up to roundings
// of the vertices (see convexity.h; bends of so little add up to 1/1024 at most). They rest on
// these facts: a reflected direction is folded to the side of its triangle's plane that it comes
// from, and a refracted one to the other, whatever the vertices' normals say; and a convex body
// lies behind each of its planes. A float's tracing may say otherwise of slivers, whose plane
// rounding has turned; what is proved is what they should show.
glint_sight glint_sight_find(const glint_scene *scene, const glint_topology *topology, bool rough);

#ifdef __cplusplus
}
#endif

#endif
