// bench_sequence SCENE [FRAMES [ROUNDS [FOLDER [ENCODING]]]]: measures how many frames of a
// turntable reach the disk each second, for each way to encode them or for one ("exr zip").
//
// It compares this with the limit of the cores: tracing alone uses all cores for a while, encoding
// alone uses one core for a while. Both together cannot take less than the sum.
#include "render/sequence.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "device/device.h"
#include "environment/environment.h"
#include "image/image_io.h"
#include "scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { WIDTH = 1920, HEIGHT = 1080, ROUNDS_MAX = 64, ALONE = 3 };

// A way to encode a frame.
typedef struct encoding {
    const char *extension, *compression;
    bool exr_float;
} encoding;

static const encoding encodings[] = {
    {"exr", "none", false}, {"exr", "rle", false},   {"exr", "zips", false}, {"exr", "zip", false},
    {"exr", "piz", false},  {"exr", "pxr24", false}, {"exr", "b44", false},  {"exr", "dwaa", false},
    {"exr", "zip", true},   {"png", "1", false},     {"png", "4", false},    {"png", "6", false},
    {"hdr", NULL, false},   {"tiff", "zip", false},  {"jpg", "95", false},
};
enum { ENCODINGS = sizeof encodings / sizeof *encodings };

typedef struct bench {
    glint_scene scene;
    glint_environment environment;
    glint_settings settings;
    glint_device *device;
    glint_renderer *renderer;
    glint_camera camera;
    glint_image sample; // the frame for timing the encoder alone
    const char *folder;
    const char *chosen; // the name of the only encoding to measure; NULL: all
    int frames, rounds, cores;
    const encoding *kind; // the current encoding
    int next;
    bool failed;
    double trace_ms[ROUNDS_MAX];               // for a frame, on all cores
    double encode_ms[ENCODINGS][ROUNDS_MAX];   // for a frame, on one core
    double sequence_ms[ENCODINGS][ROUNDS_MAX]; // for a frame of a sequence
    double bytes[ENCODINGS];
} bench;

static glint_camera camera_of(const bench *b, int frame)
{
    const glint_vec3 centre = glint_vec3_scale(glint_vec3_add(b->scene.low, b->scene.high), 0.5);
    return glint_camera_orbit(&b->camera, centre, frame, b->frames);
}

static void name_of(const encoding *kind, char name[32])
{
    snprintf(name, 32, "%s%s%s%s", kind->extension, kind->compression != NULL ? " " : "",
             kind->compression != NULL ? kind->compression : "", kind->exr_float ? " float" : "");
}

static bool is_chosen(const bench *b, const encoding *kind)
{
    char name[32];
    name_of(kind, name);
    return b->chosen == NULL || strcmp(name, b->chosen) == 0;
}

static glint_write_options options_of(const encoding *kind)
{
    return (glint_write_options){.compression = kind->compression, .exr_float = kind->exr_float};
}

static void path_of(const bench *b, int frame, char path[4096])
{
    snprintf(path, 4096, "%s/frame.%04d.%s", b->folder, frame, b->kind->extension);
}

// ---- Alone -------------------------------------------------------------------------------------

static glint_status trace_alone(bench *b, int round, glint_error *error)
{
    const double begun = glint_now_ms();
    for (int i = 0; i < b->frames; i++) {
        const glint_camera camera = camera_of(b, i);
        TRY(glint_renderer_frame(
            &(glint_frame_request){b->renderer, &camera, NULL, &b->sample, NULL}, error));
    }
    b->trace_ms[round] = (glint_now_ms() - begun) / b->frames;
    return GLINT_OK;
}

// Times the encoder by CPU time: waiting for the disk uses no core.
static glint_status encode_alone(bench *b, int index, int round, glint_error *error)
{
    char path[4096];
    path_of(b, 0, path);
    const glint_write_options options = options_of(b->kind);
    struct timespec begun, ended;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begun);
    for (int i = 0; i < ALONE; i++) {
        TRY(glint_image_write(path, &b->sample, &options, error));
    }
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &ended);
    const double ms = 1e3 * (double)(ended.tv_sec - begun.tv_sec) +
                      1e-6 * (double)(ended.tv_nsec - begun.tv_nsec);
    b->encode_ms[index][round] = ms / ALONE;
    struct stat facts;
    b->bytes[index] = stat(path, &facts) == 0 ? (double)facts.st_size : 0;
    return GLINT_OK;
}

// ---- Together ----------------------------------------------------------------------------------

static glint_sequence_next next_frame(void *context, glint_sequence_frame *frame)
{
    bench *b = context;
    if (b->next == b->frames || b->failed) {
        return GLINT_NEXT_NONE;
    }
    frame->number = b->next++;
    frame->camera = camera_of(b, frame->number);
    return GLINT_NEXT_FRAME;
}

static void frame_is_traced(void *context, glint_sequence_frame *frame)
{
    (void)context;
    (void)frame;
}

static void write_frame(void *context, glint_sequence_frame *frame)
{
    const bench *b = context;
    char path[4096];
    path_of(b, frame->number, path);
    const glint_write_options options = options_of(b->kind);
    frame->status = glint_image_write(path, &frame->image, &options, &frame->error);
}

static bool frame_is_through(void *context, glint_sequence_frame *frame)
{
    bench *b = context;
    if (frame->status != GLINT_OK) {
        fprintf(stderr, "%s\n", frame->error.message);
        b->failed = true;
    }
    return !b->failed;
}

