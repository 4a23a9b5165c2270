// Writes a document (scene/document.h) to a memory file: first the bytes of buffers and images, as
// they are read, then the tables.
#ifndef GLINT_DECODER_WRITER_HPP
#define GLINT_DECODER_WRITER_HPP

#include "scene/document.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace glint
{

// Bytes in the memory file. Who wants to see them maps them (Writer::map).
struct Stored {
    unsigned char *data = nullptr;      // NULL: they are not mapped
    std::uint64_t size = 0, offset = 0; // in the file
};

// What is wrong with a part of the file. `where` may be empty: the part that holds the note.
struct Note {
    std::string where, text;
};

class Writer
{
  public:
    explicit Writer(int file); // borrowed, and empty
    Writer(const Writer &) = delete;
    Writer &operator=(const Writer &) = delete;
    ~Writer();

    // Returns that many zeros, mapped as long as the writer lives. Throws std::bad_alloc.
    Stored allocate(std::uint64_t bytes);

    // Copies bytes of another file, without mapping many. Returns false if the file ends before, or
    // cannot be read. Throws std::bad_alloc.
    bool copy(int file, std::uint64_t offset, std::uint64_t bytes, Stored &stored);

    // Maps bytes that are not mapped yet. Throws std::bad_alloc.
    void map(Stored &stored);

    glint_text text(const std::string &text);

    // Where the header says what is done at present.
    glint_document_doing *doing()
    {
        return &header_->doing;
    }

    // Appends a row and returns its index.
    template <typename Row>
    std::int32_t add(std::vector<Row> &table, const Row &row)
    {
        table.push_back(row);
        return static_cast<std::int32_t>(table.size() - 1);
    }

    // Appends rows and returns their run.
    template <typename Row, typename Rows>
    glint_run add_run(std::vector<Row> &table, const Rows &rows)
    {
        const glint_run run = {static_cast<std::uint32_t>(table.size()),
                               static_cast<std::uint32_t>(rows.size())};
        table.insert(table.end(), rows.begin(), rows.end());
        return run;
    }

    glint_run add_notes(const std::vector<Note> &added);

    // The tables.
#define TABLE(name, type) std::vector<type> name;
    GLINT_DOCUMENT_TABLES(TABLE)
#undef TABLE

    // Writes the tables and the header. Throws a shortage.
    void finish(int default_scene);

  private:
    struct Mapping {
        void *at;
        std::size_t bytes;
    };
    std::uint64_t extend(std::uint64_t bytes);
    unsigned char *map_at(std::uint64_t offset, std::uint64_t bytes);
    void write(std::uint64_t offset, const void *bytes, std::size_t count) const;
    void write_table(glint_document_table table, const void *rows, std::size_t count,
                     std::size_t row_bytes);

    int file_;
    glint_document_header *header_; // mapped
    std::uint64_t end_ = 0;         // of the file; until finish() a multiple of the size of a page
    std::vector<Mapping> mappings_;
    Stored chunk_; // of what is small; its unused rest
    std::unordered_map<std::string, glint_text> known_;
};

} // namespace glint

#endif
