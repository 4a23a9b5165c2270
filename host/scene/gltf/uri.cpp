// Decodes the URIs of glTF. See uri.hpp.
#include "scene/gltf/uri.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace glint
{

namespace
{

int hexadecimal(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// Decodes percent signs. A '%' without two hexadecimal digits stays.
std::string percent_decoded(const std::string &text)
{
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); i++) {
        int high = text[i] == '%' && i + 2 < text.size() ? hexadecimal(text[i + 1]) : -1;
        int low = high >= 0 ? hexadecimal(text[i + 2]) : -1;
        if (low >= 0) {
            result += static_cast<char>(high * 16 + low);
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

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

// Returns the scheme with its colon, or nothing: RFC 3986.
std::string scheme_of(const std::string &uri)
{
    std::size_t i = 0;
    while (i < uri.size() && (std::isalnum(static_cast<unsigned char>(uri[i])) != 0 ||
                              std::strchr("+.-", uri[i]) != nullptr)) {
        i++;
    }
    bool is_scheme = i > 0 && i < uri.size() && uri[i] == ':' &&
                     std::isalpha(static_cast<unsigned char>(uri[0])) != 0;
    return is_scheme ? uri.substr(0, i + 1) : std::string();
}

std::string real_path(const std::string &path)
{
    if (path.size() >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return "";
    }
    std::unique_ptr<char, decltype(&std::free)> resolved(realpath(path.c_str(), nullptr),
                                                         &std::free);
    return resolved == nullptr ? std::string() : std::string(resolved.get());
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
    std::string data = percent_decoded(uri.substr(comma + 1));
    return base64 ? base64_decoded(data, 0, place) : Bytes(data.begin(), data.end());
}

FoundFile find_uri(const std::string &folder, const std::string &uri)
{
    std::string scheme = scheme_of(uri);
    if (!scheme.empty()) {
        return {"", scheme + " is not read (put the file beside the scene, or use a data URI)"};
    }
    std::string name = percent_decoded(uri);
    if (name.empty() || name.find('\0') != std::string::npos) {
        return {"", "names no file"};
    }
    // Also try a name as it is, if it only looks percent-encoded ("50%20.bin" on disk); and as
    // Windows writes paths.
    std::string slashed = name;
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    std::string found;
    int trouble = 0; // of the first name
    for (const std::string &candidate : {name, uri, slashed}) {
        found = real_path(candidate[0] == '/' ? candidate : folder + "/" + candidate);
        if (!found.empty()) {
            break;
        }
        trouble = trouble == 0 ? errno : trouble;
    }
    if (found.empty()) {
        return {"", std::string("cannot be opened: ") + std::strerror(trouble) +
                        " (put the file beside the scene)"};
    }
    std::string prefix = folder == "/" ? folder : folder + "/";
    if (found != folder && found.compare(0, prefix.size(), prefix) != 0) {
        return {"", "lies outside the scene's folder (put the file beside the scene, or below)"};
    }
    return {found, ""};
}

} // namespace glint
