#include "editor/jobs/check_points.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "editor/document/place_edits.h"
#include "editor/text/text.h"
#include "shared/core/units.h"

namespace lararium::editor {

namespace {

using Eigen::Vector3d;
using geometry::Similarity3;
using Verdict = CheckPointReport::Verdict;
constexpr double kNarrow = 4.0 / kDegreesPerRadian;  // Radians between the rays of a point's picks.

// The frame of the one pick without which the others agree; empty: there is none.
std::string OddFrame(const stage::Anchor& anchor,
                     const vision::SceneDatabase& map,
                     double tolerance_px) {
  constexpr size_t kFewestOthers = 2;
  std::string odd;
  double least = tolerance_px;
  for (size_t i = 0; anchor.picks.size() > kFewestOthers && i < anchor.picks.size(); ++i) {
    stage::Anchor others = anchor;
    others.picks.erase(others.picks.begin() + static_cast<std::ptrdiff_t>(i));
    const Result<stage::AnchorReport> report = stage::SolveAnchor(others, map);
    if (report.ok() && report->picks >= static_cast<int>(kFewestOthers) &&
        report->error_px < least) {
      least = report->error_px;
      odd = anchor.picks[i].frame;
    }
  }
  return odd;
}

CheckPointReport CheckPoint(const CheckPointDocument& point,
                            const stage::Anchor* anchor,
                            const vision::SceneDatabase& map,
                            const Similarity3& map_from_stage,
                            double tolerance_px) {
  CheckPointReport report;
  report.name = point.name;
  report.on_stage = point.position;
  if (anchor == nullptr || anchor->picks.empty()) {
    return report;
  }
  Result<stage::AnchorReport> located = stage::SolveAnchor(*anchor, map);
  if (!located.ok()) {
    report.verdict = Verdict::kNotLocated;
    report.problem = located.status();
    return report;
  }
  report.anchor = *std::move(located);
  report.found = map_from_stage.Inverse() * report.anchor.point_in_map;
  report.distance_m = (report.found - report.on_stage).norm();
  report.deviation_m = stage::AnchorSpread(*anchor, map) / map_from_stage.scale;
  report.distance_px = SeenOff(*anchor, map_from_stage * report.on_stage, map);
  if (report.anchor.error_px > tolerance_px) {
    report.verdict = Verdict::kPicksDisagree;
    report.odd_frame = OddFrame(*anchor, map, tolerance_px);
  } else if (report.anchor.picks > 1 && report.anchor.angle < kNarrow) {
    report.verdict = Verdict::kWeak;
  } else {
    report.verdict = report.distance_px <= tolerance_px ? Verdict::kGood : Verdict::kOff;
  }
  return report;
}

// A point whose picks agree, together with its picks.
struct Compared {
  const CheckPointReport* report = nullptr;
  const stage::Anchor* anchor = nullptr;
};

struct Fit {
  Similarity3 map_from_stage;
  double rms_m = 0.0;
  bool good = false;
};

// The stage that fits the points best. left_out: a point to ignore.
std::optional<Fit> FitStage(std::span<const Compared> points,
                            const vision::SceneDatabase& map,
                            double tolerance_px,
                            const CheckPointReport* left_out = nullptr) {
  std::vector<Vector3d> in_map;
  std::vector<Vector3d> on_stage;
  for (const Compared& point : points) {
    if (point.report != left_out) {
      in_map.push_back(point.report->anchor.point_in_map);
      on_stage.push_back(point.report->on_stage);
    }
  }
  if (in_map.size() < kFewestCheckPoints) {
    return std::nullopt;
  }
  const Result<Similarity3> map_from_stage = geometry::EstimateSimilarity(in_map, on_stage);
  if (!map_from_stage.ok()) {
    return std::nullopt;  // The points lie on a line.
  }
  Fit fit{*map_from_stage, 0.0, true};
  for (size_t i = 0; i < in_map.size(); ++i) {
    fit.rms_m += (map_from_stage->Inverse() * in_map[i] - on_stage[i]).squaredNorm() /
                 static_cast<double>(in_map.size());
  }
  fit.rms_m = std::sqrt(fit.rms_m);
  for (const Compared& point : points) {
    fit.good = fit.good && (point.report == left_out ||
                            SeenOff(*point.anchor, *map_from_stage * point.report->on_stage, map) <=
                                tolerance_px);
  }
  return fit;
}

// Returns the only point that is off. Where several are off because the stage itself lies wrong:
// the only point without which the others agree.
const CheckPointReport* Doubtful(std::span<const Compared> points,
                                 const vision::SceneDatabase& map,
                                 double tolerance_px) {
  const auto is_off = [](const Compared& p) { return p.report->verdict == Verdict::kOff; };
  if (std::count_if(points.begin(), points.end(), is_off) == 1) {
    return std::find_if(points.begin(), points.end(), is_off)->report;
  }
  const CheckPointReport* doubtful = nullptr;
  for (const Compared& point : points) {
    const std::optional<Fit> fit = FitStage(points, map, tolerance_px, point.report);
    if (!fit || !fit->good) {
      continue;
    }
    if (doubtful != nullptr) {
      return nullptr;  // Either of two points could be wrong.
    }
    doubtful = point.report;
  }
  return doubtful;
}

void TakeFit(const Fit& fit, const Similarity3& map_from_stage, CheckReport& report) {
  Vector3d middle = Vector3d::Zero();
  for (const CheckPointReport& point : report.points) {
    middle += point.on_stage / static_cast<double>(report.points.size());
  }
  const Similarity3 now_from_fitted = map_from_stage.Inverse() * fit.map_from_stage;
  report.map_from_stage = fit.map_from_stage;
  report.fit_rms_m = fit.rms_m;
  report.fit_good = fit.good;
  report.scale = now_from_fitted.scale;
  report.turn = Eigen::Quaterniond::Identity().angularDistance(now_from_fitted.rotation);
  report.shift_m = (now_from_fitted * middle - middle).norm();
}

void Judge(std::span<const Compared> points,
           const vision::SceneDatabase& map,
           const Similarity3& map_from_stage,
           CheckReport& report) {
  const std::optional<Fit> fit = FitStage(points, map, report.tolerance_px);
  if (!fit) {
    return;
  }
  TakeFit(*fit, map_from_stage, report);
  const bool good = std::all_of(report.points.begin(), report.points.end(), [](const auto& p) {
    return p.verdict == Verdict::kGood || p.verdict == Verdict::kNotPicked;
  });
  report.verdict = good ? CheckReport::Verdict::kGood : CheckReport::Verdict::kPoor;
  if (good || fit->good) {
    return;
  }
  if (const CheckPointReport* doubtful = Doubtful(points, map, report.tolerance_px)) {
    report.doubtful = doubtful->name;
    if (const auto others = FitStage(points, map, report.tolerance_px, doubtful)) {
      TakeFit(*others, map_from_stage, report);
    }
  }
}

const char* VerdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNotPicked:
      return "not picked";
    case Verdict::kNotLocated:
      return "not located";
    case Verdict::kPicksDisagree:
      return "picks disagree";
    case Verdict::kWeak:
      return "weak";
    case Verdict::kGood:
      return "good";
    case Verdict::kOff:
      return "off";
  }
  return "";
}

