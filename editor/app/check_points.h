#pragma once

// Whether the stage lies at a place as it does at the others: points of it, known in stage metres,
// are picked in the place's images, and where the place's staging puts them is compared with where
// the stage says that they are. The picks that tie the stage to the place have no part in it.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "shared/core/json.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

// Fewer points say nothing about how the stage is turned.
inline constexpr size_t kFewestCheckPoints = 3;

// What visitors would notice: half a percent of the width of the place's images.
double CheckTolerancePx(const geometry::CameraModel& camera);

// Root mean square distance, pixels, from an anchor's picks to where a point of the map is seen in
// their images; far beyond any tolerance where one does not see it at all.
double SeenOff(const stage::Anchor& anchor,
               const Eigen::Vector3d& point_in_map,
               const vision::SceneDatabase& map);

struct CheckPointReport {
  // kWeak: seen from almost one direction, so that nobody knows how far away it is.
  enum class Verdict { kNotPicked, kNotLocated, kPicksDisagree, kWeak, kGood, kOff };
  std::string name;
  Verdict verdict = Verdict::kNotPicked;
  Eigen::Vector3d on_stage = Eigen::Vector3d::Zero();  // where the stage says that it is, metres
  Status problem;                                      // why it could not be located
  std::string odd_frame;  // in which it was picked wrongly, where the others tell

  // Of one that was located:
  stage::AnchorReport anchor;
  Eigen::Vector3d found = Eigen::Vector3d::Zero();  // where the staging puts it, stage metres
  double distance_m = 0.0;
  double deviation_m = 0.0;  // standard deviation of found, were every pick one pixel off
  // Root mean square, over the images it was picked in, from the pick to where the staging shows
  // the point of the stage.
  double distance_px = 0.0;

  bool located() const { return verdict >= Verdict::kPicksDisagree; }
};

struct CheckReport {
  enum class Verdict { kUnknown, kGood, kPoor };
  Verdict verdict = Verdict::kUnknown;
  std::vector<CheckPointReport> points;  // in the order of the project
  double tolerance_px = 0.0;
  int compared = 0;  // that are good or off; the numbers below are of these
  double rms_m = 0.0;
  double rms_px = 0.0;

  // A point that all others contradict: it was picked wrongly, or its position is wrong. Empty:
  // none, or it cannot be told.
  std::string doubtful;
  // The stage as the points but the doubtful one say that it lies, where that can be told.
  std::optional<geometry::Similarity3> map_from_stage;
  double fit_rms_m = 0.0;  // of the points after that
  bool fit_good = false;   // each of them is within the tolerance then
  // From the stage as it is to that one.
  double scale = 1.0;
  double turn = 0.0;     // radians
  double shift_m = 0.0;  // of the middle of the points
};

CheckReport CheckStaging(const ProjectDocument& document,
                         const PlaceDocument& place,
                         const vision::SceneDatabase& map,
                         const geometry::Similarity3& map_from_picked);

// What came of it and what to do, in a sentence or two.
Sentence CheckSentence(const CheckReport& report);
// The same in the language of the interface, or untranslated.
std::string CheckAdvice(const CheckReport& report, bool translated);

// {"verdict", "points": [...], ...}; docs/file-formats.md.
Json CheckJson(const CheckReport& report);
// A line for each point, and the advice.
std::string CheckText(const CheckReport& report);

// Edits. Where a point was picked at a place; nullptr: nowhere.
const stage::Anchor* FindCheckPicks(const PlaceDocument& place, std::string_view point);
void SetCheckPick(PlaceDocument& place, const std::string& point, const stage::Pick& pick);
void ClearCheckPicks(PlaceDocument& place, std::string_view point);
// Everywhere, with its picks. The new name must not be taken.
void RenameCheckPoint(ProjectDocument& document, const std::string& from, const std::string& to);
void RemoveCheckPoint(ProjectDocument& document, const std::string& point);

}  // namespace lararium::app
