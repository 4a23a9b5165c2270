// bench_planar SCENE NODE [ROUNDS]: would a flat mirror be cheaper by its one reflected view than
// by tracing? The camera is mirrored in the node's topmost plane, which must be level, and what it
// sees there, the node taken away, is put where the first surface is the mirror: at the frame's
// resolution, at half of it and at a quarter. Prints what the parts take and what is lost.
//
// All else is made matte: what reflects the mirror again would have to be traced either way. So the
// rest of the frame, timed with a mirror that ends every path, is what is left to do, and the view
// at 1/1 is the traced frame but for rounding. Putting the view in its place is taken to cost
// nothing.
#include "render/frame.h"
#include "report/metrics.h"
#include "report/statistics.h"
#include "scene/subset.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1280, HEIGHT = 720, ROUNDS_MAX = 64, SCALES = 3 };
// Frames that are timed in turns; the views are of the scales 1, 1/2 and 1/4.
enum { TRACED, REST, VIEW, JOBS = VIEW + SCALES };

typedef struct bench {
    glint_device *device;
    glint_environment environment;
    glint_scene whole, ending, above; // as it is; with a mirror that ends paths; without it
    const glint_material *metal;
    double height; // of the mirror's plane, metres
    glint_camera camera, mirrored;
    size_t first, count; // the mirror's triangles
    glint_renderer *renderers[JOBS];
    glint_image images[JOBS];
    double ms[JOBS][ROUNDS_MAX];
    int rounds;
} bench;

static void make_matte(glint_scene *scene, const char *node)
{
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        glint_material *material = &scene->materials[instance->material];
        if (instance->node == NULL || strcmp(instance->node, node) != 0) {
            material->metallic = material->transmission = material->thickness = 0;
            material->roughness = 1;
            material->mirror = -1;
        }
    }
}

static glint_status find_mirror(bench *b, const char *node, glint_error *error)
{
    for (size_t i = 0; i < b->whole.instance_count; i++) {
        const glint_instance *instance = &b->whole.instances[i];
        if (instance->node != NULL && strcmp(instance->node, node) == 0) {
            b->first = instance->first_triangle;
            b->count = instance->triangle_count;
            b->metal = &b->whole.materials[instance->material];
            b->ending.materials[instance->material].unlit = true;
        }
    }
    if (b->metal == NULL || !(b->metal->metallic == 1)) {
        return glint_fail(error, GLINT_USAGE, "%s: no node of metal has that name", node);
    }
    double highest = -INFINITY;
    for (size_t i = 9 * b->first; i < 9 * (b->first + b->count); i += 3) {
        highest = fmax(highest, (double)b->whole.positions[i + 1]);
    }
    b->height = b->whole.origin.y + b->whole.unit * highest;
    return GLINT_OK;
}

static glint_vec3 in_mirror(glint_vec3 v)
{
    return (glint_vec3){v.x, -v.y, v.z};
}

// The picture of the mirrored camera, whose axes are left-handed, is what the mirror shows, pixel
// by pixel.
static void mirror_camera(bench *b)
{
    b->mirrored = b->camera;
    b->mirrored.eye.y = 2 * b->height - b->camera.eye.y;
    b->mirrored.right = in_mirror(b->camera.right);
    b->mirrored.up = in_mirror(b->camera.up);
    b->mirrored.back = in_mirror(b->camera.back);
}

static glint_status make_renderer(bench *b, int job, glint_error *error)
{
    glint_settings settings = glint_settings_default;
    settings.width = WIDTH >> (job > VIEW ? job - VIEW : 0);
    settings.height = HEIGHT >> (job > VIEW ? job - VIEW : 0);
    const glint_renderer_inputs inputs = {
        .device = b->device,
        .scene = job == TRACED ? &b->whole
                 : job == REST ? &b->ending
                               : &b->above,
        .environment = &b->environment,
        .settings = &settings,
    };
    return glint_renderer_create(&inputs, &b->renderers[job], error);
}

