// Encodes image files through OpenImageIO. See image/image_io.h.
//
// It encodes a file in memory. image/output_file.c writes it and checks every write, because
// several of OpenImageIO's writers do not report a full disk.
//
// Values that a format cannot hold:
//   EXR half   beyond ±65504, also infinite: ±65504. NaN stays NaN: it marks a fault, and a file
//              that is fit for comparison must not hide it.
//   EXR float  unchanged.
//   HDR        NaN and negative values become 0; infinity becomes 1.6e38, the limit of RGBE.
//   8 bits     NaN and negative values become 0; above 1 becomes 1, unless a tone curve maps it.
// Grey stays grey if the format has it (EXR, PNG, TIFF, JPEG). TIFF is written with 8 bits, sRGB.
#include "image/codec.h"
#include "image/color.h"
#include "image/formats.h"

#include <Imath/half.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

using Format = glint_written_kind;

// ---- Pixels as the file holds them --------------------------------------------------------------

const float half_max = 65504.0f;

// Leaves NaN: it fails both comparisons.
float clamp_to_half(float value)
{
    return value > half_max ? half_max : (value < -half_max ? -half_max : value);
}

#if defined(__x86_64__)
// Every processor with AVX2 has these conversions. (Not every compiler knows "f16c" in
// __builtin_cpu_supports.)
__attribute__((target("avx,f16c"))) std::size_t halves_by_eight(const float *from, half *to,
                                                                std::size_t count)
{
    const __m256 high = _mm256_set1_ps(half_max), low = _mm256_set1_ps(-half_max);
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        // min and max return their second operand if one is NaN, so NaN stays.
        __m256 value = _mm256_max_ps(low, _mm256_min_ps(high, _mm256_loadu_ps(from + i)));
        _mm_storeu_si128(reinterpret_cast<__m128i *>(to + i),
                         _mm256_cvtps_ph(value, _MM_FROUND_TO_NEAREST_INT));
    }
    return i;
}
#endif

void to_halves(const float *from, half *to, std::size_t count)
{
    std::size_t i = 0;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
        i = halves_by_eight(from, to, count);
    }
#endif
    for (; i < count; i++) {
        to[i] = half(clamp_to_half(from[i]));
    }
}

float clamp_to_rgbe(float value)
{
    const float most = 1.6e38f;
    return value > 0.0f ? std::min(value, most) : 0.0f;
}

// The channels of the file: grey may be repeated, alpha may be left out.
struct Channels {
    int color, total; // in the file
};

Channels channels_of(Format format, int in_image)
{
    bool has_alpha = in_image == 2 || in_image == 4;
    int color = in_image <= 2 ? 1 : 3;
    if (format == GLINT_WRITTEN_HDR) {
        return {3, 3};
    }
    if (format == GLINT_WRITTEN_JPEG || !has_alpha) {
        return {color, color};
    }
    return {color, color + 1};
}

void fill_rgbe(const glint_image &image, std::vector<unsigned char> &bytes)
{
    std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    bytes.resize(pixels * 3 * sizeof(float));
    float *to = reinterpret_cast<float *>(bytes.data());
    for (std::size_t p = 0; p < pixels; p++) {
        const float *from = image.pixels + p * std::size_t(image.channels);
        for (int c = 0; c < 3; c++) {
            *to++ = clamp_to_rgbe(from[image.channels >= 3 ? c : 0]);
        }
    }
}

// Applies exposure, unpremultiplies if alpha is kept, then applies the tone curve and sRGB. Tone
// curves are not linear: they must see the colour without its alpha.
void fill_codes(const glint_image &image, Channels wanted, const glint_write_options &options,
                std::vector<unsigned char> &bytes)
{
    std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    bytes.resize(pixels * std::size_t(wanted.total));
    unsigned char *to = bytes.data();
    float gain = std::exp2(options.exposure);
    for (std::size_t p = 0; p < pixels; p++) {
        const float *from = image.pixels + p * std::size_t(image.channels);
        float scale = gain;
        float alpha = 1.0f;
        if (wanted.total > wanted.color) {
            alpha = from[image.channels - 1];
            // An emitting pixel with alpha 0 keeps its colour.
            scale = alpha > 0.0f ? gain / alpha : gain;
        }
        float color[3];
        for (int c = 0; c < 3; c++) {
            color[c] = from[wanted.color == 3 ? c : 0] * scale;
        }
        glint_tone_map(options.tone, color);
        for (int c = 0; c < wanted.color; c++) {
            *to++ = glint_linear_to_srgb8(color[c]);
        }
        if (wanted.total > wanted.color) {
            float clamped = alpha > 0.0f ? std::min(alpha, 1.0f) : 0.0f;
            *to++ = static_cast<unsigned char>(std::lround(clamped * 255.0f));
        }
    }
}

