// bench_loading [options]: measures `glint info` on one mesh in three files: plain, packed by
// meshoptimizer, packed by Draco. Beside the time stands the memory at its peak. --against compares
// with another program, in turns.
#include "mesh.h"
#include "options.h"
#include "series.h"

#include "base/clock.h"
#include "base/memory.h"
#include "support/draco_mesh.h"

#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <meshoptimizer.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const char help[] =
    "usage: bench_loading [--triangles N] [--rounds N] [--glint PROGRAM] [--against PROGRAM]\n"
    "\n"
    "Times `PROGRAM info FILE` on a mesh of about N triangles [1e6] in three files: plain,\n"
    "packed by meshoptimizer, packed by Draco (14 bits). Medians and ranges of N rounds [9].\n"
    "--against names another program, which runs in turns with the first.\n";

enum { PLAIN, MESHOPT, DRACO, FILES };
static const char *const names[FILES] = {"plain", "meshopt", "draco"};

typedef struct request {
    const char *programs[2]; // the second may be NULL
    double triangles, rounds;
} request;

// Floats and indices as files store them.
typedef struct arrays {
    size_t vertices, indices;
    float *positions, *normals;
    const uint32_t *corners; // borrowed
} arrays;

// ---- Files --------------------------------------------------------------------------------------

// A .glb file in the making.
typedef struct glb {
    unsigned char *bytes;
    size_t size, capacity;
    bool failed;
} glb;

// Appends a block at a multiple of four bytes. Returns where it begins.
static size_t append(glb *to, const void *bytes, size_t size)
{
    const size_t begin = (to->size + 3) / 4 * 4, end = begin + size;
    if (end > to->capacity) {
        unsigned char *grown = realloc(to->bytes, 2 * end);
        if (grown == NULL) {
            to->failed = true;
            return begin;
        }
        to->bytes = grown;
        to->capacity = 2 * end;
    }
    if (!to->failed && to->bytes != NULL) {
        memset(to->bytes + to->size, 0, begin - to->size);
        memcpy(to->bytes + begin, bytes, size);
        to->size = end;
    }
    return begin;
}

static glint_status write_glb(const char *path, const char *json, glb *content, glint_error *error)
{
    append(content, "", 0); // so that its length is a multiple of four
    const size_t length = strlen(json), padded = (length + 3) / 4 * 4;
    const uint32_t head[] = {0x46546C67, 2, (uint32_t)(28 + padded + content->size),
                             (uint32_t)padded, 0x4E4F534A};
    const uint32_t bin[] = {(uint32_t)content->size, 0x004E4942};
    FILE *file = content->failed ? NULL : fopen(path, "wb");
    bool done = file != NULL && fwrite(head, sizeof head, 1, file) == 1 &&
                fprintf(file, "%-*s", (int)padded, json) == (int)padded &&
                fwrite(bin, sizeof bin, 1, file) == 1 &&
                fwrite(content->bytes, content->size, 1, file) == 1;
    done = file != NULL && fclose(file) == 0 && done;
    free(content->bytes);
    *content = (glb){0};
    return done ? GLINT_OK
                : glint_fail(error, GLINT_OUTPUT_FAILED,
                             "%s: cannot be written (is the disk full?)", path);
}

