// Decodes a picture, with values as stored. See decode.hpp. OpenImageIO decodes all formats but
// Radiance's.
//
// Of a mipmapped file it reads level 0. It puts an EXR's pixels into the display window; pixels
// outside the data window are zero. An EXR with the envmap attribute is only its data window. It
// converts an EXR's colours to those of Rec. 709. ICC profiles are not applied.
#include "codec/decode.hpp"
#include "codec/hdr.h"
#include "codec/parts.hpp"
#include "codec/primaries.h"

#include "image/image_io.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <strings.h>
#include <vector>

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace glint
{

namespace
{

// The first line of OpenImageIO's message, without the file's name: our own message has it.
std::string cause_of(ImageInput &input, const glint_codec_request &request)
{
    const std::string path = opened_path(request);
    std::string text = input.geterror();
    text.resize(std::min(text.size(), text.find('\n')));
    for (const std::string &lead : {"\"" + path + "\"", path}) {
        std::size_t at = text.find(lead);
        if (at != std::string::npos) {
            text.replace(at, lead.size(), "the file");
        }
    }
    return text.empty() ? "it is damaged or cut short" : text;
}

// ---- Size ---------------------------------------------------------------------------------------

// The most bytes of pixels for a byte of the file. Deflation reaches 1,032. EXR's block transforms
// and TIFF's newer methods reach more on flat pictures. DDS compresses by 8.
std::uint64_t expansion_max(const char *plugin)
{
    if (std::strcmp(plugin, "openexr") == 0) {
        return 1u << 20;
    }
    if (std::strcmp(plugin, "tiff") == 0) {
        return 1u << 15;
    }
    return std::strcmp(plugin, "dds") == 0 ? 64 : 4096;
}

// Checks the size before anything of this size is allocated.
glint_status check_size(const glint_codec_request &request, const Part &part, glint_error *error)
{
    const char *path = request.path;
    const ImageSpec &spec = part.spec;
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %d × %d × %d pixels are no picture", path,
                          spec.width, spec.height, spec.depth);
    }
    std::uint64_t pixels = std::uint64_t(spec.width) * std::uint64_t(spec.height);
    if (pixels / expansion_max(request.plugin) * spec.pixel_bytes(true) > request.file_bytes) {
        return glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: says %d × %d pixels, which its %llu bytes cannot hold (it is damaged "
            "or cut short)",
            path, spec.width, spec.height, (unsigned long long)request.file_bytes);
    }
    return check_cost(request, spec.width, spec.height, part.picked.channels(), error);
}

// ---- Facts --------------------------------------------------------------------------------------

void find_transfer(const char *plugin, const ImageSpec &spec, glint_stored_facts &facts)
{
    facts.transfer = GLINT_TRANSFER_LINEAR;
    if (facts.code_bits == 0) {
        return;
    }
    facts.transfer = GLINT_TRANSFER_SRGB;
    if (strcasecmp(spec.get_string_attribute("oiio:ColorSpace").c_str(), "linear") == 0) {
        facts.transfer = GLINT_TRANSFER_LINEAR;
    }
    if (std::strcmp(plugin, "png") != 0) {
        return;
    }
    // PNG's gAMA chunk: its specification tells writers of sRGB to store 1/2.2.
    float gamma = spec.get_float_attribute("oiio:Gamma", 0.0f);
    if (std::fabs(gamma - 1.0f) < 0.01f) {
        facts.transfer = GLINT_TRANSFER_LINEAR;
    } else if (gamma > 0.1f && gamma < 10.0f && std::fabs(gamma - 2.2f) > 0.02f) {
        facts.transfer = GLINT_TRANSFER_POWER;
        facts.gamma = gamma;
    }
}

