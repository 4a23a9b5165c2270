// Getting bytes, safely: the scene's file, its GLB chunks, its JSON and its buffers.
#ifndef GLINT_SCENE_GLTF_FILE_HPP
#define GLINT_SCENE_GLTF_FILE_HPP

#include "scene/gltf_uri.hpp"

#include <string>

namespace glint
{

struct Document {
    std::string path;   // as the user gave it
    std::string folder; // resolved: what the file may refer to lies under it
    json root = json::object();
    bool has_bin = false; // a GLB with a BIN chunk
    Bytes bin;
};

// Reads the file into `document.root` and `document.bin`: a regular file of at most 4 GiB, JSON of
// at most 1 GiB, nested at most 100 deep.
void read_document(const char *path, Document &document);

// The bytes of a buffer whose byteLength was checked, cut to that. Takes a data URI's text out of
// the JSON, so that it is not held twice.
Bytes read_buffer(Document &document, std::size_t index);

// Refuses a URI that names what must never be opened: what is neither a data URI nor a regular file
// under the folder. A file that is missing passes.
void check_uri(const Document &document, const std::string &uri, const Place &place);

} // namespace glint

#endif
