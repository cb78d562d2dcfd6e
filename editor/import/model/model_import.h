#pragma once

// Imports figures and meshes from files of other programs (glTF 2.0, VRM, FBX, Collada, OBJ,
// BVH). Any file gives a value or a Status that names it: its reader runs in a child process
// with limits on memory and time, so that a crash or hang is an error too, and the result of
// the child is validated.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/import/model/bone_map.h"
#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/human/human.h"

namespace lararium::import {

struct ImportOptions {
  std::string name;     // Name of the human; if empty, that of the file.
  std::string credits;  // authors and licence of the file
  BoneNames bones;      // A saved map; for the joints in it, no other source is used.
  // If empty, the unit in the file if it gives a plausible height, otherwise one that does.
  std::optional<float> metres_per_unit;
  float keys_per_second = 30.0f;  // Rate at which clips are resampled.
  bool in_child_process = true;   // False for tests that examine the reader itself.
};

struct ImportedHuman {
  human::Human human;
  std::vector<glm::vec3> emissions;  // Linear radiance that each material of a thing emits.
  BoneNames bones;                   // The map that was used; SaveBoneNames stores it.
  bool is_human = false;             // Legs, arms and head were found.
  std::string bone_table;            // Text for people: joint, bone, how it was found, confidence.
  std::vector<NamedBone> joints;     // The same data for programs.
  std::vector<std::string> bone_names;  // All bones that a map can name.
  std::vector<std::string> notes;       // Guesses, and parts that were left out.
};

// Imports a skinned figure in the actor frame: metres, Y up, facing -Z, soles at 0, for any
// axes and units of the file. The rest pose is the bind pose; joint frames are parallel to the
// actor's; joints have H-Anim names if the bone map knows them, otherwise their own. Keeps the
// four largest skin weights, normalised; parts fixed to a joint are skinned with weight 1.
// Textures are base colour and normal map, embedded or beside the file, converted to PNG or
// JPEG of at most 2048 pixels a side. Also imports morph targets and the face made from them
// (model_expressions.h), the springs and colliders of VRM, and clips with their stride.
Result<ImportedHuman> ImportPerson(const std::filesystem::path& file,
                                   const ImportOptions& options = {});

// Imports only the human of ImportPerson.
Result<human::Human> ImportHuman(const std::filesystem::path& file,
                                 const ImportOptions& options = {});

// Imports a rigid thing as a person whose joints are its parts, in the pose in which the file shows
// its nodes, without clips, morph targets and springs. `has_parts`: nodes become parts; otherwise
// it is of one part. `options.bones` is not used.
Result<ImportedHuman> ImportThing(const std::filesystem::path& file,
                                  bool has_parts,
                                  const ImportOptions& options = {});

// Imports only the skeleton and the clips, in the same frame, from a file with or without
// meshes (BVH, FBX). Clips keep their root motion.
Result<ImportedHuman> ImportMotion(const std::filesystem::path& file,
                                   const ImportOptions& options = {});

// Imports all meshes of the file as one, transformed by their nodes, or by their bones at rest, in
// the axes and units of the file. What the reader guessed or left out is added to `notes`.
Result<geometry::TriangleMesh> ImportMesh(const std::filesystem::path& file,
                                          std::vector<std::string>& notes);

}  // namespace lararium::import
