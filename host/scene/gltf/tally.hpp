// A tally (tally.h) for the parts of the loader that are C++.
#ifndef GLINT_SCENE_GLTF_TALLY_HPP
#define GLINT_SCENE_GLTF_TALLY_HPP

#include "scene/gltf/tally.h"

#include <string>

namespace glint
{

class Tally
{
  public:
    Tally() = default;
    Tally(const Tally &) = delete;
    Tally &operator=(const Tally &) = delete;
    ~Tally()
    {
        glint_tally_free(&tally_);
    }

    // While an About exists, added warnings concern its material, by its index in the file.
    class About
    {
      public:
        About(Tally &tally, int material) : tally_(tally)
        {
            tally_.tally_.material = material;
        }
        ~About()
        {
            tally_.tally_.material = -1;
        }
        About(const About &) = delete;
        About &operator=(const About &) = delete;

      private:
        Tally &tally_;
    };

    void add(const std::string &text, const std::string &where)
    {
        glint_tally_add(&tally_, text.c_str(), where.c_str());
    }

    void add_once(const std::string &text, const std::string &where)
    {
        glint_tally_add_once(&tally_, text.c_str(), where.c_str());
    }

    glint_tally *get()
    {
        return &tally_;
    }

  private:
    glint_tally tally_ = {{}, {}, -1, nullptr, 0, 0};
};

} // namespace glint

#endif
