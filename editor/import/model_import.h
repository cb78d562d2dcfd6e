#pragma once

// Figures and meshes from other programs' files (glTF 2.0, VRM, FBX, Collada, OBJ, BVH).
// Whatever such a file holds, the answer is a value or a Status that names the file:
// assimp's readers run in a child process with bounds on memory and time, so that one
// that crashes or hangs is an error too, and what the child hands back is checked anew.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/import/bone_map.h"
#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/human/human.h"

namespace lararium::import {

struct ImportOptions {
  std::string name;     // of the human; empty: the file's
  std::string credits;  // authors and licence of the file
  BoneNames bones;      // a saved map: where it names a joint, nothing else is asked
  // Empty: as the file says, where that gives a person of possible height; else what does.
  std::optional<float> metres_per_unit;
  float keys_per_second = 30.0f;  // at which clips are resampled
  bool in_child_process = true;   // false: for tests that look into the reader itself
};

struct ImportedHuman {
  human::Human human;
  BoneNames bones;                      // the map that was used; SaveBoneNames keeps it
  bool is_human = false;                // legs, arms and head were found
  std::string bone_table;               // for people: joint, bone, how found, how sure
  std::vector<NamedBone> joints;        // the same, for programs
  std::vector<std::string> bone_names;  // all that a map can name
  std::vector<std::string> notes;       // what was guessed or left out
};

// A skinned figure in the actor frame: metres, Y up, facing -Z, soles at 0, whatever the
// file's axes and units. The rest pose is the bind pose; joint frames are parallel to the
// actor's; joints bear H-Anim's names where the bone map knows them, their own otherwise.
// Skin weights: the four largest, normalised. Parts fixed to a joint are skinned with
// weight 1. Textures: base colour and normal map, embedded or beside the file, as PNG or
// JPEG of at most 2048 pixels a side. Morph targets, and the face that they give
// (model_expressions.h); VRM's springs and colliders; clips with their stride.
Result<ImportedHuman> ImportPerson(const std::filesystem::path& file,
                                   const ImportOptions& options = {});

// The human of ImportPerson.
Result<human::Human> ImportHuman(const std::filesystem::path& file,
                                 const ImportOptions& options = {});

// The skeleton and the clips alone, in the same frame, of a file with or without meshes
// (BVH, FBX). Clips keep where they go: nothing is taken out of their root.
Result<ImportedHuman> ImportMotion(const std::filesystem::path& file,
                                   const ImportOptions& options = {});

// Every mesh of the file in one, moved by its nodes' transforms; axes and units
// as in the file.
Result<geometry::TriangleMesh> ImportMesh(const std::filesystem::path& file);

}  // namespace lararium::import
