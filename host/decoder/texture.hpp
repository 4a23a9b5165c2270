// Reads the textures of materials, and their images.
#ifndef GLINT_DECODER_TEXTURE_HPP
#define GLINT_DECODER_TEXTURE_HPP

#include "decoder/file.hpp"
#include "decoder/model.hpp"
#include "scene/material/material.h"

namespace glint
{

// A texture slot of a material.
struct TextureSlot {
    const char *holder; // NULL: the material itself, "KHR_…": the extension
    const char *key;
    glint_texture_slot slot;
};

// Returns the slots that glint reads. If a material has two entries for one slot, the later one
// counts.
const std::array<TextureSlot, 19> &texture_slots();

// Returns the view that holds an image; −1: none. Refuses what is no index of a view.
std::ptrdiff_t view_of_image(const json &root, std::size_t image);

// Reads a textureInfo at `place`. `image` becomes 1 + the index of the file's image. Refuses a
// texture that cannot be shown. Notes faults that only its sampler has.
glint_texture_use read_texture_info(const json &root, const json &info, const Place &place,
                                    std::vector<Note> &notes);

// Writes the file's images: the URIs or the bytes of those that materials name.
void write_images(const json &root, const Model &model, Writer &writer);

} // namespace glint

#endif