void find_facts(const char *plugin, const Part &part, glint_stored_facts &facts)
{
    const ImageSpec &spec = part.spec;
    facts.width = spec.width;
    facts.height = spec.height;
    facts.channels = part.picked.channels();
    facts.code_bits = spec.format == TypeDesc::UINT8 ? 8 : spec.format == TypeDesc::UINT16 ? 16 : 0;
    find_transfer(plugin, spec, facts);
    // A DDS does not say. Programs that write DDS do not multiply alpha into the colour.
    facts.is_unassociated =
        spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0 || std::strcmp(plugin, "dds") == 0;
    bool is_exr = std::strcmp(plugin, "openexr") == 0;
    // OpenEXR has no orientation. Other programs' attribute of this name means nothing.
    facts.orientation = is_exr ? 1 : spec.get_int_attribute("Orientation", 1);
    std::string texture = spec.get_string_attribute("textureformat");
    facts.envmap = GLINT_ENVMAP_NONE;
    if (texture == "CubeFace Environment" && is_exr) {
        facts.envmap = GLINT_ENVMAP_CUBE;
    } else if (texture == "LatLong Environment" && is_exr) {
        facts.envmap = GLINT_ENVMAP_LATLONG;
    }
    facts.is_direct3d_cube = texture == "CubeFace Environment" && std::strcmp(plugin, "dds") == 0;
}

// Finds the matrix for an EXR's colours, if they are not those of Rec. 709.
glint_status find_conversion(const glint_codec_request &request, const Part &part,
                             glint_color_matrix &matrix, bool &is_converted, glint_error *error)
{
    const OIIO::ParamValue *stored =
        std::strcmp(request.plugin, "openexr") == 0 && part.picked.colors == 3
            ? part.spec.find_attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8))
            : nullptr;
    if (stored == nullptr) {
        return GLINT_OK;
    }
    glint_primaries primaries;
    for (int i = 0; i < 8; i++) {
        primaries.xy[i / 2][i % 2] = double(stored->get_float_indexed(i));
    }
    is_converted = !glint_primaries_are_rec709(&primaries);
    if (is_converted && !glint_primaries_to_rec709(&primaries, &matrix)) {
        return glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: its chromaticities are no colours (correct the attribute, or take it "
            "out)",
            request.path);
    }
    return GLINT_OK;
}

// ---- Pixels -------------------------------------------------------------------------------------

// Takes the picked channels out of pixels with `from_channels` channels. `first` is the number of
// their first channel in the file.
template <typename T>
void pick_values(const T *from, int first, int from_channels, const Part &part, T *to)
{
    std::size_t pixels = std::size_t(part.spec.width) * std::size_t(part.spec.height);
    int channels = part.picked.channels();
    for (std::size_t p = 0; p < pixels; p++) {
        for (int c = 0; c < channels; c++) {
            to[c] = from[part.picked.place(c) - first];
        }
        from += from_channels;
        to += channels;
    }
}

template <typename T>
bool read_pixels(ImageInput &input, const Part &part, TypeDesc type, T *to)
{
    int first = part.picked.place(0), last = first, channels = part.picked.channels();
    bool in_order = true;
    for (int c = 0; c < channels; c++) {
        int place = part.picked.place(c);
        in_order = in_order && place == part.picked.place(0) + c;
        first = std::min(first, place);
        last = std::max(last, place);
    }
    if (in_order) {
        return input.read_image(part.index, 0, first, last + 1, type, to);
    }
    std::size_t span = std::size_t(last + 1 - first);
    std::vector<T> all(std::size_t(part.spec.width) * std::size_t(part.spec.height) * span);
    if (!input.read_image(part.index, 0, first, last + 1, type, all.data())) {
        return false;
    }
    pick_values(all.data(), first, int(span), part, to);
    return true;
}

// Reads the pixels as they are in the file, without a frame.
bool read_values(ImageInput &input, const Part &part, const glint_stored_facts &facts, void *to)
{
    if (facts.code_bits == 8) {
        return read_pixels(input, part, TypeDesc::UINT8, static_cast<std::uint8_t *>(to));
    }
    if (facts.code_bits == 16 || facts.is_half != 0) {
        const TypeDesc type = facts.is_half != 0 ? TypeDesc::HALF : TypeDesc::UINT16;
        return read_pixels(input, part, type, static_cast<std::uint16_t *>(to));
    }
    return read_pixels(input, part, TypeDesc::FLOAT, static_cast<float *>(to));
}

