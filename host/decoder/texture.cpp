// Checks and reads textures, and decodes their images. See texture.hpp.
#include "decoder/texture.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace glint
{

namespace
{

const char *const transform_name = "KHR_texture_transform";

// Extensions that name another image than `source`, in a format that glint reads. The file may also
// have `source`, for programs that do not read this format.
const std::array<const char *, 2> sources = {"EXT_texture_webp", "MSFT_texture_dds"};

// OpenGL's codes.
constexpr std::uint64_t nearest = 9728, linear = 9729, nearest_mipmap_nearest = 9984,
                        linear_mipmap_nearest = 9985, nearest_mipmap_linear = 9986,
                        linear_mipmap_linear = 9987, clamp_to_edge = 33071, mirrored_repeat = 33648,
                        repeat = 10497;

// Reads two numbers of KHR_texture_transform.
void read_pair(const json &object, const Place &place, const char *key, double pair[2])
{
    const json *found = member(object, key);
    if (found == nullptr) {
        return;
    }
    if (!found->is_array() || found->size() != 2) {
        refuse(place / key, "not an array of 2 numbers");
    }
    for (std::size_t i = 0; i < 2; i++) {
        pair[i] = number_of((*found)[i], (place / key)[i]);
    }
}

// Reads the transform: translation · rotation · scale.
void read_transform(const json &object, const Place &place, float transform[6])
{
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    read_pair(object, place, "offset", offset);
    read_pair(object, place, "scale", scale);
    const json *found = member(object, "rotation");
    const double angle = found != nullptr ? number_of(*found, place / "rotation") : 0;
    const double c = std::cos(angle), s = std::sin(angle);
    const double rows[6] = {c * scale[0],  s * scale[1], offset[0],
                            -s * scale[0], c * scale[1], offset[1]};
    for (int i = 0; i < 6; i++) {
        if (!(std::fabs(rows[i]) <= FLT_MAX)) {
            refuse(place, "does not fit into floats (use smaller numbers)");
        }
        transform[i] = static_cast<float>(rows[i]);
    }
}

// Returns the set of texture coordinates; 0 if none is named.
std::uint64_t texcoord_of(const json &object, const Place &place)
{
    return optional_whole(object, place, "texCoord", 0, 1 << 20);
}

// Returns a sampler's code, which must be among `known`; the first of them if it is missing.
std::uint64_t code_of(const json &sampler, const Place &place, const char *key,
                      std::initializer_list<std::uint64_t> known)
{
    const json *found = member(sampler, key);
    if (found == nullptr) {
        return *known.begin();
    }
    const std::uint64_t code = whole_number(*found, place / key, 0, largest_whole);
    if (std::find(known.begin(), known.end(), code) == known.end()) {
        refuse(place / key, "no code of a filter or wrapping");
    }
    return code;
}

glint_wrap wrap_of(const json &sampler, const Place &place, const char *key)
{
    const std::uint64_t code =
        code_of(sampler, place, key, {repeat, clamp_to_edge, mirrored_repeat});
    return code == clamp_to_edge     ? GLINT_WRAP_CLAMP
           : code == mirrored_repeat ? GLINT_WRAP_MIRROR
                                     : GLINT_WRAP_REPEAT;
}

void read_sampler(const json &sampler, const Place &place, glint_texture_use &use)
{
    const std::uint64_t magnified = code_of(sampler, place, "magFilter", {linear, nearest});
    const std::uint64_t minified =
        code_of(sampler, place, "minFilter",
                {linear_mipmap_linear, nearest, linear, nearest_mipmap_nearest,
                 linear_mipmap_nearest, nearest_mipmap_linear});
    use.wrap_s = wrap_of(sampler, place, "wrapS");
    use.wrap_t = wrap_of(sampler, place, "wrapT");
    use.magnified_nearest = magnified == nearest;
    use.minified_nearest = minified == nearest || minified == nearest_mipmap_nearest ||
                           minified == nearest_mipmap_linear;
    use.mips = minified == nearest || minified == linear ? GLINT_MIP_NONE
               : minified == nearest_mipmap_nearest || minified == linear_mipmap_nearest
                   ? GLINT_MIP_NEAREST
                   : GLINT_MIP_LINEAR;
}

// Returns the image of a texture. Refuses a texture that names no image that glint reads.
std::size_t image_of(const json &root, const json &texture, const Place &place)
{
    std::size_t images = objects_of(root, "images").size();
    for (const char *name : sources) {
        const json *other = extension_of(texture, place, name);
        std::ptrdiff_t image =
            other == nullptr
                ? -1
                : optional_index(*other, place / "extensions" / name, "source", images, "image");
        if (image >= 0) {
            return static_cast<std::size_t>(image);
        }
    }
    const std::ptrdiff_t image = optional_index(texture, place, "source", images, "image");
    if (image < 0) {
        refuse(place, "no image of a kind that is read (PNG, JPEG, WebP, DDS)");
    }
    return static_cast<std::size_t>(image);
}

// ---- Images -------------------------------------------------------------------------------------

// For example: images[0] "wood", "wood.png".
std::string image_name(const json &image, const Place &place)
{
    std::string name = place.text();
    const char *comma = " ";
    for (const char *key : {"name", "uri"}) {
        const json *text = member(image, key);
        if (text != nullptr && text->is_string() &&
            !is_data_uri(text->get_ref<const std::string &>())) {
            name += comma + in_quotes(text->get_ref<const std::string &>());
            comma = ", ";
        }
    }
    return name;
}

void find_bytes(const Model &model, std::size_t view, glint_document_image &row)
{
    const tinygltf::BufferView &range = model.bufferViews[view];
    const auto buffer = static_cast<std::size_t>(range.buffer);
    const Stored &all = model.bytes[buffer];
    if (all.size < range.byteOffset || all.size - range.byteOffset < range.byteLength) {
        throw refusal(model.buffer_faults[buffer]);
    }
    row.offset = all.offset + range.byteOffset;
    row.bytes = range.byteLength;
}

// Finds an image; throws a refusal if there is none.
void find_image(const json &root, const Model &model, std::size_t index, Writer &writer,
                glint_document_image &row)
{
    const json &image = objects_of(root, "images")[index];
    const Place place = (Place() / "images")[index];
    const json *uri = member(image, "uri");
    const std::ptrdiff_t view = view_of_image(root, index);
    if (uri != nullptr && uri->is_string() && is_data_uri(uri->get_ref<const std::string &>())) {
        const Bytes bytes = decode_data_uri(uri->get_ref<const std::string &>(), place / "uri");
        const Stored stored = writer.allocate(bytes.size());
        std::copy(bytes.begin(), bytes.end(), stored.data);
        row.offset = stored.offset;
        row.bytes = stored.size;
    } else if (uri != nullptr) {
        const std::string name = text_of(*uri, place / "uri");
        if (name.empty() || name.find('\0') != std::string::npos) {
            refuse(place, "names no file");
        }
        row.uri = writer.text(name);
    } else if (view >= 0) {
        find_bytes(model, static_cast<std::size_t>(view), row);
    } else {
        refuse(place, "neither a uri nor a bufferView");
    }
}

} // namespace

const std::array<TextureSlot, 19> &texture_slots()
{
    static const std::array<TextureSlot, 19> slots = {{
        {"pbrMetallicRoughness", "baseColorTexture", GLINT_TEXTURE_BASE_COLOR},
        {"pbrMetallicRoughness", "metallicRoughnessTexture", GLINT_TEXTURE_METALLIC_ROUGHNESS},
        {nullptr, "normalTexture", GLINT_TEXTURE_NORMAL},
        {nullptr, "occlusionTexture", GLINT_TEXTURE_OCCLUSION},
        {nullptr, "emissiveTexture", GLINT_TEXTURE_EMISSION},
        {"KHR_materials_transmission", "transmissionTexture", GLINT_TEXTURE_TRANSMISSION},
        {"KHR_materials_specular", "specularTexture", GLINT_TEXTURE_SPECULAR},
        {"KHR_materials_specular", "specularColorTexture", GLINT_TEXTURE_SPECULAR_COLOR},
        {"KHR_materials_clearcoat", "clearcoatTexture", GLINT_TEXTURE_CLEARCOAT},
        {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", GLINT_TEXTURE_CLEARCOAT_ROUGHNESS},
        {"KHR_materials_clearcoat", "clearcoatNormalTexture", GLINT_TEXTURE_CLEARCOAT_NORMAL},
        {"KHR_materials_anisotropy", "anisotropyTexture", GLINT_TEXTURE_ANISOTROPY},
        {"KHR_materials_sheen", "sheenColorTexture", GLINT_TEXTURE_SHEEN_COLOR},
        {"KHR_materials_sheen", "sheenRoughnessTexture", GLINT_TEXTURE_SHEEN_ROUGHNESS},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture",
         GLINT_TEXTURE_DIFFUSE_TRANSMISSION},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture",
         GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR},
        {"KHR_materials_iridescence", "iridescenceTexture", GLINT_TEXTURE_IRIDESCENCE},
        {"KHR_materials_iridescence", "iridescenceThicknessTexture",
         GLINT_TEXTURE_IRIDESCENCE_THICKNESS},
        {"KHR_materials_pbrSpecularGlossiness", "diffuseTexture", GLINT_TEXTURE_BASE_COLOR},
    }};
    return slots;
}

