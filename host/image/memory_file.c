// Makes memory files. See memory_file.h.
#include "image/memory_file.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#define IDLE_MOST 16

// The files that were given back. `lock` guards the other members.
static struct {
    pthread_mutex_t lock;
    pid_t owner; // the process that uses them; a fork of it must make its own
    glint_memory_file files[IDLE_MOST];
    size_t count;
} idle = {.lock = PTHREAD_MUTEX_INITIALIZER};

// Takes all memory at once, so that writing to the mapping cannot fail.
static bool make(size_t bytes, glint_memory_file *made)
{
    *made = (glint_memory_file){.file = memfd_create("glint", MFD_CLOEXEC | MFD_ALLOW_SEALING),
                                .bytes = bytes,
                                .at = MAP_FAILED};
    if (made->file < 0) {
        return false;
    }
    if (fallocate(made->file, 0, 0, (off_t)bytes) == 0 &&
        fcntl(made->file, F_ADD_SEALS, F_SEAL_SHRINK) == 0) {
        made->at =
            mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, made->file, 0);
    }
    if (made->at == MAP_FAILED) {
        const int cause = errno;
        close(made->file);
        errno = cause;
        return false;
    }
    return true;
}

void glint_memory_file_free(const glint_memory_file *taken)
{
    munmap(taken->at, taken->bytes);
    close(taken->file);
}

bool glint_memory_file_take(size_t bytes, glint_memory_file *taken)
{
    bool is_found = false;
    pthread_mutex_lock(&idle.lock);
    if (idle.owner == getpid() && idle.count > 0) {
        *taken = idle.files[--idle.count];
        is_found = true;
    }
    pthread_mutex_unlock(&idle.lock);
    if (is_found && taken->bytes >= bytes) {
        return true;
    }
    if (is_found) {
        glint_memory_file_free(taken);
    }
    return make(bytes, taken);
}

void glint_memory_file_give_back(const glint_memory_file *taken)
{
    bool is_kept = false;
    pthread_mutex_lock(&idle.lock);
    if (idle.owner != getpid()) {
        idle.owner = getpid();
        idle.count = 0;
    }
    if (idle.count < IDLE_MOST) {
        idle.files[idle.count++] = *taken;
        is_kept = true;
    }
    pthread_mutex_unlock(&idle.lock);
    if (!is_kept) {
        glint_memory_file_free(taken);
    }
}
