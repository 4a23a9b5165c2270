// Reads the textures of materials, and their images.
#ifndef GLINT_SCENE_GLTF_TEXTURE_HPP
#define GLINT_SCENE_GLTF_TEXTURE_HPP

#include "scene/gltf/file.hpp"
#include "scene/gltf/model.hpp"
#include "scene/gltf/tally.hpp"
#include "scene/material/material.h"

#include <map>
#include <memory>
#include <tuple>

namespace glint
{

// A texture slot of a material.
struct TextureSlot {
    const char *holder; // NULL: the material itself, "KHR_…": the extension
    const char *key;
    glint_texture_slot slot;
    bool is_color; // R, G and B are encoded by the sRGB curve
};

// Returns the slots that glint reads. If a material has two entries for one slot, the later one
// counts.
const std::array<TextureSlot, 19> &texture_slots();

// Returns the view that holds an image; −1: none. Refuses what is no index of a view.
std::ptrdiff_t view_of_image(const json &root, std::size_t image);

// What is wrong with a part of the file. `where` may be empty: the part that holds the note.
struct Note {
    std::string where, text;
};

// An image, and how materials use it.
struct ImageUse {
    std::size_t image; // index in the file's images
    bool is_color, is_coverage;

    bool operator<(const ImageUse &other) const
    {
        return std::tie(image, is_color, is_coverage) <
               std::tie(other.image, other.is_color, other.is_coverage);
    }
};

// The images that the used materials need, each once per use.
class Images
{
  public:
    // Returns the number of an image, from 1.
    std::uint32_t number_of(const ImageUse &use);

    // Decodes all images, on all cores. Leaves out levels larger than `largest` texels across; 0:
    // no limit.
    void read(const Document &document, const Model &model, int largest);

    // Returns why an image could not be read; no text if it was read.
    const Note &fault(std::uint32_t number) const
    {
        return faults_[number - 1];
    }

    glint_textures *textures() const // borrowed
    {
        return textures_.get();
    }

  private:
    struct Release {
        void operator()(glint_textures *textures) const
        {
            glint_textures_release(textures);
        }
    };
    std::map<ImageUse, std::uint32_t> numbers_;
    std::vector<ImageUse> uses_;
    std::vector<Note> faults_;
    std::unique_ptr<glint_textures, Release> textures_;
};

// Reads a textureInfo at `place`. `image` becomes 1 + the index of the file's image. Refuses a
// texture that cannot be shown. Notes faults that only its sampler has.
glint_texture_use read_texture_info(const json &root, const json &info, const Place &place,
                                    std::vector<Note> &notes);

} // namespace glint

#endif
