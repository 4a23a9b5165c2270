// Checks and reads textures, and decodes their images. See gltf_texture.hpp.
#include "scene/gltf_texture.hpp"

#include "base/free_memory.h"
#include "base/parallel.h"

#include <algorithm>
#include <cerrno>
#include <cfloat>
#include <cmath>
#include <cstring>

namespace glint
{

namespace
{

const char *const transform_name = "KHR_texture_transform";

// Extensions that name another image than `source`, in a format that glint reads. The file may also
// have `source`, for programs that do not read this format.
const std::array<const char *, 2> sources = {"EXT_texture_webp", "MSFT_texture_dds"};

void check_image(const Document &document, const json &image, const Place &place)
{
    const json *uri = member(image, "uri");
    std::size_t views = objects_of(document.root, "bufferViews").size();
    std::ptrdiff_t view = optional_index(image, place, "bufferView", views, "bufferView");
    optional_text(image, place, "name");
    if (uri != nullptr) {
        check_uri(document, text_of(*uri, place / "uri"), place / "uri");
    } else if (view < 0 && optional_object(image, place, "extensions") == nullptr) {
        refuse(place, "neither a uri nor a bufferView (an image needs one)");
    }
}

struct Word {
    std::uint64_t code;
    const char *name;
};

void check_code(const json &object, const Place &place, const char *key,
                std::initializer_list<Word> words)
{
    const json *found = member(object, key);
    if (found == nullptr) {
        return;
    }
    std::uint64_t code = whole_number(*found, place / key, 0, largest_whole);
    std::string there;
    for (const Word &word : words) {
        if (word.code == code) {
            return;
        }
        there += (there.empty() ? "" : ", ") + std::to_string(word.code) + " " + word.name;
    }
    refuse(place / key, std::to_string(code) + " is none (there is " + there + ")");
}

constexpr std::uint64_t nearest = 9728, linear = 9729, nearest_mipmap_nearest = 9984,
                        linear_mipmap_nearest = 9985, nearest_mipmap_linear = 9986,
                        linear_mipmap_linear = 9987, clamp_to_edge = 33071, mirrored_repeat = 33648,
                        repeat = 10497;

void check_sampler(const json &sampler, const Place &place)
{
    check_code(sampler, place, "magFilter", {{nearest, "nearest"}, {linear, "linear"}});
    check_code(sampler, place, "minFilter",
               {{nearest, "nearest"},
                {linear, "linear"},
                {nearest_mipmap_nearest, "nearest mipmap nearest"},
                {linear_mipmap_nearest, "linear mipmap nearest"},
                {nearest_mipmap_linear, "nearest mipmap linear"},
                {linear_mipmap_linear, "linear mipmap linear"}});
    for (const char *key : {"wrapS", "wrapT"}) {
        check_code(sampler, place, key,
                   {{clamp_to_edge, "clamp to edge"},
                    {mirrored_repeat, "mirrored repeat"},
                    {repeat, "repeat"}});
    }
}

void check_texture(const json &root, const json &texture, const Place &place)
{
    std::size_t images = objects_of(root, "images").size();
    optional_index(texture, place, "source", images, "image");
    optional_index(texture, place, "sampler", objects_of(root, "samplers").size(), "sampler");
    for (const char *name : sources) {
        if (const json *other = extension_of(texture, place, name)) {
            optional_index(*other, place / "extensions" / name, "source", images, "image");
        }
    }
}

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

glint_wrap wrap_of(const json &sampler, const char *key)
{
    const json *found = member(sampler, key);
    const std::uint64_t code = found != nullptr ? found->get<std::uint64_t>() : repeat;
    return code == clamp_to_edge     ? GLINT_WRAP_CLAMP
           : code == mirrored_repeat ? GLINT_WRAP_MIRROR
                                     : GLINT_WRAP_REPEAT;
}

void read_sampler(const json &sampler, glint_texture_use &use)
{
    const json *large = member(sampler, "magFilter"), *small = member(sampler, "minFilter");
    const std::uint64_t magnified = large != nullptr ? large->get<std::uint64_t>() : linear;
    const std::uint64_t minified =
        small != nullptr ? small->get<std::uint64_t>() : linear_mipmap_linear;
    use.wrap_s = wrap_of(sampler, "wrapS");
    use.wrap_t = wrap_of(sampler, "wrapT");
    use.magnified_nearest = magnified == nearest;
    use.minified_nearest = minified == nearest || minified == nearest_mipmap_nearest ||
                           minified == nearest_mipmap_linear;
    use.mips = minified == nearest || minified == linear ? GLINT_MIP_NONE
               : minified == nearest_mipmap_nearest || minified == linear_mipmap_nearest
                   ? GLINT_MIP_NEAREST
                   : GLINT_MIP_LINEAR;
}

// Returns the image of a texture; −1: it names no image that glint reads.
std::ptrdiff_t image_of(const json &root, const json &texture)
{
    std::size_t images = objects_of(root, "images").size();
    for (const char *name : sources) {
        const json *other = extension_of(texture, Place(), name);
        std::ptrdiff_t image =
            other == nullptr ? -1 : optional_index(*other, Place(), "source", images, "image");
        if (image >= 0) {
            return image;
        }
    }
    return optional_index(texture, Place(), "source", images, "image");
}

// ---- Images -------------------------------------------------------------------------------------

// The bytes of an image, or its path; and its name in messages.
struct ImageData {
    std::string name, path;
    Bytes decoded; // the bytes of a data URI
    const unsigned char *bytes = nullptr;
    std::size_t size = 0;
};

// Finds an image; throws a refusal if there is none.
ImageData find_image(const Document &document, const Model &model, std::size_t index)
{
    const json &image = objects_of(document.root, "images")[index];
    const Place place = (Place() / "images")[index];
    const std::string title = optional_text(image, place, "name");
    ImageData data;
    data.name = place.text() + (title.empty() ? "" : " " + in_quotes(title));
    const json *uri = member(image, "uri");
    const std::ptrdiff_t view = optional_index(
        image, place, "bufferView", objects_of(document.root, "bufferViews").size(), "bufferView");
    if (uri != nullptr && is_data_uri(uri->get_ref<const std::string &>())) {
        data.decoded = decode_data_uri(uri->get_ref<const std::string &>(), place / "uri");
        data.bytes = data.decoded.data();
        data.size = data.decoded.size();
    } else if (uri != nullptr) {
        const std::string &text = uri->get_ref<const std::string &>();
        data.name += (title.empty() ? " " : ", ") + in_quotes(text);
        data.path = find_uri(document.folder, text, place / "uri");
        if (data.path.empty()) {
            throw refusal(data.name + ": cannot be opened: " + std::strerror(errno));
        }
    } else if (view >= 0) {
        const tinygltf::BufferView &bytes = model.bufferViews[static_cast<std::size_t>(view)];
        const tinygltf::Buffer &buffer = model.buffers[static_cast<std::size_t>(bytes.buffer)];
        data.bytes = buffer.data.data() + bytes.byteOffset;
        data.size = bytes.byteLength;
    } else {
        refuse(place, "neither a uri nor a bufferView");
    }
    return data;
}

// Returns an error's message without the name at its beginning.
std::string cause_in(const glint_error &error, const std::string &name)
{
    const std::string text = error.message;
    return text.compare(0, name.size() + 2, name + ": ") == 0 ? text.substr(name.size() + 2) : text;
}

struct Work {
    const Document *document;
    const Model *model;
    const std::vector<ImageUse> *uses;
    int largest;
    int threads; // threads per image
    std::vector<glint_texture_levels> levels;
    std::vector<std::string> faults;
    bool is_short = false; // memory is short
};

void read_image(Work &work, std::size_t i)
{
    const ImageUse &use = (*work.uses)[i];
    const ImageData data = find_image(*work.document, *work.model, use.image);
    glint_texture_request request = {};
    request.is_color = use.is_color;
    request.is_coverage = use.is_coverage;
    request.threads = work.threads;
    glint_error error = {};
    const std::string &called = data.path.empty() ? data.name : data.path;
    glint_status status =
        data.path.empty() ? glint_image_find_source_in_memory(called.c_str(), data.bytes, data.size,
                                                              &request.source, &error)
                          : glint_image_find_source(called.c_str(), &request.source, &error);
    if (status == GLINT_OK) {
        status = glint_texture_read(&request, work.largest, &work.levels[i], &error);
    }
    if (status != GLINT_OK) {
        work.is_short = work.is_short || status == GLINT_OUT_OF_MEMORY;
        work.faults[i] = data.name + ": " + cause_in(error, called);
    }
}

// Exceptions must not pass through the C code of the threads.
void read_image_in_thread(std::size_t i, void *context)
{
    Work &work = *static_cast<Work *>(context);
    try {
        read_image(work, i);
    } catch (const std::bad_alloc &) {
        work.is_short = true;
    } catch (const std::exception &fault) {
        work.faults[i] = fault.what();
    }
}

} // namespace

const std::array<TextureSlot, 19> &texture_slots()
{
    static const std::array<TextureSlot, 19> slots = {{
        {"pbrMetallicRoughness", "baseColorTexture", GLINT_TEXTURE_BASE_COLOR, true},
        {"pbrMetallicRoughness", "metallicRoughnessTexture", GLINT_TEXTURE_METALLIC_ROUGHNESS,
         false},
        {nullptr, "normalTexture", GLINT_TEXTURE_NORMAL, false},
        {nullptr, "occlusionTexture", GLINT_TEXTURE_OCCLUSION, false},
        {nullptr, "emissiveTexture", GLINT_TEXTURE_EMISSION, true},
        {"KHR_materials_transmission", "transmissionTexture", GLINT_TEXTURE_TRANSMISSION, false},
        {"KHR_materials_specular", "specularTexture", GLINT_TEXTURE_SPECULAR, false},
        {"KHR_materials_specular", "specularColorTexture", GLINT_TEXTURE_SPECULAR_COLOR, true},
        {"KHR_materials_clearcoat", "clearcoatTexture", GLINT_TEXTURE_CLEARCOAT, false},
        {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", GLINT_TEXTURE_CLEARCOAT_ROUGHNESS,
         false},
        {"KHR_materials_clearcoat", "clearcoatNormalTexture", GLINT_TEXTURE_CLEARCOAT_NORMAL,
         false},
        {"KHR_materials_anisotropy", "anisotropyTexture", GLINT_TEXTURE_ANISOTROPY, false},
        {"KHR_materials_sheen", "sheenColorTexture", GLINT_TEXTURE_SHEEN_COLOR, true},
        {"KHR_materials_sheen", "sheenRoughnessTexture", GLINT_TEXTURE_SHEEN_ROUGHNESS, false},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture",
         GLINT_TEXTURE_DIFFUSE_TRANSMISSION, false},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture",
         GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR, true},
        {"KHR_materials_iridescence", "iridescenceTexture", GLINT_TEXTURE_IRIDESCENCE, false},
        {"KHR_materials_iridescence", "iridescenceThicknessTexture",
         GLINT_TEXTURE_IRIDESCENCE_THICKNESS, false},
        {"KHR_materials_pbrSpecularGlossiness", "diffuseTexture", GLINT_TEXTURE_BASE_COLOR, true},
    }};
    return slots;
}

