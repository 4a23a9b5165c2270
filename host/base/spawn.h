// Starts programs that work beside this process.
#ifndef GLINT_BASE_SPAWN_H
#define GLINT_BASE_SPAWN_H

#include <limits.h>
#include <stdbool.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_SPAWN_SOCKET 3 // the program's descriptor of `socket`

// Finds one of glint's own programs by its name. An installed one is in the folder of libraries
// (CMakeLists.txt). In the build it is beside this program, or above it. False if it is not there.
bool glint_spawn_find(const char *name, char path[PATH_MAX]);

// Starts the program at `path`. `arguments` begin with its name and end with NULL. Its standard
// descriptors are /dev/null; `socket` (−1: none) is its only other one. The signals of a terminal
// or a batch system stay blocked there: this process handles them. Returns 0, or an errno.
int glint_spawn(const char *path, char *const arguments[], int socket, pid_t *process);

// Kills the program and waits for its end. Returns waitpid's status.
int glint_spawn_stop(pid_t process);

#ifdef __cplusplus
}
#endif

#endif
