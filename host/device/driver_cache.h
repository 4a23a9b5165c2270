// The driver's cache of compiled kernels, as PoCL keeps it: where it is, whether it can be used,
// and how damage in it is mended. Other drivers have caches of their own, which this leaves alone.
#ifndef GLINT_DEVICE_DRIVER_CACHE_H
#define GLINT_DEVICE_DRIVER_CACHE_H

#include <stdbool.h>

// Before OpenCL is used; the first call counts. Removes entries over which an earlier run died.
// Where the cache cannot be written, kernels go to a temporary folder.
void glint_driver_cache_prepare(void);

// Removes the temporary folder.
void glint_driver_cache_release(void);

// What was done about the cache, as a sentence that begins with its folder; NULL: nothing.
const char *glint_driver_cache_note(void);

// `watch` is called whenever the driver begins to compile. NULL, as at first: nobody watches.
void glint_driver_cache_watch(void (*watch)(void));

// Between the two the driver compiles, or loads from its cache.
void glint_driver_cache_begin(void);
void glint_driver_cache_end(void);

// Removes the entries that were used since the beginning. False where there were none.
bool glint_driver_cache_clean(void);

// Notes that cleaning helped.
void glint_driver_cache_is_mended(void);

// The device that is used: what is said of a death names it. NULL or "": unknown.
void glint_driver_cache_set_device(const char *device);

// Between the two the driver runs kernels.
void glint_driver_run_begin(void);
void glint_driver_run_end(void);

// For signal handlers: a line about a process that died while the driver ran kernels; NULL: it did
// not.
const char *glint_driver_run_epitaph(void);

// For signal handlers: whether the driver compiles or loads; and, if it died of that, a mark for
// the next run, and a line about it.
bool glint_driver_cache_is_used(void);
void glint_driver_cache_mark(void);
const char *glint_driver_cache_epitaph(void);

#endif
