#pragma once

// Imports clips of other programs for our people.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/import/model/bone_map.h"
#include "editor/import/motion/retarget.h"
#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::import {

struct ClipImportOptions {
  std::string source_clip;  // Name of the clip in the file; if empty, the longest.
  BoneNames bones;          // A saved map of the skeleton in the file.
  // Motion capture files often begin with one key in another pose (arms spread) for
  // calibration.
  bool drop_calibration = true;
  RetargetOptions retarget;
};

struct ImportedClip {
  human::Clip clip;  // The clip for the target skeleton.
  BoneNames bones;
  std::string bone_table;
  std::vector<std::string> notes;
};

// Reads BVH, FBX, glTF or VRM and retargets. Errors name the file; if the clip does not exist,
// they list the clips of the file.
Result<ImportedClip> ImportClip(const std::filesystem::path& file,
                                const human::Skeleton& target,
                                const ClipImportOptions& options = {});

// Adds a clip to a person and replaces one with the same name.
Status AddClip(human::Clip clip, human::Human& person);

}  // namespace lararium::import
