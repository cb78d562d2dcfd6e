#pragma once

// Verifies that the stage lies at a place as it does at the others. Check points, known in stage
// metres, are picked in the place's images; the position that the picks give is compared with the
// known one. The picks that tie the stage to the place are not used.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/json.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

// With fewer points the rotation of the stage is not determined.
inline constexpr size_t kFewestCheckPoints = 3;

// The error that visitors would notice: half a percent of the width of the place's images.
double CheckTolerancePx(const geometry::CameraModel& camera);

// Root mean square distance, pixels, from an anchor's picks to the projections of a point, map
// units, into their images. Very large where an image does not see the point.
double SeenOff(const stage::Anchor& anchor,
               const Eigen::Vector3d& point_in_map,
               const vision::SceneDatabase& map);

struct CheckPointReport {
  // kWeak: picked from almost one direction, so that the depth is not determined.
  enum class Verdict { kNotPicked, kNotLocated, kPicksDisagree, kWeak, kGood, kOff };
  std::string name;
  Verdict verdict = Verdict::kNotPicked;
  Eigen::Vector3d on_stage = Eigen::Vector3d::Zero();  // The known position, stage metres.
  Status problem;                                      // Why the point could not be located.
  std::string odd_frame;  // The image of a wrong pick, if the other picks reveal it.

  //
  // The following fields are set for a located point.
  stage::AnchorReport anchor;
  Eigen::Vector3d found = Eigen::Vector3d::Zero();  // The position from the picks, stage metres.
  double distance_m = 0.0;
  // Standard deviation of found, metres, for a pick error of one pixel.
  double deviation_m = 0.0;
  // Root mean square over the images of the picks: distance from the pick to the projection of the
  // known position.
  double distance_px = 0.0;

  bool located() const { return verdict >= Verdict::kPicksDisagree; }
};

struct CheckReport {
  enum class Verdict { kUnknown, kGood, kPoor };
  Verdict verdict = Verdict::kUnknown;
  std::vector<CheckPointReport> points;  // Same order as in the project.
  double tolerance_px = 0.0;
  int compared = 0;  // Number of points that are good or off. The values below refer to these.
  double rms_m = 0.0;
  double rms_px = 0.0;

  // A point that contradicts all others: a pick or its known position is wrong. Empty: there is
  // none, or it cannot be determined.
  std::string doubtful;
  // The stage that fits the points best, without the doubtful one; nullopt where it is not
  // determined.
  std::optional<geometry::Similarity3> map_from_stage;
  double fit_rms_m = 0.0;  // Error of the points in that stage.
  bool fit_good = false;   // All points are within the tolerance in that stage.
  // The change from the present stage to that one.
  double scale = 1.0;
  double turn = 0.0;     // Rotation angle, radians.
  double shift_m = 0.0;  // Displacement of the points' mean.
};

CheckReport CheckStaging(const ProjectDocument& document,
                         const PlaceDocument& place,
                         const vision::SceneDatabase& map,
                         const geometry::Similarity3& map_from_picked);

// The result and what to do, in one or two sentences.
Sentence CheckSentence(const CheckReport& report);
// CheckSentence() as text. translated: in the language of the interface; otherwise English.
std::string CheckAdvice(const CheckReport& report, bool translated);

// {"verdict", "points": [...], ...}; docs/file-formats.md.
Json CheckJson(const CheckReport& report);
// One line for each point, and the advice.
std::string CheckText(const CheckReport& report);

// The functions below find and edit picks.
//
// Returns the picks of a check point at a place; nullptr where there are none.
const stage::Anchor* FindCheckPicks(const PlaceDocument& place, std::string_view point);
void SetCheckPick(PlaceDocument& place, const std::string& point, const stage::Pick& pick);
void ClearCheckPicks(PlaceDocument& place, std::string_view point);
// Renames the check point and its picks at all places. The new name must not be in use.
void RenameCheckPoint(ProjectDocument& document, const std::string& from, const std::string& to);
void RemoveCheckPoint(ProjectDocument& document, const std::string& point);

}  // namespace lararium::editor
