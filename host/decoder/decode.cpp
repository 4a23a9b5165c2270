// Decodes the file of a request. See decode.h.
#include "decoder/decode.h"

#include "decoder/decode.hpp"

#include <OpenImageIO/imageio.h>

#include <cstring>
#include <exception>
#include <new>

namespace glint
{

namespace
{

glint_status decode(const glint_decode_request &request, Memory &memory,
                    glint_decode_answer &answer, glint_error *error)
{
    try {
        if (request.is_mesh != 0) {
            return decode_mesh(request, memory.file(), answer, error);
        }
        return request.all_channels != 0 ? decode_channels(request, memory, answer, error)
                                         : decode_picture(request, memory, answer, error);
    } catch (const std::bad_alloc &) {
        return glint_fail_memory(error, request.is_mesh != 0 ? "a mesh" : "an image");
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

void glint_decode_prepare(void)
{
    // Creating a reader loads the list of plugins.
    (void)OIIO::ImageInput::create("openexr");
}

void glint_decode(const glint_decode_request *request, int memory, glint_decode_answer *answer)
{
    OIIO::attribute("threads", request->threads);
    // Here too 0 is one thread for each core. −1 is the caller's thread alone.
    OIIO::attribute("exr_threads", request->threads == 1 ? -1 : request->threads);
    glint::Memory values(memory);
    glint_error error = {};
    answer->kind = GLINT_DECODED;
    answer->status = glint::decode(*request, values, *answer, &error);
    std::memcpy(answer->message, error.message, sizeof answer->message);
}
