// Reads and checks JSON. See json.hpp.
#include "decoder/json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace glint
{

Place Place::operator/(const char *key) const
{
    Place result = *this;
    if (result.depth_ < result.steps_.size()) {
        result.steps_[result.depth_++] = {key, 0};
    }
    return result;
}

Place Place::operator[](std::size_t index) const
{
    Place result = *this;
    if (result.depth_ < result.steps_.size()) {
        result.steps_[result.depth_++] = {nullptr, index};
    }
    return result;
}

std::string Place::text() const
{
    std::string text;
    for (std::size_t i = 0; i < depth_; i++) {
        if (steps_[i].key == nullptr) {
            text += "[" + std::to_string(steps_[i].index) + "]";
        } else {
            text += (text.empty() ? "" : ".") + std::string(steps_[i].key);
        }
    }
    return text;
}

void refuse(const Place &place, const std::string &cause)
{
    throw refusal(place.text(), cause);
}

std::string in_quotes(const std::string &text)
{
    constexpr std::size_t limit = 60;
    if (text.size() <= limit) {
        return "\"" + text + "\"";
    }
    // Do not cut in the middle of a UTF-8 character.
    std::size_t end = limit;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) {
        end--;
    }
    return "\"" + text.substr(0, end) + "...\"";
}

std::string shown(double value)
{
    std::array<char, 40> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.9g", value);
    return buffer.data();
}

std::string counted(std::size_t count, const char *noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

static std::string described(const json &value)
{
    switch (value.type()) {
    case json::value_t::object:
        return "an object";
    case json::value_t::array:
        return "an array";
    case json::value_t::string:
        return "the text " + in_quotes(value.get_ref<const std::string &>());
    case json::value_t::boolean:
        return value.get<bool>() ? "true" : "false";
    case json::value_t::null:
        return "null";
    default:
        return value.is_number_float() ? shown(value.get<double>()) : value.dump();
    }
}

const json *member(const json &object, const char *key)
{
    auto found = object.find(key);
    return found == object.end() || found->is_null() ? nullptr : &*found;
}

static const json &required(const json &object, const Place &place, const char *key)
{
    const json *found = member(object, key);
    if (found == nullptr) {
        refuse(place / key, "missing (glTF 2.0 requires it)");
    }
    return *found;
}

void expect_object(const json &value, const Place &place)
{
    if (!value.is_object()) {
        refuse(place, described(value) + " stands where an object must stand");
    }
}

static void expect_array(const json &value, const Place &place)
{
    if (!value.is_array()) {
        refuse(place, described(value) + " stands where an array must stand");
    }
}

const json &object_at(const json &object, const Place &place, const char *key)
{
    const json &value = required(object, place, key);
    expect_object(value, place / key);
    return value;
}

const json &array_at(const json &object, const Place &place, const char *key)
{
    const json &value = required(object, place, key);
    expect_array(value, place / key);
    return value;
}

const json &optional_array(const json &object, const Place &place, const char *key)
{
    static const json nothing = json::array();
    const json *found = member(object, key);
    if (found == nullptr) {
        return nothing;
    }
    expect_array(*found, place / key);
    return *found;
}

const json *optional_object(const json &object, const Place &place, const char *key)
{
    const json *found = member(object, key);
    if (found == nullptr || (found->is_array() && found->empty())) {
        return nullptr;
    }
    expect_object(*found, place / key);
    return found;
}

void check_objects(const json &root, const char *key)
{
    const json &array = optional_array(root, Place(), key);
    for (std::size_t i = 0; i < array.size(); i++) {
        expect_object(array[i], (Place() / key)[i]);
    }
}

const json &objects_of(const json &root, const char *key)
{
    static const json nothing = json::array();
    const json *found = member(root, key);
    return found == nullptr ? nothing : *found;
}

const json *extension_of(const json &object, const Place &place, const char *name)
{
    const json *extensions = optional_object(object, place, "extensions");
    return extensions == nullptr ? nullptr
                                 : optional_object(*extensions, place / "extensions", name);
}

std::string text_of(const json &value, const Place &place)
{
    if (!value.is_string()) {
        refuse(place, described(value) + " stands where a text must stand");
    }
    return value.get<std::string>();
}

std::string optional_text(const json &object, const Place &place, const char *key)
{
    const json *found = member(object, key);
    return found == nullptr ? std::string() : text_of(*found, place / key);
}

std::string name_of(const json &object)
{
    const json *found = member(object, "name");
    return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

bool optional_boolean(const json &object, const Place &place, const char *key, bool fallback)
{
    const json *found = member(object, key);
    if (found == nullptr) {
        return fallback;
    }
    if (!found->is_boolean()) {
        refuse(place / key, described(*found) + " stands where true or false must stand");
    }
    return found->get<bool>();
}

std::uint64_t whole_number(const json &value, const Place &place, std::uint64_t low,
                           std::uint64_t high)
{
    double number = value.is_number() ? value.get<double>() : -1;
    // The upper bound also keeps the conversion to an integer defined; NaN fails it.
    bool whole = value.is_number_unsigned() ||
                 (number >= 0 && number < 9007199254740992.0 && std::floor(number) == number);
    std::uint64_t result = 0;
    if (whole) {
        result = value.is_number_unsigned() ? value.get<std::uint64_t>()
                                            : static_cast<std::uint64_t>(number);
    }
    if (!whole || result < low || result > high) {
        std::string range = high >= largest_whole
                                ? "from " + std::to_string(low) + " up"
                                : "from " + std::to_string(low) + " to " + std::to_string(high);
        refuse(place,
               described(value) + " is out of range (it must be a whole number " + range + ")");
    }
    return result;
}

std::uint64_t whole_at(const json &object, const Place &place, const char *key, std::uint64_t low,
                       std::uint64_t high)
{
    return whole_number(required(object, place, key), place / key, low, high);
}

std::uint64_t optional_whole(const json &object, const Place &place, const char *key,
                             std::uint64_t fallback, std::uint64_t high)
{
    const json *found = member(object, key);
    return found == nullptr ? fallback : whole_number(*found, place / key, 0, high);
}

std::size_t index_of(const json &value, const Place &place, std::size_t count, const char *noun)
{
    double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number < static_cast<double>(count)) || std::floor(number) != number) {
        std::string there = count == 0 ? std::string("none") : counted(count, noun);
        refuse(place, described(value) + ": there is no such " + noun + " (the file has " + there +
                          ", counted from 0)");
    }
    return static_cast<std::size_t>(number);
}

std::ptrdiff_t optional_index(const json &object, const Place &place, const char *key,
                              std::size_t count, const char *noun)
{
    const json *found = member(object, key);
    return found == nullptr
               ? -1
               : static_cast<std::ptrdiff_t>(index_of(*found, place / key, count, noun));
}

double number_of(const json &value, const Place &place)
{
    double number = value.is_number() ? value.get<double>() : NAN;
    if (!std::isfinite(number)) {
        refuse(place, described(value) + " stands where a finite number must stand");
    }
    return number;
}

std::size_t index_at(const json &object, const Place &place, const char *key, std::size_t count,
                     const char *noun)
{
    return index_of(required(object, place, key), place / key, count, noun);
}

double number_at(const json &object, const Place &place, const char *key)
{
    return number_of(required(object, place, key), place / key);
}

std::string text_at(const json &object, const Place &place, const char *key)
{
    return text_of(required(object, place, key), place / key);
}

} // namespace glint
