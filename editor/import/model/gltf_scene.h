#pragma once

// Reads glTF 2.0 to a scene of assimp, whose own reader refuses valid files and ignores
// interpolation and transforms of textures. Internal to editor/import: only code in the child
// process of model_isolation reads foreign files with it.

#include <assimp/scene.h>

#include <memory>
#include <string>
#include <vector>

#include "editor/import/model/model_gltf.h"

namespace lararium::import {

// Most vertices of a model, in all its parts.
inline constexpr size_t kMaxVertices = 2'000'000;

// What was guessed or is not taken over: of nodes, meshes and clips, and of materials.
struct GltfNotes {
  std::vector<std::string> structure, surface;
};

// Node i of the document is named "n<i>", and mesh i "m<i>" or, if it has several primitives,
// "m<i>-<primitive>". The scene holds the nodes of the document's default scene, and the joints
// of their skins wherever they are. Triangles without normals are flat; a mesh has its default
// morph weights. Curves become straight pieces between keys. What is not taken over is listed in
// `notes`. Errors: missing or damaged data; each names `where` and the location in the file.
Result<std::unique_ptr<aiScene>> ReadGltfScene(const GltfDocument& document,
                                               const std::string& where,
                                               GltfNotes& notes);

}  // namespace lararium::import
