// Decodes the URIs of glTF: data URIs, and relative references to files.
#ifndef GLINT_SCENE_GLTF_URI_HPP
#define GLINT_SCENE_GLTF_URI_HPP

#include "scene/gltf/json.hpp"

namespace glint
{

using Bytes = std::vector<unsigned char>;

bool is_data_uri(const std::string &uri);

// Returns the bytes of a data URI (RFC 2397) of any media type, base64 or percent-encoded.
Bytes decode_data_uri(const std::string &uri, const Place &place);

// The file that a URI names: its path, with links resolved; or the reason why there is none.
struct FoundFile {
    std::string path, fault;
};

// Finds the file that a relative reference names, percent-decoded. Finds none for schemes such as
// http, and none outside the folder. Tries backslashes as slashes, too.
FoundFile find_uri(const std::string &folder, const std::string &uri);

} // namespace glint

#endif
