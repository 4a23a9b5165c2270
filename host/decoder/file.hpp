// Reads the scene's file safely: its GLB chunks, its JSON and its buffers.
#ifndef GLINT_DECODER_FILE_HPP
#define GLINT_DECODER_FILE_HPP

#include "decoder/ask.hpp"
#include "decoder/limits.hpp"
#include "decoder/uri.hpp"
#include "decoder/writer.hpp"

#include <string>

namespace glint
{

// A scene's file, as it is read.
struct SceneFile {
    SceneFile(Asker &glint, Limits &limited) : asker(glint), limits(limited) {}

    Asker &asker;
    Limits &limits;
    json root = json::object();
    bool has_bin = false; // the file is a GLB with a BIN chunk
    Stored bin;
};

// Reads the file, which it closes, into `input.root` and `input.bin`. It must be a regular
// file of at most 4 GiB; its JSON at most 1 GiB, nested at most 100 deep. `path` is its name.
void read_document(const char *path, int scene, Writer &writer, SceneFile &input);

// Returns the bytes of a buffer, cut to its byteLength, which must be checked. Removes a data URI's
// text from the JSON, so that memory does not hold it twice.
Stored read_buffer(SceneFile &input, std::size_t index, Writer &writer);

} // namespace glint

#endif
