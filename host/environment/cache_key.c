// Identifies the files of an environment by their content. See cache_key.h.
#include "environment/cache_key.h"

#include "base/parallel.h"
#include "environment/checksum.h"
#include "environment/face_files.h"
#include "image/codec.h"
#include "image/decoder.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <xxhash.h>

#define PART ((uint64_t)4 << 20) // bytes that a thread hashes at a time
#define PARTS_MAX 4096           // larger files are not kept
#define BUFFER ((size_t)256 << 10)
#define FRESH 2 // seconds

// ---- The files ----------------------------------------------------------------------------------

typedef struct file_list {
    glint_face_files faces;
    const char *paths[6];
    int count;
    glint_source_kind kind;
} file_list;

// Lists the files of `path`, as glint_source_load finds them. The caller frees `faces`.
static bool list_files(const char *path, file_list *list)
{
    *list = (file_list){.kind = glint_source_kind_of(path)};
    if (list->kind == GLINT_SOURCE_FILE) {
        list->paths[0] = path;
        list->count = 1;
        return true;
    }
    const glint_status status = list->kind == GLINT_SOURCE_FOLDER
                                    ? glint_face_files_in_folder(path, &list->faces, NULL)
                                    : glint_face_files_by_pattern(path, &list->faces, NULL);
    for (int face = 0; face < 6; face++) {
        list->paths[face] = list->faces.paths[face];
    }
    list->count = 6;
    return status == GLINT_OK;
}

// ---- The hash -----------------------------------------------------------------------------------

// The data that all threads share.
typedef struct hashing {
    int file;
    uint64_t bytes;
    uint64_t *parts;
    atomic_bool has_failed;
} hashing;

static void hash_file_part(size_t index, void *context)
{
    hashing *shared = context;
    const uint64_t first = index * PART, left = shared->bytes - first;
    uint64_t end = left < PART ? shared->bytes : first + PART, at = first;
    XXH3_state_t *state = XXH3_createState();
    char *buffer = malloc(BUFFER);
    bool is_good = state != NULL && buffer != NULL && XXH3_64bits_reset(state) == XXH_OK;
    while (is_good && at < end) {
        const size_t wanted = end - at < BUFFER ? (size_t)(end - at) : BUFFER;
        const ssize_t length = pread(shared->file, buffer, wanted, (off_t)at);
        if (length > 0) {
            (void)XXH3_64bits_update(state, buffer, (size_t)length);
            at += (uint64_t)length;
        } else {
            is_good = length < 0 && errno == EINTR;
        }
    }
    if (is_good) {
        shared->parts[index] = XXH3_64bits_digest(state);
    } else {
        atomic_store(&shared->has_failed, true);
    }
    free(buffer);
    (void)XXH3_freeState(state);
}

// Hashes an open regular file of `bytes`.
static bool hash_open_file(int file, uint64_t bytes, XXH3_state_t *into)
{
    const size_t count = (size_t)((bytes + PART - 1) / PART);
    hashing shared = {.file = file, .bytes = bytes};
    shared.parts = calloc(count + 1, sizeof *shared.parts);
    if (shared.parts == NULL || count > PARTS_MAX) {
        free(shared.parts);
        return false;
    }
    glint_parallel_for(count, hash_file_part, &shared);
    shared.parts[count] = bytes;
    (void)XXH3_128bits_update(into, shared.parts, (count + 1) * sizeof *shared.parts);
    free(shared.parts);
    return !atomic_load(&shared.has_failed);
}

static bool hash_file(const char *path, struct stat *facts, XXH3_state_t *into)
{
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0) {
        return false;
    }
    const bool is_good = fstat(file, facts) == 0 && S_ISREG(facts->st_mode) &&
                         hash_open_file(file, (uint64_t)facts->st_size, into);
    close(file);
    return is_good;
}

static void hash_program(const char *path, XXH3_state_t *into)
{
    struct stat facts;
    int64_t program[3] = {0};
    if (stat(path, &facts) == 0) {
        program[0] = facts.st_size;
        program[1] = facts.st_mtim.tv_sec;
        program[2] = facts.st_mtim.tv_nsec;
    }
    (void)XXH3_128bits_update(into, program, sizeof program);
}

static void hash_request(const glint_layout_request *request, const file_list *list,
                         XXH3_state_t *into)
{
    static const glint_layout_request nothing = {0};
    request = request != NULL ? request : &nothing;
    const int64_t flags[] = {request->layout, list->kind, glint_decoder_allows_large()};
    const double numbers[] = {request->circle[0], request->circle[1], request->circle[2],
                              request->ball_distance, request->ball_fov};
    (void)XXH3_128bits_update(into, flags, sizeof flags);
    (void)XXH3_128bits_update(into, numbers, sizeof numbers);
}

// Another program may make other cubes, even if its version is the same: developers build often.
static void finish(XXH3_state_t *state, glint_env_cache_key *key)
{
    char codec[PATH_MAX];
    hash_program("/proc/self/exe", state);
    hash_program(glint_codec_find(codec) ? codec : "", state);
    (void)XXH3_128bits_update(state, GLINT_VERSION, sizeof GLINT_VERSION);
    const XXH128_hash_t hash = XXH3_128bits_digest(state);
    key->hash[0] = hash.low64;
    key->hash[1] = hash.high64;
}

bool glint_env_cache_key_of_cube(const glint_cube *cube, int edge, glint_env_cache_key *key)
{
    uint64_t what[3] = {(uint64_t)cube->edge, (uint64_t)edge};
    *key = (glint_env_cache_key){.bytes = glint_cube_size(cube) * sizeof(float)};
    XXH3_state_t *state = XXH3_createState();
    const bool is_good = state != NULL && XXH3_128bits_reset(state) == XXH_OK &&
                         glint_checksum(cube->texels, key->bytes, &what[2]);
    if (is_good) {
        (void)XXH3_128bits_update(state, what, sizeof what);
        finish(state, key);
    }
    (void)XXH3_freeState(state);
    return is_good;
}

bool glint_env_cache_key_make(const char *path, const glint_layout_request *request,
                              glint_env_cache_key *key)
{
    *key = (glint_env_cache_key){.begun = time(NULL)};
    file_list list;
    XXH3_state_t *state = XXH3_createState();
    bool is_good = list_files(path, &list) && state != NULL && XXH3_128bits_reset(state) == XXH_OK;
    for (int i = 0; is_good && i < list.count; i++) {
        is_good = hash_file(list.paths[i], &key->files[i], state);
        key->bytes += (uint64_t)key->files[i].st_size;
    }
    if (is_good) {
        hash_request(request, &list, state);
        finish(state, key);
    }
    key->file_count = list.count;
    key->kind = list.kind;
    (void)XXH3_freeState(state);
    glint_face_files_free(&list.faces);
    return is_good;
}

// ---- Changes ------------------------------------------------------------------------------------

static bool is_same_file(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino && a->st_size == b->st_size &&
           a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec &&
           a->st_ctim.tv_sec == b->st_ctim.tv_sec && a->st_ctim.tv_nsec == b->st_ctim.tv_nsec;
}

bool glint_env_cache_key_holds(const char *path, const glint_env_cache_key *key)
{
    file_list list;
    bool is_same = list_files(path, &list) && list.count == key->file_count;
    for (int i = 0; is_same && i < list.count; i++) {
        struct stat now;
        is_same = stat(list.paths[i], &now) == 0 && is_same_file(&now, &key->files[i]) &&
                  key->begun - now.st_mtim.tv_sec > FRESH;
    }
    glint_face_files_free(&list.faces);
    return is_same;
}
