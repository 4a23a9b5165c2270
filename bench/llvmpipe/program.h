// The same mirror by OpenGL: one draw of the mesh, whose fragments look up the environment along
// the reflected direction, and one of the background. bench/README.md says what is in its times.
#ifndef GLINT_BENCH_LLVMPIPE_PROGRAM_H
#define GLINT_BENCH_LLVMPIPE_PROGRAM_H

#include "base/status.h"
#include "environment/environment.h"
#include "scenes.h"

// What the environment's texels are.
typedef enum llvmpipe_texels {
    LLVMPIPE_FLOATS, // GL_RGBA32F
    LLVMPIPE_HALVES, // GL_RGBA16F
    LLVMPIPE_TEXELS,
} llvmpipe_texels;

const char *llvmpipe_texels_name(llvmpipe_texels texels); // "RGBA32F"

typedef struct llvmpipe_inputs {
    const bench_scene *scene;      // borrowed during creation only
    const glint_cube *environment; // likewise
    int width, height;             // pixels
} llvmpipe_inputs;

typedef struct llvmpipe_program llvmpipe_program; // opaque

// Compiles and uploads into the context that is current. Errors: GLINT_DEVICE_FAILED; a shader that
// does not compile leaves the log in error->details.
glint_status llvmpipe_program_create(const llvmpipe_inputs *inputs, llvmpipe_program **program,
                                     glint_error *error);

// NULL is allowed.
void llvmpipe_program_free(llvmpipe_program *program);

// Draws a frame and returns its milliseconds, from the first call to when the driver has finished.
double llvmpipe_program_frame(llvmpipe_program *program, llvmpipe_texels texels);

// Reads the last frame, [height][width][4], row 0 at the top. Errors: GLINT_DEVICE_FAILED where
// OpenGL has reported an error in any call so far.
glint_status llvmpipe_program_read(llvmpipe_program *program, float *pixels, glint_error *error);

#endif
