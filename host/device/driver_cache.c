// Watches and repairs the driver's cache of compiled kernels. See driver_cache.h.
#include "device/driver_cache.h"

#include "base/cache_folder.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <fts.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

#define FOLDER_NAME "POCL_CACHE_DIR"
#define MARK "glint-died"       // file in the cache: the time when the run began to compile
#define STAMPS "glint"          // folder of glint_driver_cache_name_stamp
#define TOUCHED "last_accessed" // file in an entry; PoCL touches it when it uses the entry
#define LEAST_ROOM (UINT64_C(16) << 20)
#define LONGEST_NAME 800 // bytes: PoCL holds paths of 1023 bytes, with at most 200 of its own
#define TOO_LONG "its name is too long for PoCL"
#define MOST_SHOWN 300 // bytes of a folder's name in a message
#define SLACK 2        // seconds that the clocks of files may be behind

static char folder[PATH_MAX];              // the cache; "": not known yet
static bool is_lost;                       // PoCL has no folder at all
static char temporary[PATH_MAX];           // our own folder; "": none
static char fault[GLINT_MESSAGE_CAPACITY]; // why the cache can keep nothing; "": it can
static char note[GLINT_MESSAGE_CAPACITY];
static char epitaph[GLINT_MESSAGE_CAPACITY];
static char run_epitaph[GLINT_MESSAGE_CAPACITY];
static atomic_bool runs;
static char mark_path[PATH_MAX + sizeof "/" MARK];
static char mark_text[32];
static time_t begun;
static atomic_bool is_used; // a compilation is under way
static void (*watcher)(void);

// ---- The folder ---------------------------------------------------------------------------------

// Unsets PoCL's variables that are set and empty, as CI systems set what nobody gave. PoCL aborts
// over an empty POCL_CACHE_DIR, and finds no devices with an empty POCL_DEVICES.
static void unset_empty_variables(void)
{
    char name[64];
    for (char **entry = environ; entry != NULL && *entry != NULL;) {
        const size_t length = strcspn(*entry, "=");
        const bool is_empty = strncmp(*entry, "POCL_", strlen("POCL_")) == 0 &&
                              strcmp(*entry + length, "=") == 0 && length < sizeof name;
        snprintf(name, sizeof name, "%.*s", (int)length, *entry);
        // Removing an entry moves the others: begin again.
        entry = is_empty && unsetenv(name) == 0 ? environ : entry + 1;
    }
}

// Finds the folder as PoCL does. Returns false if its name is too long for PoCL.
static bool find_folder(void)
{
    const char *given = getenv(FOLDER_NAME), *home = getenv("HOME");
    const char *caches = getenv("XDG_CACHE_HOME");
    int length;
    if (given != NULL) {
        length = snprintf(folder, sizeof folder, "%s", given);
    } else if (caches != NULL && caches[0] != '\0') {
        length = snprintf(folder, sizeof folder, "%s/pocl/kcache", caches);
    } else if (home != NULL && home[0] != '\0') {
        length = snprintf(folder, sizeof folder, "%s/.cache/pocl/kcache", home);
    } else {
        length = snprintf(folder, sizeof folder, "/tmp/pocl/kcache");
    }
    snprintf(mark_path, sizeof mark_path, "%s/" MARK, folder);
    glint_driver_cache_set_device(NULL);
    return length <= LONGEST_NAME;
}

// Tells PoCL the folder by its full name. PoCL takes no name of one letter, and its linker takes
// "-cache" or "=cache" for an option. Returns false if the name is too long.
static bool tell_pocl(const char *path)
{
    char whole[PATH_MAX];
    return realpath(path, whole) != NULL && strlen(whole) <= LONGEST_NAME &&
           setenv(FOLDER_NAME, strcmp(whole, "/") == 0 ? "/." : whole, 1) == 0;
}

