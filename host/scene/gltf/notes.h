// Gives the warnings that a document has about an object that is shown.
#ifndef GLINT_SCENE_GLTF_NOTES_H
#define GLINT_SCENE_GLTF_NOTES_H

#include "scene/document.h"
#include "scene/gltf/names.h"
#include "scene/gltf/tally.h"

// `where` is the object's place, for notes that name none.
static inline void glint_notes_tally(const glint_document *document, glint_run notes,
                                     const char *where, glint_tally *tally)
{
    for (uint32_t i = 0; i < notes.count; i++) {
        const glint_document_note *note = &document->notes[notes.first + i];
        glint_tally_add_once(tally, glint_document_text(document, note->text),
                             note->where != 0 ? glint_document_text(document, note->where) : where);
    }
}

// Writes a node's place, such as nodes[3] "wheel", and returns it.
static inline const char *glint_node_place(const glint_document *document, int node,
                                           char where[GLINT_WHERE])
{
    return glint_name_place("nodes", (size_t)node,
                            glint_document_text(document, document->nodes[node].name), where);
}

#endif
