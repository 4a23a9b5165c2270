// An OpenGL context without a window, drawn by Mesa's llvmpipe: OpenGL on the processor.
#ifndef GLINT_BENCH_LLVMPIPE_CONTEXT_H
#define GLINT_BENCH_LLVMPIPE_CONTEXT_H

#include "base/status.h"

typedef struct llvmpipe_context llvmpipe_context; // opaque

// Makes an OpenGL 3.3 core context current in the calling thread. Errors: GLINT_DEVICE_FAILED, also
// where Mesa would draw with anything but llvmpipe.
glint_status llvmpipe_context_create(llvmpipe_context **context, glint_error *error);

// NULL is allowed.
void llvmpipe_context_free(llvmpipe_context *context);

// What the driver says of itself: "llvmpipe (LLVM 15.0.6, 256 bits)" and "4.5 (Core Profile) Mesa
// 22.3.6". Valid while the context is.
const char *llvmpipe_context_renderer(const llvmpipe_context *context);
const char *llvmpipe_context_version(const llvmpipe_context *context);

#endif
