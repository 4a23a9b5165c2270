// Reads a glTF file into a document: read, check, unpack, write. Turns every exception into a
// status. See scene/gltf/reader.h.
//
// Limits: files of 4 GiB, buffers of 8 GiB.
#include "scene/gltf/reader.h"

#include "decoder/buffers.hpp"
#include "decoder/check.hpp"
#include "decoder/compose.hpp"
#include "decoder/draco.hpp"
#include "decoder/meshopt.hpp"

#include <cerrno>
#include <cstring>
#include <new>
#include <sys/mman.h>
#include <unistd.h>

namespace glint
{

namespace
{

void read(const char *path, int file)
{
    Writer writer(file);
    Document document;
    Model model;
    read_document(path, writer, document);
    check_document(document, model);
    read_buffers(document, writer, model);
    unpack_views(writer, model);
    decode_draco(writer, model);
    settle_attributes(model);
    compose(document, model, writer);
}

// Calls `work` and turns its exceptions into a status.
template <typename Work>
glint_status guard(glint_error *error, Work work)
{
    try {
        work();
        return GLINT_OK;
    } catch (const refusal &refused) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s", refused.what());
    } catch (const shortage &lack) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY, "%s", lack.what());
    } catch (const std::bad_alloc &) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY, "not enough memory for the scene");
    } catch (const std::exception &unexpected) {
        return glint_fail(error, GLINT_BAD_INPUT, "cannot be loaded: %s", unexpected.what());
    } catch (...) {
        return glint_fail(error, GLINT_BAD_INPUT, "cannot be loaded");
    }
}

} // namespace

} // namespace glint

glint_status glint_reader_run(const char *path, int *file, glint_error *error)
{
    *file = memfd_create("glint document", MFD_CLOEXEC);
    if (*file < 0) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY, "no memory file to read into: %s (try again)",
                          std::strerror(errno));
    }
    const glint_status status = glint::guard(error, [&] { glint::read(path, *file); });
    if (status != GLINT_OK) {
        close(*file);
        *file = -1;
    }
    return status;
}
