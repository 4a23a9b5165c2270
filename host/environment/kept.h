// Keeps the cubes of environments in a cache on disk, so that glint resamples a file once.
//
// An entry is one file: a header of a page, then the cube's texels as they are in memory. It
// appears whole (a temporary name, then a rename). It is not flushed to disk, so a crash of the
// machine may damage it: lengths and checksums tell. Nothing here is an error: without an entry,
// the caller loads the environment the ordinary way.
//
// The cache takes at most GLINT_KEPT_MIB on disk; the variable GLINT_ENV_CACHE_MIB gives another
// limit (0: no cache). The least recently used entries go first.
#ifndef GLINT_ENVIRONMENT_KEPT_H
#define GLINT_ENVIRONMENT_KEPT_H

#include "environment/cube.h"
#include "environment/kept_key.h"

#include <stdbool.h>
#include <stdint.h>

#define GLINT_KEPT_MIB 1024
#define GLINT_KEPT_SHARE 2 // an entry takes at most the limit divided by this

// Facts about the file, from which the layout is recognised again.
typedef struct glint_kept_facts {
    int32_t width, height, channels; // of the picture
    int32_t envmap;                  // a glint_envmap
    int32_t is_direct3d_cube;
} glint_kept_facts;

// True unless the cache is turned off.
bool glint_kept_is_on(void);

// Takes an entry. The cube maps the entry's file; changes of its texels stay in memory. Returns
// false if there is no good entry. Removes an entry that is damaged.
bool glint_kept_take(const glint_kept_key *key, glint_kept_facts *facts, glint_cube *cube);

// True if the cache has an entry of a file with as many bytes as `path`. So the next load may need
// no decoder.
bool glint_kept_is_likely(const char *path);

// Writes an entry on another thread. NULL: nothing is written. The cube must keep its texels, and
// the caller must not change them, until glint_kept_settle.
typedef struct glint_keeping glint_keeping;
glint_keeping *glint_kept_begin(const glint_kept_key *key, const glint_kept_facts *facts,
                                const glint_cube *cube);

// Waits until the entry is written, or cannot be written. `keeping` may be NULL.
void glint_kept_settle(glint_keeping *keeping);

#endif
