// Decodes the URIs of glTF: data URIs, and relative references to files.
#ifndef GLINT_SCENE_GLTF_URI_HPP
#define GLINT_SCENE_GLTF_URI_HPP

#include "scene/gltf_json.hpp"

namespace glint
{

using Bytes = std::vector<unsigned char>;

bool is_data_uri(const std::string &uri);

// Returns the bytes of a data URI (RFC 2397) of any media type, base64 or percent-encoded.
Bytes decode_data_uri(const std::string &uri, const Place &place);

// Returns the path of the file that a relative reference names, percent-decoded, with links
// resolved. Empty, with errno set, if there is no such file. Refuses schemes such as http, and
// files outside the folder.
std::string find_uri(const std::string &folder, const std::string &uri, const Place &place);

} // namespace glint

#endif