// ---- Header and metadata ------------------------------------------------------------------------

void add_attribute(ImageSpec &spec, const glint_metadata &entry)
{
    switch (entry.type) {
    case GLINT_METADATA_STRING:
        spec.attribute(entry.name, entry.string != nullptr ? entry.string : "");
        break;
    case GLINT_METADATA_INT:
        spec.attribute(entry.name, entry.integer);
        break;
    case GLINT_METADATA_FLOAT:
        spec.attribute(entry.name, entry.real);
        break;
    case GLINT_METADATA_MATRIX:
        spec.attribute(entry.name, OIIO::TypeMatrix, entry.matrix);
        break;
    }
}

// Writes "name: value" lines for formats without typed attributes. Leaves matrices out.
std::string as_text(const glint_write_options &options)
{
    std::string text;
    for (std::size_t i = 0; i < options.metadata_count; i++) {
        const glint_metadata &entry = options.metadata[i];
        if (entry.type != GLINT_METADATA_MATRIX) {
            ImageSpec single;
            add_attribute(single, entry);
            // get_string() also handles numbers; get_string_attribute would give "".
            const OIIO::ParamValue *value = single.find_attribute(entry.name);
            text += std::string(entry.name) + ": " +
                    (value != nullptr ? value->get_string() : std::string()) + "\n";
        }
    }
    return text;
}

// EXR holds all metadata as attributes. The other formats get it as text, in their description or
// comment. A named attribute that OpenImageIO knows from EXIF would add a directory to a TIFF. For
// it OpenImageIO must read back its output, which it cannot do from memory.
void add_metadata(ImageSpec &spec, Format format, const glint_write_options &options)
{
    if (format == GLINT_WRITTEN_EXR) {
        for (std::size_t i = 0; i < options.metadata_count; i++) {
            add_attribute(spec, options.metadata[i]);
        }
    } else if (format != GLINT_WRITTEN_HDR && options.metadata_count > 0) {
        spec.attribute("ImageDescription", as_text(options));
    }
}

void name_channels(ImageSpec &spec, Channels wanted)
{
    spec.channelnames =
        wanted.color == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
    spec.alpha_channel = -1;
    if (wanted.total > wanted.color) {
        spec.channelnames.emplace_back("A");
        spec.alpha_channel = wanted.color;
    }
}

void describe_exr(ImageSpec &spec, const glint_write_options &options)
{
    spec.attribute("compression", options.compression != nullptr ? options.compression : "zip");
    if (options.envmap != GLINT_ENVMAP_NONE) {
        spec.attribute("textureformat", options.envmap == GLINT_ENVMAP_CUBE
                                            ? "CubeFace Environment"
                                            : "LatLong Environment");
    }
}

void describe_codes(ImageSpec &spec, Format format, const glint_write_options &options)
{
    if (format != GLINT_WRITTEN_TIFF) {
        spec.attribute("oiio:ColorSpace", "sRGB");
    }
    // The colours are already unpremultiplied.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    const char *given = options.compression;
    if (format == GLINT_WRITTEN_PNG) {
        // Deflation takes most of the time. Level 2 is three times as fast as the default, 6. Its
        // files are some percent larger.
        spec.attribute("png:compressionLevel", given != nullptr ? std::atoi(given) : 2);
    } else if (format == GLINT_WRITTEN_JPEG) {
        spec.attribute("CompressionQuality", given != nullptr ? std::atoi(given) : 95);
        spec.attribute("jpeg:subsampling", "4:4:4");
    } else {
        spec.attribute("compression", given != nullptr ? given : "zip");
    }
}

// ---- Encoding -----------------------------------------------------------------------------------

struct Encoded {
    ImageSpec spec;
    std::vector<unsigned char> bytes; // of the file's type, or of each channel's own type
};

