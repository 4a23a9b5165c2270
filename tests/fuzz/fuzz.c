// Fuzzes everything that glint reads, in builds with sanitizers:
//
//   fuzz TARGET SECONDS SEED FOLDER [FILE…]
//
// TARGET is gltf, textures, options, images, texts or documents. Inputs are mutations of the FILEs;
// for options the FILEs hold command lines, for documents what `fuzz write-documents` wrote. The
// fuzzer writes each input to FOLDER before reading it, so a crash leaves its input there. Decoders
// may die in a library, and are counted; glint must live, and no sanitizer may end glint-decoder.
// Exit status 0: all inputs were read or refused. The same seed gives the same inputs.
#include "cli/commands.h"
#include "cli/common/frame_list.h"
#include "cli/common/frame_name.h"
#include "cli/common/options.h"
#include "environment/environment.h"
#include "image/image_io.h"
#include "report/bench/baseline.h"
#include "report/farm_report.h"
#include "report/frame/fingerprint.h"
#include "scene/gltf/load.h"
#include "scene/gltf/open.h"
#include "scene/gltf/reader.h"
#include "scene/scene.h"
#include "scene/shape/topology.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define LONGEST (1 << 20)

// ---- Mutations ----------------------------------------------------------------------------------

typedef struct text {
    char *bytes; // [LONGEST]
    size_t length;
} text;

static uint64_t random_state;

// SplitMix64.
static uint64_t next_random(void)
{
    uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static size_t below(size_t limit)
{
    return limit > 0 ? next_random() % limit : 0;
}

// Words that break parsers.
static const char *const words[] = {
    "0",
    "-1",
    "1",
    "1e999",
    "-0.0",
    "NaN",
    "null",
    "true",
    "4294967295",
    "2147483648",
    "18446744073709551616",
    "1e-320",
    "[]",
    "{}",
    "\"\"",
    "\"",
    "\\u0000",
    "\\ud800",
    "%00",
    "..",
    "/dev/zero",
    "data:,",
    "####",
    "\\#",
    "%s%n",
    "\xff\xfe",
    // NOLINTNEXTLINE(misc-misleading-bidirectional): that is what it tests
    "\xe2\x80\xae",
    "\x1b[2J",
    "1-2147483647",
    "-2147483648-2147483647x-1",
    "1/0",
    "capture:",
    "--",
    "=",
    ",",
    "[",
    "{",
    "}",
    "]",
    ":",
};

static void replace(text *t, size_t at, size_t removed, const char *by, size_t length)
{
    if (t->length - removed + length > LONGEST) {
        return;
    }
    memmove(t->bytes + at + length, t->bytes + at + removed, t->length - at - removed);
    memcpy(t->bytes + at, by, length);
    t->length += length - removed;
}

// The end of the token at `at`, a number or a word.
static size_t token_end(const text *t, size_t at)
{
    while (at < t->length &&
           (isalnum((unsigned char)t->bytes[at]) || memchr("+-._", t->bytes[at], 4) != NULL)) {
        at++;
    }
    return at;
}

static void mutate_once(text *t)
{
    const size_t at = below(t->length), left = t->length - at;
    const size_t span = below(left < 64 ? left : 64);
    const char *word = words[below(COUNT(words))];
    char copy[64];
    switch (below(7)) {
    case 0:
        if (t->length > 0) {
            t->bytes[at] ^= (char)(1u << below(8));
        }
        break;
    case 1:
        if (t->length > 0) {
            t->bytes[at] = (char)next_random();
        }
        break;
    case 2:
        replace(t, at, span, "", 0);
        break;
    case 3:
        memcpy(copy, t->bytes + at, span);
        replace(t, below(t->length), 0, copy, span);
        break;
    case 4:
        replace(t, at, 0, word, strlen(word));
        break;
    case 5:
        replace(t, at, token_end(t, at) - at, word, strlen(word));
        break;
    default:
        t->length = below(16) == 0 ? at : t->length; // truncate
    }
}

static void mutate(text *t)
{
    for (size_t i = 1 + below(4); i > 0; i--) {
        mutate_once(t);
    }
}

// ---- Targets ------------------------------------------------------------------------------------

typedef struct tallies {
    uint64_t inputs, accepted, refused, deaths;
} tallies;

static const char *folder;

static const char *place(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_input(const char *name, const text *t)
{
    FILE *file = fopen(place(name), "wb");
    if (file == NULL || fwrite(t->bytes, 1, t->length, file) != t->length || fclose(file) != 0) {
        perror(place(name));
        exit(2);
    }
}

static void count_death(tallies *sum, const char *message)
{
    if (strstr(message, "glint-decoder: it does not run") != NULL) {
        fprintf(stderr, "fuzz: a sanitizer ended it: %s\n", message);
        exit(1);
    }
    sum->deaths +=
        strstr(message, "the decoder failed") != NULL || strstr(message, " to decode (") != NULL;
}

static void count(tallies *sum, glint_status status, glint_error *error)
{
    sum->accepted += status == GLINT_OK;
    sum->refused += status != GLINT_OK;
    if (status != GLINT_OK) {
        count_death(sum, error->message);
    }
    glint_error_free(error);
}

static void put_number(char *to, size_t number)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (char)(number >> (8 * i));
    }
}

