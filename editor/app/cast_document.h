#pragma once

// A member of the cast as the project writes it down.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

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

// At most one of recipe and model; with neither, the plain built-in figure.
struct CastDocument {
  std::string name;                          // as the drama calls the actor
  std::optional<import::CastRecipe> recipe;  // built from the cast library
  std::string model;                         // a figure that the editor imports
  std::string bone_map;  // of the model, where its bones were named by hand; may be empty
  std::vector<ClipDocument> clips;
  // Of the plain figure, which also stands in where the cast library is missing.
  double height = 1.72;                        // metres
  Eigen::Vector3d tunic = {0.60, 0.55, 0.45};  // linear RGB albedo
};

Result<CastDocument> ParseCastMember(const JsonView& view);
Json FormatCastMember(const CastDocument& member);

}  // namespace lararium::app
