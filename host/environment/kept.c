// Keeps the cubes of environments in a cache on disk. See kept.h.
#include "environment/kept.h"

#include "base/cache_folder.h"
#include "base/parallel.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#define FOLDER "environments"
#define ENDING ".cube"
#define FORMAT 1
#define PAGE 4096
#define PART ((size_t)4 << 20) // bytes that a thread checks at a time

typedef struct header {
    char magic[8];
    uint32_t format;
    int32_t edge;
    uint64_t key[2];
    uint64_t texel_bytes;
    uint64_t texels; // checksum
    glint_kept_facts facts;
    uint32_t zero;
    uint64_t header; // checksum of the members above
} header;

static const char magic[8] = {'g', 'l', 'i', 'n', 't', 'e', 'n', 'v'};

// ---- Places -------------------------------------------------------------------------------------

static uint64_t limit_bytes(void)
{
    const char *text = getenv("GLINT_ENV_CACHE_MIB");
    char *end = NULL;
    const unsigned long long mib = text != NULL ? strtoull(text, &end, 10) : GLINT_KEPT_MIB;
    const bool is_number = text == NULL || (text[0] >= '0' && text[0] <= '9' && *end == '\0');
    return (is_number && mib < ((uint64_t)1 << 40) ? mib : GLINT_KEPT_MIB) << 20;
}

static bool find_folder(char folder[PATH_MAX])
{
    return limit_bytes() > 0 && glint_cache_folder_find(FOLDER, folder);
}

bool glint_kept_is_on(void)
{
    char folder[PATH_MAX];
    return find_folder(folder);
}

// The name begins with the number of bytes, so that glint_kept_is_likely need not hash the file.
static bool find_entry(const glint_kept_key *key, char folder[PATH_MAX], char path[PATH_MAX])
{
    if (!find_folder(folder)) {
        return false;
    }
    const int length = snprintf(path, PATH_MAX, "%s/%llx-%016llx%016llx" ENDING, folder,
                                (unsigned long long)key->bytes, (unsigned long long)key->hash[1],
                                (unsigned long long)key->hash[0]);
    return length > 0 && length < PATH_MAX;
}

bool glint_kept_is_likely(const char *path)
{
    char folder_path[PATH_MAX], beginning[32];
    struct stat facts;
    if (stat(path, &facts) != 0 || !S_ISREG(facts.st_mode) || !find_folder(folder_path)) {
        return false;
    }
    const int length =
        snprintf(beginning, sizeof beginning, "%llx-", (unsigned long long)facts.st_size);
    DIR *folder = opendir(folder_path);
    bool is_likely = false;
    for (const struct dirent *at; folder != NULL && !is_likely && (at = readdir(folder)) != NULL;) {
        is_likely = strncmp(at->d_name, beginning, (size_t)length) == 0;
    }
    if (folder != NULL) {
        closedir(folder);
    }
    return is_likely;
}

// ---- Checksums ----------------------------------------------------------------------------------

typedef struct check {
    const char *bytes;
    size_t count;
    uint64_t *parts;
} check;

static void check_part(size_t index, void *context)
{
    const check *shared = context;
    const size_t first = index * PART, left = shared->count - first;
    shared->parts[index] = XXH3_64bits(shared->bytes + first, left < PART ? left : PART);
}

// Sums up bytes on all cores. Returns false without memory.
static bool sum_up(const void *bytes, size_t count, uint64_t *sum)
{
    const size_t parts = (count + PART - 1) / PART;
    const check shared = {bytes, count, malloc(parts * sizeof(uint64_t))};
    if (shared.parts == NULL) {
        return false;
    }
    glint_parallel_for(parts, check_part, (void *)&shared);
    *sum = XXH3_64bits(shared.parts, parts * sizeof(uint64_t));
    free(shared.parts);
    return true;
}

static uint64_t sum_up_header(const header *of)
{
    return XXH3_64bits(of, offsetof(header, header));
}

// ---- Reading ------------------------------------------------------------------------------------

static bool read_all(int file, void *to, size_t count)
{
    ssize_t length;
    do {
        length = pread(file, to, count, 0);
    } while (length < 0 && errno == EINTR);
    return length == (ssize_t)count;
}

static bool is_good_header(const header *of, const glint_kept_key *key, off_t file_bytes)
{
    if (memcmp(of->magic, magic, sizeof magic) != 0 || of->format != FORMAT ||
        of->header != sum_up_header(of) || of->key[0] != key->hash[0] ||
        of->key[1] != key->hash[1] || of->edge < 1 || of->edge > GLINT_CUBE_EDGE_MAX) {
        return false;
    }
    const uint64_t texels = glint_cube_size(&(glint_cube){.edge = of->edge});
    return of->texel_bytes == texels * sizeof(float) &&
           (uint64_t)file_bytes == PAGE + of->texel_bytes;
}

