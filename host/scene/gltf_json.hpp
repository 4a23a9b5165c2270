// Reading JSON that nobody has checked yet: every accessor names the place that it read when it
// refuses. Refusals travel as exceptions inside the shim; gltf.cpp turns them into a status.
#ifndef GLINT_SCENE_GLTF_JSON_HPP
#define GLINT_SCENE_GLTF_JSON_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace glint
{

using json = nlohmann::json;

// Bad input. what() is "object[index]: cause (what to do)", without the file's name.
class refusal : public std::runtime_error
{
  public:
    using std::runtime_error::runtime_error;
};

// The machine cannot hold the scene: GLINT_OUT_OF_MEMORY, with a message.
class shortage : public std::runtime_error
{
  public:
    using std::runtime_error::runtime_error;
};

// Where something stands in the document, such as meshes[3].primitives[0].mode. Cheap to make, so
// that it can be made for every object; the text is put together only for a message. The keys must
// outlive it.
class Place
{
  public:
    Place operator/(const char *key) const;    // a member of the object
    Place operator[](std::size_t index) const; // an element of the array
    std::string text() const;

  private:
    struct Step {
        const char *key; // NULL: an index
        std::size_t index;
    };
    std::array<Step, 12> steps_{};
    std::size_t depth_ = 0;
};

[[noreturn]] void refuse(const Place &place, const std::string &cause);

// The text in quotes, cut after a few dozen characters.
std::string in_quotes(const std::string &text);

// A number as a short text; counted("node", 2) is "2 nodes".
std::string shown(double value);
std::string counted(std::size_t count, const char *noun);

// The thing of that name among those with these, or else of that index ("0"). Refuses what is
// neither, with a list of what there is; `noun` is what such a thing is called.
std::size_t find_named(const std::vector<std::string> &names, const char *name, const char *noun);

// NULL where the object has no such member.
const json *member(const json &object, const char *key);

// The member, which must be there and be an object, an array (of so many elements, if any length is
// given), a text.
const json &object_at(const json &object, const Place &place, const char *key);
const json &array_at(const json &object, const Place &place, const char *key);

// Refuses what is no object.
void expect_object(const json &value, const Place &place);

// Refuses what stands under a key of the top level unless it is an array of objects, or missing.
void check_objects(const json &root, const char *key);
// That array, once it has been checked; an empty one where there is none.
const json &objects_of(const json &root, const char *key);
// An array that may be missing, of anything.
const json &optional_array(const json &object, const Place &place, const char *key);
// NULL where it is missing.
const json *optional_object(const json &object, const Place &place, const char *key);

// An object's extension; NULL where it has none of that name. Refuses one that is no object.
const json *extension_of(const json &object, const Place &place, const char *name);

// A malloc'd copy; NULL for an empty text.
char *copy_text(const std::string &text);

std::string text_of(const json &value, const Place &place);
std::string optional_text(const json &object, const Place &place, const char *key);
bool optional_boolean(const json &object, const Place &place, const char *key, bool fallback);

// A whole number in [low, high]; 3.0 is one.
std::uint64_t whole_number(const json &value, const Place &place, std::uint64_t low,
                           std::uint64_t high);
std::uint64_t whole_at(const json &object, const Place &place, const char *key, std::uint64_t low,
                       std::uint64_t high);
std::uint64_t optional_whole(const json &object, const Place &place, const char *key,
                             std::uint64_t fallback, std::uint64_t high);

// An index into an array of `count` things.
std::size_t index_of(const json &value, const Place &place, std::size_t count, const char *noun);
// −1 where the member is missing.
std::ptrdiff_t optional_index(const json &object, const Place &place, const char *key,
                              std::size_t count, const char *noun);

// A finite number, and one within [low, high], but for the rounding of a float.
double number_of(const json &value, const Place &place);
double number_within(const json &value, const Place &place, double low, double high);

// Whole numbers beyond this are not exact in a JSON number.
constexpr std::uint64_t largest_whole = (std::uint64_t{1} << 53) - 1;

} // namespace glint

#endif
