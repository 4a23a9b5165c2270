// Reads the inverse bind matrices of skins. See pose.h.
#include "scene/gltf/pose.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static glint_status read_matrix(const glint_array *matrices, size_t skin, size_t joint,
                                glint_mat4 *result, glint_error *error)
{
    const double tolerance = 1e-5; // of the last row, as for a node's matrix
    double m[16];
    glint_array_numbers(matrices, joint, 16, m);
    for (int i = 0; i < 16; i++) {
        if (!isfinite(m[i])) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "skins[%zu].inverseBindMatrices: matrix %zu is not finite (the file "
                              "is damaged)",
                              skin, joint);
        }
    }
    if (fabs(m[3]) > tolerance || fabs(m[7]) > tolerance || fabs(m[11]) > tolerance ||
        fabs(m[15] - 1) > tolerance) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "skins[%zu].inverseBindMatrices: the last row of matrix %zu is not 0 0 0 "
                          "1 (glTF 2.0 requires it)",
                          skin, joint);
    }
    *result = glint_mat4_identity;
    for (int i = 0; i < 16; i++) {
        if (i % 4 < 3) {
            result->m[i % 4][i / 4] = m[i]; // the file stores columns
        }
    }
    return GLINT_OK;
}

glint_status glint_skins_read(const glint_document *document, glint_mat4 **inverse_bind,
                              glint_error *error)
{
    *inverse_bind = glint_allocate(document->joints_count, sizeof **inverse_bind);
    if (*inverse_bind == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t s = 0; s < document->skins_count; s++) {
        const glint_document_skin *skin = &document->skins[s];
        const glint_array matrices = glint_array_open(document, skin->inverse_bind);
        for (uint32_t j = 0; j < skin->joints.count; j++) {
            glint_mat4 *matrix = &(*inverse_bind)[skin->joints.first + j];
            *matrix = glint_mat4_identity;
            if (matrices.count > 0) {
                TRY(read_matrix(&matrices, s, j, matrix, error));
            }
        }
    }
    return GLINT_OK;
}