// Maps an entry of an open file.
static bool map_entry(int file, const glint_kept_key *key, glint_kept_facts *facts,
                      glint_cube *cube)
{
    header found;
    struct stat size;
    if (fstat(file, &size) != 0 || !read_all(file, &found, sizeof found) ||
        !is_good_header(&found, key, size.st_size)) {
        return false;
    }
    const size_t bytes = PAGE + (size_t)found.texel_bytes;
    char *mapped = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE, file, 0);
    if (mapped == MAP_FAILED) {
        return false;
    }
    uint64_t sum;
    if (!sum_up(mapped + PAGE, found.texel_bytes, &sum) || sum != found.texels) {
        munmap(mapped, bytes);
        return false;
    }
    *facts = found.facts;
    *cube = (glint_cube){found.edge, (float *)(void *)(mapped + PAGE), PAGE};
    return true;
}

bool glint_kept_take(const glint_kept_key *key, glint_kept_facts *facts, glint_cube *cube)
{
    char folder[PATH_MAX], path[PATH_MAX];
    const int file = find_entry(key, folder, path) ? open(path, O_RDONLY | O_CLOEXEC) : -1;
    if (file < 0) {
        return false;
    }
    const bool is_good = map_entry(file, key, facts, cube);
    if (is_good) {
        (void)futimens(file, NULL); // the entry is in use
    } else {
        (void)unlink(path);
    }
    close(file);
    return is_good;
}

// ---- Writing ------------------------------------------------------------------------------------

struct glint_keeping {
    pthread_t thread;
    header head;
    const float *texels;
    char folder[PATH_MAX], path[PATH_MAX];
};

static bool write_all(int file, const void *from, size_t count)
{
    for (const char *at = from; count > 0;) {
        const ssize_t written = write(file, at, count);
        if (written < 0 && errno != EINTR) {
            return false;
        }
        at += written > 0 ? written : 0;
        count -= written > 0 ? (size_t)written : 0;
    }
    return true;
}

static bool write_entry(int file, const header *head, const float *texels)
{
    char page[PAGE] = {0};
    memcpy(page, head, sizeof *head);
    return write_all(file, page, sizeof page) && write_all(file, texels, head->texel_bytes);
}

static void *keep(void *context)
{
    glint_keeping *k = context;
    char temporary[PATH_MAX];
    const int length = snprintf(temporary, sizeof temporary, "%s/.tmp-XXXXXX", k->folder);
    if (length >= PATH_MAX || !sum_up(k->texels, k->head.texel_bytes, &k->head.texels)) {
        return NULL;
    }
    k->head.header = sum_up_header(&k->head);
    glint_cache_folder_make_room(k->folder, ENDING, PAGE + k->head.texel_bytes, limit_bytes());
    const int file = mkostemp(temporary, O_CLOEXEC);
    if (file < 0) {
        return NULL;
    }
    const bool is_written = write_entry(file, &k->head, k->texels);
    if (close(file) != 0 || !is_written || rename(temporary, k->path) != 0) {
        (void)unlink(temporary);
    }
    return NULL;
}

// Starts the thread with all signals blocked: other threads handle them. So a full disk's SIGXFSZ
// (a limit on the size of files) stays away too.
static bool start(glint_keeping *k)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool has_started = pthread_create(&k->thread, NULL, keep, k) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return has_started;
}

glint_keeping *glint_kept_begin(const glint_kept_key *key, const glint_kept_facts *facts,
                                const glint_cube *cube)
{
    glint_keeping *k = calloc(1, sizeof *k);
    if (k == NULL) {
        return NULL;
    }
    k->texels = cube->texels;
    k->head = (header){.format = FORMAT,
                       .edge = cube->edge,
                       .key = {key->hash[0], key->hash[1]},
                       .texel_bytes = glint_cube_size(cube) * sizeof(float),
                       .facts = *facts};
    memcpy(k->head.magic, magic, sizeof magic);
    if (!find_entry(key, k->folder, k->path) ||
        PAGE + k->head.texel_bytes > limit_bytes() / GLINT_KEPT_SHARE ||
        !glint_cache_folder_make(k->folder) || !start(k)) {
        free(k);
        return NULL;
    }
    return k;
}

void glint_kept_settle(glint_keeping *keeping)
{
    if (keeping != NULL) {
        pthread_join(keeping->thread, NULL);
        free(keeping);
    }
}