// Appends the additional channels to the picture's, pixel by pixel.
void add_channels(const glint_write_options &options, Encoded &made)
{
    ImageSpec &spec = made.spec;
    const std::size_t picture_bytes = spec.pixel_bytes();
    spec.channelformats.assign(std::size_t(spec.nchannels), spec.format);
    for (std::size_t i = 0; i < options.channel_count; i++) {
        spec.channelnames.emplace_back(options.channels[i].name);
        spec.channelformats.emplace_back(TypeDesc::FLOAT);
    }
    spec.nchannels += int(options.channel_count);
    const std::size_t pixels = std::size_t(spec.width) * std::size_t(spec.height);
    std::vector<unsigned char> all(pixels * spec.pixel_bytes(true));
    unsigned char *to = all.data();
    for (std::size_t p = 0; p < pixels; p++) {
        std::memcpy(to, made.bytes.data() + p * picture_bytes, picture_bytes);
        to += picture_bytes;
        for (std::size_t i = 0; i < options.channel_count; i++) {
            std::memcpy(to, options.channels[i].values + p, sizeof(float));
            to += sizeof(float);
        }
    }
    made.bytes.swap(all);
}

Encoded prepare(const glint_image &image, Format format, const glint_write_options &options)
{
    // Choose channels and type.
    Channels wanted = channels_of(format, image.channels);
    TypeDesc type = TypeDesc::UINT8;
    if (format == GLINT_WRITTEN_HDR || (format == GLINT_WRITTEN_EXR && options.exr_float)) {
        type = TypeDesc::FLOAT;
    } else if (format == GLINT_WRITTEN_EXR) {
        type = TypeDesc::HALF;
    }
    Encoded made{ImageSpec(image.width, image.height, wanted.total, type), {}};
    name_channels(made.spec, wanted);
    std::size_t values =
        std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels);
    // Convert the pixels.
    if (format == GLINT_WRITTEN_EXR) {
        describe_exr(made.spec, options);
        made.bytes.resize(values * type.size());
        if (options.exr_float) {
            std::memcpy(made.bytes.data(), image.pixels, values * sizeof(float));
        } else {
            to_halves(image.pixels, reinterpret_cast<half *>(made.bytes.data()), values);
        }
        if (options.channel_count > 0) {
            add_channels(options, made);
        }
    } else if (format == GLINT_WRITTEN_HDR) {
        fill_rgbe(image, made.bytes);
    } else {
        describe_codes(made.spec, format, options);
        fill_codes(image, wanted, options, made.bytes);
    }
    add_metadata(made.spec, format, options);
    return made;
}

// The first line of OpenImageIO's message.
std::string cause_of(const ImageOutput &output)
{
    std::string text = output.geterror();
    text.resize(std::min(text.size(), text.find('\n')));
    return text.empty() ? "the encoder failed without saying why" : text;
}

using File = OIIO::Filesystem::IOVecOutput;

glint_status encode_prepared(const char *path, const char *plugin, const Encoded &made, File &file,
                             glint_error *error)
{
    std::unique_ptr<ImageOutput> output = ImageOutput::create(plugin);
    if (output == nullptr) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "%s: OpenImageIO was built without this format (choose another)", path);
    }
    // An unknown type means that each channel has its own type.
    const TypeDesc type =
        made.spec.channelformats.empty() ? made.spec.format : TypeDesc(TypeDesc::UNKNOWN);
    if (!output->set_ioproxy(&file) || !output->open(path, made.spec) ||
        !output->write_image(type, made.bytes.data()) || !output->close()) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be encoded: %s (try .exr)",
                          path, cause_of(*output).c_str());
    }
    return GLINT_OK;
}

glint_status copy(const std::vector<unsigned char> &file, glint_encoded *encoded,
                  glint_error *error)
{
    encoded->bytes = static_cast<unsigned char *>(std::malloc(file.size()));
    if (encoded->bytes == nullptr) {
        return glint_fail_memory(error, "an encoded image");
    }
    std::memcpy(encoded->bytes, file.data(), file.size());
    encoded->size = file.size();
    return GLINT_OK;
}

glint_status encode_image(const char *path, const glint_image *image,
                          const glint_write_options *options, glint_encoded *encoded,
                          glint_error *error)
{
    const glint_written_format *format = glint_image_written_format(path);
    try {
        File file;
        const Encoded made = prepare(*image, format->kind, *options);
        TRY(encode_prepared(path, format->plugin, made, file, error));
        return copy(file.buffer(), encoded, error);
    } catch (const std::bad_alloc &) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: not enough memory to encode it", path);
    } catch (const std::exception &fault) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be encoded: %s (try .exr)",
                          path, fault.what());
    } catch (...) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be encoded (try .exr)", path);
    }
}

void use_threads(int count)
{
    OIIO::attribute("threads", count);
    // Here too 0 is one thread for each core. −1 is the caller's thread alone.
    OIIO::attribute("exr_threads", count == 1 ? -1 : count);
}

} // namespace

extern "C" __attribute__((visibility("default")))
const glint_codec glint_codec_functions = {GLINT_VERSION, encode_image, use_threads};
