// Creates an OpenGL context that llvmpipe draws. See context.h.
#include "llvmpipe/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <stdlib.h>
#include <string.h>

struct llvmpipe_context {
    EGLDisplay display;
    EGLContext context;
};

static glint_status fail(const char *what, glint_error *error)
{
    return glint_fail(error, GLINT_DEVICE_FAILED, "llvmpipe: %s (EGL error 0x%x)", what,
                      (unsigned)eglGetError());
}

// Creates a context without a surface: frames go to a framebuffer object.
static glint_status create_context(llvmpipe_context *c, glint_error *error)
{
    static const EGLint config_wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                           EGL_NONE};
    static const EGLint context_wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    if (!eglBindAPI(EGL_OPENGL_API) ||
        !eglChooseConfig(c->display, config_wanted, &config, 1, &count) || count < 1) {
        return fail("EGL has no configuration for OpenGL", error);
    }
    c->context = eglCreateContext(c->display, config, EGL_NO_CONTEXT, context_wanted);
    if (c->context == EGL_NO_CONTEXT) {
        return fail("no context of OpenGL 3.3", error);
    }
    if (!eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->context)) {
        return fail("the context cannot be made current without a surface", error);
    }
    const char *renderer = llvmpipe_context_renderer(c);
    if (renderer == NULL || strncmp(renderer, "llvmpipe", strlen("llvmpipe")) != 0) {
        return glint_fail(error, GLINT_DEVICE_FAILED, "llvmpipe: OpenGL is drawn by '%s'",
                          renderer != NULL ? renderer : "nothing");
    }
    return GLINT_OK;
}

glint_status llvmpipe_context_create(llvmpipe_context **context, glint_error *error)
{
    *context = NULL;
    // Mesa reads these variables when the display is initialised. They keep a graphics card out.
    (void)setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    (void)setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "llvmpipe: EGL lacks EGL_MESA_platform_surfaceless (install Mesa's EGL)");
    }
    llvmpipe_context *c = calloc(1, sizeof *c);
    if (c == NULL) {
        return glint_fail_memory(error, "an OpenGL context");
    }
    c->context = EGL_NO_CONTEXT;
    c->display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    glint_status status = c->display != EGL_NO_DISPLAY && eglInitialize(c->display, NULL, NULL)
                              ? create_context(c, error)
                              : fail("no display without surfaces", error);
    if (status != GLINT_OK) {
        llvmpipe_context_free(c);
        return status;
    }
    *context = c;
    return GLINT_OK;
}

void llvmpipe_context_free(llvmpipe_context *c)
{
    if (c == NULL) {
        return;
    }
    if (c->context != EGL_NO_CONTEXT) {
        eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(c->display, c->context);
    }
    if (c->display != EGL_NO_DISPLAY) {
        eglTerminate(c->display);
    }
    free(c);
}

const char *llvmpipe_context_renderer(const llvmpipe_context *context)
{
    (void)context; // the current context
    return (const char *)glGetString(GL_RENDERER);
}

const char *llvmpipe_context_version(const llvmpipe_context *context)
{
    (void)context;
    return (const char *)glGetString(GL_VERSION);
}
