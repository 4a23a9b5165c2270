// Decodes data URIs. See uri.hpp.
#include "decoder/uri.hpp"

#include "scene/gltf/find_file.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace glint
{

namespace
{

bool begins_with_ignoring_case(const std::string &text, const char *head)
{
    std::size_t length = std::strlen(head);
    return text.size() >= length &&
           std::equal(head, head + length, text.begin(), [](char a, char b) {
               return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
           });
}

int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '+' ? 62 : (c == '/' ? 63 : -1);
}

// Decodes base64 from `begin`. Padding may be missing; nothing may follow it.
Bytes base64_decoded(const std::string &text, std::size_t begin, const Place &place)
{
    std::size_t end = text.size();
    for (int padding = 0; padding < 2 && end > begin && text[end - 1] == '='; padding++) {
        end--;
    }
    Bytes bytes;
    bytes.reserve((end - begin) / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t i = begin; i < end; i++) {
        int digit = base64_digit(text[i]);
        if (digit < 0) {
            refuse(place, "character " + std::to_string(i) + ", " +
                              in_quotes(std::string(1, text[i])) +
                              ", is no base64 digit (export the file again)");
        }
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<unsigned char>(bits >> count & 0xff));
        }
    }
    return bytes;
}

} // namespace

bool is_data_uri(const std::string &uri)
{
    return begins_with_ignoring_case(uri, "data:");
}

Bytes decode_data_uri(const std::string &uri, const Place &place)
{
    std::size_t comma = uri.find(',');
    if (comma == std::string::npos) {
        refuse(place, "a data URI without a comma (data:[type][;base64],DATA)");
    }
    constexpr std::size_t marker_length = 7; // ";base64"
    bool base64 =
        comma >= marker_length &&
        begins_with_ignoring_case(uri.substr(comma - marker_length, marker_length), ";base64");
    if (base64 && uri.find('%', comma) == std::string::npos) {
        return base64_decoded(uri, comma + 1, place);
    }
    std::string data = uri.substr(comma + 1);
    data.resize(glint_percent_decode(data.data(), data.size(), data.data()));
    return base64 ? base64_decoded(data, 0, place) : Bytes(data.begin(), data.end());
}

} // namespace glint