const char* VerdictName(CheckReport::Verdict verdict) {
  switch (verdict) {
    case CheckReport::Verdict::kUnknown:
      return "unknown";
    case CheckReport::Verdict::kGood:
      return "good";
    case CheckReport::Verdict::kPoor:
      return "poor";
  }
  return "";
}

}  // namespace

double SeenOff(const stage::Anchor& anchor,
               const Vector3d& point_in_map,
               const vision::SceneDatabase& map) {
  double sum = 0.0;
  int count = 0;
  for (const vision::Keyframe& keyframe : map.keyframes) {
    for (const stage::Pick& pick : anchor.picks) {
      if (!stage::LiesIn(pick, keyframe)) {
        continue;
      }
      const auto pixel = map.camera.Project(keyframe.camera_from_map * point_in_map);
      sum += pixel ? (*pixel - pick.pixel).squaredNorm() : std::pow(map.camera.width, 2);
      ++count;
    }
  }
  return std::sqrt(sum / std::max(count, 1));
}

double CheckTolerancePx(const geometry::CameraModel& camera) { return 0.005 * camera.width; }

CheckReport CheckStaging(const ProjectDocument& document,
                         const PlaceDocument& place,
                         const vision::SceneDatabase& map,
                         const Similarity3& map_from_picked) {
  const Similarity3 map_from_stage = map_from_picked * place.picked_from_stage;
  CheckReport report;
  report.tolerance_px = CheckTolerancePx(map.camera);
  for (const CheckPointDocument& point : document.check_points) {
    report.points.push_back(CheckPoint(point, FindCheckPicks(place, point.name), map,
                                       map_from_stage, report.tolerance_px));
  }
  std::vector<Compared> compared;
  for (const CheckPointReport& point : report.points) {
    if (point.verdict == Verdict::kGood || point.verdict == Verdict::kOff) {
      compared.push_back({&point, FindCheckPicks(place, point.name)});
      report.rms_m += point.distance_m * point.distance_m;
      report.rms_px += point.distance_px * point.distance_px;
    }
  }
  report.compared = static_cast<int>(compared.size());
  report.rms_m = std::sqrt(report.rms_m / std::max(report.compared, 1));
  report.rms_px = std::sqrt(report.rms_px / std::max(report.compared, 1));
  Judge(compared, map, map_from_stage, report);
  return report;
}

