// Encodes image files through OpenImageIO. See encode.h and image/encoding.h. PNG is encoded by
// glint itself (image/png.c).
//
// It encodes a file in memory, and glint writes it (image/output_file.c). So this process needs no
// right to write files.
#include "codec/encode.h"
#include "base/whole_io.h"
#include "codec/mapping.hpp"
#include "image/encoding.h"
#include "image/formats.h"
#include "image/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <unistd.h>

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

// ---- Header and metadata ------------------------------------------------------------------------

// The texts of a job, in their order.
class Texts
{
  public:
    explicit Texts(const unsigned char *at) : at_(reinterpret_cast<const char *>(at)) {}
    const char *next()
    {
        const char *text = at_;
        at_ += std::strlen(text) + 1;
        return text;
    }

  private:
    const char *at_;
};

void add_attribute(ImageSpec &spec, const glint_encode_attribute &entry, const char *name,
                   const char *string)
{
    switch (entry.type) {
    case GLINT_METADATA_STRING:
        spec.attribute(name, string);
        break;
    case GLINT_METADATA_INT:
        spec.attribute(name, entry.integer);
        break;
    case GLINT_METADATA_FLOAT:
        spec.attribute(name, entry.real);
        break;
    case GLINT_METADATA_MATRIX:
        spec.attribute(name, OIIO::TypeMatrix, entry.matrix);
        break;
    default:
        break;
    }
}

void name_channels(ImageSpec &spec, const glint_encode_job &job)
{
    spec.channelnames =
        job.color == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
    spec.alpha_channel = -1;
    if (job.channels > job.color) {
        spec.channelnames.emplace_back("A");
        spec.alpha_channel = job.color;
    }
}

// Appends the further channels to the picture's.
void add_channels(ImageSpec &spec, const glint_encode_job &job, Texts &texts)
{
    if (job.channel_count == 0) {
        return;
    }
    spec.channelformats.assign(std::size_t(spec.nchannels), spec.format);
    for (std::uint32_t i = 0; i < job.channel_count; i++) {
        spec.channelnames.emplace_back(texts.next());
        spec.channelformats.emplace_back(TypeDesc::FLOAT);
    }
    spec.nchannels += int(job.channel_count);
}

void describe_exr(ImageSpec &spec, const glint_encode_job &job, const glint::Mapping &memory,
                  Texts &texts)
{
    spec.attribute("compression", job.compression[0] != '\0' ? job.compression : "zip");
    if (job.envmap != GLINT_ENVMAP_NONE) {
        spec.attribute("textureformat", job.envmap == GLINT_ENVMAP_CUBE ? "CubeFace Environment"
                                                                        : "LatLong Environment");
    }
    add_channels(spec, job, texts);
    for (std::uint32_t i = 0; i < job.attribute_count; i++) {
        glint_encode_attribute entry;
        std::memcpy(&entry, memory.at(job.attribute_offset + i * sizeof entry), sizeof entry);
        const char *name = texts.next();
        add_attribute(spec, entry, name, texts.next());
    }
}

// A named attribute that OpenImageIO knows from EXIF would add a directory to a TIFF. For it
// OpenImageIO must read back its output, which it cannot do from memory. So all metadata is text.
void describe_codes(ImageSpec &spec, const glint_encode_job &job, const char *description)
{
    const bool is_given = job.compression[0] != '\0';
    // The colours are already unpremultiplied.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (job.format == GLINT_WRITTEN_JPEG) {
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("CompressionQuality", is_given ? std::atoi(job.compression) : 95);
        spec.attribute("jpeg:subsampling", "4:4:4");
    } else {
        spec.attribute("compression", is_given ? job.compression : "zip");
    }
    if (description[0] != '\0') {
        spec.attribute("ImageDescription", description);
    }
}

TypeDesc type_of(std::int32_t value_type)
{
    return value_type == GLINT_VALUE_CODE   ? TypeDesc::UINT8
           : value_type == GLINT_VALUE_HALF ? TypeDesc::HALF
                                            : TypeDesc::FLOAT;
}

ImageSpec describe(const glint_encode_job &job, const glint::Mapping &memory)
{
    ImageSpec spec(job.width, job.height, job.channels, type_of(job.value_type));
    Texts texts(memory.at(job.text_offset));
    name_channels(spec, job);
    if (job.format == GLINT_WRITTEN_EXR) {
        describe_exr(spec, job, memory, texts);
    } else if (job.format != GLINT_WRITTEN_HDR) {
        describe_codes(spec, job, texts.next());
    }
    return spec;
}

// ---- Encoding -----------------------------------------------------------------------------------

// The first line of OpenImageIO's message.
std::string cause_of(const ImageOutput &output)
{
    std::string text = output.geterror();
    text.resize(std::min(text.size(), text.find('\n')));
    return text.empty() ? "the encoder failed without saying why" : text;
}

using File = OIIO::Filesystem::IOVecOutput;

// The file is complete when this function has returned: OpenImageIO finishes some files when it
// destroys their ImageOutput.
glint_status encode(const glint_codec_request &request, const glint_encode_job &job,
                    const glint::Mapping &memory, File &file, glint_error *error)
{
    const char *path = request.path;
    const ImageSpec spec = describe(job, memory);
    std::unique_ptr<ImageOutput> output = ImageOutput::create(request.plugin);
    if (output == nullptr) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "%s: OpenImageIO was built without this format (choose another)", path);
    }
    // An unknown type means that each channel has its own type.
    const TypeDesc type = spec.channelformats.empty() ? spec.format : TypeDesc(TypeDesc::UNKNOWN);
    if (!output->set_ioproxy(&file) || !output->open(path, spec) ||
        !output->write_image(type, memory.at(job.pixel_offset)) || !output->close()) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be encoded: %s (try .exr)",
                          path, cause_of(*output).c_str());
    }
    return GLINT_OK;
}

glint_status encode_in(int memory_file, const glint_codec_request &request,
                       glint_codec_answer &answer, glint_error *error)
{
    const glint::Mapping memory(memory_file);
    glint_encode_job job;
    std::memcpy(&job, memory.at(0), sizeof job);
    File file;
    TRY(encode(request, job, memory, file, error));
    answer.value_bytes = file.buffer().size();
    return glint_write_all_at(memory_file, job.file_offset, file.buffer().data(),
                              file.buffer().size())
               ? GLINT_OK
               : glint_fail(error, GLINT_OUTPUT_FAILED, "%s: not enough memory to encode it",
                            request.path);
}

glint_status try_to_encode(const glint_codec_request &request, int file, glint_codec_answer &answer,
                           glint_error *error)
{
    try {
        return encode_in(file, request, answer, error);
    } catch (const std::bad_alloc &) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: not enough memory to encode it",
                          request.path);
    } catch (const std::exception &fault) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be encoded: %s (try .exr)",
                          request.path, fault.what());
    } catch (...) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be encoded (try .exr)",
                          request.path);
    }
}

} // namespace

void glint_encode(const glint_codec_request *request, int memory, glint_codec_answer *answer)
{
    glint_error error = {};
    answer->kind = GLINT_CODEC_DONE;
    answer->status = try_to_encode(*request, memory, *answer, &error);
    std::memcpy(answer->message, error.message, sizeof answer->message);
}