#define HEAD                                                                                       \
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
#define ACCESSORS                                                                                  \
    "\"accessors\":[{%s\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"},"                   \
    "{%s\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"},"                                  \
    "{%s\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}],"
#define MESH                                                                                       \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2"

static glint_status write_plain(const char *path, const arrays *a, glint_error *error)
{
    glb content = {0};
    char json[2048];
    const size_t bytes = 12 * a->vertices;
    append(&content, a->positions, bytes);
    append(&content, a->normals, bytes);
    append(&content, a->corners, 4 * a->indices);
    snprintf(json, sizeof json,
             HEAD "\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[{\"buffer\":0,"
                  "\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu},"
                  "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}]," ACCESSORS MESH "}]}]}",
             content.size, bytes, bytes, bytes, 2 * bytes, 4 * a->indices, "\"bufferView\":0,",
             a->vertices, "\"bufferView\":1,", a->vertices, "\"bufferView\":2,", a->indices);
    return write_glb(path, json, &content, error);
}

// Packs vertices of three floats, or indices.
static size_t pack(glb *content, const arrays *a, const float *vertices, size_t *size)
{
    const size_t most = vertices != NULL ? meshopt_encodeVertexBufferBound(a->vertices, 12)
                                         : meshopt_encodeIndexBufferBound(a->indices, a->vertices);
    unsigned char *packed = malloc(most);
    if (packed == NULL) {
        content->failed = true;
        return 0;
    }
    *size = vertices != NULL ? meshopt_encodeVertexBuffer(packed, most, vertices, a->vertices, 12)
                             : meshopt_encodeIndexBuffer(packed, most, a->corners, a->indices);
    const size_t begin = append(content, packed, *size);
    free(packed);
    return begin;
}

static glint_status write_meshopt(const char *path, const arrays *a, glint_error *error)
{
    glb content = {0};
    char json[4096];
    int length = 0;
    const float *const values[] = {a->positions, a->normals, NULL};
    size_t begin = 0; // in the unpacked buffer
    char views[2048];
    for (int i = 0; i < 3; i++) {
        size_t size = 0;
        const size_t at = pack(&content, a, values[i], &size);
        const size_t stride = i < 2 ? 12 : 4, count = i < 2 ? a->vertices : a->indices;
        length += snprintf(views + length, sizeof views - (size_t)length,
                           "%s{\"buffer\":1,\"byteOffset\":%zu,\"byteLength\":%zu,\"extensions\":{"
                           "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":%zu,"
                           "\"byteLength\":%zu,\"byteStride\":%zu,\"count\":%zu,\"mode\":\"%s\"}}}",
                           i > 0 ? "," : "", begin, stride * count, at, size, stride, count,
                           i < 2 ? "ATTRIBUTES" : "TRIANGLES");
        begin += stride * count;
    }
    snprintf(json, sizeof json,
             HEAD "\"extensionsUsed\":[\"EXT_meshopt_compression\"],\"extensionsRequired\":["
                  "\"EXT_meshopt_compression\"],\"buffers\":[{\"byteLength\":%zu},{\"byteLength\":"
                  "%zu,\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}}],"
                  "\"bufferViews\":[%s]," ACCESSORS MESH "}]}]}",
             content.size, begin, views, "\"bufferView\":0,", a->vertices, "\"bufferView\":1,",
             a->vertices, "\"bufferView\":2,", a->indices);
    return write_glb(path, json, &content, error);
}

static glint_status write_draco(const char *path, const arrays *a, glint_error *error)
{
    glb content = {0};
    char json[2048];
    size_t size = 0;
    uint8_t *colors = glint_allocate(a->vertices, 4);
    const draco_mesh mesh = {a->vertices, a->indices / 3, a->positions, a->normals,
                             colors,      a->corners,     true,         14};
    unsigned char *packed = colors != NULL ? draco_pack(&mesh, &size) : NULL;
    free(colors);
    if (packed == NULL) {
        return glint_fail_memory(error, "the packed mesh");
    }
    append(&content, packed, size);
    free(packed);
    snprintf(json, sizeof json,
             HEAD "\"extensionsUsed\":[\"KHR_draco_mesh_compression\"],\"extensionsRequired\":["
                  "\"KHR_draco_mesh_compression\"],\"buffers\":[{\"byteLength\":%zu}],"
                  "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}]," ACCESSORS MESH
                  ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,"
                  "\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}}}]}]}",
             size, size, "", a->vertices, "", a->vertices, "", a->indices);
    return write_glb(path, json, &content, error);
}

static glint_status make_files(const char *folder, double triangles, glint_error *error)
{
    bench_mesh mesh = {0};
    const bench_ball ball = {.radius = 1, .displacement = bench_bumps};
    glint_status status;
    TRY(bench_mesh_add_icosphere(&mesh, &ball, (int)fmax(1, round(sqrt(triangles / 20))), error));
    TRY_OR(cleanup, status, bench_mesh_smooth(&mesh, error));
    arrays a = {.vertices = mesh.vertex_count,
                .indices = 3 * mesh.triangle_count,
                .positions = glint_allocate(mesh.vertex_count, 12),
                .normals = glint_allocate(mesh.vertex_count, 12),
                .corners = mesh.triangles[0]};
    for (size_t i = 0; a.positions != NULL && a.normals != NULL && i < a.vertices; i++) {
        const glint_vec3 p = mesh.vertices[i], n = mesh.normals[i];
        memcpy(a.positions + 3 * i, (float[]){(float)p.x, (float)p.y, (float)p.z}, 12);
        memcpy(a.normals + 3 * i, (float[]){(float)n.x, (float)n.y, (float)n.z}, 12);
    }
    status =
        a.positions == NULL || a.normals == NULL ? glint_fail_memory(error, "the mesh") : GLINT_OK;
    typedef glint_status writer(const char *path, const arrays *a, glint_error *error);
    writer *const writers[FILES] = {write_plain, write_meshopt, write_draco};
    for (int i = 0; status == GLINT_OK && i < FILES; i++) {
        char path[PATH_MAX];
        snprintf(path, sizeof path, "%s/%s.glb", folder, names[i]);
        status = writers[i](path, &a, error);
    }
    free(a.positions);
    free(a.normals);
    fprintf(stderr, "%zu triangles, %zu vertices\n", mesh.triangle_count, mesh.vertex_count);
cleanup:
    bench_mesh_free(&mesh);
    return status;
}

// ---- Measuring ----------------------------------------------------------------------------------

// Runs `program info path`. Sets the time and the memory at its peak, of the process or a child
// that it waits for.
static glint_status run(const char *program, const char *path, double *ms, double *mib,
                        glint_error *error)
{
    char *arguments[] = {(char *)program, "info", (char *)path, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const double begin = glint_now_ms();
    pid_t process;
    const int failed = posix_spawn(&process, program, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    int how = 0;
    struct rusage usage = {0};
    if (failed != 0 || wait4(process, &how, 0, &usage) < 0 || !WIFEXITED(how) ||
        WEXITSTATUS(how) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s info %s: failed (see above)", program, path);
    }
    *ms = glint_now_ms() - begin;
    *mib = (double)usage.ru_maxrss / 1024;
    return GLINT_OK;
}

static void print(const char *name, const bench_series ms[2], const double mib[2], bool against)
{
    const bench_summary own = bench_summarize(&ms[0]);
    printf("| %s | %.0f (%.0f–%.0f) | %.0f |", name, own.median, own.min, own.max, mib[0]);
    if (against) {
        const bench_summary other = bench_summarize(&ms[1]);
        const bench_summary ratio = bench_summarize_ratio(&ms[0], &ms[1]);
        printf(" %.0f (%.0f–%.0f) | %.0f | %.2f (%.2f–%.2f) |", other.median, other.min, other.max,
               mib[1], ratio.median, ratio.min, ratio.max);
    }
    printf("\n");
}

static glint_status measure(const request *r, const char *folder, int file, glint_error *error)
{
    static bench_series ms[2];
    double mib[2] = {0};
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s.glb", folder, names[file]);
    ms[0].count = ms[1].count = 0;
    for (int round = 0; round < (int)r->rounds; round++) {
        for (int p = 0; p < 2 && r->programs[p] != NULL; p++) {
            double time = 0, memory = 0;
            TRY(run(r->programs[p], path, &time, &memory, error));
            bench_series_add(&ms[p], time);
            mib[p] = fmax(mib[p], memory);
        }
    }
    print(names[file], ms, mib, r->programs[1] != NULL);
    return GLINT_OK;
}

// ---- Command line -------------------------------------------------------------------------------

enum { TRIANGLES = BENCH_OWN_OPTIONS, PROGRAM, AGAINST };

static const struct option options[] = {{"triangles", required_argument, NULL, TRIANGLES},
                                        {"rounds", required_argument, NULL, BENCH_ROUNDS},
                                        {"glint", required_argument, NULL, PROGRAM},
                                        {"against", required_argument, NULL, AGAINST},
                                        {"help", no_argument, NULL, BENCH_HELP},
                                        {0}};

static glint_status take(int option, void *into, glint_error *error)
{
    request *r = into;
    switch (option) {
    case TRIANGLES:
        return bench_parse_count("triangles", optarg, 1e8, &r->triangles, error);
    case BENCH_ROUNDS:
        return bench_parse_count("rounds", optarg, BENCH_ROUNDS_MAX, &r->rounds, error);
    case PROGRAM:
        r->programs[0] = optarg;
        return GLINT_OK;
    case AGAINST:
        r->programs[1] = optarg;
        return GLINT_OK;
    case BENCH_HELP:
        fputs(help, stdout);
        exit(0);
    default:
        return glint_fail(error, GLINT_USAGE, "there is no such option (--help lists them)");
    }
}

static glint_status measure_all(const request *r, const char *folder, glint_error *error)
{
    TRY(make_files(folder, r->triangles, error));
    printf("| file | ms | MiB |%s\n|---|---|---|%s\n",
           r->programs[1] != NULL ? " against: ms | MiB | ratio |" : "",
           r->programs[1] != NULL ? "---|---|---|" : "");
    for (int i = 0; i < FILES; i++) {
        TRY(measure(r, folder, i, error));
    }
    return GLINT_OK;
}

int main(int argc, char **argv)
{
    glint_error error = {0};
    char beside[PATH_MAX + 8], folder[] = "/tmp/glint-loading-XXXXXX";
    ssize_t length = readlink("/proc/self/exe", beside, PATH_MAX);
    beside[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(beside, '/');
    memcpy(slash != NULL ? slash + 1 : beside, "glint", sizeof "glint");
    request r = {.programs = {beside, NULL}, .triangles = 1e6, .rounds = 9};
    const bench_parser parser = {options, take, &r};
    glint_status status = bench_parse_options(argc, argv, &parser, &error);
    if (status == GLINT_OK && mkdtemp(folder) == NULL) {
        status = glint_fail(&error, GLINT_OUTPUT_FAILED, "%s: cannot be made", folder);
    } else if (status == GLINT_OK) {
        status = measure_all(&r, folder, &error);
        for (int i = 0; i < FILES; i++) {
            char path[PATH_MAX];
            snprintf(path, sizeof path, "%s/%s.glb", folder, names[i]);
            unlink(path);
        }
        rmdir(folder);
    }
    return bench_finish("bench_loading", status, &error);
}
