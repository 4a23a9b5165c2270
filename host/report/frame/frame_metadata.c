// Collects the metadata of a frame's file. See frame_metadata.h.
#include "report/frame/frame_metadata.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

// The matrix with the camera's axes as columns; its last row moves the eye to the origin: p' = p M.
static glint_mat4 world_to_camera(const glint_camera *camera)
{
    glint_vec3 forward = glint_vec3_scale(camera->back, -1);
    const glint_vec3 axes[3] = {camera->right, camera->up, forward};
    glint_mat4 matrix = glint_mat4_identity;
    for (int column = 0; column < 3; column++) {
        matrix.m[0][column] = axes[column].x;
        matrix.m[1][column] = axes[column].y;
        matrix.m[2][column] = axes[column].z;
        matrix.m[3][column] = -glint_vec3_dot(axes[column], camera->eye);
    }
    return matrix;
}

static void store(const glint_mat4 *source, float matrix[16])
{
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            matrix[4 * row + column] = (float)source->m[row][column];
        }
    }
}

void glint_world_to_camera(const glint_camera *camera, float matrix[16])
{
    glint_mat4 result = world_to_camera(camera);
    store(&result, matrix);
}

void glint_world_to_ndc(const glint_camera *camera, double aspect, float matrix[16])
{
    // In camera space, the lower right corner of the image is at (aspect, −1) × half, for
    // perspective at z = 1. x and y go to [0, 1]. For this, 0.5 w is added to both, so that the
    // division by w keeps it.
    double half = camera->orthographic ? camera->ymag : tan(camera->yfov / 2);
    glint_mat4 projection = {
        {{0.5 / (half * aspect), 0, 0, 0}, {0, -0.5 / half, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 0}}};
    if (camera->orthographic) {
        projection.m[3][0] = projection.m[3][1] = 0.5;
        projection.m[3][3] = 1;
    } else {
        projection.m[2][0] = projection.m[2][1] = 0.5;
        projection.m[2][3] = 1;
        // A camera without clipping planes has no depth range: z' = z − 1 keeps the matrix
        // invertible and z'/w within (−∞, 1).
        projection.m[3][2] = -1;
    }
    glint_mat4 to_camera = world_to_camera(camera);
    glint_mat4 result = glint_mat4_multiply(&to_camera, &projection);
    store(&result, matrix);
}

static glint_metadata *add(glint_frame_metadata *metadata, const char *name,
                           glint_metadata_type type)
{
    glint_metadata *entry = &metadata->entries[metadata->count++];
    entry->name = name;
    entry->type = type;
    return entry;
}

void glint_frame_metadata_add_text(glint_frame_metadata *metadata, const char *name,
                                   const char *text)
{
    if (text != NULL && text[0] != '\0' && metadata->count < GLINT_FRAME_METADATA_MAX) {
        add(metadata, name, GLINT_METADATA_STRING)->string = text;
    }
}

static void add_int(glint_frame_metadata *metadata, const char *name, int value)
{
    add(metadata, name, GLINT_METADATA_INT)->integer = value;
}

void glint_frame_metadata_add_real(glint_frame_metadata *metadata, const char *name, double value)
{
    if (metadata->count < GLINT_FRAME_METADATA_MAX) {
        add(metadata, name, GLINT_METADATA_FLOAT)->real = (float)value;
    }
}

// Adds capDate and utcOffset of the standard: the local time, and the seconds that lead from it to
// UTC.
static void add_time(glint_frame_metadata *metadata)
{
    time_t seconds = time(NULL);
    struct tm local;
    if (localtime_r(&seconds, &local) == NULL ||
        strftime(metadata->date, sizeof metadata->date, "%Y:%m:%d %H:%M:%S", &local) == 0) {
        return;
    }
    glint_frame_metadata_add_text(metadata, "capDate", metadata->date);
    glint_frame_metadata_add_real(metadata, "utcOffset", 0 - (double)local.tm_gmtoff);
}

// Adds the proxy of the environment, in metres of world space.
static void add_proxy(glint_frame_metadata *metadata, const glint_proxy *proxy)
{
    const glint_vec3 low = glint_vec3_subtract(proxy->middle, proxy->half_extent);
    const glint_vec3 high = glint_vec3_add(proxy->middle, proxy->half_extent);
    char *text = metadata->proxy;
    if (proxy->kind == GLINT_PROXY_SPHERE) {
        snprintf(text, sizeof metadata->proxy,
                 "sphere %.9g %.9g %.9g %.9g, seen from %.9g %.9g %.9g", proxy->middle.x,
                 proxy->middle.y, proxy->middle.z, proxy->half_extent.x, proxy->center.x,
                 proxy->center.y, proxy->center.z);
    } else {
        snprintf(text, sizeof metadata->proxy,
                 "box %.9g %.9g %.9g to %.9g %.9g %.9g, seen from %.9g %.9g %.9g", low.x, low.y,
                 low.z, high.x, high.y, high.z, proxy->center.x, proxy->center.y, proxy->center.z);
    }
    glint_frame_metadata_add_text(metadata, "glint:proxy", text);
}

// Adds the settings that the table marks for files, if they differ from their defaults.
static void add_settings(glint_frame_metadata *metadata, const glint_settings *settings)
{
    size_t texts = 0;
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if (setting->metadata == NULL ||
            !glint_setting_differs(setting, settings, &glint_settings_default)) {
            continue;
        }
        if (setting->option.kind == GLINT_OPTION_REAL) {
            glint_frame_metadata_add_real(metadata, setting->metadata,
                                          glint_setting_number(setting, settings, 0));
        } else if (texts < GLINT_FRAME_METADATA_SETTINGS) {
            char *text = metadata->settings[texts++];
            glint_setting_print(setting, settings, text);
            glint_frame_metadata_add_text(metadata, setting->metadata, text);
        }
    }
}

void glint_frame_metadata_fill(const glint_subject *subject, int frame, double exposure,
                               double render_ms, glint_frame_metadata *metadata)
{
    *metadata = (glint_frame_metadata){0};
    const glint_settings *settings = subject->settings;
    double aspect = (double)settings->width / (double)settings->height;
    glint_world_to_camera(subject->camera,
                          add(metadata, "worldToCamera", GLINT_METADATA_MATRIX)->matrix);
    glint_world_to_ndc(subject->camera, aspect,
                       add(metadata, "worldToNDC", GLINT_METADATA_MATRIX)->matrix);
    add_time(metadata);
    glint_plan_describe(subject->plan, metadata->plan, sizeof metadata->plan);
    snprintf(metadata->device, sizeof metadata->device, "%s (%s, %s)", subject->device->name,
             subject->device->platform, subject->device->driver);
    glint_frame_metadata_add_text(metadata, "Software", "glint " GLINT_VERSION);
    add_int(metadata, "imageCounter", frame);
    glint_frame_metadata_add_text(metadata, "glint:scene", subject->scene->path);
    glint_frame_metadata_add_text(metadata, "glint:environment", subject->environment->name);
    if (settings->proxy) {
        add_proxy(metadata, &subject->environment->proxy);
    }
    glint_frame_metadata_add_text(metadata, "glint:camera", subject->camera->name);
    glint_frame_metadata_add_text(metadata, "glint:plan", metadata->plan);
    glint_frame_metadata_add_text(metadata, "glint:device", metadata->device);
    add_int(metadata, "glint:samples", settings->samples_per_axis * settings->samples_per_axis);
    add_settings(metadata, settings);
    glint_frame_metadata_add_real(metadata, "glint:exposure", exposure);
    glint_frame_metadata_add_real(metadata, "glint:render_ms", render_ms);
}
