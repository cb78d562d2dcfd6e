#pragma once

// A member of the cast, as the project file describes it.

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/bake/speech_synthesis.h"
#include "editor/import/cast/cast_recipe.h"
#include "editor/import/model/bone_map.h"
#include "shared/core/json_fields.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Limits for the height of the plain figure, metres.
inline constexpr double kMinHeight = 0.8;
inline constexpr double kMaxHeight = 2.2;

// A recorded motion that is retargeted to the figure.
struct ClipDocument {
  std::string name;  // The name that the drama uses.
  std::string file;  // BVH, FBX or glTF
  bool loops = false;
};

// At most one of preset, recipe and model is set. Without any: the plain built-in figure.
struct CastDocument {
  std::string name;                          // The name of the actor in the drama.
  std::string title;                         // The name in the interface; empty: as in the drama.
  std::string preset;                        // One of import::CastPresetNames().
  std::optional<import::CastRecipe> recipe;  // Like a preset, but stored in this project.
  std::string model;                         // The file of a figure that the editor imports.
  // The file that maps bones of the model to joints, if one was written by hand; may be empty.
  std::string bone_map;
  // Joints that were assigned in the window. They override those of bone_map.
  import::BoneNames bones;
  std::vector<ClipDocument> clips;
  bake::VoiceSettings voice;  // Used for lines that are not recorded.
  // Properties of the plain figure, which is also used where the cast library is missing.
  double height = 1.72;                        // Metres.
  Eigen::Vector3d tunic = {0.60, 0.55, 0.45};  // Linear RGB albedo.

  const std::string& label() const { return title.empty() ? name : title; }
};

// The recipe that builds the member; nullopt where it is not a person of the cast library. Fails
// where the preset is unknown.
Result<std::optional<import::CastRecipe>> RecipeOf(const CastDocument& member);

// The manual assignment of the model's bones: those of the bone map file, if there is one,
// overridden by the names in bones.
Result<import::BoneNames> GivenBoneNames(const std::filesystem::path& bone_map,
                                         const import::BoneNames& bones);

void DescribeVoice(Fields& fields, bake::VoiceSettings& voice);
void DescribeFields(Fields& fields, CastDocument& member);

}  // namespace lararium::editor