std::ptrdiff_t view_of_image(const json &root, std::size_t image)
{
    return optional_index(objects_of(root, "images")[image], (Place() / "images")[image],
                          "bufferView", objects_of(root, "bufferViews").size(), "bufferView");
}

glint_texture_use read_texture_info(const json &root, const json &info, const Place &place,
                                    std::vector<Note> &notes)
{
    const json &textures = objects_of(root, "textures");
    const std::ptrdiff_t index = optional_index(info, place, "index", textures.size(), "texture");
    if (index < 0) {
        refuse(place, "no index of a texture");
    }
    const Place texture_place = (Place() / "textures")[static_cast<std::size_t>(index)];
    const json &texture = textures[static_cast<std::size_t>(index)];
    glint_texture_use use = {};
    use.image = static_cast<std::uint32_t>(image_of(root, texture, texture_place)) + 1;
    std::uint64_t texcoord = texcoord_of(info, place);
    if (const json *transform = extension_of(info, place, transform_name)) {
        const Place at = place / "extensions" / transform_name;
        read_transform(*transform, at, use.transform);
        texcoord =
            member(*transform, "texCoord") != nullptr ? texcoord_of(*transform, at) : texcoord;
    }
    if (texcoord > 1) {
        refuse(place, "TEXCOORD_" + std::to_string(texcoord) + " is not read (use set 0 or 1)");
    }
    use.texcoord = static_cast<int>(texcoord);
    try {
        const json &samplers = objects_of(root, "samplers");
        const std::ptrdiff_t sampler =
            optional_index(texture, texture_place, "sampler", samplers.size(), "sampler");
        if (sampler >= 0) {
            const auto number = static_cast<std::size_t>(sampler);
            glint_texture_use sampled = use;
            read_sampler(samplers[number], (Place() / "samplers")[number], sampled);
            use = sampled;
        }
    } catch (const refusal &fault) {
        notes.push_back({fault.where(), fault.cause() + "; glTF's default sampler is used"});
    }
    return use;
}

void write_images(const json &root, const Model &model, Writer &writer)
{
    const json &images = objects_of(root, "images");
    std::vector<bool> is_named(images.size());
    for (const glint_document_material &row : writer.materials) {
        for (const glint_texture_use &use : row.material.textures) {
            if (use.image != 0) {
                is_named[use.image - 1] = true;
            }
        }
    }
    for (std::size_t i = 0; i < images.size(); i++) {
        glint_document_image &row = writer.images.emplace_back();
        if (!is_named[i]) {
            continue;
        }
        row.shown = writer.text(image_name(images[i], (Place() / "images")[i]));
        try {
            find_image(root, model, i, writer, row);
        } catch (const refusal &fault) {
            row.fault = writer.text(fault.cause());
        }
    }
}

} // namespace glint
