// Decodes all channels of an EXR. See decode.hpp.
#include "codec/decode.hpp"

#include <OpenImageIO/imageio.h>

#include <cstring>
#include <memory>
#include <string>

namespace
{

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

glint_status refuse(const glint_codec_request &request, const char *why, glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT, "%s: %s", request.path, why);
}

glint_status take(const glint_codec_request &request, ImageInput &input, glint::Memory &memory,
                  glint_codec_answer &answer, glint_error *error)
{
    const ImageSpec &spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 ||
        spec.nchannels > GLINT_PICTURE_CHANNELS_MAX || spec.depth > 1 || spec.deep) {
        return refuse(request, "its size or its channels cannot be used (render it anew)", error);
    }
    TRY(glint::check_cost(request, spec.width, spec.height, spec.nchannels, error));
    std::string names;
    for (const std::string &name : spec.channelnames) {
        names += name.c_str();
        names += '\0';
    }
    answer.facts.width = spec.width;
    answer.facts.height = spec.height;
    answer.facts.channels = spec.nchannels;
    answer.value_bytes = std::uint64_t(spec.width) * std::uint64_t(spec.height) *
                         std::uint64_t(spec.nchannels) * sizeof(float);
    answer.name_bytes = names.size();
    std::uint8_t *values = memory.grow(answer.value_bytes + names.size());
    std::memcpy(values + answer.value_bytes, names.data(), names.size());
    if (!input.read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, values)) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (make the file anew)", request.path,
                          input.geterror().c_str());
    }
    return GLINT_OK;
}

} // namespace

glint_status glint::decode_channels(const glint_codec_request &request, Memory &memory,
                                    glint_codec_answer &answer, glint_error *error)
{
    std::unique_ptr<ImageInput> input = ImageInput::create(request.plugin);
    ImageSpec spec;
    if (input == nullptr) {
        return refuse(request, "OpenImageIO was built without OpenEXR", error);
    }
    if (!input->open(opened_path(request), spec)) {
        (void)input->geterror();
        return refuse(request, "is no EXR that can be read (check the name, or render it anew)",
                      error);
    }
    const glint_status status = take(request, *input, memory, answer, error);
    input->close();
    return status;
}