static glint_status load(bench *b, const char *path, const char *node, glint_error *error)
{
    glint_scene *const scenes[] = {&b->whole, &b->ending, &b->above};
    glint_status status = glint_device_open(NULL, &b->device, error);
    for (int i = 0; status == GLINT_OK && i < 3; i++) {
        status = glint_scene_load(path, NULL, scenes[i], NULL, error);
        make_matte(scenes[i], node);
    }
    if (status == GLINT_OK) {
        status = glint_environment_studio(&b->environment, error);
    }
    if (status == GLINT_OK) {
        status = glint_scene_camera(&b->whole, NULL, &b->camera, error);
    }
    if (status == GLINT_OK) {
        status = find_mirror(b, node, error);
    }
    if (status == GLINT_OK) {
        status = glint_scene_remove_nodes(&b->above, node, error);
        mirror_camera(b);
    }
    for (int job = 0; status == GLINT_OK && job < JOBS; job++) {
        status = make_renderer(b, job, error);
    }
    return status;
}

static glint_status run(bench *b, glint_error *error)
{
    glint_status status = GLINT_OK;
    for (int round = 0; round < b->rounds; round++) {
        for (int job = 0; status == GLINT_OK && job < JOBS; job++) {
            glint_frame_report report = {0};
            status = glint_renderer_frame(b->renderers[job], job < VIEW ? &b->camera : &b->mirrored,
                                          NULL, &b->images[job], &report, error);
            b->ms[job][round] = report.kernel_ms;
        }
    }
    return status;
}

// ---- What is lost ------------------------------------------------------------------------------

// Which pixels show the mirror's plane first.
static glint_status find_pixels(bench *b, bool *shows, glint_error *error)
{
    glint_settings settings = glint_settings_default;
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.output = GLINT_OUTPUT_HITS;
    const glint_renderer_inputs inputs = {.device = b->device,
                                          .scene = &b->whole,
                                          .environment = &b->environment,
                                          .settings = &settings};
    glint_renderer *renderer;
    glint_image hits = {0};
    glint_status status = glint_renderer_create(&inputs, &renderer, error);
    if (status == GLINT_OK) {
        status = glint_renderer_frame(renderer, &b->camera, NULL, &hits, NULL, error);
    }
    for (size_t i = 0; status == GLINT_OK && i < (size_t)WIDTH * HEIGHT; i++) {
        const double triangle = (double)hits.pixels[4 * i + 3];
        shows[i] = triangle >= (double)b->first && triangle < (double)(b->first + b->count);
        for (int k = 0; shows[i] && k < 3; k++) {
            const float y = b->whole.positions[9 * (size_t)triangle + 3 * (size_t)k + 1];
            shows[i] = b->whole.origin.y + b->whole.unit * (double)y > b->height - 1e-6;
        }
    }
    glint_image_free(&hits);
    glint_renderer_free(renderer);
    return status;
}

// The reflectance of the metal, in channel k, where the middle of pixel (x, y) shows it.
static double reflectance(const bench *b, int x, int y, int k)
{
    const double step = 2 * tan(b->camera.yfov / 2) / HEIGHT;
    const glint_vec3 d = glint_vec3_normalize(glint_vec3_add(
        glint_vec3_scale(b->camera.back, -1),
        glint_vec3_add(glint_vec3_scale(b->camera.right, step * (x + 0.5 - WIDTH / 2.0)),
                       glint_vec3_scale(b->camera.up, step * (HEIGHT / 2.0 - y - 0.5)))));
    const double f0 = (double)b->metal->base_color[k];
    return f0 + (1 - f0) * pow(1 - fabs(d.y), 5);
}

// The view at a place of the frame, bilinear.
static double look_up(const glint_image *view, double x, double y, int k)
{
    const double px = x * view->width / WIDTH - 0.5, py = y * view->height / HEIGHT - 0.5;
    const int i = (int)floor(px), j = (int)floor(py);
    double sum = 0;
    for (int corner = 0; corner < 4; corner++) {
        const int right = corner & 1, down = corner >> 1;
        const int column = i + right < 0              ? 0
                           : i + right >= view->width ? view->width - 1
                                                      : i + right;
        const int row = j + down < 0 ? 0 : j + down >= view->height ? view->height - 1 : j + down;
        const double weight = (right ? px - i : 1 - (px - i)) * (down ? py - j : 1 - (py - j));
        sum +=
            weight *
            (double)
                view->pixels[4 * ((size_t)row * (size_t)view->width + (size_t)column) + (size_t)k];
    }
    return sum;
}