// Packs the JSON as the first chunk of a GLB. The 20 bytes before it may be damaged, too.
static void pack(text *glb, const text *t)
{
    enum { HEADER = 20 };
    const size_t length = (t->length + 3) / 4 * 4;
    glb->length = HEADER + length;
    memcpy(glb->bytes, "glTF\2\0\0\0", 8);
    put_number(glb->bytes + 8, glb->length);
    put_number(glb->bytes + 12, length);
    memcpy(glb->bytes + 16, "JSON", 4);
    memset(glb->bytes + HEADER, ' ', length);
    memcpy(glb->bytes + HEADER, t->bytes, t->length);
    if (below(4) == 0) {
        glb->bytes[below(HEADER)] = (char)next_random();
    }
}

// Reads FOLDER/input.gltf.
static void load_scene(tallies *sum)
{
    glint_scene scene = {0};
    glint_topology topology = {0};
    glint_warnings warnings = {0};
    glint_error error = {0};
    glint_status status = glint_scene_load(place("input.gltf"), NULL, &scene, &warnings, &error);
    if (status == GLINT_OK && scene.triangle_count < 100000) {
        status = glint_topology_find(&scene, &topology, &error);
        glint_topology_free(&topology);
    }
    for (size_t i = 0; i < warnings.count; i++) {
        count_death(sum, warnings.texts[i]);
    }
    glint_scene_free(&scene);
    glint_warnings_free(&warnings);
    count(sum, status, &error);
}

// Loads a mutated document, with references that are whole words of 32 bits.
static void try_documents(const text *t, tallies *sum)
{
    static const uint32_t wrong[] = {0,   1,          2,         3,          7,
                                     100, UINT32_MAX, INT32_MAX, 0x80000000, 0x7fc00000};
    glint_scene_source *source;
    glint_scene scene = {0};
    glint_warnings warnings = {0};
    glint_error error = {0};
    const int file = memfd_create("document", MFD_CLOEXEC);
    for (size_t i = below(4) + 1; i > 0 && t->length >= 4; i--) {
        uint32_t word = wrong[below(COUNT(wrong))];
        word = below(8) == 0 ? (uint32_t)next_random() : word;
        memcpy(t->bytes + below(t->length / 4) * 4, &word, sizeof word);
    }
    write_input("input.document", t);
    if (file < 0 || write(file, t->bytes, t->length) != (ssize_t)t->length) {
        exit(2);
    }
    glint_status status =
        glint_scene_open_document(place("input.gltf"), file, NULL, &source, &error);
    close(file);
    if (status == GLINT_OK) {
        status = glint_scene_at(source, 0.5, &scene, &warnings, &error);
        glint_scene_close(source);
    }
    glint_scene_free(&scene);
    glint_warnings_free(&warnings);
    count(sum, status, &error);
}

