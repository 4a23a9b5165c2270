// Reading image files. See image/image_io.h.
//
// Only formats whose decoders were found to stand corrupt files come here (image/formats.c); JPEG
// is decoded in a child process, and PNG too, whose library prints its complaints. Orientation
// (EXIF, TIFF, Radiance) is applied.
#include "codec/decode.hpp"

#include "image/color.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <string>

namespace
{

using glint::Decoded;
using glint::Facts;
using glint::Transfer;

// A JPEG that is cut short decodes without a complaint, grey where it ends: whether its end is
// there must be looked for. Segments tell their length; after the start of scan (DA) the end (FF
// D9) comes, which cannot be among the coded pixels.
bool jpeg_is_whole(const std::vector<unsigned char> &bytes)
{
    std::size_t at = 2;
    while (at + 4 <= bytes.size() && bytes[at] == 0xff) {
        unsigned marker = bytes[at + 1];
        at += 2u + bytes[at + 2] * 256u + bytes[at + 3];
        if (marker == 0xda) {
            const unsigned char end[] = {0xff, 0xd9};
            return at < bytes.size() && std::search(bytes.begin() + std::ptrdiff_t(at), bytes.end(),
                                                    end, end + 2) != bytes.end();
        }
    }
    // Not the usual structure: the decoder may judge.
    return at + 4 <= bytes.size();
}

glint_status check_jpeg(const char *path, std::uint64_t size, glint_error *error)
{
    std::vector<unsigned char> bytes(size);
    std::FILE *file = std::fopen(path, "rbe");
    std::size_t length = file != nullptr ? std::fread(bytes.data(), 1, bytes.size(), file) : 0;
    if (file != nullptr) {
        std::fclose(file);
    }
    bytes.resize(length);
    if (!jpeg_is_whole(bytes)) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: its end is missing (make the file anew)",
                          path);
    }
    return GLINT_OK;
}

// ---- From values as stored to linear, premultiplied, upright ------------------------------------

float linear_of(const Facts &facts, float code)
{
    switch (facts.transfer) {
    case Transfer::Srgb:
        return glint_srgb_to_linear(code);
    case Transfer::Power:
        return std::pow(code, facts.gamma);
    case Transfer::Linear:
        break;
    }
    return code;
}

// One pixel as read. Alpha is never curved. A colour that was multiplied by alpha before the curve
// is divided first: the curve belongs to the colour.
void convert_pixel(const Facts &facts, const float *linear, const float *codes, float *pixel)
{
    int colors = facts.channels <= 2 ? 1 : 3;
    float alpha = colors < facts.channels ? codes[colors] : 1.0f;
    bool was_multiplied = colors < facts.channels && facts.is_unassociated == 0;
    for (int c = 0; c < colors; c++) {
        if (was_multiplied && facts.transfer != Transfer::Linear) {
            pixel[c] = alpha > 0.0f ? alpha * linear_of(facts, codes[c] / alpha) : linear[c];
        } else {
            pixel[c] = was_multiplied ? linear[c] : linear[c] * alpha;
        }
    }
    if (colors < facts.channels) {
        pixel[colors] = alpha;
    }
}

template <typename Code>
void convert_codes(const Decoded &decoded, unsigned most, float *pixels)
{
    const Facts &facts = decoded.facts;
    std::vector<float> linear(most + 1), plain(most + 1);
    for (unsigned code = 0; code <= most; code++) {
        plain[code] = float(double(code) / most);
        linear[code] = linear_of(facts, plain[code]);
    }
    std::size_t channels = std::size_t(facts.channels);
    std::size_t count = std::size_t(facts.width) * std::size_t(facts.height);
    for (std::size_t p = 0; p < count; p++) {
        Code codes[4];
        std::memcpy(codes, decoded.codes.data() + p * channels * sizeof(Code),
                    channels * sizeof(Code));
        float curved[4], straight[4];
        for (std::size_t c = 0; c < channels; c++) {
            curved[c] = linear[codes[c]];
            straight[c] = plain[codes[c]];
        }
        convert_pixel(facts, curved, straight, pixels + p * channels);
    }
}

