// Finds and makes the folders of glint's caches. A cache holds what glint can compute again, so a
// missing or broken cache is never an error.
#ifndef GLINT_BASE_CACHE_FOLDER_H
#define GLINT_BASE_CACHE_FOLDER_H

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

// Sets `path` to the folder of the cache `name` ("environments"): in $GLINT_CACHE_DIR, else in
// $XDG_CACHE_HOME/glint, else in $HOME/.cache/glint. (Kernels are in the driver's cache,
// device/driver_cache.h.) The folder may not exist. Returns false if GLINT_CACHE_DIR is empty,
// which turns the cache off, or if no variable gives a place. Relative paths in XDG_CACHE_HOME and
// HOME do not count, as the XDG specification demands.
bool glint_cache_folder_find(const char *name, char path[PATH_MAX]);

// Makes the folder and the folders above it with these permissions (0700: for this user alone).
// Returns false if that fails; errno says why.
bool glint_cache_folder_make(const char *path, mode_t mode);

// The names of temporaries begin with this.
#define GLINT_CACHE_TEMPORARY ".tmp-"

// Makes room for `bytes` in a cache that may take `limit` bytes: removes the files that end with
// `ending`, least recently modified first. Also removes temporaries
// that nobody has written to for ten minutes: their processes are dead.
void glint_cache_folder_make_room(const char *path, const char *ending, uint64_t bytes,
                                  uint64_t limit);

#ifdef __cplusplus
}
#endif

#endif