// Writes the documents of scenes: documents FOLDER FILE…
static int write_documents(const char *to, char **scenes)
{
    for (int i = 0; scenes[i] != NULL; i++) {
        char name[4096], bytes[4096];
        int file;
        if (glint_reader_run(scenes[i], &file, NULL) != GLINT_OK) {
            continue;
        }
        snprintf(name, sizeof name, "%s/%d.document", to, i);
        FILE *out = fopen(name, "wb");
        for (ssize_t length; out != NULL && (length = read(file, bytes, sizeof bytes)) > 0;) {
            fwrite(bytes, 1, (size_t)length, out);
        }
        close(file);
        if (out == NULL || fclose(out) != 0) {
            perror(name);
            return 2;
        }
    }
    return 0;
}

static void try_gltf(const text *t, tallies *sum)
{
    static char bytes[LONGEST + 64];
    text glb = {.bytes = bytes};
    if (below(3) == 0 && t->length > 0 && t->bytes[0] == '{') {
        pack(&glb, t);
        t = &glb;
    }
    write_input("input.gltf", t);
    load_scene(sum);
}

// Uses an image as the texture of a triangle, in all roles.
static void try_textures(const text *t, tallies *sum)
{
    static char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},"
        "\"material\":0}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
        "\"type\":\"VEC3\"},{\"bufferView\":0,\"byteOffset\":8,\"componentType\":5126,\"count\":3,"
        "\"type\":\"VEC2\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA\"}],\"images\":[{\"uri\":"
        "\"input.image\"}],\"textures\":[{\"source\":0}],\"materials\":[{\"alphaMode\":\"BLEND\","
        "\"normalTexture\":{\"index\":0},\"pbrMetallicRoughness\":{\"baseColorTexture\":"
        "{\"index\":0}}}]}";
    const text file = {gltf, sizeof gltf - 1};
    write_input("input.gltf", &file);
    write_input("input.image", t);
    load_scene(sum);
}

static void try_images(const text *t, tallies *sum)
{
    static const glint_layout layouts[] = {GLINT_LAYOUT_UNKNOWN, GLINT_LAYOUT_LATLONG,
                                           GLINT_LAYOUT_BALL};
    const glint_layout_request request = {.layout = layouts[below(COUNT(layouts))]};
    glint_environment environment = {0};
    glint_warnings warnings = {0};
    glint_channels channels = {0};
    glint_error error = {0};
    char fingerprint[GLINT_FINGERPRINT_TEXT];
    write_input("input.image", t);
    glint_fingerprint_find(place("input.image"), fingerprint);
    if (below(4) == 0) {
        count(sum, glint_image_read_channels(place("input.image"), &channels, &error), &error);
        glint_channels_free(&channels);
        return;
    }
    const glint_status status =
        glint_environment_load(place("input.image"), &request, &environment, &warnings, &error);
    glint_environment_free(&environment);
    glint_warnings_free(&warnings);
    count(sum, status, &error);
}

static const glint_command *const commands[] = {
    &glint_command_render,  &glint_command_info,    &glint_command_bench,
    &glint_command_compare, &glint_command_env,     &glint_command_farm,
    &glint_command_capture, &glint_command_relight, &glint_command_selftest,
};

// Parses the words of a line in order.
static void try_options(const text *t, tallies *sum)
{
    enum { WORDS = 64 };
    const glint_command *command = commands[below(COUNT(commands))];
    char *line = strndup(t->bytes, t->length), *rest = line, *argv[WORDS + 1] = {"glint"}, *word;
    int argc = 1;
    while (argc < WORDS && (word = strsep(&rest, " \n")) != NULL) {
        argv[argc++] = word;
    }
    void *request = calloc(1, command->request_size);
    if (request == NULL || line == NULL) {
        exit(2);
    }
    if (command->set_defaults != NULL) {
        command->set_defaults(request);
    }
    glint_arguments arguments = {.words = argv, .word_count = argc};
    glint_error error = {0};
    write_input("input.options", t);
    const glint_status status = glint_options_parse(command, request, &arguments, &error);
    free(request);
    free(line);
    count(sum, status, &error);
}