void glint_driver_cache_set_device(const char *device)
{
    char by[300] = "";
    if (device != NULL && device[0] != '\0') {
        snprintf(by, sizeof by, "device '%.250s': ", device);
    }
    snprintf(epitaph, sizeof epitaph,
             "glint: %s%.500s: the driver died while it compiled kernels, or loaded them from this "
             "cache (run glint again: it will compile them anew)\n",
             by, folder);
    snprintf(
        run_epitaph, sizeof run_epitaph,
        "glint: %sthe process died while the driver ran kernels (glint selftest says what this "
        "driver does wrong, glint devices which others there are)\n",
        by);
}

// Why the folder cannot keep kernels; NULL: it can.
static const char *find_fault(void)
{
    struct stat facts;
    struct statvfs room;
    if (!glint_cache_folder_make(folder, 0777)) {
        return strerror(errno);
    }
    if (stat(folder, &facts) == 0 && !S_ISDIR(facts.st_mode)) {
        return "it is no folder";
    }
    if (access(folder, W_OK | X_OK) != 0) {
        return strerror(errno);
    }
    const bool is_full = statvfs(folder, &room) == 0 &&
                         (uint64_t)room.f_bavail * (uint64_t)room.f_frsize < LEAST_ROOM;
    if (is_full) {
        return "its disk is full";
    }
    return tell_pocl(folder) ? NULL : TOO_LONG;
}

// ---- Entries ------------------------------------------------------------------------------------

