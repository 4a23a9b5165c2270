// A checked document, loaded by tinygltf. The one file that holds its code. See gltf_model.hpp.
#define TINYGLTF_IMPLEMENTATION
#include "scene/gltf_model.hpp"

#include <climits>

namespace glint
{

namespace
{

void copy_whole(const json &from, json &to, const char *key)
{
    const json *found = member(from, key);
    if (found != nullptr) {
        to[key] = found->is_number_unsigned() ? found->get<std::uint64_t>()
                                              : static_cast<std::uint64_t>(found->get<double>());
    }
}

void copy_wholes(const json &from, json &to, const char *key)
{
    const json *found = member(from, key);
    if (found != nullptr) {
        json &array = to[key] = json::array();
        for (const json &value : *found) {
            array.push_back(static_cast<std::uint64_t>(value.get<double>()));
        }
    }
}

void copy_as_is(const json &from, json &to, const char *key)
{
    const json *found = member(from, key);
    if (found != nullptr) {
        to[key] = *found;
    }
}

json reduced_storage(const json &root)
{
    json result;
    result["asset"] = {{"version", "2.0"}};
    json &buffers = result["buffers"] = json::array();
    for (const json &buffer : objects_of(root, "buffers")) {
        json reduced;
        copy_whole(buffer, reduced, "byteLength");
        reduced["uri"] = std::to_string(buffers.size()); // what the callback is asked for
        buffers.push_back(std::move(reduced));
    }
    json &views = result["bufferViews"] = json::array();
    for (const json &view : objects_of(root, "bufferViews")) {
        json reduced;
        for (const char *key : {"buffer", "byteOffset", "byteLength", "byteStride"}) {
            copy_whole(view, reduced, key);
        }
        views.push_back(std::move(reduced));
    }
    // tinygltf refuses indices without a view, which are zeros. Accessors without one get a last
    // view, that nobody reads: an index past the document's own views means zeros.
    std::size_t no_view = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    json &accessors = result["accessors"] = json::array();
    for (const json &accessor : objects_of(root, "accessors")) {
        json reduced = {{"bufferView", no_view}};
        for (const char *key : {"bufferView", "byteOffset", "componentType", "count"}) {
            copy_whole(accessor, reduced, key);
        }
        copy_as_is(accessor, reduced, "type");
        copy_as_is(accessor, reduced, "normalized");
        if (const json *sparse = member(accessor, "sparse")) {
            json &part = reduced["sparse"];
            copy_whole(*sparse, part, "count");
            for (const char *key : {"bufferView", "byteOffset", "componentType"}) {
                copy_whole((*sparse)["indices"], part["indices"], key);
                copy_whole((*sparse)["values"], part["values"], key);
            }
        }
        accessors.push_back(std::move(reduced));
    }
    return result;
}

void add_meshes(const json &root, json &result)
{
    json &meshes = result["meshes"] = json::array();
    for (const json &mesh : objects_of(root, "meshes")) {
        json reduced;
        json &primitives = reduced["primitives"] = json::array();
        for (const json &primitive : mesh["primitives"]) {
            json part;
            for (const char *key : {"indices", "material", "mode"}) {
                copy_whole(primitive, part, key);
            }
            json &attributes = part["attributes"] = json::object();
            copy_whole(primitive["attributes"], attributes, "POSITION");
            copy_whole(primitive["attributes"], attributes, "NORMAL");
            primitives.push_back(std::move(part));
        }
        meshes.push_back(std::move(reduced));
    }
}

void add_graph(const json &root, json &result)
{
    json &nodes = result["nodes"] = json::array();
    for (const json &node : objects_of(root, "nodes")) {
        json reduced = json::object();
        copy_whole(node, reduced, "mesh");
        copy_whole(node, reduced, "camera");
        copy_wholes(node, reduced, "children");
        for (const char *key : {"name", "matrix", "translation", "rotation", "scale"}) {
            copy_as_is(node, reduced, key);
        }
        nodes.push_back(std::move(reduced));
    }
    json &scenes = result["scenes"] = json::array();
    for (const json &scene : objects_of(root, "scenes")) {
        json reduced = json::object();
        copy_as_is(scene, reduced, "name");
        copy_wholes(scene, reduced, "nodes");
        scenes.push_back(std::move(reduced));
    }
    copy_whole(root, result, "scene");
    json &cameras = result["cameras"] = json::array();
    for (const json &camera : objects_of(root, "cameras")) {
        json reduced;
        copy_as_is(camera, reduced, "name");
        copy_as_is(camera, reduced, "type");
        // What is required besides, and not used: near and far planes do not clip.
        if (camera["type"] == "perspective") {
            reduced["perspective"] = {{"yfov", camera["perspective"]["yfov"]}, {"znear", 0.1}};
        } else {
            reduced["orthographic"] = {
                {"xmag", 1}, {"ymag", camera["orthographic"]["ymag"]}, {"znear", 0}, {"zfar", 1}};
        }
        cameras.push_back(std::move(reduced));
    }
}

// The callbacks hand over what read_buffers has read: "buffers/3" is the third.
bool buffer_exists(const std::string &, void *)
{
    return true;
}

std::string same_path(const std::string &path, void *)
{
    return path;
}

bool take_buffer(std::vector<unsigned char> *out, std::string *, const std::string &path,
                 void *user_data)
{
    auto *buffers = static_cast<std::vector<Bytes> *>(user_data);
    std::size_t index = std::stoul(path.substr(path.rfind('/') + 1));
    if (index >= buffers->size()) {
        return false;
    }
    *out = std::move((*buffers)[index]);
    return true;
}

} // namespace

void load_model(Document &document, tinygltf::Model &model)
{
    json reduced = reduced_storage(document.root);
    add_meshes(document.root, reduced);
    add_graph(document.root, reduced);
    std::string text = reduced.dump();
    reduced = nullptr;
    if (text.size() > UINT_MAX) {
        throw refusal("more than 4 GiB of JSON (split the scene)");
    }
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({&buffer_exists, &same_path, &take_buffer, nullptr, &document.buffers});
    std::string trouble;
    std::string warning;
    bool loaded = loader.LoadASCIIFromString(&model, &trouble, &warning, text.c_str(),
                                             static_cast<unsigned int>(text.size()), "buffers");
    // It drops some of what it cannot use without a word; indices would then point elsewhere.
    bool whole = model.accessors.size() == objects_of(document.root, "accessors").size() &&
                 model.meshes.size() == objects_of(document.root, "meshes").size() &&
                 model.nodes.size() == objects_of(document.root, "nodes").size() &&
                 model.cameras.size() == objects_of(document.root, "cameras").size();
    for (std::size_t i = 0; whole && i < model.meshes.size(); i++) {
        whole = model.meshes[i].primitives.size() ==
                objects_of(document.root, "meshes")[i]["primitives"].size();
    }
    if (!loaded || !whole) {
        throw refusal("cannot be loaded: " + trouble.substr(0, trouble.find('\n')) +
                      " (export it again)");
    }
}

} // namespace glint
