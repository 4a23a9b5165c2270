// What the parts of the codec share.
#ifndef GLINT_CODEC_DECODE_HPP
#define GLINT_CODEC_DECODE_HPP

#include "image/codec.h"

#include <cstddef>
#include <cstdint>
#include <shared_mutex>
#include <vector>

namespace glint
{

// The most values (pixels times channels) an image may have: 4 GiB of float.
constexpr std::size_t values_max = std::size_t(1) << 30;

enum class Transfer : std::int32_t { Linear, Srgb, Power };

// A file's facts, plain enough to go through a pipe.
struct Facts {
    std::int32_t width, height, channels; // channels: 1 to 4, as in glint_image
    std::int32_t code_bits;               // 8 or 16: whole numbers; 0: float values
    Transfer transfer;
    float gamma;                  // of Transfer::Power: linear = code^gamma
    std::int32_t is_unassociated; // alpha is stored beside the colour, not multiplied in
    std::int32_t orientation;     // 1 to 8 as in TIFF and EXIF
    std::int32_t envmap;          // a glint_envmap
    std::int32_t is_direct3d_cube;
};

// Values as stored: `codes` (8 bits, or 16 in the machine's order) or `values`.
struct Decoded {
    Facts facts = {};
    std::vector<std::uint8_t> codes;
    std::vector<float> values;
};

using Source = glint_image_source;

// Decodes a file. Throws nothing but std::bad_alloc. The caller holds the
// gate.
glint_status decode(const Source &source, Decoded &decoded, glint_error *error);

// decode() in a child process, which may crash.
glint_status decode_in_child(const Source &source, Decoded &decoded, glint_error *error);

// Shared by all who are inside OpenImageIO, exclusive around fork: a child must not inherit a lock
// of the library's that another thread holds, for in the child nobody would release it.
std::shared_mutex &gate();

// glint_codec's (image/codec.h).
glint_status read_image(const Source *source, glint_image *image, glint_image_facts *facts,
                        glint_error *error);
glint_status read_channels(const char *path, glint_channels *channels, glint_error *error);
glint_status encode_image(const char *path, const glint_image *image,
                          const glint_write_options *options, glint_encoded *encoded,
                          glint_error *error);
void use_threads(int count);

} // namespace glint

#endif
