// Limits the memory and the time of the decoder's process, by the files that it got. SECURITY.md
// has the figures.
#ifndef GLINT_DECODER_LIMITS_HPP
#define GLINT_DECODER_LIMITS_HPP

#include <cstdint>
#include <string>

struct glint_document_doing;

namespace glint
{

class Limits
{
  public:
    // `free_bytes`: of memory. Call it before the process enters its sandbox.
    explicit Limits(std::uint64_t free_bytes);
    Limits(const Limits &) = delete;
    Limits &operator=(const Limits &) = delete;
    ~Limits();

    // Allows more, for a file of this size.
    void add_file(std::uint64_t bytes);

    // The memory that was free at the start.
    std::uint64_t free_bytes() const
    {
        return free_;
    }

    // True if not the machine or the user sets the limit of memory, but the file's size does.
    bool is_by_size() const
    {
        return memory_ < free_;
    }

    std::uint64_t memory_bytes() const
    {
        return memory_;
    }

    // Where the present work is noted, for a message if the process dies.
    void watch(glint_document_doing *doing);

    // Limits the work on one part by these alone, until end_part. Work on a part that Draco packed
    // may run wild.
    void begin_part(const std::string &name, std::uint64_t memory_bytes, std::uint64_t cpu_seconds);
    // `more_seconds`: what the part adds to the time of the whole.
    void end_part(std::uint64_t more_seconds);

  private:
    std::uint64_t used_bytes() const;
    void note(const std::string &name, std::uint64_t seconds);
    void apply() const;

    int facts_; // /proc/self/statm
    std::uint64_t free_, hard_, files_ = 0, memory_ = 0, seconds_ = 0;
    glint_document_doing *doing_ = nullptr;
};

} // namespace glint

#endif
