#pragma once

// Functions by which several subcommands read their arguments.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/document/named_entries.h"
#include "editor/document/project.h"
#include "editor/text/command_result.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

// A position on the stage in metres, from three numbers.
Result<Eigen::Vector3d> ParsePosition(const std::string& option,
                                      const std::vector<double>& numbers);

// The rotation for a heading, optionally followed by tilt and roll; degrees.
Eigen::Quaterniond RotationOf(const std::vector<double>& degrees);

// Describes a pose in the form that options accept, to the millimetre and tenth of a degree:
// "at 1.000,0.000,-2.000, turned 90.0,0.0,0.0 degrees, scaled by 0.5000". Omits an identity
// rotation and a scale of 1.
std::string DescribePose(const geometry::Similarity3& stage_from_thing);
// The part of DescribePose for the rotation.
std::string DescribeTurn(const Eigen::Quaterniond& rotation);

// Parses the complete text as one number; nullopt if it is not a number.
std::optional<double> ParseNumber(std::string_view text);

// Finds a keyframe in the map of a place. Errors name `option`.
Result<const vision::Keyframe*> FindKeyframe(const vision::SceneDatabase& map,
                                             const std::string& where,
                                             const std::string& frame,
                                             uint32_t session);

// A pixel in a training image of a place.
Result<stage::Pick> PickInImage(const vision::SceneDatabase& map,
                                const std::string& where,
                                const std::string& frame,
                                uint32_t session,
                                const Eigen::Vector2d& pixel);

// Parses a pick from "FRAME,x,y"; the name of the frame may contain commas.
Result<stage::Pick> ParsePick(const vision::SceneDatabase& map,
                              const std::string& where,
                              uint32_t session,
                              const std::string& option,
                              const std::string& text);

// Runs Worker on the project that options name. A title of a place becomes the place's name.
template <typename Worker, typename Options>
Result<CommandResult> RunOnProject(Options options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  if (!options.place.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(options.place, ChoosePlace(paths, document, options.place));
  }
  return Worker(paths, std::move(document), options).Run();
}

}  // namespace lararium::editor