std::size_t bytes_of(const glint_stored_facts &facts)
{
    return std::size_t(facts.width) * std::size_t(facts.height) * std::size_t(facts.channels) *
           glint_stored_value_bytes(&facts);
}

bool is_framed(const glint_codec_request &request, const Part &part,
               const glint_stored_facts &facts)
{
    const ImageSpec &spec = part.spec;
    return std::strcmp(request.plugin, "openexr") == 0 && facts.envmap == GLINT_ENVMAP_NONE &&
           facts.code_bits == 0 &&
           (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
            spec.height != spec.full_height);
}

// Puts an EXR's data window into its display window, which is zero elsewhere.
void frame_pixels(const ImageSpec &spec, const glint_stored_facts &window, const float *values,
                  float *framed)
{
    const std::int64_t left = std::int64_t(spec.x) - spec.full_x;
    const std::int64_t top = std::int64_t(spec.y) - spec.full_y;
    const std::int64_t width = spec.full_width, height = spec.full_height;
    const std::int64_t first = std::max<std::int64_t>(0, -left);
    const std::int64_t last = std::min<std::int64_t>(window.width, width - left);
    const std::size_t channels = std::size_t(window.channels);
    for (std::int64_t y = std::max<std::int64_t>(0, -top);
         y < window.height && y + top < height && first < last; y++) {
        const float *from = values + std::size_t(y * window.width + first) * channels;
        float *to = framed + std::size_t((y + top) * width + first + left) * channels;
        std::copy(from, from + std::size_t(last - first) * channels, to);
    }
}

// Reads and frames the pixels. False if that fails.
bool read_framed(ImageInput &input, const Part &part, Memory &memory, glint_stored_facts &facts)
{
    const ImageSpec &spec = part.spec;
    std::vector<float> values(bytes_of(facts) / sizeof(float));
    const bool is_read = read_values(input, part, facts, values.data());
    const glint_stored_facts window = facts;
    facts.width = spec.full_width;
    facts.height = spec.full_height;
    frame_pixels(spec, window, values.data(),
                 reinterpret_cast<float *>(memory.grow(bytes_of(facts))));
    return is_read;
}

glint_status decode_part(const glint_codec_request &request, ImageInput &input, Memory &memory,
                         glint_codec_answer &answer, glint_error *error)
{
    glint_stored_facts &facts = answer.facts;
    glint_color_matrix matrix;
    bool is_converted = false;
    Part part;
    TRY(find_part(request, input, part, error));
    TRY(check_size(request, part, error));
    find_facts(request.plugin, part, facts);
    TRY(find_conversion(request, part, matrix, is_converted, error));
    // Halfs stay halfs: they take half the memory, and glint converts them in parallel.
    const ImageSpec &spec = part.spec;
    const bool framed = is_framed(request, part, facts);
    facts.is_half =
        spec.format == TypeDesc::HALF && spec.channelformats.empty() && !is_converted && !framed;
    if (framed) {
        TRY(check_cost(request, spec.full_width, spec.full_height, facts.channels, error));
    }
    if (!(framed ? read_framed(input, part, memory, facts)
                 : read_values(input, part, facts, memory.grow(bytes_of(facts))))) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (make the file anew)", request.path,
                          cause_of(input, request).c_str());
    }
    answer.value_bytes = bytes_of(facts);
    if (is_converted) {
        glint_color_matrix_apply(&matrix, reinterpret_cast<float *>(memory.data()),
                                 std::size_t(facts.width) * std::size_t(facts.height),
                                 std::size_t(facts.channels));
    }
    return GLINT_OK;
}

// ---- JPEG ---------------------------------------------------------------------------------------

// What the segments of a JPEG say. Segments state their length.
struct JpegFacts {
    bool is_whole = true;  // unless its end is missing
    bool has_inks = false; // four components
    bool has_adobe = false;
};

// True if the pixels have an end. After the start of scan (DA) comes the end (FF D9), which cannot
// occur in the coded pixels. A truncated JPEG decodes without an error, grey where it ends.
bool has_end(const std::vector<unsigned char> &bytes, std::size_t pixels)
{
    const unsigned char end[] = {0xff, 0xd9};
    return pixels < bytes.size() && std::search(bytes.begin() + std::ptrdiff_t(pixels), bytes.end(),
                                                end, end + 2) != bytes.end();
}