static void remove_tree(const char *path)
{
    char name[PATH_MAX + sizeof "/" STAMPS];
    snprintf(name, sizeof name, "%s", path);
    FTS *tree = fts_open((char *[]){name, NULL}, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    for (FTSENT *entry; tree != NULL && (entry = fts_read(tree)) != NULL;) {
        if (entry->fts_info == FTS_DP) {
            (void)rmdir(entry->fts_accpath);
        } else if (entry->fts_info != FTS_D) {
            (void)unlink(entry->fts_accpath);
        }
    }
    if (tree != NULL) {
        fts_close(tree);
    }
}

static void remove_stamps(void)
{
    char stamps[PATH_MAX + sizeof "/" STAMPS];
    snprintf(stamps, sizeof stamps, "%s/" STAMPS, folder);
    remove_tree(stamps);
}

// Removes the entries used since `since`, and all stamps. An entry is a folder in a folder of the
// cache.
static bool remove_used_since(time_t since)
{
    bool is_any = false;
    remove_stamps();
    char name[PATH_MAX];
    snprintf(name, sizeof name, "%s", folder);
    FTS *tree = fts_open((char *[]){name, NULL}, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    for (FTSENT *entry; tree != NULL && (entry = fts_read(tree)) != NULL;) {
        char touched[PATH_MAX];
        struct stat facts;
        if (entry->fts_info != FTS_D || entry->fts_level < 2) {
            continue;
        }
        fts_set(tree, entry, FTS_SKIP);
        const int length = snprintf(touched, sizeof touched, "%s/" TOUCHED, entry->fts_path);
        if (length < (int)sizeof touched && stat(touched, &facts) == 0 &&
            facts.st_mtime >= since - SLACK) {
            remove_tree(entry->fts_path);
            is_any = true;
        }
    }
    if (tree != NULL) {
        fts_close(tree);
    }
    return is_any;
}

// ---- Before and while ---------------------------------------------------------------------------

static void mend_after_death(void)
{
    char text[sizeof mark_text] = "";
    const int mark = open(mark_path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (mark < 0) {
        return;
    }
    const bool is_read = read(mark, text, sizeof text - 1) > 0;
    close(mark);
    (void)unlink(mark_path);
    if (is_read && remove_used_since((time_t)strtoll(text, NULL, 10))) {
        snprintf(note, sizeof note,
                 "%.700s: an earlier run died over this kernel cache: what it used was removed, "
                 "and is compiled anew",
                 folder);
    }
}

// Makes a temporary folder in `place` and tells PoCL. Returns false if PoCL cannot use it.
static bool make_temporary(const char *place)
{
    const int length = snprintf(temporary, sizeof temporary, "%s/glint-kernels-XXXXXX", place);
    if (length < 0 || (size_t)length >= sizeof temporary || mkdtemp(temporary) == NULL) {
        temporary[0] = '\0';
        return false;
    }
    if (!tell_pocl(temporary)) {
        (void)rmdir(temporary);
        temporary[0] = '\0';
        return false;
    }
    return true;
}

// Sends kernels to a temporary folder of this run.
static void take_temporary(void)
{
    const char *place = getenv("TMPDIR");
    const bool is_made =
        (place != NULL && place[0] != '\0' && make_temporary(place)) || make_temporary("/tmp");
    snprintf(note, sizeof note, "%.700s%s", fault,
             is_made ? "; kernels are compiled for this run alone (" FOLDER_NAME
                       " names another folder)"
                     : "; TMPDIR and /tmp cannot be used either (let " FOLDER_NAME
                       " name a folder that can be written)");
    is_lost = !is_made;
    if (is_made) {
        snprintf(folder, sizeof folder, "%s", temporary);
    }
}

void glint_driver_cache_prepare(void)
{
    if (folder[0] != '\0') {
        return;
    }
    unset_empty_variables();
    const char *why = find_folder() ? find_fault() : TOO_LONG;
    if (why != NULL) {
        const bool is_whole = strlen(folder) <= MOST_SHOWN;
        snprintf(fault, sizeof fault, "%.*s%s: the kernel cache cannot be used: %.100s", MOST_SHOWN,
                 folder, is_whole ? "" : "...", why);
        take_temporary();
    } else {
        mend_after_death();
    }
}

void glint_driver_cache_release(void)
{
    if (temporary[0] != '\0') {
        remove_tree(temporary);
        temporary[0] = '\0';
    }
}

const char *glint_driver_cache_fault(void)
{
    return fault[0] != '\0' ? fault : NULL;
}

const char *glint_driver_cache_loss(void)
{
    return is_lost ? note : NULL;
}

const char *glint_driver_cache_note(void)
{
    return note[0] != '\0' ? note : NULL;
}

void glint_driver_cache_begin(void)
{
    begun = time(NULL);
    snprintf(mark_text, sizeof mark_text, "%lld\n", (long long)begun);
    atomic_store(&is_used, true);
    if (watcher != NULL) {
        watcher();
    }
}

void glint_driver_cache_watch(void (*watch)(void))
{
    watcher = watch;
}

void glint_driver_cache_end(void)
{
    atomic_store(&is_used, false);
}

bool glint_driver_cache_clean(void)
{
    return folder[0] != '\0' && remove_used_since(begun);
}

bool glint_driver_cache_name_stamp(const char *name, char *path, size_t capacity)
{
    int length = snprintf(path, capacity, "%s/" STAMPS, folder);
    if (folder[0] == '\0' || length < 0 || (size_t)length >= capacity ||
        !glint_cache_folder_make(path, 0777)) {
        return false;
    }
    length = snprintf(path, capacity, "%s/" STAMPS "/%s", folder, name);
    return length > 0 && (size_t)length < capacity;
}

void glint_driver_cache_is_mended(void)
{
    snprintf(note, sizeof note,
             "%.700s: a kernel of this cache was damaged: it was removed, and compiled anew",
             folder);
}

void glint_driver_run_begin(void)
{
    atomic_store(&runs, true);
    if (watcher != NULL) {
        watcher();
    }
}

void glint_driver_run_end(void)
{
    atomic_store(&runs, false);
}

// ---- In signal handlers -------------------------------------------------------------------------

bool glint_driver_cache_is_used(void)
{
    return folder[0] != '\0' && atomic_load(&is_used);
}

void glint_driver_cache_mark(void)
{
    const int mark = open(mark_path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (mark >= 0) {
        (void)!write(mark, mark_text, strlen(mark_text));
        close(mark);
    }
}

const char *glint_driver_cache_epitaph(void)
{
    return epitaph;
}

const char *glint_driver_run_epitaph(void)
{
    return atomic_load(&runs) ? run_epitaph : NULL;
}
