// Warnings that name the first thing that they concern, and count the others.
#ifndef GLINT_SCENE_GLTF_TALLY_HPP
#define GLINT_SCENE_GLTF_TALLY_HPP

#include "base/status.h"

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace glint
{

class Tally
{
  public:
    // `text` says what was found and what is done about it; `where` is kept of the first only.
    void add(const std::string &text, const std::string &where)
    {
        auto added = index_of_.emplace(text, entries_.size());
        if (added.second) {
            entries_.push_back({text, where, 0});
        }
        entries_[added.first->second].count++;
    }

    // One line each, in the order in which they were first added.
    void report(const char *path, glint_warnings *warnings) const
    {
        for (const Entry &entry : entries_) {
            std::string more =
                entry.count > 1 ? " and " + std::to_string(entry.count - 1) + " more" : "";
            glint_warn(warnings, "%s: %s%s: %s", path, entry.where.c_str(), more.c_str(),
                       entry.text.c_str());
        }
    }

  private:
    struct Entry {
        std::string text, where;
        std::size_t count;
    };
    std::vector<Entry> entries_;
    std::unordered_map<std::string, std::size_t> index_of_;
};

} // namespace glint

#endif
