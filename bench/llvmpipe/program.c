// Draws the mirror by OpenGL. See program.h.
#include "llvmpipe/program.h"

#include "base/clock.h"
#include "base/half.h"
#include "base/memory.h"
#include "kernels/layout.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// ---- Shaders -----------------------------------------------------------------------------------

enum { POSITION, NORMAL }; // attributes of the vertices

static const char mesh_vertex[] = "#version 330 core\n"
                                  "uniform mat4 clip_from_stored;\n"
                                  "uniform vec3 eye;\n"
                                  "layout(location = 0) in vec3 position;\n"
                                  "layout(location = 1) in vec3 vertex_normal;\n"
                                  "out vec3 incident;\n"
                                  "out vec3 normal;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    incident = position - eye;\n"
                                  "    normal = vertex_normal;\n"
                                  "    gl_Position = clip_from_stored * vec4(position, 1.0);\n"
                                  "}\n";

// The texture has one level only. textureLod saves the derivatives that select a level.
static const char mesh_fragment[] =
    "#version 330 core\n"
    "uniform samplerCube environment;\n"
    "in vec3 incident;\n"
    "in vec3 normal;\n"
    "out vec4 radiance;\n"
    "void main()\n"
    "{\n"
    "    radiance = textureLod(environment, reflect(incident, normalize(normal)), 0.0);\n"
    "}\n";

// A triangle that covers the screen on the far plane, so that the depth test culls it behind the
// mesh.
static const char background_vertex[] =
    "#version 330 core\n"
    "uniform vec3 right, up, forward;\n"
    "out vec3 direction;\n"
    "void main()\n"
    "{\n"
    "    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "    direction = forward + corner.x * right + corner.y * up;\n"
    "    gl_Position = vec4(corner, 1.0, 1.0);\n"
    "}\n";

static const char background_fragment[] =
    "#version 330 core\n"
    "uniform samplerCube environment;\n"
    "in vec3 direction;\n"
    "out vec4 radiance;\n"
    "void main()\n"
    "{\n"
    "    radiance = textureLod(environment, direction, 0.0);\n"
    "}\n";

// ---- Program -----------------------------------------------------------------------------------

struct llvmpipe_program {
    int width, height;
    GLsizei index_count;
    GLuint mesh, background; // shader programs
    GLuint mesh_array, empty_array;
    GLuint vertices, indices;
    GLuint cubes[LLVMPIPE_TEXELS];
    GLuint framebuffer, color, depth;
};

const char *llvmpipe_texels_name(llvmpipe_texels texels)
{
    static const char *const names[LLVMPIPE_TEXELS] = {"RGBA32F", "RGBA16F"};
    return names[texels];
}

static glint_status compile(GLuint program, GLenum kind, const char *source, glint_error *error)
{
    GLint compiled = GL_FALSE;
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) {
        glAttachShader(program, shader);
    } else {
        char log[4096] = "";
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        error->details = strdup(log);
    }
    glDeleteShader(shader); // OpenGL deletes it with the program
    return compiled ? GLINT_OK
                    : glint_fail(error, GLINT_DEVICE_FAILED,
                                 "llvmpipe: a shader does not compile (the log follows)");
}

static glint_status link_program(const char *vertex, const char *fragment, GLuint *program,
                                 glint_error *error)
{
    *program = glCreateProgram();
    TRY(compile(*program, GL_VERTEX_SHADER, vertex, error));
    TRY(compile(*program, GL_FRAGMENT_SHADER, fragment, error));
    GLint linked = GL_FALSE;
    glLinkProgram(*program);
    glGetProgramiv(*program, GL_LINK_STATUS, &linked);
    if (!linked) {
        return glint_fail(error, GLINT_DEVICE_FAILED, "llvmpipe: the shaders do not link");
    }
    return GLINT_OK;
}

// ---- Camera ------------------------------------------------------------------------------------

static void set_vector(GLuint program, const char *name, glint_vec3 v)
{
    glUniform3f(glGetUniformLocation(program, name), (float)v.x, (float)v.y, (float)v.z);
}

// Finds the near and far depth of the scene, in stored units, with a margin.
static void find_depths(const bench_scene *scene, glint_vec3 eye, double *near, double *far)
{
    *near = INFINITY;
    *far = 0;
    for (size_t i = 0; i < scene->vertex_count; i++) {
        const float *p = scene->positions + 3 * i;
        glint_vec3 from_eye =
            glint_vec3_subtract((glint_vec3){(double)p[0], (double)p[1], (double)p[2]}, eye);
        double depth = -glint_vec3_dot(from_eye, scene->camera.back);
        *near = fmin(*near, depth);
        *far = fmax(*far, depth);
    }
    *far *= 1.01;
    *near = fmax(0.99 * *near, 1e-3 * *far); // for an eye inside the scene
}

