// Draws the same mirror by OpenGL, in two draws: the mesh, whose pixel shader looks up the
// environment along the reflected direction, and the background. bench/README.md lists the work
// that its times include.
#ifndef GLINT_BENCH_LLVMPIPE_PROGRAM_H
#define GLINT_BENCH_LLVMPIPE_PROGRAM_H

#include "base/status.h"
#include "environment/environment.h"
#include "scenes.h"

// Formats of the environment's texels.
typedef enum llvmpipe_texels {
    LLVMPIPE_FLOATS, // GL_RGBA32F
    LLVMPIPE_HALVES, // GL_RGBA16F
    LLVMPIPE_TEXELS,
} llvmpipe_texels;

const char *llvmpipe_texels_name(llvmpipe_texels texels); // "RGBA32F"

typedef struct llvmpipe_inputs {
    const bench_scene *scene;      // borrowed during creation only
    const glint_cube *environment; // borrowed during creation only
    int width, height;             // pixels
} llvmpipe_inputs;

typedef struct llvmpipe_program llvmpipe_program; // opaque

// Compiles and uploads into the current context. Errors: GLINT_DEVICE_FAILED. If a shader does not
// compile, error->details holds the log.
glint_status llvmpipe_program_create(const llvmpipe_inputs *inputs, llvmpipe_program **program,
                                     glint_error *error);

// NULL is allowed.
void llvmpipe_program_free(llvmpipe_program *program);

// Draws a frame. Returns the milliseconds from the first call until the driver has finished.
double llvmpipe_program_frame(llvmpipe_program *program, llvmpipe_texels texels);

// Reads the last frame, [height][width][4], row 0 at the top. Errors: GLINT_DEVICE_FAILED if any
// OpenGL call so far has reported an error.
glint_status llvmpipe_program_read(llvmpipe_program *program, float *pixels, glint_error *error);

#endif