// The traced frame with a view in the mirror's place.
static void put_view(const bench *b, const bool *shows, const glint_image *view, glint_image *put)
{
    memcpy(put->pixels, b->images[TRACED].pixels, sizeof(float) * 4 * WIDTH * HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        for (int k = 0; shows[i] && k < 3; k++) {
            put->pixels[4 * i + k] =
                (float)(reflectance(b, x, y, k) * look_up(view, x + 0.5, y + 0.5, k));
        }
    }
}

static glint_status print_errors(bench *b, glint_error *error)
{
    static bool shows[WIDTH * HEIGHT];
    glint_image put = {0};
    glint_status status = glint_image_create(WIDTH, HEIGHT, 4, &put, error);
    if (status == GLINT_OK) {
        status = find_pixels(b, shows, error);
    }
    for (int s = 0; status == GLINT_OK && s < SCALES; s++) {
        put_view(b, shows, &b->images[VIEW + s], &put);
        glint_metrics metrics;
        status = glint_metrics_find(&put, &b->images[TRACED], NULL, &metrics, error);
        if (status == GLINT_OK) {
            printf("view at 1/%d: relative RMSE %.4g, MAE %.4g of the mean\n", 1 << s,
                   metrics.relative_rmse, metrics.mae / metrics.mean);
        }
    }
    glint_image_free(&put);
    return status;
}

static void print_times(bench *b)
{
    static const char *const names[JOBS] = {"traced", "the rest of the frame", "view at 1/1",
                                            "view at 1/2", "view at 1/4"};
    double ratios[SCALES][ROUNDS_MAX];
    for (int round = 0; round < b->rounds; round++) {
        for (int s = 0; s < SCALES; s++) {
            ratios[s][round] = (b->ms[REST][round] + b->ms[VIEW + s][round]) / b->ms[TRACED][round];
        }
    }
    for (int job = 0; job < JOBS; job++) {
        const glint_summary t = glint_summarize(b->ms[job], (size_t)b->rounds);
        printf("%-22s %8.1f ms (%.1f to %.1f)\n", names[job], t.median, t.minimum, t.maximum);
    }
    for (int s = 0; s < SCALES; s++) {
        const glint_summary r = glint_summarize(ratios[s], (size_t)b->rounds);
        printf("rest and view at 1/%d: %.2f of the traced frame's time (%.2f to %.2f)\n", 1 << s,
               r.median, r.minimum, r.maximum);
    }
}

int main(int argc, char **argv)
{
    static bench b;
    glint_error error = {0};
    if (argc < 3) {
        fprintf(stderr, "bench_planar SCENE NODE [ROUNDS]\n");
        return 2;
    }
    b.rounds = argc > 3 ? atoi(argv[3]) : 5;
    b.rounds = b.rounds < 1 ? 1 : b.rounds > ROUNDS_MAX ? ROUNDS_MAX : b.rounds;
    glint_status status = load(&b, argv[1], argv[2], &error);
    if (status == GLINT_OK) {
        status = run(&b, &error);
    }
    if (status == GLINT_OK) {
        status = print_errors(&b, &error);
        print_times(&b);
    }
    for (int job = 0; job < JOBS; job++) {
        glint_renderer_free(b.renderers[job]);
        glint_image_free(&b.images[job]);
    }
    glint_scene_free(&b.whole);
    glint_scene_free(&b.ending);
    glint_scene_free(&b.above);
    glint_environment_free(&b.environment);
    glint_device_close(b.device);
    if (status != GLINT_OK) {
        fprintf(stderr, "bench_planar: %s\n", error.message);
    }
    glint_error_free(&error);
    return status == GLINT_OK ? 0 : (int)status;
}
