#pragma once

// Figures and meshes from other programs' files (glTF 2.0, FBX, Collada, OBJ),
// read through assimp. Whatever such a file holds, the answer is a value or a
// Status that names the file.

#include <filesystem>
#include <string>

#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/human/human.h"

namespace lararium::import {

struct ImportOptions {
  std::string name;     // of the human; empty: the file's
  std::string credits;  // authors and licence of the file
  // Most glTF figures face +Z and are turned to face -Z, as our actors do.
  bool faces_positive_z = true;
  float metres_per_unit = 1.0f;   // 0.01 for files in centimetres
  float keys_per_second = 30.0f;  // at which clips are resampled
};

// A skinned figure: skeleton, skinned parts, parts fixed to a joint (as skinned
// with weight 1), base colours as albedo, clips. Joint names become H-Anim's
// where they are known synonyms. Reads files that are Y-up and in metres, as glTF
// demands. Textures are not read: a part takes its material's base colour, times
// the vertex colours where there are some.
Result<human::Human> ImportHuman(const std::filesystem::path& file,
                                 const ImportOptions& options = {});

// Every mesh of the file in one, moved by its nodes' transforms; axes and units
// as in the file.
Result<geometry::TriangleMesh> ImportMesh(const std::filesystem::path& file);

}  // namespace lararium::import
