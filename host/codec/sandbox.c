// Restricts a child's system calls and resources. See sandbox.h.
#include "codec/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

#define FILES_MAX 64

// AddressSanitizer reserves terabytes of address space.
#ifdef __SANITIZE_ADDRESS__
#define IS_ADDRESS_SANITIZED 1
#else
#define IS_ADDRESS_SANITIZED 0
#endif

// ---- System calls -------------------------------------------------------------------------------

// System calls that always fail with EPERM. Names that the machine does not have are ignored.
static const char *const refused[] = {
    "execve",
    "execveat",
    "fork",
    "vfork",
    "ptrace",
    "process_vm_readv",
    "process_vm_writev",
    "pidfd_open",
    "pidfd_getfd",
    "pidfd_send_signal",
    "rt_sigqueueinfo",
    "rt_tgsigqueueinfo",
    "tkill",
    "socket",
    "connect",
    "bind",
    "listen",
    "accept",
    "accept4",
    "creat",
    "unlink",
    "unlinkat",
    "rename",
    "renameat",
    "renameat2",
    "link",
    "linkat",
    "symlink",
    "symlinkat",
    "mkdir",
    "mkdirat",
    "rmdir",
    "mknod",
    "mknodat",
    "truncate",
    "chmod",
    "fchmod",
    "fchmodat",
    "chown",
    "fchown",
    "lchown",
    "fchownat",
    "setxattr",
    "lsetxattr",
    "fsetxattr",
    "removexattr",
    "lremovexattr",
    "fremovexattr",
    "utime",
    "utimes",
    "utimensat",
    "futimesat",
    "mount",
    "umount2",
    "move_mount",
    "open_tree",
    "fsopen",
    "chroot",
    "pivot_root",
    "setns",
    "unshare",
    "bpf",
    "perf_event_open",
    "userfaultfd",
    "add_key",
    "keyctl",
    "request_key",
    "io_uring_setup",
    "init_module",
    "finit_module",
    "kexec_load",
    "setuid",
    "setgid",
    "setresuid",
    "setresgid",
    "swapon",
    "reboot",
    "acct",
    "quotactl",
};

// System calls that report ENOSYS. Callers then use older calls, whose arguments the filter can
// judge.
static const char *const absent[] = {"clone3", "openat2"};

static int refuse(scmp_filter_ctx filter, const char *name, uint32_t code)
{
    const int number = seccomp_syscall_resolve_name(name);
    return number == __NR_SCMP_ERROR ? 0
                                     : seccomp_rule_add(filter, SCMP_ACT_ERRNO(code), number, 0);
}

// Refuses to open for writing, to start processes (not threads), and to reach other processes by
// signals or limits.
static int refuse_by_arguments(scmp_filter_ctx filter)
{
    static const int writing[] = {O_WRONLY, O_RDWR, O_CREAT, O_TRUNC};
    const scmp_datum_t own = (scmp_datum_t)getpid();
    const uint32_t no = SCMP_ACT_ERRNO(EPERM);
    int fault = 0;
    for (size_t i = 0; i < sizeof writing / sizeof writing[0]; i++) {
        const scmp_datum_t flag = (scmp_datum_t)writing[i];
        fault |= seccomp_rule_add(filter, no, SCMP_SYS(openat), 1,
                                  SCMP_A2(SCMP_CMP_MASKED_EQ, flag, flag));
        fault |= seccomp_rule_add(filter, no, SCMP_SYS(open), 1,
                                  SCMP_A1(SCMP_CMP_MASKED_EQ, flag, flag));
    }
    fault |= seccomp_rule_add(filter, no, SCMP_SYS(clone), 1,
                              SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0));
    fault |= seccomp_rule_add(filter, no, SCMP_SYS(kill), 1, SCMP_A0(SCMP_CMP_NE, own));
    fault |= seccomp_rule_add(filter, no, SCMP_SYS(tgkill), 1, SCMP_A0(SCMP_CMP_NE, own));
    fault |= seccomp_rule_add(filter, no, SCMP_SYS(prlimit64), 1, SCMP_A0(SCMP_CMP_NE, 0));
    return fault;
}

