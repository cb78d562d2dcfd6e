#pragma once

// How the bones of an imported figure were taken for joints of H-Anim, for people to look
// over and to correct.

#include <optional>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/import/bone_map.h"
#include "shared/core/status.h"

namespace lararium::app {

struct BoneRow {
  std::string joint;  // of H-Anim
  std::string bone;   // of the file; empty: none was found
  std::optional<import::FoundBy> found_by;
  float confidence = 1.0f;  // 0..1
  std::string problem;      // what is doubtful about it; empty: nothing
};

struct BoneReview {
  std::vector<BoneRow> rows;        // what was found, from the root; then what is missing
  std::vector<std::string> bones;   // of the file: what a joint can be
  std::vector<std::string> others;  // those that are no joint
  import::BoneNames map;            // what a saved map holds
  std::vector<std::string> notes;   // what the import guessed or left out
  bool is_human = false;
};

// Reads the model again, with its map as the member has it.
Result<BoneReview> ReviewBones(const ProjectPaths& paths, const CastDocument& member);

// bone: empty: there is no such joint; none: as it is found. Another joint that was given
// that bone by hand loses it.
void ChooseBone(const std::string& joint,
                const std::optional<std::string>& bone,
                CastDocument& member);

// Where the map of somebody is saved, and the file's content with what was said by hand.
std::filesystem::path BoneMapFile(const ProjectPaths& paths, const CastDocument& member);
Status SaveBoneMap(const ProjectPaths& paths, const CastDocument& member, const BoneReview& review);

}  // namespace lararium::app
