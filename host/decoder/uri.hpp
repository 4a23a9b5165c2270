// Decodes data URIs.
#ifndef GLINT_DECODER_URI_HPP
#define GLINT_DECODER_URI_HPP

#include "decoder/json.hpp"

namespace glint
{

using Bytes = std::vector<unsigned char>;

bool is_data_uri(const std::string &uri);

// Returns the bytes of a data URI (RFC 2397) of any media type, base64 or percent-encoded.
Bytes decode_data_uri(const std::string &uri, const Place &place);

} // namespace glint

#endif