bool glint_sandbox_enter(bool may_open)
{
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
    if (filter == NULL) {
        return false;
    }
    int fault = refuse_by_arguments(filter);
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        fault |= refuse(filter, refused[i], EPERM);
    }
    for (size_t i = 0; i < sizeof absent / sizeof absent[0]; i++) {
        fault |= refuse(filter, absent[i], ENOSYS);
    }
    static const char *const opening[] = {"open", "openat"};
    for (size_t i = 0; !may_open && i < sizeof opening / sizeof opening[0]; i++) {
        fault |= refuse(filter, opening[i], EPERM);
    }
    fault |= seccomp_load(filter);
    seccomp_release(filter);
    return fault == 0;
}

// ---- Descriptors --------------------------------------------------------------------------------

static bool is_among(int descriptor, const int *kept, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (kept[i] == descriptor) {
            return true;
        }
    }
    return false;
}

void glint_sandbox_close_others(const int *kept, size_t count)
{
    int last = GLINT_CODEC_SOCKET - 1;
    for (size_t i = 0; i < count; i++) {
        last = kept[i] > last ? kept[i] : last;
    }
    for (int descriptor = GLINT_CODEC_SOCKET; descriptor < last; descriptor++) {
        if (!is_among(descriptor, kept, count)) {
            (void)close(descriptor);
        }
    }
    closefrom(last + 1);
}

// ---- Limits -------------------------------------------------------------------------------------

#define THREAD_STACK (UINT64_C(2) << 20)

static void limit(int resource, uint64_t value)
{
    const struct rlimit both = {(rlim_t)value, (rlim_t)value};
    (void)setrlimit(resource, &both);
}

// The process's current address space in bytes; 0: unknown.
static uint64_t bytes_now(void)
{
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    if (file != NULL) {
        if (fscanf(file, "%lu", &pages) != 1) {
            pages = 0;
        }
        fclose(file);
    }
    return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

// Limits the memory of threads: stacks of THREAD_STACK, and one heap for all.
static void make_threads_small(void)
{
    pthread_attr_t small;
    if (pthread_attr_init(&small) == 0) {
        pthread_attr_setstacksize(&small, THREAD_STACK);
        pthread_setattr_default_np(&small);
        pthread_attr_destroy(&small);
    }
    mallopt(M_ARENA_MAX, 1);
}

void glint_sandbox_leave_no_core(void)
{
    limit(RLIMIT_CORE, 0);
}

void glint_sandbox_limit(const glint_decode_limits *limits, int threads)
{
    glint_sandbox_leave_no_core();
    limit(RLIMIT_NOFILE, FILES_MAX);
    if (limits->cpu_seconds > 0) {
        // A process can ignore SIGXCPU. SIGKILL follows one second later.
        const struct rlimit seconds = {limits->cpu_seconds, limits->cpu_seconds + 1};
        (void)setrlimit(RLIMIT_CPU, &seconds);
    }
    if (limits->seconds > 0) {
        alarm(limits->seconds);
    }
    // Writing to the memory file takes no address space, so limit its size.
    if (limits->picture_bytes > 0) {
        limit(RLIMIT_FSIZE, limits->picture_bytes + GLINT_DECODE_NAMES_MAX);
    }
    if (limits->memory_bytes > 0 && !IS_ADDRESS_SANITIZED) {
        const uint64_t count = (uint64_t)(threads > 0 ? threads : sysconf(_SC_NPROCESSORS_ONLN));
        make_threads_small();
        // OpenImageIO and OpenEXR each have their own threads.
        limit(RLIMIT_AS, bytes_now() + limits->memory_bytes + 2 * count * THREAD_STACK);
    }
}
