// Finds the root nodes that a scene shows. See roots.h.
#include "scene/gltf/roots.h"

#include "base/memory.h"
#include "scene/gltf/names.h"
#include "scene/gltf/notes.h"

#include <stdlib.h>

// What is known about a node, bits.
enum {
    LISTED = 1,
    MET = 2,   // in the list
    ASKED = 4, // the next bit is known
    BELOW = 8, // an ancestor is listed
};

// Finds whether an ancestor of a node is listed. Each ancestor is asked once, so all calls together
// take linear time.
static bool is_below_listed(const glint_document *document, int32_t node, unsigned char *known)
{
    int32_t end = node;
    bool is_below = false;
    for (; end >= 0 && (known[end] & ASKED) == 0; end = document->nodes[end].parent) {
        if (end != node && (known[end] & LISTED) != 0) {
            is_below = true;
            break;
        }
    }
    if (end >= 0 && !is_below) {
        is_below = (known[end] & BELOW) != 0 || (end != node && (known[end] & LISTED) != 0);
    }
    for (int32_t up = node; up != end; up = document->nodes[up].parent) {
        known[up] |= (unsigned char)(ASKED | (is_below ? BELOW : 0));
    }
    return is_below;
}

// Returns what is unusual about a node that a scene lists; NULL: nothing. *is_root: it is drawn as
// a root.
static const char *judge(const glint_document *document, int32_t node, unsigned char *known,
                         bool *is_root)
{
    *is_root = false;
    if ((known[node] & MET) != 0) {
        return "the scene lists the node twice (it is drawn once)";
    }
    known[node] |= MET;
    if (is_below_listed(document, node, known)) {
        return "the scene lists the node, and shows it below its parent, too (it is drawn once, "
               "there)";
    }
    *is_root = true;
    return document->nodes[node].parent >= 0
               ? "the scene lists the node, but not its parent (it is drawn where it stands "
                 "without the parent)"
               : NULL;
}

// A scene should list roots, each once. Nodes with a parent are drawn once: in the parent's tree if
// the scene shows it, else as roots, as three.js does.
static glint_status settle(const glint_document *document, glint_run listed, glint_roots *roots,
                           glint_tally *tally, glint_error *error)
{
    unsigned char *known = glint_allocate(document->nodes_count, 1);
    if (known == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    const int32_t *nodes = document->node_lists + listed.first;
    for (uint32_t i = 0; i < listed.count; i++) {
        known[nodes[i]] |= LISTED;
    }
    for (uint32_t i = 0; i < listed.count; i++) {
        bool is_root;
        const char *said = judge(document, nodes[i], known, &is_root);
        if (said != NULL) {
            char where[GLINT_WHERE];
            glint_tally_add(tally, said, glint_node_place(document, nodes[i], where));
        }
        if (is_root) {
            roots->nodes[roots->count++] = nodes[i];
        }
    }
    free(known);
    return GLINT_OK;
}

glint_status glint_roots_find(const glint_document *document, const char *name, glint_roots *roots,
                              glint_tally *tally, glint_error *error)
{
    *roots = (glint_roots){glint_allocate(document->nodes_count, sizeof *roots->nodes), 0};
    if (roots->nodes == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    size_t scene = document->default_scene >= 0 ? (size_t)document->default_scene : 0;
    if (name != NULL) {
        const glint_named_rows rows = GLINT_NAMED_ROWS(document, scenes, "scene");
        TRY(glint_name_find(&rows, name, &scene, error));
    }
    if (document->scenes_count > 0) {
        char where[GLINT_WHERE];
        const glint_document_scene *chosen = &document->scenes[scene];
        glint_notes_tally(document, chosen->notes, glint_name_place("scenes", scene, "", where),
                          tally);
        return settle(document, chosen->roots, roots, tally, error);
    }
    // glTF calls such a file a library. A user who renders it wants to see its contents.
    for (size_t i = 0; i < document->nodes_count; i++) {
        if (document->nodes[i].parent < 0) {
            roots->nodes[roots->count++] = (int32_t)i;
        }
    }
    if (roots->count > 0) {
        glint_tally_add(tally, "missing, so that every root node is shown", "scenes");
    }
    return GLINT_OK;
}
