// Decoding in a child process, for formats whose decoder may abort on a corrupt file.
//
// The parent may have other threads. fork copies only the calling one, so the child must not wait
// for a lock that another held: the gate keeps everybody out of OpenImageIO during the fork, libc
// does the same for its allocator, and whole-number pixels are read in the calling thread, without
// OpenImageIO's pool, whose threads the child has not. Should the child wait all the same (the
// allocator of GCC's AddressSanitizer is not unlocked), an alarm ends it, and another one is made,
// which may take longer.
#include "codec/decode.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <new>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace glint
{

namespace
{

const unsigned seconds_max[] = {15, 120}; // of each child

// What the child sends first; the pixels follow where `status` is GLINT_OK.
struct Answer {
    std::int32_t status;
    char message[GLINT_MESSAGE_CAPACITY];
    Facts facts;
    std::uint64_t bytes; // of `codes`
};

bool send_all(int pipe, const void *from, std::size_t size)
{
    const char *bytes = static_cast<const char *>(from);
    while (size > 0) {
        ssize_t done = write(pipe, bytes, size);
        if (done < 0 && errno != EINTR) {
            return false;
        }
        if (done > 0) {
            bytes += done;
            size -= std::size_t(done);
        }
    }
    return true;
}

bool receive_all(int pipe, void *to, std::size_t size)
{
    char *bytes = static_cast<char *>(to);
    while (size > 0) {
        ssize_t done = read(pipe, bytes, size);
        if (done == 0 || (done < 0 && errno != EINTR)) {
            return false;
        }
        if (done > 0) {
            bytes += done;
            size -= std::size_t(done);
        }
    }
    return true;
}

// The child dies of what would kill it, silently, and of a signal that stops its parent.
void settle_child(unsigned seconds)
{
    for (int number : {SIGINT, SIGTERM, SIGALRM, SIGABRT, SIGSEGV, SIGPIPE}) {
        signal(number, SIG_DFL);
    }
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    alarm(seconds);
    struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    int nowhere = open("/dev/null", O_RDWR);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
}

[[noreturn]] void run_child(int pipe, const Source &source)
{
    static Answer answer;
    glint_error error = {};
    Decoded decoded;
    try {
        answer.status = decode(source, decoded, &error);
    } catch (...) {
        answer.status =
            glint_fail(&error, GLINT_BAD_INPUT, "%s: cannot be decoded (convert it)", source.path);
    }
    std::memcpy(answer.message, error.message, sizeof answer.message);
    answer.facts = decoded.facts;
    answer.bytes = decoded.codes.size();
    bool sent = send_all(pipe, &answer, sizeof answer) &&
                (answer.status != GLINT_OK || send_all(pipe, decoded.codes.data(), answer.bytes));
    // Without the exit handlers and destructors: they belong to the parent.
    _exit(sent ? 0 : 1);
}

// The child may have gone wrong in any way: what it says is checked before it is believed.
bool is_credible(const Answer &answer)
{
    const Facts &facts = answer.facts;
    if (facts.width < 1 || facts.height < 1 || facts.channels < 1 || facts.channels > 4 ||
        (facts.code_bits != 8 && facts.code_bits != 16)) {
        return false;
    }
    std::uint64_t pixels = std::uint64_t(facts.width) * std::uint64_t(facts.height);
    return pixels <= values_max / 4 && answer.bytes == pixels * std::uint64_t(facts.channels) *
                                                           std::uint64_t(facts.code_bits / 8);
}

glint_status receive(int pipe, const char *path, Decoded &decoded, glint_error *error)
{
    static const char *const crashed =
        "%s: the decoder failed on it: it is damaged (make the file anew)";
    Answer answer = {};
    if (!receive_all(pipe, &answer, sizeof answer)) {
        return glint_fail(error, GLINT_BAD_INPUT, crashed, path);
    }
    if (answer.status != GLINT_OK) {
        answer.message[sizeof answer.message - 1] = '\0';
        return glint_fail(error, GLINT_BAD_INPUT, "%s", answer.message);
    }
    if (!is_credible(answer)) {
        return glint_fail(error, GLINT_BAD_INPUT, crashed, path);
    }
    decoded.facts = answer.facts;
    decoded.codes.resize(answer.bytes);
    if (!receive_all(pipe, decoded.codes.data(), answer.bytes)) {
        return glint_fail(error, GLINT_BAD_INPUT, crashed, path);
    }
    return GLINT_OK;
}

// One child. *is_late: an alarm ended it.
glint_status decode_within(unsigned seconds, const Source &source, Decoded &decoded, bool *is_late,
                           glint_error *error)
{
    const char *path = source.path;
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: no pipe to a decoder: %s (try again)", path,
                          std::strerror(errno));
    }
    pid_t child;
    {
        std::unique_lock<std::shared_mutex> alone(gate());
        child = fork();
    }
    if (child == 0) {
        settle_child(seconds);
        run_child(ends[1], source);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return glint_fail(error, GLINT_BAD_INPUT, "%s: no process to decode it: %s (try again)",
                          path, std::strerror(errno));
    }
    glint_status status = GLINT_OK;
    try {
        status = receive(ends[0], path, decoded, error);
    } catch (const std::bad_alloc &) {
        status = glint_fail_memory(error, "an image");
    }
    // A child that still writes ends of the closed pipe.
    close(ends[0]);
    int how = 0;
    while (waitpid(child, &how, 0) < 0 && errno == EINTR) {
    }
    *is_late = status != GLINT_OK && WIFSIGNALED(how) && WTERMSIG(how) == SIGALRM;
    return status;
}

} // namespace

glint_status decode_in_child(const Source &source, Decoded &decoded, glint_error *error)
{
    glint_status status = GLINT_OK;
    bool is_late = true;
    for (unsigned seconds : seconds_max) {
        if (is_late) {
            is_late = false;
            if (error != nullptr) {
                glint_error_free(error);
            }
            status = decode_within(seconds, source, decoded, &is_late, error);
        }
    }
    if (is_late) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: the decoder was not done in two minutes (convert it to EXR or TIFF)",
                          source.path);
    }
    return status;
}

} // namespace glint
