// Creates an OpenGL context without a window, drawn on the processor by Mesa's llvmpipe.
#ifndef GLINT_BENCH_LLVMPIPE_CONTEXT_H
#define GLINT_BENCH_LLVMPIPE_CONTEXT_H

#include "base/status.h"

typedef struct llvmpipe_context llvmpipe_context; // opaque

// Makes an OpenGL 3.3 core context current in the calling thread. Errors: GLINT_DEVICE_FAILED, also
// if Mesa would draw with another driver than llvmpipe.
glint_status llvmpipe_context_create(llvmpipe_context **context, glint_error *error);

// NULL is allowed.
void llvmpipe_context_free(llvmpipe_context *context);

// The driver's names: "llvmpipe (LLVM 15.0.6, 256 bits)" and "4.5 (Core Profile) Mesa 22.3.6".
// Valid as long as the context.
const char *llvmpipe_context_renderer(const llvmpipe_context *context);
const char *llvmpipe_context_version(const llvmpipe_context *context);

#endif
