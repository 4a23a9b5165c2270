// Watches PoCL's cache of compiled kernels: finds it, checks that it can be used, and repairs
// damage. Other drivers have their own caches, which glint leaves alone.
#ifndef GLINT_DEVICE_DRIVER_CACHE_H
#define GLINT_DEVICE_DRIVER_CACHE_H

#include <stdbool.h>
#include <stddef.h>

// Call it before OpenCL is used; only the first call has an effect. Removes entries over which an
// earlier run died. If the cache cannot be written, or PoCL cannot use its name, sends kernels to a
// temporary folder. Unsets PoCL's empty variables, and sets POCL_CACHE_DIR to the folder.
void glint_driver_cache_prepare(void);

// Removes the temporary folder.
void glint_driver_cache_release(void);

// A sentence on what was done to the cache, which begins with its folder. NULL: nothing was done.
const char *glint_driver_cache_note(void);

// Why PoCL has no folder at all, and thus no device; begins with the cache's folder. NULL: it has
// one.
const char *glint_driver_cache_loss(void);

// Why the cache can keep no kernels for later runs, which begins with its folder. NULL: it can.
const char *glint_driver_cache_fault(void);

// Sets `watch`, called whenever the driver begins to compile. NULL, the default: no call.
void glint_driver_cache_watch(void (*watch)(void));

// Call these before and after the driver compiles, or loads from its cache.
void glint_driver_cache_begin(void);
void glint_driver_cache_end(void);

// Removes the entries used since glint_driver_cache_begin. Returns false if there were none.
bool glint_driver_cache_clean(void);

// Records that glint_driver_cache_clean helped.
void glint_driver_cache_is_mended(void);

// Writes the path of a stamp (compiled.h), a file in a folder of glint's own in the cache, and
// makes the folder. When damaged entries are removed, all stamps go too. False if there is no
// cache, or the path is too long.
bool glint_driver_cache_name_stamp(const char *name, char *path, size_t capacity);

// Sets the device's name, for messages about a death. NULL or "": unknown.
void glint_driver_cache_set_device(const char *device);

// Call these before and after the driver runs kernels.
void glint_driver_run_begin(void);
void glint_driver_run_end(void);

// For signal handlers: a line about a process that died while the driver ran kernels. NULL if the
// driver ran none.
const char *glint_driver_run_epitaph(void);

// For signal handlers: true if the driver is compiling or loading. If the process dies of it:
// leaves a mark for the next run, and returns a line about it.
bool glint_driver_cache_is_used(void);
void glint_driver_cache_mark(void);
const char *glint_driver_cache_epitaph(void);

#endif
