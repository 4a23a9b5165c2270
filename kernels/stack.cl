// Defines the scene on the device, and the stack of nodes and leaves that wait in a traversal, the
// nearest on top.

// Expand the lists of arguments.h to parameters and to members.
#define PARAMETER(type, name) type name,
#define MEMBER(type, name) type name;

// The environment as rough surfaces read it (layout.h, Lobes).
typedef struct cell_map {
    global const float *values; // albedo, brightness and cells
    int last;                   // the finest level
    float tolerance;            // from the frame record
    float compensation;         // from the frame record
} cell_map;

// The scene's buffers, as every part of the shading gets them.
typedef struct scene_buffers {
    uint features[GLINT_FEATURE_WORDS]; // from the frame record, for HAS
    global const float *nodes;
    global const float *clusters;
    global const float *normals;
    global const int *numbers;
    global const glint_material_record *materials;
    global const glint_medium_record *media;
    global const glint_solid_record *solids; // of the triangles, by their numbers
    global const float *attributes;          // of the triangles' corners, by the triangles' numbers
    global const glint_texture_record *textures;
    global const ushort *texels;
    global const glint_light_record *lights;
    float anisotropy;               // from the frame record
    int media_bits, media_capacity; // from the frame record
    cube_map environment, irradiance;
    cell_map cells;
    global const float *vertices; // results at vertices, with VERTEX_COLOR and VERTEX_DIRECTION
    global const uint *pixels;    // with PIXEL_LIST: their numbers, see layout.h
} scene_buffers;

#if GLINT_GENERAL
#define TEXELS_ARE_HALF (frame.half_texels != 0)
#else
#define TEXELS_ARE_HALF GLINT_HALF_TEXELS
#endif

// Makes scene_buffers from the arguments of a kernel.
typedef char all_feature_words_are_copied[GLINT_FEATURE_WORDS == 2 ? 1 : -1];
#define SCENE_OF_ARGUMENTS                                                                         \
    {                                                                                              \
        {frame.features[0], frame.features[1]}, nodes, clusters, normals, numbers, materials,      \
            media, solids, attributes, textures, texels, lights, frame.anisotropy,                 \
            frame.media_bits, frame.media_capacity,                                                \
            {environment, frame.environment_edge, TEXELS_ARE_HALF},                                \
            {irradiance, frame.irradiance_edge, false},                                            \
            {lobes, frame.cells_last, frame.cells_tolerance, frame.compensation}, vertices, listed \
    }

typedef global const float *node_pointer;

static inline node_pointer node_at(const scene_buffers *scene, int index)
{
    return scene->nodes + (size_t)index * (GLINT_NODE_VALUES * GLINT_BVH_WIDTH);
}

static inline int child_of(node_pointer node, int child)
{
    return ((global const int *)(node + 6 * GLINT_BVH_WIDTH))[child];
}

// A waiting node or leaf. `entry` is the distance or depth at which the rays may enter it. `box` is
// the index of its box among the children of all nodes.
typedef struct waiting {
    int child;
    scalar entry;
    int box;
} waiting;

// Prefetches a child that the traversal will soon visit: a node, or a cluster and its normals.
static inline void prefetch_child(const scene_buffers *scene, int child)
{
    if (child >= 0) {
        prefetch_values(node_at(scene, child), GLINT_NODE_VALUES * GLINT_BVH_WIDTH);
        return;
    }
    const size_t index = (size_t)~child;
    prefetch_values(scene->clusters + index * GLINT_CLUSTER_VALUES, GLINT_CLUSTER_VALUES);
    if (GLINT_SMOOTH_NORMALS) {
        prefetch_values(scene->normals + index * GLINT_CLUSTER_NORMALS, GLINT_CLUSTER_NORMALS);
    }
}

// Puts a child of a node on the stack. The entries from `base` on are the node's own children, in
// order of falling distance. Equal distances keep the order of the children, so the order is always
// the same. Returns the new size.
static inline int push_waiting(const scene_buffers *scene, waiting *stack, int base, int size,
                               int node, int child, scalar entry)
{
    int i = size++;
    for (; i > base && stack[i - 1].entry <= entry; i--) {
        stack[i] = stack[i - 1];
    }
    stack[i].child = child_of(node_at(scene, node), child);
    stack[i].entry = entry;
    stack[i].box = node * GLINT_BVH_WIDTH + child;
    prefetch_child(scene, stack[i].child);
    return size;
}
