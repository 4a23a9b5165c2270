// Keeps cube maps in a cache on disk. See cache.h.
#include "environment/cache.h"

#include "base/cache_folder.h"
#include "base/whole_io.h"
#include "environment/checksum.h"

#include <dirent.h>
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
#define LIMIT_MIB 1024
#define PAGE 4096

typedef struct header {
    char magic[8];
    uint64_t key[2];
    uint64_t texel_bytes;
    uint64_t texels; // checksum
    glint_env_cache_facts facts;
    int32_t edge;
    uint64_t header; // checksum of the members above
} header;

static const char magic[8] = {'g', 'l', 'i', 'n', 't', 'e', 'n', 'v'};

// ---- Places -------------------------------------------------------------------------------------

static uint64_t limit_bytes(void)
{
    const char *text = getenv("GLINT_ENV_CACHE_MIB");
    char *end = NULL;
    const unsigned long long mib = text != NULL ? strtoull(text, &end, 10) : LIMIT_MIB;
    const bool is_number = text == NULL || (text[0] >= '0' && text[0] <= '9' && *end == '\0');
    return (is_number && mib < ((uint64_t)1 << 40) ? mib : LIMIT_MIB) << 20;
}

static bool find_folder(char folder[PATH_MAX])
{
    return limit_bytes() > 0 && glint_cache_folder_find(FOLDER, folder);
}

bool glint_env_cache_is_on(void)
{
    char folder[PATH_MAX];
    return find_folder(folder);
}

// The name begins with the number of bytes: glint_env_cache_may_have does not hash the file.
static bool find_entry(const glint_env_cache_key *key, char folder[PATH_MAX], char path[PATH_MAX])
{
    if (!find_folder(folder)) {
        return false;
    }
    const int length = snprintf(path, PATH_MAX, "%s/%llx-%016llx%016llx" ENDING, folder,
                                (unsigned long long)key->bytes, (unsigned long long)key->hash[1],
                                (unsigned long long)key->hash[0]);
    return length > 0 && length < PATH_MAX;
}

bool glint_env_cache_may_have(const char *path)
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

// ---- Reading ------------------------------------------------------------------------------------

static uint64_t sum_up_header(const header *of)
{
    return XXH3_64bits(of, offsetof(header, header));
}

static bool is_good_header(const header *of, const glint_env_cache_key *key, off_t file_bytes)
{
    if (memcmp(of->magic, magic, sizeof magic) != 0 || of->header != sum_up_header(of) ||
        of->key[0] != key->hash[0] || of->key[1] != key->hash[1] || of->edge < 1 ||
        of->edge > GLINT_CUBE_EDGE_MAX) {
        return false;
    }
    const uint64_t texels = glint_cube_size(&(glint_cube){.edge = of->edge});
    return of->texel_bytes == texels * sizeof(float) &&
           (uint64_t)file_bytes == PAGE + of->texel_bytes;
}

// Maps an entry of an open file. If that fails, *is_damaged says whether the file is to blame.
static bool map_entry(int file, const glint_env_cache_key *key, glint_env_cache_facts *facts,
                      glint_cube *cube, bool *is_damaged)
{
    header found;
    struct stat size;
    if (fstat(file, &size) != 0 || !glint_read_all_at(file, 0, &found, sizeof found) ||
        !is_good_header(&found, key, size.st_size)) {
        *is_damaged = true;
        return false;
    }
    const size_t bytes = PAGE + (size_t)found.texel_bytes;
    char *mapped = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE, file, 0);
    if (mapped == MAP_FAILED) {
        return false;
    }
    uint64_t sum = 0;
    const bool is_summed = glint_checksum(mapped + PAGE, found.texel_bytes, &sum);
    if (!is_summed || sum != found.texels) {
        *is_damaged = is_summed;
        munmap(mapped, bytes);
        return false;
    }
    *facts = found.facts;
    *cube = (glint_cube){found.edge, (float *)(void *)(mapped + PAGE), PAGE};
    return true;
}

bool glint_env_cache_take(const glint_env_cache_key *key, glint_env_cache_facts *facts,
                          glint_cube *cube)
{
    char folder[PATH_MAX], path[PATH_MAX];
    const int file = find_entry(key, folder, path) ? open(path, O_RDONLY | O_CLOEXEC) : -1;
    if (file < 0) {
        return false;
    }
    bool is_damaged = false;
    const bool is_good = map_entry(file, key, facts, cube, &is_damaged);
    if (is_good) {
        (void)futimens(file, NULL); // the entry is in use
    } else if (is_damaged) {
        (void)unlink(path);
    }
    close(file);
    return is_good;
}

// ---- Writing ------------------------------------------------------------------------------------

struct glint_env_cache_write {
    pthread_t thread;
    header head;
    const float *texels;
    char folder[PATH_MAX], path[PATH_MAX];
};

static bool write_entry(int file, const header *head, const float *texels)
{
    char page[PAGE] = {0};
    memcpy(page, head, sizeof *head);
    return glint_write_all(file, page, sizeof page) &&
           glint_write_all(file, texels, head->texel_bytes);
}

static void *write_in_thread(void *context)
{
    glint_env_cache_write *w = context;
    char temporary[PATH_MAX];
    const int length =
        snprintf(temporary, sizeof temporary, "%s/" GLINT_CACHE_TEMPORARY "XXXXXX", w->folder);
    if (length >= PATH_MAX || !glint_checksum(w->texels, w->head.texel_bytes, &w->head.texels)) {
        return NULL;
    }
    w->head.header = sum_up_header(&w->head);
    glint_cache_folder_make_room(w->folder, ENDING, PAGE + w->head.texel_bytes, limit_bytes());
    const int file = mkostemp(temporary, O_CLOEXEC);
    if (file < 0) {
        return NULL;
    }
    const bool is_written = write_entry(file, &w->head, w->texels);
    if (close(file) != 0 || !is_written || rename(temporary, w->path) != 0) {
        (void)unlink(temporary);
    }
    return NULL;
}

// Starts the thread with all signals blocked, because other threads handle them. Blocked, SIGXFSZ
// does not end glint where the entry exceeds `ulimit -f`: write() fails instead.
static bool start(glint_env_cache_write *w)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool has_started = pthread_create(&w->thread, NULL, write_in_thread, w) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return has_started;
}

glint_env_cache_write *glint_env_cache_begin_write(const glint_env_cache_key *key,
                                                   const glint_env_cache_facts *facts,
                                                   const glint_cube *cube)
{
    glint_env_cache_write *w = calloc(1, sizeof *w);
    if (w == NULL) {
        return NULL;
    }
    w->texels = cube->texels;
    w->head = (header){.edge = cube->edge,
                       .key = {key->hash[0], key->hash[1]},
                       .texel_bytes = glint_cube_size(cube) * sizeof(float),
                       .facts = *facts};
    memcpy(w->head.magic, magic, sizeof magic);
    if (!find_entry(key, w->folder, w->path) ||
        PAGE + w->head.texel_bytes > limit_bytes() / GLINT_ENV_CACHE_SHARE ||
        !glint_cache_folder_make(w->folder, 0700) || !start(w)) {
        free(w);
        return NULL;
    }
    return w;
}

void glint_env_cache_end_write(glint_env_cache_write *write)
{
    if (write != NULL) {
        pthread_join(write->thread, NULL);
        free(write);
    }
}