// Sets glint's camera, see glint_frame_record. A pixel is as wide as it is high.
static void set_camera(const llvmpipe_inputs *inputs, const llvmpipe_program *p)
{
    const glint_camera *camera = &inputs->scene->camera;
    const glint_scene *soup = &inputs->scene->scene;
    glint_vec3 eye =
        glint_vec3_scale(glint_vec3_subtract(camera->eye, soup->origin), 1 / soup->unit);
    double half_height = tan(camera->yfov / 2), near, far;
    double half_width = half_height * inputs->width / inputs->height;
    find_depths(inputs->scene, eye, &near, &far);

    glint_vec3 forward = glint_vec3_scale(camera->back, -1);
    const glint_vec3 rows[4] = {glint_vec3_scale(camera->right, 1 / half_width),
                                glint_vec3_scale(camera->up, 1 / half_height),
                                glint_vec3_scale(forward, (far + near) / (far - near)), forward};
    GLfloat matrix[4][4]; // [row][column]
    for (int i = 0; i < 4; i++) {
        double offset = i == 2 ? -2 * far * near / (far - near) : 0;
        matrix[i][0] = (float)rows[i].x;
        matrix[i][1] = (float)rows[i].y;
        matrix[i][2] = (float)rows[i].z;
        matrix[i][3] = (float)(offset - glint_vec3_dot(rows[i], eye));
    }
    glUseProgram(p->mesh);
    glUniformMatrix4fv(glGetUniformLocation(p->mesh, "clip_from_stored"), 1, GL_TRUE,
                       &matrix[0][0]);
    set_vector(p->mesh, "eye", eye);
    glUseProgram(p->background);
    set_vector(p->background, "right", glint_vec3_scale(camera->right, half_width));
    set_vector(p->background, "up", glint_vec3_scale(camera->up, half_height));
    set_vector(p->background, "forward", forward);
}

// ---- Uploads -----------------------------------------------------------------------------------

static glint_status upload_mesh(const bench_scene *scene, llvmpipe_program *p, glint_error *error)
{
    typedef struct vertex {
        GLfloat position[3], normal[3];
    } vertex;
    vertex *vertices = glint_allocate(scene->vertex_count, sizeof *vertices);
    if (vertices == NULL) {
        return glint_fail_memory(error, "vertices");
    }
    // Interleave positions and normals.
    for (size_t i = 0; i < scene->vertex_count; i++) {
        memcpy(vertices[i].position, scene->positions + 3 * i, sizeof vertices->position);
        memcpy(vertices[i].normal, scene->normals + 3 * i, sizeof vertices->normal);
    }
    // Create the vertex arrays and upload the vertices.
    glGenVertexArrays(1, &p->empty_array);
    glGenVertexArrays(1, &p->mesh_array);
    glBindVertexArray(p->mesh_array);
    glGenBuffers(1, &p->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, p->vertices);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(scene->vertex_count * sizeof *vertices), vertices,
                 GL_STATIC_DRAW);
    glVertexAttribPointer(POSITION, 3, GL_FLOAT, GL_FALSE, sizeof *vertices,
                          (const void *)offsetof(vertex, position));
    glVertexAttribPointer(NORMAL, 3, GL_FLOAT, GL_FALSE, sizeof *vertices,
                          (const void *)offsetof(vertex, normal));
    glEnableVertexAttribArray(POSITION);
    glEnableVertexAttribArray(NORMAL);
    // Upload the indices.
    glGenBuffers(1, &p->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, p->indices);
    p->index_count = (GLsizei)(3 * scene->triangle_count);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 (GLsizeiptr)(3 * scene->triangle_count * sizeof *scene->triangles),
                 scene->triangles, GL_STATIC_DRAW);
    free(vertices);
    return GLINT_OK;
}

// Copies a face, flipped. OpenGL's faces have the order of kernels/layout.h, but are seen from
// outside (OpenGL 3.3, table 3.19). ±X and ±Z are flipped left to right, ±Y top to bottom.
static void copy_face(const glint_cube *cube, int face, float *texels)
{
    const int edge = cube->edge, last = edge - 1;
    const bool is_y = face / 2 == 1;
    for (int j = 0; j < edge; j++) {
        for (int i = 0; i < edge; i++) {
            const float *from =
                glint_cube_texel(cube, face, is_y ? i : last - i, is_y ? last - j : j);
            memcpy(texels + 4 * ((size_t)j * (size_t)edge + (size_t)i), from, 4 * sizeof(float));
        }
    }
}

