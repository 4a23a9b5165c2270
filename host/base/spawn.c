// Starts programs that work beside this process. See spawn.h.
#include "base/spawn.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

bool glint_spawn_find(const char *name, char path[PATH_MAX])
{
    static const char *const places[] = {"/../" GLINT_LIBRARY_FOLDER "/", "/", "/../"};
    char own[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    if (length < 0) {
        return false;
    }
    own[length] = '\0';
    *strrchr(own, '/') = '\0';
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const int written = snprintf(path, PATH_MAX, "%s%s%s", own, places[i], name);
        if (written < PATH_MAX && access(path, X_OK) == 0) {
            return true;
        }
    }
    return false;
}

int glint_spawn(const char *path, char *const arguments[], int socket, pid_t *process)
{
    static const int ours[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t all, blocked;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    if (socket >= 0) {
        posix_spawn_file_actions_adddup2(&files, socket, GLINT_SPAWN_SOCKET);
    }
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; standard++) {
        posix_spawn_file_actions_addopen(&files, standard, "/dev/null", O_RDWR, 0);
    }
    posix_spawn_file_actions_addclosefrom_np(&files, GLINT_SPAWN_SOCKET + (socket >= 0));
    sigfillset(&all);
    sigemptyset(&blocked);
    for (size_t i = 0; i < sizeof ours / sizeof ours[0]; i++) {
        sigaddset(&blocked, ours[i]);
    }
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setsigmask(&attributes, &blocked);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    const int fault = posix_spawn(process, path, &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return fault;
}

int glint_spawn_stop(pid_t process)
{
    int how = 0;
    kill(process, SIGKILL);
    while (waitpid(process, &how, 0) < 0 && errno == EINTR) {
    }
    return how;
}