// Tests the parsers of small texts, and the JSON files that glint reads back.
static void try_texts(const text *t, tallies *sum)
{
    char *copy = strndup(t->bytes, t->length);
    glint_frame_list list = {0};
    glint_frame_name name = {0};
    glint_shard shard;
    glint_error error = {0};
    json_t *baseline = NULL;
    if (copy == NULL) {
        exit(2);
    }
    if (glint_frame_list_parse(copy, &list, &error) == GLINT_OK) {
        glint_frame_cursor cursor = {.list = &list, .shard = {1, 1}};
        int frame;
        for (int i = 0; i < 1000 && glint_frame_next(&cursor, &frame); i++) {
            (void)glint_frame_list_holds(&list, frame);
        }
    }
    glint_error_free(&error);
    glint_frame_list_free(&list);
    (void)glint_shard_parse(copy, &shard, NULL);
    if (glint_frame_name_parse(copy, &name, NULL) == GLINT_OK) {
        free(glint_frame_name_make(&name, 1));
    }
    glint_frame_name_free(&name);
    write_input("1.json", t);
    glint_status status = glint_baseline_load(place("1.json"), &baseline, &error);
    json_decref(baseline);
    count(sum, status, &error);
    glint_farm_report report = {0};
    write_input("1_1.jsonl", t);
    status = glint_farm_report_read(folder, "1", &report, &error);
    glint_farm_report_free(&report);
    count(sum, status, &error);
    free(copy);
}

static const struct {
    const char *name;
    void (*attempt)(const text *t, tallies *sum);
} targets[] = {
    {"gltf", try_gltf},     {"textures", try_textures}, {"options", try_options},
    {"images", try_images}, {"texts", try_texts},       {"documents", try_documents},
};

// ---- The run ------------------------------------------------------------------------------------

static text read_seed(const char *path)
{
    text seed = {.bytes = malloc(LONGEST)};
    FILE *file = fopen(path, "rb");
    if (seed.bytes == NULL || file == NULL) {
        perror(path);
        exit(2);
    }
    seed.length = fread(seed.bytes, 1, LONGEST, file);
    fclose(file);
    return seed;
}

int main(int argc, char **argv)
{
    size_t target = 0;
    if (argc > 3 && strcmp(argv[1], "write-documents") == 0) {
        return write_documents(argv[2], argv + 3);
    }
    while (argc > 5 && target < COUNT(targets) && strcmp(argv[1], targets[target].name) != 0) {
        target++;
    }
    if (argc < 6 || target == COUNT(targets)) {
        fprintf(stderr,
                "fuzz gltf|textures|options|images|texts|documents SECONDS SEED FOLDER FILE…\n"
                "fuzz write-documents FOLDER SCENE…\n");
        return 2;
    }
    const double seconds = atof(argv[2]);
    random_state = strtoull(argv[3], NULL, 10);
    folder = argv[4];
    const size_t seed_count = (size_t)(argc - 5);
    text *seeds = calloc(seed_count, sizeof *seeds), input = {.bytes = malloc(LONGEST)};
    if (seeds == NULL || input.bytes == NULL) {
        fputs("fuzz: not enough memory\n", stderr);
        exit(2);
    }
    size_t read = 0;
    do {
        seeds[read] = read_seed(argv[5 + read]);
    } while (++read < seed_count);
    // Read mutations of random seeds until the time is over.
    tallies sum = {0};
    for (const time_t end = time(NULL) + (time_t)seconds; time(NULL) < end; sum.inputs++) {
        const text *seed = &seeds[below(seed_count)];
        if (seed->length > 0) {
            memcpy(input.bytes, seed->bytes, seed->length);
        }
        input.length = seed->length;
        if (targets[target].attempt != try_documents) {
            mutate(&input);
        }
        targets[target].attempt(&input, &sum);
    }
    printf("%s: %" PRIu64 " inputs: %" PRIu64 " read, %" PRIu64
           " refused; the decoder died %" PRIu64 " times\n",
           argv[1], sum.inputs, sum.accepted, sum.refused, sum.deaths);
    for (size_t i = 0; i < seed_count; i++) {
        free(seeds[i].bytes);
    }
    free(seeds);
    free(input.bytes);
    return 0;
}