void check_textures(const Document &document)
{
    const json &root = document.root;
    const json &images = objects_of(root, "images"), &samplers = objects_of(root, "samplers");
    const json &textures = objects_of(root, "textures");
    for (std::size_t i = 0; i < images.size(); i++) {
        check_image(document, images[i], (Place() / "images")[i]);
    }
    for (std::size_t i = 0; i < samplers.size(); i++) {
        check_sampler(samplers[i], (Place() / "samplers")[i]);
    }
    for (std::size_t i = 0; i < textures.size(); i++) {
        check_texture(root, textures[i], (Place() / "textures")[i]);
    }
}

void check_texture_info(const json &root, const json &info, const Place &place)
{
    if (member(info, "index") == nullptr) {
        refuse(place / "index", "missing (glTF 2.0 requires it)");
    }
    index_of(info["index"], place / "index", objects_of(root, "textures").size(), "texture");
    texcoord_of(info, place);
    if (const json *transform = extension_of(info, place, transform_name)) {
        const Place at = place / "extensions" / transform_name;
        float unused[6];
        read_transform(*transform, at, unused);
        texcoord_of(*transform, at);
    }
}

glint_texture_use read_texture_info(const json &root, const json &info, std::ptrdiff_t *image)
{
    glint_texture_use use = {};
    const json &texture = objects_of(root, "textures")[info["index"].get<std::size_t>()];
    *image = image_of(root, texture);
    use.texcoord = static_cast<int>(texcoord_of(info, Place()));
    if (const json *transform = extension_of(info, Place(), transform_name)) {
        read_transform(*transform, Place(), use.transform);
        if (member(*transform, "texCoord") != nullptr) {
            use.texcoord = static_cast<int>(texcoord_of(*transform, Place()));
        }
    }
    const json *sampler = member(texture, "sampler");
    if (sampler != nullptr) {
        read_sampler(objects_of(root, "samplers")[sampler->get<std::size_t>()], use);
    }
    return use;
}

std::uint32_t Images::number_of(const ImageUse &use)
{
    const auto added = numbers_.emplace(use, static_cast<std::uint32_t>(uses_.size() + 1));
    if (added.second) {
        uses_.push_back(use);
    }
    return added.first->second;
}

void Images::read(const Document &document, const Model &model, int largest)
{
    const int cores = glint_usable_cores(), images = static_cast<int>(uses_.size());
    Work work = {&document, &model, &uses_, largest, std::max(1, cores / std::max(1, images)),
                 {},        {},     false};
    work.levels.resize(uses_.size());
    work.faults.resize(uses_.size());
    glint_parallel_for(uses_.size(), read_image_in_thread, &work);
    glint_textures *joined = nullptr;
    const bool is_whole =
        !work.is_short && !uses_.empty() &&
        glint_textures_join(work.levels.data(), work.levels.size(), &joined, nullptr) == GLINT_OK;
    for (glint_texture_levels &levels : work.levels) {
        std::free(levels.texels);
    }
    if (!uses_.empty() && !is_whole) {
        throw shortage("not enough memory for its textures (give --texture-size)");
    }
    faults_ = std::move(work.faults);
    textures_.reset(joined);
}

} // namespace glint
