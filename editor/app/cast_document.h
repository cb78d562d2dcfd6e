#pragma once

// A member of the cast as the project writes it down.

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/bake/speech_synthesis.h"
#include "editor/import/bone_map.h"
#include "editor/import/cast_recipe.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::app {

// Of the plain figure, metres.
inline constexpr double kMinHeight = 0.8;
inline constexpr double kMaxHeight = 2.2;

// A recorded motion that is carried over to the figure.
struct ClipDocument {
  std::string name;  // as the drama calls it
  std::string file;  // BVH, FBX or glTF
  bool loops = false;
};

// At most one of preset, recipe and model; without any, the plain built-in figure.
struct CastDocument {
  std::string name;                          // as the drama calls the actor
  std::string preset;                        // one of import::CastPresetNames()
  std::optional<import::CastRecipe> recipe;  // as the preset, but this project's own
  std::string model;                         // a figure that the editor imports
  std::string bone_map;  // of the model, where its bones were named by hand; may be empty
  // Joints of the model named in the window, on top of the bone map: import::BoneNames.
  import::BoneNames bones;
  std::vector<ClipDocument> clips;
  bake::VoiceSettings voice;  // where lines are not recorded
  // Of the plain figure, which also stands in where the cast library is missing.
  double height = 1.72;                        // metres
  Eigen::Vector3d tunic = {0.60, 0.55, 0.45};  // linear RGB albedo
};

// The recipe that the member is built by; nothing where it is no person of the cast
// library. Fails where there is no such preset.
Result<std::optional<import::CastRecipe>> RecipeOf(const CastDocument& member);

// What was said by hand about the model's bones: its bone map's file, if it names one, and
// its own names over that.
Result<import::BoneNames> GivenBoneNames(const std::filesystem::path& bone_map,
                                         const import::BoneNames& bones);

// {"variant", "pitch", "range", "rate"}, each of which may be missing.
Result<bake::VoiceSettings> ParseVoice(const JsonView& view);
Json FormatVoice(const bake::VoiceSettings& voice);

Result<CastDocument> ParseCastMember(const JsonView& view);
Json FormatCastMember(const CastDocument& member);

}  // namespace lararium::app
