// Finds how much memory is left. See free_memory.h.
#include "base/free_memory.h"

#include <inttypes.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#define GROUPS "/sys/fs/cgroup"

// Reads the number after `label` at the beginning of a line; with label "", the file's first word.
static bool read_number(const char *path, const char *label, uint64_t *number)
{
    FILE *file = fopen(path, "re");
    char line[PATH_MAX];
    bool is_found = false;
    while (file != NULL && !is_found && fgets(line, sizeof line, file) != NULL) {
        const size_t length = strlen(label);
        is_found =
            strncmp(line, label, length) == 0 && sscanf(line + length, "%" SCNu64, number) == 1;
    }
    if (file != NULL) {
        fclose(file);
    }
    return is_found;
}

static uint64_t least(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

static uint64_t left_of(uint64_t limit, uint64_t used)
{
    return limit > used ? limit - used : 0;
}

static uint64_t left_by_machine(void)
{
    uint64_t kibibytes;
    return read_number("/proc/meminfo", "MemAvailable:", &kibibytes) ? kibibytes * 1024
                                                                     : UINT64_MAX;
}

static uint64_t left_by_limit(void)
{
    struct rlimit limit;
    uint64_t pages;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        !read_number("/proc/self/statm", "", &pages)) {
        return UINT64_MAX;
    }
    return left_of(limit.rlim_cur, pages * (uint64_t)sysconf(_SC_PAGESIZE));
}

// The bytes that a cgroup has left. Cached files count as free: the system drops them when memory
// is short.
static uint64_t left_in_group(const char *group)
{
    static const char *const cached[] = {"inactive_file ", "active_file "};
    char file[PATH_MAX];
    uint64_t most, used, bytes;
    snprintf(file, sizeof file, GROUPS "%.4000s/memory.max", group);
    if (!read_number(file, "", &most)) {
        return UINT64_MAX;
    }
    snprintf(file, sizeof file, GROUPS "%.4000s/memory.current", group);
    if (!read_number(file, "", &used)) {
        return UINT64_MAX;
    }
    snprintf(file, sizeof file, GROUPS "%.4000s/memory.stat", group);
    for (int i = 0; i < 2; i++) {
        used = read_number(file, cached[i], &bytes) ? left_of(used, bytes) : used;
    }
    return left_of(most, used);
}

// The least that the process's cgroup and its parents have left (cgroups, version 2).
static uint64_t left_by_groups(void)
{
    char path[PATH_MAX];
    FILE *own = fopen("/proc/self/cgroup", "re");
    const bool is_known = own != NULL && fscanf(own, "0::%4000s", path) == 1;
    if (own != NULL) {
        fclose(own);
    }
    uint64_t left = UINT64_MAX;
    for (char *end = is_known ? path + strlen(path) : NULL; end != NULL; end = strrchr(path, '/')) {
        *end = '\0';
        left = least(left, left_in_group(path));
    }
    return left;
}

uint64_t glint_free_memory(void)
{
    return least(left_by_machine(), least(left_by_limit(), left_by_groups()));
}
