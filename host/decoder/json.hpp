// Reads unchecked JSON. A function that refuses a value names its place in the file. Refusals
// are exceptions inside the decoder; main.cpp turns them into an answer.
//
// The rule (docs/formats.md): what may be left out is warned about, and the rest is drawn. What
// would give a wrong or unsafe picture is refused. So who reads a part that may be left out (a
// texture, a light, an animation's channel) catches its refusals and warns instead. A member that
// is null counts as missing.
#ifndef GLINT_DECODER_JSON_HPP
#define GLINT_DECODER_JSON_HPP

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

// Bad input. what() is "object[index]: cause (what to do)", without the file's name. where() is the
// place, which may be empty.
class refusal : public std::runtime_error
{
  public:
    using std::runtime_error::runtime_error;
    refusal(const std::string &where, const std::string &cause)
        : std::runtime_error(where.empty() ? cause : where + ": " + cause), where_(where),
          cause_(cause)
    {
    }
    const std::string &where() const
    {
        return where_;
    }
    std::string cause() const
    {
        return cause_.empty() ? what() : cause_;
    }

  private:
    std::string where_, cause_;
};

// The machine cannot hold the scene: GLINT_OUT_OF_MEMORY, with a message.
class shortage : public std::runtime_error
{
  public:
    using std::runtime_error::runtime_error;
};

// A place in the file, such as meshes[3].primitives[0].mode. It is cheap, so that the decoder can
// make one for every object; only a message composes its text. The keys must outlive it.
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

// Returns the text in quotes, cut after a few dozen characters.
std::string in_quotes(const std::string &text);

// Return short texts: a number; and a count, for example counted("node", 2) is "2 nodes".
std::string shown(double value);
std::string counted(std::size_t count, const char *noun);

// Returns a member; NULL if the object does not have it, or if it is null.
const json *member(const json &object, const char *key);

// Return a required member that is an object or an array. Refuse a missing member or another type.
const json &object_at(const json &object, const Place &place, const char *key);
const json &array_at(const json &object, const Place &place, const char *key);

// Return a required index into an array of `count` things, and a required finite number.
std::size_t index_at(const json &object, const Place &place, const char *key, std::size_t count,
                     const char *noun);
double number_at(const json &object, const Place &place, const char *key);
std::string text_at(const json &object, const Place &place, const char *key);

// Refuses a value that is not an object.
void expect_object(const json &value, const Place &place);

// Checks a top-level member: it must be missing or an array of objects.
void check_objects(const json &root, const char *key);
// Returns such a checked array; an empty array if it is missing.
const json &objects_of(const json &root, const char *key);
// Returns an optional array of any elements.
const json &optional_array(const json &object, const Place &place, const char *key);
// Returns an optional object; NULL if it is missing. An empty array counts as missing: some
// languages write an empty object so.
const json *optional_object(const json &object, const Place &place, const char *key);

// Returns an object's extension by name; NULL if it is missing. Refuses an extension that is no
// object.
const json *extension_of(const json &object, const Place &place, const char *name);

std::string text_of(const json &value, const Place &place);
std::string optional_text(const json &object, const Place &place, const char *key);
// Returns the member "name", which any object may have; empty if it is no text: a name changes no
// picture.
std::string name_of(const json &object);
bool optional_boolean(const json &object, const Place &place, const char *key, bool fallback);

// Return a whole number in [low, high]; 3.0 is whole.
std::uint64_t whole_number(const json &value, const Place &place, std::uint64_t low,
                           std::uint64_t high);
std::uint64_t whole_at(const json &object, const Place &place, const char *key, std::uint64_t low,
                       std::uint64_t high);
std::uint64_t optional_whole(const json &object, const Place &place, const char *key,
                             std::uint64_t fallback, std::uint64_t high);

// Returns an index into an array of `count` things.
std::size_t index_of(const json &value, const Place &place, std::size_t count, const char *noun);
// Returns an optional index; −1 if the member is missing.
std::ptrdiff_t optional_index(const json &object, const Place &place, const char *key,
                              std::size_t count, const char *noun);

// Returns a finite number.
double number_of(const json &value, const Place &place);

// Larger whole numbers are not exact in a JSON number.
constexpr std::uint64_t largest_whole = (std::uint64_t{1} << 53) - 1;

} // namespace glint

#endif
