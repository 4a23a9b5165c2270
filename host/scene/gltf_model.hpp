// A checked document, loaded by tinygltf.
#ifndef GLINT_SCENE_GLTF_MODEL_HPP
#define GLINT_SCENE_GLTF_MODEL_HPP

#include "scene/gltf_file.hpp"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_FS
#include <fstream> // which tinygltf leaves out without its file functions, and uses all the same
#include <tiny_gltf.h>

namespace glint
{

// Takes document.buffers. tinygltf is given a document of its own, written from the checked one and
// holding only what the loader uses of it: buffers, views, accessors, meshes with positions and
// normals, nodes, scenes and cameras. So nothing reaches it that nobody has checked (images,
// extensions, extras, doubled keys, whole numbers written as 3.0), and it opens no file.
void load_model(Document &document, tinygltf::Model &model);

} // namespace glint

#endif
