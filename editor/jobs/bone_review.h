#pragma once

// How the bones of an imported figure were assigned to joints of H-Anim, so that a user can check
// and correct it.

#include <optional>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "editor/import/model/bone_map.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct BoneRow {
  std::string joint;  // An H-Anim joint.
  std::string bone;   // The bone in the file; empty: none was found.
  std::optional<import::FoundBy> found_by;
  float confidence = 1.0f;  // 0..1
  std::string problem;      // Why the assignment is doubtful; empty: it is not.
};

struct BoneReview {
  // Joints that were found, from the root; then those that are missing.
  std::vector<BoneRow> rows;
  std::vector<std::string> bones;   // All bones of the file that can be assigned.
  std::vector<std::string> others;  // Bones that are not assigned to a joint.
  import::BoneNames map;            // The content of a saved bone map.
  std::vector<std::string> notes;   // Guesses and omissions of the import.
  bool is_human = false;
};

// Reads the model again, with the member's bone map.
Result<BoneReview> ReviewBones(const ProjectPaths& paths, const CastDocument& member);

// Assigns a bone to a joint by hand. bone: empty: the figure has no such joint; nullopt: as the
// import finds it. A bone belongs to one joint, so another joint that has it loses it.
void ChooseBone(const std::string& joint,
                const std::optional<std::string>& bone,
                CastDocument& member);

// The file of a member's bone map. SaveBoneMap() writes the import's result and the manual
// assignments into it.
std::filesystem::path BoneMapFile(const ProjectPaths& paths, const CastDocument& member);
Status SaveBoneMap(const ProjectPaths& paths, const CastDocument& member, const BoneReview& review);

}  // namespace lararium::editor
