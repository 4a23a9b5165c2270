// Reads the scene's file and never trusts it. Lengths are compared with the bytes present before
// memory is allocated.
#include "decoder/file.hpp"

#include "base/whole_io.h"
#include "decoder/foreign_format.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace glint
{

namespace
{

constexpr std::uint64_t largest_file = std::uint64_t{1} << 32; // the limit of a GLB's length
constexpr std::uint64_t largest_json = std::uint64_t{1} << 30;
constexpr std::size_t deepest_nesting = 100;

// A regular file. Refuses others.
class File
{
  public:
    explicit File(int descriptor) : descriptor_(descriptor) // owned
    {
        struct stat facts = {};
        if (fstat(descriptor_, &facts) != 0 || !S_ISREG(facts.st_mode)) {
            close(descriptor_);
            throw refusal("it is no regular file");
        }
        size_ = static_cast<std::uint64_t>(facts.st_size);
    }
    ~File()
    {
        close(descriptor_);
    }
    File(const File &) = delete;
    File &operator=(const File &) = delete;

    std::uint64_t size() const
    {
        return size_;
    }

    int descriptor() const
    {
        return descriptor_;
    }

    // Fills `bytes` from an offset. Returns false if the file ends before, or cannot be read.
    bool read(std::uint64_t offset, void *bytes, std::size_t count) const
    {
        return glint_read_all_at(descriptor_, offset, bytes, count);
    }

  private:
    int descriptor_;
    std::uint64_t size_ = 0;
};

std::string at_byte(std::uint64_t offset)
{
    return "byte " + std::to_string(offset) + ": ";
}

std::uint32_t little_endian(const unsigned char *bytes)
{
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
           static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

[[noreturn]] void refuse_reading(std::uint64_t offset)
{
    throw refusal(at_byte(offset) + "the file could not be read (is it still being written?)");
}

void read_or_refuse(const File &file, std::uint64_t offset, void *bytes, std::size_t count)
{
    if (!file.read(offset, bytes, count)) {
        refuse_reading(offset);
    }
}

// Refuses deep nesting: a JSON parser, and the destructor of its tree, recurse. `offset` is the
// start of the text in the file.
void check_nesting(const std::string &text, std::uint64_t offset)
{
    std::size_t depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); i++) {
        char c = text[i];
        if (in_text) {
            if (c == '\\') {
                i++;
            } else if (c == '"') {
                in_text = false;
            }
        } else if (c == '"') {
            in_text = true;
        } else if (c == '[' || c == '{') {
            if (++depth > deepest_nesting) {
                throw refusal(at_byte(offset + i) + "JSON nested more than " +
                              std::to_string(deepest_nesting) +
                              " levels deep (no glTF file needs that)");
            }
        } else if ((c == ']' || c == '}') && depth > 0) {
            depth--;
        }
    }
}

// Shortens the parser's message "[json.exception.parse_error.101] parse error at line 1, column 9:
// syntax error while parsing value - invalid literal; last read: '…'; expected …". Removes its head
// and the last token, which can be as long as the file.
std::string syntax_cause(const std::string &what)
{
    std::size_t begin = what.find(": ");
    std::string cause = begin == std::string::npos ? what : what.substr(begin + 2);
    std::size_t token = cause.find("; last read: ");
    std::size_t expected = cause.rfind("; expected ");
    if (token != std::string::npos) {
        std::string tail = expected != std::string::npos && expected > token
                               ? cause.substr(expected)
                               : std::string();
        cause.resize(token);
        cause += tail;
    }
    return cause;
}

void parse(const std::string &text, std::uint64_t offset, json &root)
{
    check_nesting(text, offset);
    try {
        root = json::parse(text);
    } catch (const json::parse_error &error) {
        std::uint64_t byte = error.byte > 0 ? error.byte - 1 : 0;
        bool ended = byte >= text.size();
        throw refusal(at_byte(offset + byte) + "not JSON: " + syntax_cause(error.what()) +
                      (ended ? " (the file is cut short?)" : " (mend it, or export it again)"));
    } catch (const json::exception &error) {
        throw refusal("not JSON that can be used: " + syntax_cause(error.what()) +
                      " (export it again)");
    }
    if (!root.is_object()) {
        throw refusal("the top level is no JSON object (this is not a glTF file)");
    }
}

struct Chunk {
    std::uint64_t offset; // offset of the data
    std::uint32_t length;
    std::uint32_t type;
};

// Reads the header of the chunk at `offset`; the chunk must end by `end`.
Chunk read_chunk(const File &file, std::uint64_t offset, std::uint64_t end)
{
    std::array<unsigned char, 8> header{};
    if (end - offset < header.size()) {
        throw refusal(at_byte(offset) + "GLB: " + counted(end - offset, "byte") +
                      " where a chunk's header of 8 must stand (the file is damaged)");
    }
    read_or_refuse(file, offset, header.data(), header.size());
    Chunk chunk = {offset + 8, little_endian(header.data()), little_endian(header.data() + 4)};
    if (chunk.length > end - chunk.offset) {
        throw refusal(at_byte(offset) + "GLB: a chunk says that it has " +
                      counted(chunk.length, "byte") + ", but " +
                      std::to_string(end - chunk.offset) +
                      " are left (the file is damaged or cut short)");
    }
    return chunk;
}

void read_glb(const File &file, Writer &writer, SceneFile &input)
{
    constexpr std::uint32_t type_json = 0x4E4F534A;
    constexpr std::uint32_t type_bin = 0x004E4942;
    std::array<unsigned char, 12> header{};
    if (file.size() < header.size()) {
        throw refusal(at_byte(file.size()) + "GLB: the file ends within its 12-byte header");
    }
    read_or_refuse(file, 0, header.data(), header.size());
    std::uint32_t version = little_endian(header.data() + 4);
    std::uint64_t length = little_endian(header.data() + 8);
    if (version != 2) {
        throw refusal("byte 4: GLB version " + std::to_string(version) +
                      " (only version 2 is read: convert it to glTF 2.0)");
    }
    if (length > file.size() || length < header.size()) {
        throw refusal("byte 8: GLB: the header says that the file has " + counted(length, "byte") +
                      ", but it has " + std::to_string(file.size()) +
                      " (the file is damaged or cut short)");
    }
    Chunk chunk = read_chunk(file, header.size(), length);
    if (chunk.type != type_json) {
        throw refusal("byte 16: GLB: the first chunk is not the JSON chunk (the file is damaged)");
    }
    if (chunk.length > largest_json) {
        throw refusal("byte 12: GLB: more than 1 GiB of JSON (put the data into the BIN chunk)");
    }
    std::string text(chunk.length, '\0');
    read_or_refuse(file, chunk.offset, text.data(), text.size());
    parse(text, chunk.offset, input.root);
    // Skip chunks of unknown types, as the format requires.
    for (std::uint64_t next = chunk.offset + chunk.length; next < length;) {
        chunk = read_chunk(file, next, length);
        if (chunk.type == type_bin && !input.has_bin) {
            input.has_bin = true;
            if (!writer.copy(file.descriptor(), chunk.offset, chunk.length, input.bin)) {
                refuse_reading(chunk.offset);
            }
        }
        next = chunk.offset + chunk.length;
    }
}

int ask(SceneFile &input, const std::string &uri, const Place &place)
{
    try {
        return input.asker.open(uri);
    } catch (const refusal &reason) {
        refuse(place, in_quotes(uri) + ": " + reason.what());
    }
}

Stored read_external(SceneFile &input, const std::string &uri, const Place &place,
                     std::uint64_t length, Writer &writer)
{
    const File file(ask(input, uri, place));
    if (file.size() < length) {
        refuse(place, in_quotes(uri) + " has " + counted(file.size(), "byte") +
                          ", byteLength says " + std::to_string(length) +
                          " (the file is cut short, or another one)");
    }
    input.limits.add_file(length);
    Stored bytes;
    if (!writer.copy(file.descriptor(), 0, length, bytes)) {
        refuse(place, in_quotes(uri) + " could not be read (is it still being written?)");
    }
    return bytes;
}

// Refuses a file of another format, and reads its first bytes.
std::array<unsigned char, GLINT_FOREIGN_HEAD> read_head(const File &file, const std::string &path)
{
    std::array<unsigned char, GLINT_FOREIGN_HEAD> head{};
    const auto length = static_cast<std::size_t>(std::min<std::uint64_t>(head.size(), file.size()));
    read_or_refuse(file, 0, head.data(), length);
    std::array<char, 256> what{};
    const glint_foreign_file facts = {path.c_str(), head.data(), length, file.size()};
    if (glint_foreign_describe(&facts, what.data(), what.size())) {
        throw refusal(what.data());
    }
    return head;
}

} // namespace