Sentence CheckSentence(const CheckReport& report) {
  for (const CheckPointReport& point : report.points) {
    if (point.verdict == Verdict::kPicksDisagree && !point.odd_frame.empty()) {
      return Sentence("%s was picked wrongly in %s: without that pick the others agree.",
                      {point.name, point.odd_frame});
    }
    if (point.verdict == Verdict::kPicksDisagree) {
      return Sentence("The picks of %s disagree by %s px: look at them again.",
                      {point.name, Text("%.1f", point.anchor.error_px)});
    }
    if (point.verdict == Verdict::kNotLocated) {
      return point.problem.message();
    }
    if (point.verdict == Verdict::kWeak) {
      return Sentence(
          "%s was picked from almost one direction, where a pixel moves it by %s cm: pick it in "
          "images taken farther apart.",
          {point.name, Text("%.0f", kCentimetresPerMetre * point.deviation_m)});
    }
  }
  if (report.verdict == CheckReport::Verdict::kUnknown) {
    return report.compared < static_cast<int>(kFewestCheckPoints)
               ? Sentence("Pick at least three points here, each in two images.")
               : Sentence("The points lie on a line: pick another one beside it.");
  }
  if (report.verdict == CheckReport::Verdict::kGood) {
    return Sentence(
        "The stage lies as it should, to %s cm (%s px).",
        {Text("%.1f", kCentimetresPerMetre * report.rms_m), Text("%.1f", report.rms_px)});
  }
  if (!report.doubtful.empty()) {
    return Sentence(
        "Look at %s again: it was picked wrongly here, or its position on the stage is wrong. The "
        "other points agree.",
        {report.doubtful});
  }
  if (report.fit_good) {
    return Sentence(
        "The points agree with one another to %s cm, but the stage lies elsewhere. Laying it by "
        "them moves it by %s cm, turns it by %s\xc2\xb0 and makes it %s times as large.",
        {Text("%.1f", kCentimetresPerMetre * report.fit_rms_m),
         Text("%.1f", kCentimetresPerMetre * report.shift_m),
         Text("%.1f", kDegreesPerRadian * report.turn), Text("%.3f", report.scale)});
  }
  return Sentence(
      "The points agree neither with the stage nor with one another: look at their picks and "
      "positions again.");
}

std::string CheckAdvice(const CheckReport& report, bool translated) {
  const Sentence advice = CheckSentence(report);
  return translated ? advice.Translated(Tr) : advice.English();
}

