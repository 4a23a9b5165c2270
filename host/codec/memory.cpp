// Reads files, maps the memory file and limits the size of a picture. See decode.hpp.
#include "codec/decode.hpp"

#include <cstdio>
#include <new>
#include <sys/mman.h>
#include <unistd.h>

namespace glint
{

std::vector<unsigned char> read_file(const glint_codec_request &request)
{
    std::vector<unsigned char> bytes(request.file_bytes);
    std::FILE *file = std::fopen(opened_path(request).c_str(), "rbe");
    std::size_t length = file != nullptr ? std::fread(bytes.data(), 1, bytes.size(), file) : 0;
    if (file != nullptr) {
        std::fclose(file);
    }
    bytes.resize(length);
    return bytes;
}

Memory::~Memory()
{
    if (at_ != nullptr) {
        munmap(at_, bytes_);
    }
}

std::uint8_t *Memory::grow(std::size_t bytes)
{
    if (at_ != nullptr) {
        munmap(at_, bytes_);
        at_ = nullptr;
    }
    void *at = ftruncate(file_, off_t(bytes)) == 0 ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                                                          MAP_SHARED | MAP_POPULATE, file_, 0)
                                                   : MAP_FAILED;
    if (at == MAP_FAILED) {
        throw std::bad_alloc();
    }
    at_ = at;
    bytes_ = bytes;
    return static_cast<std::uint8_t *>(at);
}

// The most values (pixels times channels) of a picture: 4 GiB of floats.
static constexpr std::uint64_t values_max = std::uint64_t(1) << 30;

glint_status check_cost(const glint_codec_request &request, std::int64_t width, std::int64_t height,
                        std::int64_t channels, glint_error *error)
{
    const std::uint64_t mib = 1u << 20;
    if (width < 1 || height < 1 || width > INT32_MAX || height > INT32_MAX) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %lld × %lld pixels are no picture",
                          request.path, (long long)width, (long long)height);
    }
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    if (pixels > values_max / std::uint64_t(channels)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %lld × %lld pixels are more than can be read (make it smaller)",
                          request.path, (long long)width, (long long)height);
    }
    const std::uint64_t bytes = pixels * std::uint64_t(channels) * sizeof(float);
    const std::uint64_t most = request.limits.picture_bytes;
    if (most > 0 && bytes > most) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %lld × %lld pixels take %llu MiB, and a file of its size may take "
                          "%llu (it is damaged; or give --allow-large-images)",
                          request.path, (long long)width, (long long)height,
                          (unsigned long long)(bytes / mib), (unsigned long long)(most / mib));
    }
    return GLINT_OK;
}

} // namespace glint
