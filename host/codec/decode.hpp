// Declares what the parts that decode share.
#ifndef GLINT_CODEC_DECODE_HPP
#define GLINT_CODEC_DECODE_HPP

#include "codec/decode.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace glint
{

// The path to open: the file, or the image in memory.
inline std::string opened_path(const glint_codec_request &request)
{
    return request.file < 0 ? request.path : "/proc/self/fd/" + std::to_string(request.file);
}

// The bytes of the file of a request; fewer if it is cut short.
std::vector<unsigned char> read_file(const glint_codec_request &request);

// The memory file that receives the values. Owns its mapping.
class Memory
{
  public:
    explicit Memory(int file) : file_(file) {}
    Memory(const Memory &) = delete;
    Memory &operator=(const Memory &) = delete;
    ~Memory();

    // Makes the file this large and zero. Throws std::bad_alloc.
    std::uint8_t *grow(std::size_t bytes);
    // What grow returned last.
    std::uint8_t *data() const
    {
        return static_cast<std::uint8_t *>(at_);
    }

  private:
    int file_;
    void *at_ = nullptr;
    std::size_t bytes_ = 0;
};

// Decode a picture, or all channels. They throw OpenImageIO's exceptions and std::bad_alloc.
glint_status decode_picture(const glint_codec_request &request, Memory &memory,
                            glint_codec_answer &answer, glint_error *error);
glint_status decode_channels(const glint_codec_request &request, Memory &memory,
                             glint_codec_answer &answer, glint_error *error);

// Refuses a picture that takes more than the request allows.
glint_status check_cost(const glint_codec_request &request, std::int64_t width, std::int64_t height,
                        std::int64_t channels, glint_error *error);

} // namespace glint

#endif