Json CheckJson(const CheckReport& report) {
  Json points = Json::array();
  for (const CheckPointReport& point : report.points) {
    Json& entry = points.emplace_back(
        Json{{"name", point.name},
             {"verdict", VerdictName(point.verdict)},
             {"position", {point.on_stage.x(), point.on_stage.y(), point.on_stage.z()}},
             {"problem", point.problem.ok() ? Json() : Json(point.problem.message())}});
    if (point.located()) {
      entry["found"] = {point.found.x(), point.found.y(), point.found.z()};
      entry["distance_cm"] = kCentimetresPerMetre * point.distance_m;
      entry["distance_px"] = point.distance_px;
      entry["cm_per_px"] = kCentimetresPerMetre * point.deviation_m;
      entry["picks"] = point.anchor.picks;
      entry["error_px"] = point.anchor.error_px;
      entry["left_out"] = point.anchor.left_out;
      entry["odd_frame"] = point.odd_frame;
    }
  }
  Json json = {{"verdict", VerdictName(report.verdict)},
               {"points", std::move(points)},
               {"compared", report.compared},
               {"tolerance_px", report.tolerance_px},
               {"rms_cm", kCentimetresPerMetre * report.rms_m},
               {"rms_px", report.rms_px},
               {"doubtful", report.doubtful},
               {"advice", CheckAdvice(report, false)},
               {"fit", nullptr}};
  if (report.map_from_stage) {
    json["fit"] = {{"good", report.fit_good},
                   {"rms_cm", kCentimetresPerMetre * report.fit_rms_m},
                   {"shift_cm", kCentimetresPerMetre * report.shift_m},
                   {"turn_deg", kDegreesPerRadian * report.turn},
                   {"scale", report.scale}};
  }
  return json;
}

std::string CheckText(const CheckReport& report) {
  if (report.points.empty()) {
    return "";
  }
  std::string text = Text("check points: %s\n", VerdictName(report.verdict));
  for (const CheckPointReport& point : report.points) {
    text += "  " + point.name + ": ";
    if (point.located()) {
      text += Text("%.1f cm off (+- %.1f cm for each px of the picks), %.2f px: ",
                   kCentimetresPerMetre * point.distance_m,
                   kCentimetresPerMetre * point.deviation_m, point.distance_px);
    }
    text += std::string(VerdictName(point.verdict)) + "\n";
  }
  return text + "  " + CheckAdvice(report, false) + "\n";
}

const stage::Anchor* FindCheckPicks(const PlaceDocument& place, std::string_view point) {
  const auto found = std::find_if(place.check_picks.begin(), place.check_picks.end(),
                                  [&](const stage::Anchor& a) { return a.name == point; });
  return found == place.check_picks.end() ? nullptr : &*found;
}

void SetCheckPick(PlaceDocument& place, const std::string& point, const stage::Pick& pick) {
  auto* anchor = const_cast<stage::Anchor*>(FindCheckPicks(place, point));
  if (anchor == nullptr) {
    anchor = &place.check_picks.emplace_back();
    anchor->name = point;
  }
  SetPick(*anchor, pick);
}

void ClearCheckPicks(PlaceDocument& place, std::string_view point) {
  std::erase_if(place.check_picks, [&](const stage::Anchor& a) { return a.name == point; });
}

void RenameCheckPoint(ProjectDocument& document, const std::string& from, const std::string& to) {
  const auto rename = [&](auto& entries) {
    for (auto& entry : entries) {
      if (entry.name == from) {
        entry.name = to;
      }
    }
  };
  rename(document.check_points);
  for (PlaceDocument& place : document.places) {
    rename(place.check_picks);
  }
}

void RemoveCheckPoint(ProjectDocument& document, const std::string& point) {
  std::erase_if(document.check_points, [&](const auto& p) { return p.name == point; });
  for (PlaceDocument& place : document.places) {
    ClearCheckPicks(place, point);
  }
}

}  // namespace lararium::editor
