// Writes a file that appears whole or not at all. See output_file.h.
//
// The temporary is named .NAME.PID-HOST-N.tmp.EXT. PID tells whether its process still lives. HOST,
// a hash of the machine's name, separates machines that share a folder: they cannot judge each
// other's processes. N separates the temporaries of one process.
//
// Limits: the signal handler knows at most SLOTS temporaries in flight, with paths up to SLOT_PATH.
// The next run removes the others.
#include "image/output_file.h"

#include "base/whole_io.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define SLOTS (GLINT_OUTPUT_FILES_AT_ONCE + 8)
#define SLOT_PATH 1024
#define OPENING_MS 1000 // longest wait of discarding for a file under creation

// ---- Temporaries in flight ----------------------------------------------------------------------

typedef enum slot_state {
    SLOT_EMPTY,
    SLOT_OPENING, // the file may appear any moment; its thread blocks all signals
    SLOT_THERE,   // the file exists
} slot_state;

typedef struct slot {
    atomic_int state; // a slot_state
    bool taken;       // guarded by slots_lock
    char path[SLOT_PATH];
} slot;

static slot slots[SLOTS];
static pthread_mutex_t slots_lock = PTHREAD_MUTEX_INITIALIZER;
static atomic_int unregistered; // temporaries in flight without a slot
static atomic_int discarding;

// Takes a slot. Returns false once temporaries are discarded, because a path must not change while
// it is read. If there is no slot, *found is NULL and `unregistered` counts the file.
static bool slot_take(const char *path, slot **found)
{
    *found = NULL;
    pthread_mutex_lock(&slots_lock);
    const bool is_allowed = !atomic_load(&discarding);
    for (int i = 0; is_allowed && i < SLOTS && strlen(path) < SLOT_PATH && *found == NULL; i++) {
        if (!slots[i].taken) {
            *found = &slots[i];
            slots[i].taken = true;
            memcpy(slots[i].path, path, strlen(path) + 1);
            atomic_store(&slots[i].state, SLOT_OPENING);
        }
    }
    if (is_allowed && *found == NULL) {
        atomic_fetch_add(&unregistered, 1);
    }
    pthread_mutex_unlock(&slots_lock);
    return is_allowed;
}

static void slot_release(slot *taken)
{
    pthread_mutex_lock(&slots_lock);
    if (taken == NULL) {
        atomic_fetch_sub(&unregistered, 1);
    } else {
        atomic_store(&taken->state, SLOT_EMPTY);
        taken->taken = false;
    }
    pthread_mutex_unlock(&slots_lock);
}

static bool slot_holds(const char *path)
{
    bool held = atomic_load(&unregistered) > 0;
    pthread_mutex_lock(&slots_lock);
    for (int i = 0; i < SLOTS && !held; i++) {
        held = slots[i].taken && strcmp(slots[i].path, path) == 0;
    }
    pthread_mutex_unlock(&slots_lock);
    return held;
}

void glint_output_file_discard_all(void)
{
    atomic_store(&discarding, 1);
    for (int i = 0; i < SLOTS; i++) {
        // A thread may be between its check of `discarding` and the file's creation. Signals are
        // blocked there, so wait.
        for (int waited = 0; waited < OPENING_MS && atomic_load(&slots[i].state) == SLOT_OPENING;
             waited++) {
            poll(NULL, 0, 1);
        }
        if (atomic_load(&slots[i].state) != SLOT_EMPTY) {
            unlink(slots[i].path);
        }
    }
}

// ---- Where the file goes ------------------------------------------------------------------------

// The parts of a path; zero is valid.
typedef struct place {
    char *path;   // the file itself, links followed
    char *folder; // its folder
    char *name;   // within the folder
} place;

static void place_free(place *where)
{
    free(where->path);
    free(where->folder);
    free(where->name);
    *where = (place){0};
}

static glint_status place_split(place *where, glint_error *error)
{
    const char *slash = strrchr(where->path, '/');
    const char *name = slash != NULL ? slash + 1 : where->path;
    size_t folder = slash == where->path ? 1 : (size_t)(name - where->path) - (slash != NULL);
    where->name = strdup(name);
    where->folder = slash == NULL ? strdup(".") : strndup(where->path, folder);
    if (where->name == NULL || where->folder == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    return GLINT_OK;
}

// Checks what stands at the path. A regular file may be replaced; a link leads to its file. A
// device or a pipe cannot appear whole by renaming. A folder is a mistake.
static glint_status check_target(const char *path, const place *where, glint_error *error)
{
    struct stat facts;
    if (stat(where->path, &facts) != 0) {
        return GLINT_OK;
    }
    if (S_ISDIR(facts.st_mode) || where->name[0] == '\0') {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: is a folder (name a file in it)", path);
    }
    if (!S_ISREG(facts.st_mode)) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "%s: is no regular file, and a device or pipe cannot be replaced as a "
                          "whole (name a file)",
                          path);
    }
    if (access(where->path, W_OK) != 0) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "%s: is write-protected (change its permissions or the name)", path);
    }
    return GLINT_OK;
}

