// Keeps cube maps in a cache on disk: those of environments, so that glint resamples a file once,
// and irradiance maps (cached_irradiance.h).
//
// An entry is one file: a header of a page, then the cube's texels as they are in memory. It
// appears whole (a temporary name, then a rename). It is not flushed to disk, so a crash of the
// machine may damage it: lengths and checksums tell. Nothing here is an error: without an entry,
// the caller makes the cube the ordinary way.
//
// The cache takes at most 1 GiB on disk; the environment variable GLINT_ENV_CACHE_MIB gives another
// limit (0: no cache). The least recently used entries go first.
#ifndef GLINT_ENVIRONMENT_CACHE_H
#define GLINT_ENVIRONMENT_CACHE_H

#include "environment/cache_key.h"
#include "environment/cube.h"

#include <stdbool.h>
#include <stdint.h>

#define GLINT_ENV_CACHE_SHARE 2 // an entry takes at most the limit divided by this

// Facts about the file, from which the layout is recognised again.
typedef struct glint_env_cache_facts {
    int32_t width, height, channels; // of the picture
    int32_t envmap;                  // a glint_envmap
    int32_t is_direct3d_cube;
    int32_t code_bits;
} glint_env_cache_facts;

// True unless the cache is turned off.
bool glint_env_cache_is_on(void);

// Takes an entry. The cube maps the entry's file; changes of its texels stay in memory. Returns
// false if there is no good entry, or no memory. Removes an entry that is damaged.
bool glint_env_cache_take(const glint_env_cache_key *key, glint_env_cache_facts *facts,
                          glint_cube *cube);

// True if the cache has an entry of a file with as many bytes as `path`. So the next load may need
// no decoder.
bool glint_env_cache_may_have(const char *path);

// Writes an entry on another thread. NULL: nothing is written. The cube must keep its texels, and
// the caller must not change them, until glint_env_cache_end_write.
typedef struct glint_env_cache_write glint_env_cache_write;
glint_env_cache_write *glint_env_cache_begin_write(const glint_env_cache_key *key,
                                                   const glint_env_cache_facts *facts,
                                                   const glint_cube *cube);

// Waits until the entry is written, or cannot be written. `write` may be NULL.
void glint_env_cache_end_write(glint_env_cache_write *write);

#endif