void read_document(const char *path, int scene, Writer &writer, SceneFile &input)
{
    const File file(scene);
    input.limits.add_file(file.size());
    if (file.size() == 0) {
        throw refusal("byte 0: the file is empty (export it again)");
    }
    const auto head = read_head(file, path);
    if (file.size() > largest_file) {
        throw refusal("the file has more than 4 GiB (put the data into .bin files beside it)");
    }
    if (std::memcmp(head.data(), "glTF", 4) == 0) {
        read_glb(file, writer, input);
        return;
    }
    if (file.size() > largest_json) {
        throw refusal("more than 1 GiB of JSON (put the data into .bin files beside it)");
    }
    std::string text(static_cast<std::size_t>(file.size()), '\0');
    read_or_refuse(file, 0, text.data(), text.size());
    parse(text, 0, input.root);
}

Stored read_buffer(SceneFile &input, std::size_t i, Writer &writer)
{
    Place place = (Place() / "buffers")[i];
    json &buffer = input.root["buffers"][i];
    std::uint64_t length = whole_at(buffer, place, "byteLength", 1, largest_whole);
    auto found = buffer.find("uri");
    if (found == buffer.end()) {
        if (input.bin.size < length) {
            refuse(place / "byteLength", std::to_string(length) + " is more than the BIN chunk's " +
                                             counted(input.bin.size, "byte") +
                                             " (the file is damaged)");
        }
        Stored bytes = input.bin;
        bytes.size = length;
        return bytes;
    }
    std::string uri = std::move(found->get_ref<std::string &>());
    if (!is_data_uri(uri)) {
        return read_external(input, uri, place / "uri", length, writer);
    }
    const Bytes bytes = decode_data_uri(uri, place / "uri");
    if (bytes.size() < length) {
        refuse(place / "uri", "the data URI holds " + counted(bytes.size(), "byte") +
                                  ", byteLength says " + std::to_string(length) +
                                  " (the text is cut short, or byteLength is wrong)");
    }
    const Stored stored = writer.allocate(length);
    std::memcpy(stored.data, bytes.data(), length);
    return stored;
}

} // namespace glint
