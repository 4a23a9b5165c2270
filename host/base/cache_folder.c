// Finds the folders of glint's caches, and keeps them within their limits. See cache_folder.h.
#include "base/cache_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define PATIENCE 600 // seconds without a write after which a temporary is stale

static bool join(const char *folder, const char *between, const char *name, char path[PATH_MAX])
{
    const int length = snprintf(path, PATH_MAX, "%s%s%s", folder, between, name);
    return length > 0 && length < PATH_MAX;
}

bool glint_cache_folder_find(const char *name, char path[PATH_MAX])
{
    const char *own = getenv("GLINT_CACHE_DIR");
    const char *caches = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    if (own != NULL) {
        return own[0] != '\0' && join(own, "/", name, path);
    }
    if (caches != NULL && caches[0] == '/') {
        return join(caches, "/glint/", name, path);
    }
    return home != NULL && home[0] == '/' && join(home, "/.cache/glint/", name, path);
}

bool glint_cache_folder_make(const char *path, mode_t mode)
{
    char part[PATH_MAX];
    const int length = snprintf(part, sizeof part, "%s", path);
    if (length < 1 || length >= PATH_MAX) {
        return false;
    }
    for (char *slash = strchr(part + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        (void)mkdir(part, mode);
        *slash = '/';
    }
    return mkdir(part, mode) == 0 || errno == EEXIST;
}

// ---- Room ---------------------------------------------------------------------------------------

// A file of the cache.
typedef struct entry {
    char name[NAME_MAX + 1];
    uint64_t bytes;
    struct timespec used; // last modification; whoever uses an entry sets it
} entry;

typedef struct listing {
    entry *entries;
    size_t count, capacity;
    uint64_t bytes; // of all entries and temporaries
} listing;

static void add(listing *list, const char *name, const struct stat *facts)
{
    if (list->count == list->capacity) {
        const size_t capacity = 2 * list->capacity + 16;
        entry *more = realloc(list->entries, capacity * sizeof *more);
        if (more == NULL) {
            return;
        }
        list->entries = more;
        list->capacity = capacity;
    }
    entry *added = &list->entries[list->count++];
    snprintf(added->name, sizeof added->name, "%s", name);
    added->bytes = (uint64_t)facts->st_size;
    added->used = facts->st_mtim;
    list->bytes += added->bytes;
}

static bool has_ending(const char *name, const char *ending)
{
    const size_t length = strlen(name), wanted = strlen(ending);
    return length > wanted && strcmp(name + length - wanted, ending) == 0;
}

static listing list_entries(DIR *folder, const char *ending)
{
    listing list = {0};
    for (const struct dirent *at; (at = readdir(folder)) != NULL;) {
        struct stat facts;
        if (fstatat(dirfd(folder), at->d_name, &facts, AT_SYMLINK_NOFOLLOW) != 0 ||
            !S_ISREG(facts.st_mode)) {
            continue;
        }
        if (strncmp(at->d_name, GLINT_CACHE_TEMPORARY, strlen(GLINT_CACHE_TEMPORARY)) == 0) {
            const bool is_stale = time(NULL) - facts.st_mtim.tv_sec > PATIENCE;
            if (!is_stale || unlinkat(dirfd(folder), at->d_name, 0) != 0) {
                list.bytes += (uint64_t)facts.st_size;
            }
        } else if (has_ending(at->d_name, ending)) {
            add(&list, at->d_name, &facts);
        }
    }
    return list;
}

static int compare_use(const void *a, const void *b)
{
    const struct timespec x = ((const entry *)a)->used, y = ((const entry *)b)->used;
    const int seconds = (x.tv_sec > y.tv_sec) - (x.tv_sec < y.tv_sec);
    return seconds != 0 ? seconds : (x.tv_nsec > y.tv_nsec) - (x.tv_nsec < y.tv_nsec);
}

void glint_cache_folder_make_room(const char *path, const char *ending, uint64_t bytes,
                                  uint64_t limit)
{
    DIR *folder = opendir(path);
    if (folder == NULL) {
        return;
    }
    listing list = list_entries(folder, ending);
    if (list.count > 0) {
        qsort(list.entries, list.count, sizeof *list.entries, compare_use);
    }
    for (size_t i = 0; i < list.count && list.bytes + bytes > limit; i++) {
        if (unlinkat(dirfd(folder), list.entries[i].name, 0) == 0) {
            list.bytes -= list.entries[i].bytes;
        }
    }
    free(list.entries);
    closedir(folder);
}
