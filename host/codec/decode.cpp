// Decodes the file of a request. See decode.h.
#include "codec/decode.h"

#include "codec/decode.hpp"

#include <OpenImageIO/imageio.h>

#include <cstring>
#include <exception>
#include <new>

namespace glint
{

namespace
{

glint_status decode(const glint_codec_request &request, Memory &memory, glint_codec_answer &answer,
                    glint_error *error)
{
    try {
        return request.work == GLINT_DECODE_CHANNELS
                   ? decode_channels(request, memory, answer, error)
                   : decode_picture(request, memory, answer, error);
    } catch (const std::bad_alloc &) {
        return glint_fail_memory(error, "an image");
    } catch (const std::exception &fault) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (make the file anew)", request.path,
                          fault.what());
    } catch (...) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: cannot be decoded (make the file anew)",
                          request.path);
    }
}

} // namespace

} // namespace glint

void glint_codec_prepare(void)
{
    // Creating a reader loads the list of plugins.
    (void)OIIO::ImageInput::create("openexr");
}

void glint_codec_set_threads(int threads)
{
    OIIO::attribute("threads", threads);
    // Here too 0 is one thread for each core. −1 is the caller's thread alone.
    OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);
}

void glint_decode(const glint_codec_request *request, int memory, glint_codec_answer *answer)
{
    glint_codec_set_threads(request->threads);
    glint::Memory values(memory);
    glint_error error = {};
    answer->kind = GLINT_CODEC_DONE;
    answer->status = glint::decode(*request, values, *answer, &error);
    std::memcpy(answer->message, error.message, sizeof answer->message);
}
