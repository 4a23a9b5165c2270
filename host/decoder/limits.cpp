// Limits memory and time. See limits.hpp.
#include "decoder/limits.hpp"

#include "scene/document.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace glint
{

namespace
{

constexpr std::uint64_t mib = std::uint64_t{1} << 20;
// The model of a file of many small objects takes a hundred times its bytes. Packed views take at
// most 64 times theirs.
constexpr std::uint64_t memory_least = 1024 * mib;
constexpr std::uint64_t memory_each = 128;
constexpr std::uint64_t cpu_seconds_least = 60;
constexpr std::uint64_t bytes_a_second = 4 * mib;

// AddressSanitizer reserves terabytes of address space.
#ifdef __SANITIZE_ADDRESS__
constexpr bool limits_memory = false;
#else
constexpr bool limits_memory = true;
#endif

// Sets a soft limit. The hard limit stays, and limits it.
void limit(__rlimit_resource resource, std::uint64_t value)
{
    struct rlimit both = {};
    if (getrlimit(resource, &both) == 0) {
        both.rlim_cur = std::min<rlim_t>(value, both.rlim_max);
        (void)setrlimit(resource, &both);
    }
}

// Sets the hard limit, too.
void limit_for_good(__rlimit_resource resource, std::uint64_t value)
{
    struct rlimit both = {};
    if (getrlimit(resource, &both) == 0) {
        both.rlim_max = std::min<rlim_t>(value, both.rlim_max);
        both.rlim_cur = std::min(both.rlim_cur, both.rlim_max);
        (void)setrlimit(resource, &both);
    }
}

std::uint64_t used_seconds()
{
    struct rusage usage = {};
    (void)getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec);
}

} // namespace

Limits::Limits(std::uint64_t free_bytes)
    : facts_(open("/proc/self/statm", O_RDONLY | O_CLOEXEC)), free_(free_bytes)
{
    struct rlimit now = {};
    hard_ = getrlimit(RLIMIT_AS, &now) == 0 ? now.rlim_cur : RLIM_INFINITY;
    // What a process that a file has taken over cannot lift.
    const std::uint64_t used = used_bytes();
    if (free_ < RLIM_INFINITY - used) {
        limit_for_good(RLIMIT_FSIZE, free_);
        if (limits_memory && used > 0) {
            limit_for_good(RLIMIT_AS, used + free_);
        }
    }
}

Limits::~Limits()
{
    if (facts_ >= 0) {
        close(facts_);
    }
}

// Returns the process's address space; 0: unknown.
std::uint64_t Limits::used_bytes() const
{
    std::array<char, 64> text{};
    const ssize_t length = pread(facts_, text.data(), text.size() - 1, 0);
    const std::uint64_t pages = length > 0 ? std::strtoull(text.data(), nullptr, 10) : 0;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void Limits::watch(glint_document_doing *doing)
{
    doing_ = doing;
    note("", seconds_);
}

void Limits::note(const std::string &name, std::uint64_t seconds)
{
    if (doing_ != nullptr) {
        glint_document_doing now = {};
        name.copy(now.name, sizeof now.name - 1);
        now.seconds = static_cast<std::uint32_t>(std::min<std::uint64_t>(seconds, UINT32_MAX));
        *doing_ = now;
    }
}

void Limits::apply() const
{
    if (limits_memory) {
        limit(RLIMIT_AS, std::min(memory_, hard_));
    }
    limit(RLIMIT_CPU, seconds_);
}

void Limits::add_file(std::uint64_t bytes)
{
    files_ += bytes;
    memory_ = memory_least + memory_each * std::min(files_, std::uint64_t{1} << 50);
    seconds_ = cpu_seconds_least + files_ / bytes_a_second;
    note("", seconds_);
    apply();
}

void Limits::begin_part(const std::string &name, std::uint64_t memory_bytes,
                        std::uint64_t cpu_seconds)
{
    const std::uint64_t used = used_bytes();
    note(name, cpu_seconds);
    if (limits_memory && used > 0) {
        limit(RLIMIT_AS, std::min(used + memory_bytes, hard_));
    }
    limit(RLIMIT_CPU, used_seconds() + cpu_seconds);
}

void Limits::end_part(std::uint64_t more_seconds)
{
    seconds_ += more_seconds;
    note("", seconds_);
    apply();
}

} // namespace glint