// A start of frame has one of the markers C0 to CF that are not C4, C8 or CC.
bool is_frame(unsigned marker)
{
    return marker == 0xc0 || (marker > 0xc0 && marker <= 0xcf && marker % 4 != 0);
}

JpegFacts find_jpeg_facts(const std::vector<unsigned char> &bytes)
{
    JpegFacts facts;
    std::size_t at = 2;
    while (at + 4 <= bytes.size() && bytes[at] == 0xff) {
        const unsigned marker = bytes[at + 1];
        if (marker == 0xff) { // a fill byte
            at++;
            continue;
        }
        const std::size_t next = at + 2u + bytes[at + 2] * 256u + bytes[at + 3];
        if (marker == 0xda) {
            facts.is_whole = has_end(bytes, next);
            return facts;
        }
        if (is_frame(marker) && at + 9 < bytes.size()) {
            facts.has_inks = bytes[at + 9] == 4;
        }
        if (marker == 0xee && at + 9 <= bytes.size()) {
            facts.has_adobe = facts.has_adobe || std::memcmp(&bytes[at + 4], "Adobe", 5) == 0;
        }
        at = next;
    }
    // This is not the usual structure: leave the decision to the decoder.
    facts.is_whole = at + 4 <= bytes.size();
    return facts;
}

glint_status check_jpeg(const glint_codec_request &request, glint_error *error)
{
    const JpegFacts facts = find_jpeg_facts(read_file(request));
    if (!facts.is_whole) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: its end is missing (make the file anew)",
                          request.path);
    }
    // OpenImageIO takes all inks for inverted, as programs of Adobe store them.
    if (facts.has_inks && !facts.has_adobe) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: holds CMYK without Adobe's marker, so it is not clear what its inks "
                          "are (save it as RGB)",
                          request.path);
    }
    return GLINT_OK;
}

// ---- Radiance -----------------------------------------------------------------------------------

glint_status decode_hdr(const glint_codec_request &request, Memory &memory,
                        glint_codec_answer &answer, glint_error *error)
{
    const std::vector<unsigned char> bytes = read_file(request);
    const glint_hdr_file file = {request.path, bytes.data(), bytes.size()};
    glint_hdr header;
    TRY(glint_hdr_read_header(&file, &header, error));
    TRY(check_cost(request, header.length, header.scanlines, 3, error));
    answer.facts.width = header.length;
    answer.facts.height = header.scanlines;
    answer.facts.channels = 3;
    answer.facts.orientation = header.orientation;
    answer.value_bytes = bytes_of(answer.facts);
    return glint_hdr_read_pixels(&file, &header,
                                 reinterpret_cast<float *>(memory.grow(answer.value_bytes)), error);
}

} // namespace

glint_status decode_picture(const glint_codec_request &request, Memory &memory,
                            glint_codec_answer &answer, glint_error *error)
{
    const char *path = request.path;
    if (std::strcmp(request.plugin, "hdr") == 0) {
        return decode_hdr(request, memory, answer, error);
    }
    if (std::strcmp(request.plugin, "jpeg") == 0) {
        TRY(check_jpeg(request, error));
    }
    std::unique_ptr<ImageInput> input = ImageInput::create(request.plugin);
    if (input == nullptr) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: OpenImageIO was built without this format (convert it to .exr)",
                          path);
    }
    ImageSpec spec, wishes;
    // Ask for colour and alpha as stored: premultiplying comes after linearising.
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(opened_path(request), spec, wishes)) {
        const std::string cause = cause_of(*input, request);
        const bool is_subsampled = cause.find("ubsampled") != std::string::npos;
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s", path,
                          is_subsampled
                              ? "has channels of lower resolution, as luminance and chroma "
                                "(Y, RY, BY) have: they are not read (save it as R, G, B)"
                              : (cause + " (make the file anew)").c_str());
    }
    const glint_status status = decode_part(request, *input, memory, answer, error);
    input->close();
    return status;
}

} // namespace glint