static glint_status run_sequence(bench *b, int index, int round, glint_error *error)
{
    const glint_sequence sequence = {
        .renderer = b->renderer,
        .writers = glint_sequence_writers(16.0 * WIDTH * HEIGHT),
        .next = next_frame,
        .traced = frame_is_traced,
        .write = write_frame,
        .done = frame_is_through,
        .context = b,
    };
    b->next = 0;
    const double begun = glint_now_ms();
    glint_status status = glint_sequence_run(&sequence, error);
    b->sequence_ms[index][round] = (glint_now_ms() - begun) / b->frames;
    return b->failed ? GLINT_OUTPUT_FAILED : status;
}

// ---- The program -------------------------------------------------------------------------------

static glint_status prepare(bench *b, const char *scene, glint_error *error)
{
    b->settings = glint_settings_default;
    b->settings.width = WIDTH;
    b->settings.height = HEIGHT;
    TRY(glint_scene_load(scene, NULL, &b->scene, NULL, error));
    TRY(glint_scene_camera(&b->scene, NULL, &b->camera, error));
    TRY(glint_environment_studio(&b->environment, error));
    TRY(glint_device_open(NULL, &b->device, error));
    const glint_renderer_inputs inputs = {.device = b->device,
                                          .scene = &b->scene,
                                          .environment = &b->environment,
                                          .settings = &b->settings};
    glint_image_use_threads(1);
    b->cores = glint_usable_cores();
    return glint_renderer_create(&inputs, &b->renderer, error);
}

static void remove_frames(bench *b)
{
    char path[4096];
    for (int i = 0; i < ENCODINGS; i++) {
        b->kind = &encodings[i];
        for (int frame = 0; frame < b->frames; frame++) {
            path_of(b, frame, path);
            unlink(path);
        }
    }
}

// Measures all encodings in turns, round by round.
static glint_status measure(bench *b, glint_error *error)
{
    for (int round = 0; round < b->rounds; round++) {
        TRY(trace_alone(b, round, error));
        for (int i = 0; i < ENCODINGS; i++) {
            b->kind = &encodings[i];
            if (!is_chosen(b, b->kind)) {
                continue;
            }
            char name[32];
            name_of(b->kind, name);
            fprintf(stderr, "round %d of %d: %s\n", round + 1, b->rounds, name);
            TRY(encode_alone(b, i, round, error));
            TRY(run_sequence(b, i, round, error));
        }
    }
    return GLINT_OK;
}

static void report(bench *b)
{
    printf("%s, %d cores, %dx%d, %d frames, %d rounds: medians\n",
           glint_device_capabilities(b->device)->name, b->cores, WIDTH, HEIGHT, b->frames,
           b->rounds);
    const size_t rounds = (size_t)b->rounds;
    double share[ENCODINGS][ROUNDS_MAX];
    for (int i = 0; i < ENCODINGS; i++) {
        for (size_t r = 0; r < rounds; r++) {
            const double least = b->trace_ms[r] + b->encode_ms[i][r] / b->cores;
            share[i][r] = least / b->sequence_ms[i][r];
        }
    }
    printf("tracing alone: %.1f ms a frame, %.1f core-ms\n",
           glint_summarize(b->trace_ms, rounds).median,
           b->cores * glint_summarize(b->trace_ms, rounds).median);
    printf("%-16s %9s %12s %10s %22s\n", "encoding", "MiB", "core-ms", "frames/s",
           "of what cores allow");
    for (int i = 0; i < ENCODINGS; i++) {
        if (!is_chosen(b, &encodings[i])) {
            continue;
        }
        char name[32];
        name_of(&encodings[i], name);
        const glint_summary shares = glint_summarize(share[i], rounds);
        printf("%-16s %9.2f %12.1f %10.2f %7.0f%% (%.0f to %.0f)\n", name, b->bytes[i] / 0x1p20,
               glint_summarize(b->encode_ms[i], rounds).median,
               1e3 / glint_summarize(b->sequence_ms[i], rounds).median, 100 * shares.median,
               100 * shares.minimum, 100 * shares.maximum);
    }
}

int main(int argc, char **argv)
{
    if (argc < 2 || argc > 6) {
        fprintf(stderr, "usage: bench_sequence SCENE [FRAMES [ROUNDS [FOLDER [ENCODING]]]]\n");
        return GLINT_USAGE;
    }
    char own[] = "/tmp/bench_sequence_XXXXXX";
    bench b = {.frames = argc > 2 ? atoi(argv[2]) : 24, .rounds = argc > 3 ? atoi(argv[3]) : 3};
    b.folder = argc > 4 ? argv[4] : mkdtemp(own);
    b.chosen = argc > 5 ? argv[5] : NULL;
    if (b.frames < 1 || b.rounds < 1 || b.rounds > ROUNDS_MAX || b.folder == NULL) {
        fprintf(stderr,
                "bench_sequence: frames from 1, rounds from 1 to %d, a folder to write to\n",
                ROUNDS_MAX);
        return GLINT_USAGE;
    }
    glint_error error = {0};
    glint_status status = prepare(&b, argv[1], &error);
    if (status == GLINT_OK) {
        status = measure(&b, &error);
    }
    if (status == GLINT_OK) {
        report(&b);
    } else {
        fprintf(stderr, "bench_sequence: %s\n", error.message);
    }
    remove_frames(&b);
    if (argc <= 4) {
        rmdir(b.folder);
    }
    glint_error_free(&error);
    glint_image_free(&b.sample);
    glint_renderer_free(b.renderer);
    glint_device_close(b.device);
    glint_environment_free(&b.environment);
    glint_scene_free(&b.scene);
    return (int)status;
}
