// Identifies the files of an environment by their content, for the cache (cache.h).
#ifndef GLINT_ENVIRONMENT_CACHE_KEY_H
#define GLINT_ENVIRONMENT_CACHE_KEY_H

#include "environment/cube.h"
#include "environment/layouts.h"
#include "environment/source.h"

#include <stdbool.h>
#include <stdint.h>
#include <sys/stat.h>
#include <time.h>

// What an environment is made of. Two keys with equal hashes have the same cube.
typedef struct glint_env_cache_key {
    uint64_t bytes;   // of all files
    uint64_t hash[2]; // of the files, the request, and glint's programs
    // To notice a file that changes while it is read.
    time_t begun; // just before the first file was read
    struct stat files[6];
    int file_count;
    glint_source_kind kind;
} glint_env_cache_key;

// Makes the key of `path` (see glint_environment_load). Reads all files, on all cores. Returns
// false if that fails.
bool glint_env_cache_key_make(const char *path, const glint_layout_request *request,
                              glint_env_cache_key *key);

// Makes the key of a map of this edge that is computed from a cube. Returns false without memory.
bool glint_env_cache_key_of_cube(const glint_cube *cube, int edge, glint_env_cache_key *key);

// True if the files surely are those that were hashed. A file that was modified in the two seconds
// before it was hashed may have changed again without a new time of modification: false.
bool glint_env_cache_key_holds(const char *path, const glint_env_cache_key *key);

#endif