static glint_status check_folder(const char *path, const place *where, glint_error *error)
{
    struct stat facts;
    if (stat(where->folder, &facts) != 0) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: its folder %s: %s (make it first)", path,
                          where->folder, strerror(errno));
    }
    if (!S_ISDIR(facts.st_mode)) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: %s is no folder (name another)", path,
                          where->folder);
    }
    if (access(where->folder, W_OK | X_OK) != 0) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "%s: its folder is not writable (change its permissions or the name)",
                          path);
    }
    return GLINT_OK;
}

static glint_status place_find(const char *path, place *where, glint_error *error)
{
    struct stat facts;
    bool is_link = lstat(path, &facts) == 0 && S_ISLNK(facts.st_mode);
    where->path = is_link ? realpath(path, NULL) : strdup(path);
    if (where->path == NULL) {
        glint_fail(error, GLINT_OUTPUT_FAILED,
                   is_link ? "%s: a symbolic link that leads nowhere (remove it or mend it)"
                           : "%s: not enough memory for its name",
                   path);
        return GLINT_OUTPUT_FAILED;
    }
    TRY(place_split(where, error));
    TRY(check_target(path, where, error));
    return check_folder(path, where, error);
}

glint_status glint_output_file_check_folder(const char *path, glint_error *error)
{
    place where = {.path = strdup(path)};
    if (where.path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    glint_status status;
    TRY_OR(cleanup, status, place_split(&where, error));
    TRY_OR(cleanup, status, check_folder(path, &where, error));
cleanup:
    place_free(&where);
    return status;
}

glint_status glint_output_file_check(const char *path, glint_error *error)
{
    place where = {0};
    glint_status status = place_find(path, &where, error);
    place_free(&where);
    return status;
}

// ---- Names of temporaries -----------------------------------------------------------------------

static uint32_t host_hash(void)
{
    char name[256] = {0};
    gethostname(name, sizeof name - 1);
    uint32_t hash = 2166136261u; // FNV-1a
    for (const char *c = name; *c != '\0'; c++) {
        hash = (hash ^ (unsigned char)*c) * 16777619u;
    }
    return hash;
}

// The fixed parts of a temporary's name: ".NAME." and ".tmp.EXT". A name near the file system's
// limit is shortened. Then NAME stands for all names with this beginning; process and number still
// separate them.
#define NAME_ROOM 150
static void temporary_parts(const place *where, char before[NAME_MAX], char after[NAME_MAX])
{
    const char *dot = strrchr(where->name, '.');
    const char *extension = dot != NULL && strlen(dot) < 16 ? dot : "";
    snprintf(before, NAME_MAX, ".%.*s.", NAME_ROOM, where->name);
    snprintf(after, NAME_MAX, ".tmp%s", extension);
}

// The last ".tmp" in a name; NULL if there is none.
static const char *find_ending(const char *name)
{
    const char *found = NULL;
    for (const char *at = strstr(name, ".tmp"); at != NULL; at = strstr(at + 1, ".tmp")) {
        found = at;
    }
    return found;
}

// True if `name` is a temporary, of any output, whose process is gone, or of an earlier process
// with our number.
static bool is_stale(const place *where, const char *name)
{
    const char *ending = find_ending(name);
    char head[NAME_MAX + 1];
    if (ending == NULL || strlen(name) > NAME_MAX) {
        return false;
    }
    snprintf(head, sizeof head, "%.*s", (int)(ending - name), name);
    const char *numbers = strrchr(head, '.');
    long process = 0;
    unsigned host = 0, number = 0;
    int used = 0;
    if (numbers == NULL || numbers == head ||
        sscanf(numbers + 1, "%ld-%8x-%u%n", &process, &host, &number, &used) != 3 ||
        numbers[1 + used] != '\0' || host != host_hash() || process < 1 || process > INT_MAX) {
        return false;
    }
    if (process != (long)getpid()) {
        return kill((pid_t)process, 0) != 0 && errno == ESRCH;
    }
    char path[PATH_MAX];
    int printed = snprintf(path, sizeof path, "%s/%s", where->folder, name);
    return printed > 0 && (size_t)printed < sizeof path && !slot_holds(path);
}

// Returns whether this process looked through this folder last time. Doing so for every file of a
// long sequence would take longer than writing them.
static bool was_swept(const place *where)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static char last[PATH_MAX];
    pthread_mutex_lock(&lock);
    const bool was = strcmp(last, where->folder) == 0;
    snprintf(last, sizeof last, "%s", where->folder);
    pthread_mutex_unlock(&lock);
    return was;
}

