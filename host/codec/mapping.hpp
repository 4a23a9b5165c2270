// Maps a memory file that holds a job of glint's.
#ifndef GLINT_CODEC_MAPPING_HPP
#define GLINT_CODEC_MAPPING_HPP

#include <cstddef>
#include <cstdint>
#include <new>
#include <sys/mman.h>
#include <sys/stat.h>

namespace glint
{

class Mapping
{
  public:
    // Throws std::bad_alloc.
    explicit Mapping(int file)
    {
        struct stat facts = {};
        if (fstat(file, &facts) == 0) {
            bytes_ = static_cast<std::size_t>(facts.st_size);
            at_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        }
        if (at_ == MAP_FAILED) {
            throw std::bad_alloc();
        }
    }
    Mapping(const Mapping &) = delete;
    Mapping &operator=(const Mapping &) = delete;
    ~Mapping()
    {
        munmap(at_, bytes_);
    }
    unsigned char *at(std::uint64_t offset) const
    {
        return static_cast<unsigned char *>(at_) + offset;
    }

  private:
    void *at_ = MAP_FAILED;
    std::size_t bytes_ = 0;
};

} // namespace glint

#endif
