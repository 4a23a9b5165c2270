// What materials say of textures, and the images behind them.
#ifndef GLINT_SCENE_GLTF_TEXTURE_HPP
#define GLINT_SCENE_GLTF_TEXTURE_HPP

#include "scene/gltf_file.hpp"
#include "scene/gltf_model.hpp"
#include "scene/gltf_tally.hpp"
#include "scene/material.h"

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
    bool is_color; // its R, G and B have the sRGB curve
};

// The slots that are read. A material may have two for one slot, of which the later counts.
const std::array<TextureSlot, 19> &texture_slots();

// Checks images, samplers and textures, used or not.
void check_textures(const Document &document);

// Checks a textureInfo object.
void check_texture_info(const json &root, const json &info, const Place &place);

// An image as materials use it.
struct ImageUse {
    std::size_t image; // in the file's images
    bool is_color, is_coverage;

    bool operator<(const ImageUse &other) const
    {
        return std::tie(image, is_color, is_coverage) <
               std::tie(other.image, other.is_color, other.is_coverage);
    }
};

// The images that used materials need, each once for what it is read for.
class Images
{
  public:
    // Its number, from 1.
    std::uint32_t number_of(const ImageUse &use);

    // Decodes all, on all cores. Levels larger than `largest` texels across are left out; 0: none.
    void read(const Document &document, const Model &model, int largest);

    // Why an image could not be read; empty where it was.
    const std::string &fault(std::uint32_t number) const
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
    std::vector<std::string> faults_;
    std::unique_ptr<glint_textures, Release> textures_;
};

// What a checked textureInfo says; `image` is left 0. Sets *image to the file's image, −1 where
// there is none that is read.
glint_texture_use read_texture_info(const json &root, const json &info, std::ptrdiff_t *image);

} // namespace glint

#endif
