// Writes documents. See writer.hpp.
#include "decoder/writer.hpp"

#include "base/whole_io.h"
#include "decoder/json.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <sys/mman.h>
#include <unistd.h>

namespace glint
{

namespace
{

// Smaller pieces share a mapping: a process may have 65,530. So the mappings grow with the file.
constexpr std::uint64_t chunk_least = std::uint64_t{1} << 16;
constexpr std::uint64_t chunk_share = 16; // of the file
constexpr std::uint64_t page_bytes = 4096;
constexpr std::uint64_t copied_bytes = std::uint64_t{1} << 18; // at once
// Bytes whose alignment is enough for a table's row and for a number of a file.
constexpr std::uint64_t alignment = 16;

std::uint64_t round_up(std::uint64_t bytes, std::uint64_t to)
{
    return (bytes + to - 1) / to * to;
}

} // namespace

Writer::Writer(int file) : file_(file)
{
    texts.push_back('\0');
    header_ =
        reinterpret_cast<glint_document_header *>(map_at(extend(sizeof *header_), sizeof *header_));
}

Writer::~Writer()
{
    for (const Mapping &mapping : mappings_) {
        (void)munmap(mapping.at, mapping.bytes); // of none: EINVAL, and nothing happens
    }
}

// Makes the file longer, by whole pages. Returns the offset of the new ones.
std::uint64_t Writer::extend(std::uint64_t bytes)
{
    const std::uint64_t offset = end_;
    end_ += round_up(bytes, page_bytes);
    if (ftruncate(file_, static_cast<off_t>(end_)) != 0) {
        throw std::bad_alloc();
    }
    return offset;
}

unsigned char *Writer::map_at(std::uint64_t offset, std::uint64_t bytes)
{
    const std::uint64_t whole = round_up(bytes, page_bytes);
    Mapping &mapping = mappings_.emplace_back(Mapping{nullptr, 0}); // may throw
    void *at =
        mmap(nullptr, whole, PROT_READ | PROT_WRITE, MAP_SHARED, file_, static_cast<off_t>(offset));
    if (at == MAP_FAILED) {
        throw std::bad_alloc();
    }
    mapping = {at, whole};
    return static_cast<unsigned char *>(at);
}

Stored Writer::allocate(std::uint64_t bytes)
{
    Stored stored;
    stored.size = bytes;
    const std::uint64_t chunk = std::max(chunk_least, end_ / chunk_share / page_bytes * page_bytes);
    if (bytes >= chunk / 4) {
        stored.offset = extend(bytes);
        stored.data = map_at(stored.offset, bytes);
        return stored;
    }
    if (chunk_.size < bytes) {
        chunk_.offset = extend(chunk);
        chunk_.data = map_at(chunk_.offset, chunk);
        chunk_.size = chunk;
    }
    stored.data = chunk_.data;
    stored.offset = chunk_.offset;
    const std::uint64_t taken = std::min(round_up(bytes, alignment), chunk_.size);
    chunk_.data += taken;
    chunk_.offset += taken;
    chunk_.size -= taken;
    return stored;
}

bool Writer::copy(int file, std::uint64_t offset, std::uint64_t bytes, Stored &stored)
{
    if (bytes < chunk_least) {
        stored = allocate(bytes);
        return glint_read_all_at(file, offset, stored.data, bytes);
    }
    // Each page of a mapping costs a fault, twice as much as to copy it.
    stored = {nullptr, bytes, extend(bytes)};
    std::vector<unsigned char> piece(std::min(bytes, copied_bytes));
    for (std::uint64_t done = 0; done < bytes; done += piece.size()) {
        const auto count =
            static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), bytes - done));
        if (!glint_read_all_at(file, offset + done, piece.data(), count)) {
            return false;
        }
        write(stored.offset + done, piece.data(), count);
    }
    return true;
}

void Writer::map(Stored &stored)
{
    if (stored.data == nullptr && stored.size > 0) {
        stored.data = map_at(stored.offset, stored.size);
    }
}

glint_text Writer::text(const std::string &text)
{
    const std::string whole = text.c_str(); // a name may hold a zero
    if (whole.empty()) {
        return 0;
    }
    const auto found = known_.find(whole);
    if (found != known_.end()) {
        return found->second;
    }
    if (texts.size() + whole.size() >= std::size_t{INT32_MAX}) {
        throw refusal("its names have more than 2 GiB (leave them out)");
    }
    const auto at = static_cast<glint_text>(texts.size());
    texts.insert(texts.end(), whole.c_str(), whole.c_str() + whole.size() + 1);
    known_.emplace(whole, at);
    return at;
}

glint_run Writer::add_notes(const std::vector<Note> &added)
{
    std::vector<glint_document_note> rows;
    rows.reserve(added.size());
    for (const Note &note : added) {
        rows.push_back({text(note.where), text(note.text)});
    }
    return add_run(notes, rows);
}

void Writer::write(std::uint64_t offset, const void *bytes, std::size_t count) const
{
    if (!glint_write_all_at(file_, offset, bytes, count)) {
        throw shortage(std::string("its contents cannot be stored: ") + std::strerror(errno));
    }
}

void Writer::write_table(glint_document_table table, const void *rows, std::size_t count,
                         std::size_t row_bytes)
{
    if (count > std::size_t{INT32_MAX}) {
        throw refusal("it has more than 2^31 things of a kind (split the scene)");
    }
    write(end_, rows, count * row_bytes);
    header_->tables[table] = {end_, count};
    end_ = round_up(end_ + count * row_bytes, alignment);
}

void Writer::finish(int default_scene)
{
    header_->magic = GLINT_DOCUMENT_MAGIC;
    header_->default_scene = default_scene;
#define TABLE(name, type)                                                                          \
    write_table(GLINT_TABLE_##name, (name).data(), (name).size(), sizeof(type));
    GLINT_DOCUMENT_TABLES(TABLE)
#undef TABLE
    if (ftruncate(file_, static_cast<off_t>(end_)) != 0) { // also an empty table lies in the file
        throw shortage(std::string("its contents cannot be stored: ") + std::strerror(errno));
    }
}

} // namespace glint
