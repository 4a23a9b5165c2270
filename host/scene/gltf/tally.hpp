// Collects warnings. Each names the first place that it concerns, and counts the others.
#ifndef GLINT_SCENE_GLTF_TALLY_HPP
#define GLINT_SCENE_GLTF_TALLY_HPP

#include "base/status.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace glint
{

class Tally
{
  public:
    // While an About exists, added warnings concern its material, by its index in the file.
    class About
    {
      public:
        About(Tally &tally, int material) : tally_(tally)
        {
            tally_.material_ = material;
        }
        ~About()
        {
            tally_.material_ = -1;
        }
        About(const About &) = delete;
        About &operator=(const About &) = delete;

      private:
        Tally &tally_;
    };

    // Adds a warning. `text` says what was found and what is done about it. Only the first `where`
    // is kept.
    void add(const std::string &text, const std::string &where)
    {
        auto added = index_of_.emplace(text, entries_.size());
        if (added.second) {
            entries_.push_back({text, where, 0});
        }
        entries_[added.first->second].count++;
        if (material_ >= 0 && added.first->second < 64) {
            lines_about_[material_] |= std::uint64_t{1} << added.first->second;
        }
    }

    // Adds a warning about a thing that several materials may share: counts each `where` once.
    void add_once(const std::string &text, const std::string &where)
    {
        add(text, where);
        if (!once_.insert(text + "\n" + where).second) {
            entries_[index_of_.at(text)].count--;
        }
    }

    // Returns which of the first 64 lines of report() concern a material: bit i for line i.
    std::uint64_t lines_about(int material) const
    {
        auto found = lines_about_.find(material);
        return found == lines_about_.end() ? 0 : found->second;
    }

    // Reports one line per warning, in the order of their first addition.
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
    std::unordered_set<std::string> once_; // added by add_once()
    int material_ = -1;
    std::unordered_map<int, std::uint64_t> lines_about_;
};

} // namespace glint

#endif
