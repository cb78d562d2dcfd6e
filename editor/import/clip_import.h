#pragma once

// Clips of other programs' files for our people.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/import/bone_map.h"
#include "editor/import/retarget.h"
#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::import {

struct ClipImportOptions {
  std::string source_clip;  // which of the file's; empty: the longest
  BoneNames bones;          // a saved map of the file's skeleton
  // Captured files often begin with one key of another pose (arms spread), for calibration.
  bool drop_calibration = true;
  RetargetOptions retarget;
};

struct ImportedClip {
  human::Clip clip;  // for the skeleton that was given
  BoneNames bones;
  std::string bone_table;
  std::vector<std::string> notes;
};

// Reads BVH, FBX, glTF or VRM and retargets. Errors name the file; without a clip of the
// name asked for, they list those that are there.
Result<ImportedClip> ImportClip(const std::filesystem::path& file,
                                const human::Skeleton& target,
                                const ClipImportOptions& options = {});

// Adds a clip to a person, in place of one of that name.
Status AddClip(human::Clip clip, human::Human& person);

}  // namespace lararium::import