static glint_status upload_environment(const glint_cube *cube, llvmpipe_program *p,
                                       glint_error *error)
{
    static const GLint formats[LLVMPIPE_TEXELS] = {GL_RGBA32F, GL_RGBA16F};
    float *texels = glint_allocate(4 * (size_t)cube->edge * (size_t)cube->edge, sizeof *texels);
    if (texels == NULL) {
        return glint_fail_memory(error, "a face of the environment");
    }
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glGenTextures(LLVMPIPE_TEXELS, p->cubes);
    for (int i = 0; i < LLVMPIPE_TEXELS; i++) {
        glBindTexture(GL_TEXTURE_CUBE_MAP, p->cubes[i]);
        for (int face = 0; face < GLINT_CUBE_FACES; face++) {
            copy_face(cube, face, texels);
            glTexImage2D((GLenum)(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face), 0, formats[i], cube->edge,
                         cube->edge, 0, GL_RGBA, GL_FLOAT, texels);
        }
        glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, 0);
        glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    free(texels);
    return GLINT_OK;
}

static glint_status create_framebuffer(llvmpipe_program *p, glint_error *error)
{
    glGenFramebuffers(1, &p->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, p->framebuffer);
    glGenRenderbuffers(1, &p->color);
    glBindRenderbuffer(GL_RENDERBUFFER, p->color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA16F, p->width, p->height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, p->color);
    glGenRenderbuffers(1, &p->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, p->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, p->width, p->height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, p->depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "llvmpipe: no framebuffer of %d x %d halves with a depth", p->width,
                          p->height);
    }
    glViewport(0, 0, p->width, p->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    if (!getenv("LPNC"))
        glEnable(GL_CULL_FACE);
    return GLINT_OK;
}

// ---- Interface ---------------------------------------------------------------------------------

static glint_status check_errors(glint_error *error)
{
    GLenum found = glGetError();
    return found == GL_NO_ERROR ? GLINT_OK
                                : glint_fail(error, GLINT_DEVICE_FAILED,
                                             "llvmpipe: OpenGL reports error 0x%x", found);
}

glint_status llvmpipe_program_create(const llvmpipe_inputs *inputs, llvmpipe_program **program,
                                     glint_error *error)
{
    *program = NULL;
    llvmpipe_program *p = calloc(1, sizeof *p);
    if (p == NULL) {
        return glint_fail_memory(error, "a program");
    }
    p->width = inputs->width;
    p->height = inputs->height;
    glint_status status;
    TRY_OR(cleanup, status, link_program(mesh_vertex, mesh_fragment, &p->mesh, error));
    TRY_OR(cleanup, status,
           link_program(background_vertex, background_fragment, &p->background, error));
    set_camera(inputs, p);
    TRY_OR(cleanup, status, upload_mesh(inputs->scene, p, error));
    TRY_OR(cleanup, status, upload_environment(inputs->environment, p, error));
    TRY_OR(cleanup, status, create_framebuffer(p, error));
    TRY_OR(cleanup, status, check_errors(error));
    *program = p;
    return GLINT_OK;
cleanup:
    llvmpipe_program_free(p);
    return status;
}

void llvmpipe_program_free(llvmpipe_program *p)
{
    if (p == NULL) {
        return;
    }
    // OpenGL ignores names that are 0.
    glDeleteProgram(p->mesh);
    glDeleteProgram(p->background);
    glDeleteVertexArrays(1, &p->mesh_array);
    glDeleteVertexArrays(1, &p->empty_array);
    glDeleteBuffers(1, &p->vertices);
    glDeleteBuffers(1, &p->indices);
    glDeleteTextures(LLVMPIPE_TEXELS, p->cubes);
    glDeleteFramebuffers(1, &p->framebuffer);
    glDeleteRenderbuffers(1, &p->color);
    glDeleteRenderbuffers(1, &p->depth);
    free(p);
}

double llvmpipe_program_frame(llvmpipe_program *p, llvmpipe_texels texels)
{
    glBindTexture(GL_TEXTURE_CUBE_MAP, p->cubes[texels]);
    glFinish();
    double start = glint_now_ms();
    glClear(GL_DEPTH_BUFFER_BIT);
    glUseProgram(p->mesh);
    glBindVertexArray(p->mesh_array);
    glDrawElements(GL_TRIANGLES, p->index_count, GL_UNSIGNED_INT, NULL);
    glUseProgram(p->background);
    glBindVertexArray(p->empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
    return glint_now_ms() - start;
}

// OpenGL's rows run from the bottom up, so this reverses them.
glint_status llvmpipe_program_read(llvmpipe_program *p, float *pixels, glint_error *error)
{
    for (int row = 0; row < p->height; row++) {
        glReadPixels(0, p->height - 1 - row, p->width, 1, GL_RGBA, GL_FLOAT,
                     pixels + 4 * (size_t)row * (size_t)p->width);
    }
    return check_errors(error);
}