void convert_values(const Decoded &decoded, float *pixels)
{
    const Facts &facts = decoded.facts;
    std::size_t channels = std::size_t(facts.channels);
    std::size_t count = std::size_t(facts.width) * std::size_t(facts.height);
    if (facts.is_unassociated == 0) {
        std::memcpy(pixels, decoded.values.data(), count * channels * sizeof(float));
        return;
    }
    for (std::size_t p = 0; p < count; p++) {
        const float *value = decoded.values.data() + p * channels;
        convert_pixel(facts, value, value, pixels + p * channels);
    }
}

// Where pixel (x, y) of an upright image of `width` × `height` lies in the stored one, by EXIF's
// numbers: 2 mirrored, 3 half a turn, 4 upside down, 5 to 8 with rows and columns exchanged.
void stored_place(int orientation, int width, int height, int place[2])
{
    int x = place[0], y = place[1];
    bool flips_x = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    bool flips_y = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    bool exchanges = orientation >= 5;
    if (exchanges) {
        // Upright (x, y) comes from stored (y, x), 6 and 8 being quarter turns.
        place[0] = flips_y ? height - 1 - y : y;
        place[1] = flips_x ? width - 1 - x : x;
    } else {
        place[0] = flips_x ? width - 1 - x : x;
        place[1] = flips_y ? height - 1 - y : y;
    }
}

glint_status set_upright(int orientation, glint_image *image, glint_error *error)
{
    if (orientation < 2 || orientation > 8) {
        return GLINT_OK;
    }
    bool exchanges = orientation >= 5;
    glint_image upright;
    glint_status status = glint_image_create(exchanges ? image->height : image->width,
                                             exchanges ? image->width : image->height,
                                             image->channels, &upright, error);
    if (status != GLINT_OK) {
        return status;
    }
    for (int y = 0; y < upright.height; y++) {
        for (int x = 0; x < upright.width; x++) {
            int place[2] = {x, y};
            stored_place(orientation, upright.width, upright.height, place);
            std::memcpy(glint_image_pixel(&upright, x, y),
                        glint_image_pixel(image, place[0], place[1]),
                        std::size_t(image->channels) * sizeof(float));
        }
    }
    glint_image_free(image);
    *image = upright;
    return GLINT_OK;
}

glint_status finish(const Decoded &decoded, glint_image *image, glint_error *error)
{
    const Facts &facts = decoded.facts;
    glint_status status =
        glint_image_create(facts.width, facts.height, facts.channels, image, error);
    if (status != GLINT_OK) {
        return status;
    }
    if (facts.code_bits == 8) {
        convert_codes<std::uint8_t>(decoded, 255, image->pixels);
    } else if (facts.code_bits == 16) {
        convert_codes<std::uint16_t>(decoded, 65535, image->pixels);
    } else {
        convert_values(decoded, image->pixels);
    }
    return set_upright(facts.orientation, image, error);
}

glint_status read_file(const glint::Source &source, glint_image *image, glint_image_facts *facts,
                       glint_error *error)
{
    const bool is_jpeg = std::strcmp(source.plugin, "jpeg") == 0;
    if (is_jpeg) {
        TRY(check_jpeg(source.path, source.size, error));
    }
    Decoded decoded;
    if (is_jpeg || std::strcmp(source.plugin, "png") == 0) {
        TRY(glint::decode_in_child(source, decoded, error));
    } else {
        std::shared_lock<std::shared_mutex> inside(glint::gate());
        TRY(glint::decode(source, decoded, error));
    }
    if (facts != nullptr) {
        facts->envmap = glint_envmap(decoded.facts.envmap);
        facts->was_encoded = decoded.facts.transfer != Transfer::Linear;
        facts->is_direct3d_cube = decoded.facts.is_direct3d_cube != 0;
    }
    return finish(decoded, image, error);
}

} // namespace

glint_status glint::read_image(const Source *source, glint_image *image, glint_image_facts *facts,
                               glint_error *error)
{
    const char *path = source->path;
    try {
        return read_file(*source, image, facts, error);
    } catch (const std::bad_alloc &) {
        return glint_fail_memory(error, "an image");
    } catch (const std::exception &fault) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (make the file anew)", path,
                          fault.what());
    } catch (...) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be read (make the file anew)", path);
    }
}
