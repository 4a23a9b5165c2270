// All channels of an EXR. See image/image_io.h.
#include "codec/decode.hpp"

#include "base/memory.h"

#include <OpenImageIO/imageio.h>

#include <cstring>
#include <memory>
#include <mutex>

namespace
{

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

glint_status refuse(const char *path, const char *why, glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT, "%s: %s", path, why);
}

glint_status take(const char *path, ImageInput &input, const ImageSpec &spec,
                  glint_channels *channels, glint_error *error)
{
    const std::size_t pixels = std::size_t(spec.width) * std::size_t(spec.height);
    const std::size_t count = std::size_t(spec.nchannels);
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.nchannels > 4096 ||
        spec.depth > 1 || spec.deep || pixels > glint::values_max / count) {
        return refuse(path, "its size or its channels cannot be used (render it anew)", error);
    }
    channels->width = spec.width;
    channels->height = spec.height;
    channels->values = static_cast<float *>(glint_allocate_unset(pixels, count * sizeof(float)));
    channels->names = static_cast<char **>(glint_allocate(count, sizeof(char *)));
    if (channels->values == nullptr || channels->names == nullptr) {
        return glint_fail_memory(error, "a file's channels");
    }
    channels->count = spec.nchannels;
    for (std::size_t i = 0; i < count; i++) {
        channels->names[i] = strdup(spec.channelnames[i].c_str());
        if (channels->names[i] == nullptr) {
            return glint_fail_memory(error, "a file's channels");
        }
    }
    if (!input.read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, channels->values)) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (make the file anew)", path,
                          input.geterror().c_str());
    }
    return GLINT_OK;
}

glint_status read_all(const char *path, glint_channels *channels, glint_error *error)
{
    std::shared_lock<std::shared_mutex> inside(glint::gate());
    std::unique_ptr<ImageInput> input = ImageInput::create("openexr");
    ImageSpec spec;
    if (input == nullptr) {
        return refuse(path, "OpenImageIO was built without OpenEXR", error);
    }
    if (!input->open(path, spec)) {
        input->geterror();
        return refuse(path, "is no EXR that can be read (check the name, or render it anew)",
                      error);
    }
    glint_status status = take(path, *input, spec, channels, error);
    input->close();
    return status;
}

} // namespace

glint_status glint::read_channels(const char *path, glint_channels *channels, glint_error *error)
{
    try {
        return read_all(path, channels, error);
    } catch (const std::bad_alloc &) {
        return glint_fail_memory(error, "a file's channels");
    } catch (const std::exception &fault) {
        return refuse(path, fault.what(), error);
    } catch (...) {
        return refuse(path, "cannot be read (render it anew)", error);
    }
}