static void remove_stale(const place *where)
{
    DIR *folder = was_swept(where) ? NULL : opendir(where->folder);
    if (folder == NULL) {
        return; // also if the folder may be written but not listed
    }
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        if (entry->d_name[0] == '.' && is_stale(where, entry->d_name)) {
            unlinkat(dirfd(folder), entry->d_name, 0);
        }
    }
    closedir(folder);
}

// ---- Writing ------------------------------------------------------------------------------------

// `folder` is held open, so that the temporary is found even if somebody moves the folder.
typedef struct temporary {
    char path[PATH_MAX]; // for the signal handler
    const char *name;    // within the folder
    slot *registered;
    bool made;
    int folder, file;
} temporary;

// Creates the temporary of made->path. Returns 0 or errno. It is registered before it exists. No
// signal comes to this thread until its existence is recorded.
static int create_temporary(temporary *made)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    int cause = EINTR;
    if (slot_take(made->path, &made->registered)) {
        made->file =
            atomic_load(&discarding)
                ? (errno = EINTR, -1)
                : openat(made->folder, made->name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        cause = made->file >= 0 ? 0 : errno;
        made->made = cause == 0;
        if (made->made && made->registered != NULL) {
            atomic_store(&made->registered->state, SLOT_THERE);
        } else if (!made->made) {
            slot_release(made->registered);
        }
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return cause;
}

static int open_temporary(const place *where, temporary *made)
{
    static atomic_uint next;
    char before[NAME_MAX], after[NAME_MAX];
    temporary_parts(where, before, after);
    made->folder = open(where->folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (made->folder < 0) {
        return errno;
    }
    made->name = made->path + strlen(where->folder) + 1;
    for (int attempt = 0; attempt < 1000; attempt++) {
        int printed =
            snprintf(made->path, sizeof made->path, "%s/%s%ld-%08x-%u%s", where->folder, before,
                     (long)getpid(), host_hash(), atomic_fetch_add(&next, 1), after);
        if (printed < 0 || (size_t)printed >= sizeof made->path) {
            return ENAMETOOLONG;
        }
        const int cause = create_temporary(made);
        if (cause != EEXIST) {
            return cause;
        }
    }
    return EEXIST;
}

// Returns 0 or the cause, an errno.
static int write_and_sync(int file, const unsigned char *bytes, size_t size)
{
    if (!glint_write_all(file, bytes, size)) {
        return errno;
    }
    // Some file systems cannot sync and say so. Others report an earlier write error here.
    if (fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP) {
        return errno;
    }
    return 0;
}

// Syncs the folder, so that the new name reaches the disk. The file is whole either way.
static void sync_folder(int folder)
{
    int file = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file >= 0) {
        fsync(file);
        close(file);
    }
}

static const char *advice(int cause)
{
    switch (cause) {
    case ENOSPC:
    case EDQUOT:
        return "free some space or write elsewhere";
    case EACCES:
    case EPERM:
    case EROFS:
        return "change the permissions or write elsewhere";
    case ENAMETOOLONG:
        return "choose a shorter name";
    default:
        return "write elsewhere";
    }
}

glint_status glint_output_file_write(const char *path, const void *bytes, size_t size,
                                     glint_error *error)
{
    place where = {0};
    temporary made = {.folder = -1, .file = -1};
    int cause = 0;
    // Find the folder, and clean it.
    glint_status status = place_find(path, &where, error);
    if (status != GLINT_OK) {
        goto cleanup;
    }
    remove_stale(&where);
    // Write a temporary file.
    cause = open_temporary(&where, &made);
    if (cause == 0) {
        cause = write_and_sync(made.file, bytes, size);
    }
    if (made.file >= 0 && close(made.file) != 0 && cause == 0 && errno != EINTR) {
        cause = errno;
    }
    // Give it its name.
    if (cause == 0 && renameat(made.folder, made.name, made.folder, where.name) != 0) {
        cause = errno;
    }
    if (cause != 0) {
        status = glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be written: %s (%s)", path,
                            strerror(cause), advice(cause));
        goto cleanup;
    }
    sync_folder(made.folder);

cleanup:
    if (made.made) {
        if (status != GLINT_OK) {
            unlinkat(made.folder, made.name, 0);
        }
        slot_release(made.registered);
    }
    if (made.folder >= 0) {
        close(made.folder);
    }
    place_free(&where);
    return status;
}
