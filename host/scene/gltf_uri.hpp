// URIs as glTF uses them: data URIs, and relative references to files.
#ifndef GLINT_SCENE_GLTF_URI_HPP
#define GLINT_SCENE_GLTF_URI_HPP

#include "scene/gltf_file.hpp"

namespace glint
{

bool is_data_uri(const std::string &uri);

// The bytes of a data URI (RFC 2397) of any media type, base64 or percent-encoded.
Bytes decode_data_uri(const std::string &uri, const Place &place);

// The path of the file that a relative reference names, percent-decoded, links resolved. Refuses
// schemes such as http, what does not exist, and what lies outside the folder.
std::string resolve_uri(const std::string &folder, const std::string &uri, const Place &place);

} // namespace glint

#endif
