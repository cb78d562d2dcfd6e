#include "editor/jobs/occluder_alignment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/document/document_fields.h"
#include "editor/document/place_edits.h"
#include "editor/jobs/check_points.h"
#include "editor/text/text.h"
#include "shared/core/check.h"
#include "shared/core/units.h"

namespace lararium::editor {

namespace {

using Eigen::Vector3d;
using geometry::Similarity3;

constexpr double kPercent = 100.0;

std::string PlaceOf(const OccluderDocument& occluder) { return "occluder '" + occluder.name + "'"; }

ModelPairReport ReportPair(const ModelPairDocument& pair,
                           const Vector3d& model_on_stage,
                           const vision::SceneDatabase& map,
                           const Similarity3& map_from_stage) {
  ModelPairReport report;
  Result<stage::AnchorReport> located = stage::SolveAnchor(pair.anchor, map);
  report.located = located.ok();
  if (!located.ok()) {
    report.problem = located.status();
    return report;
  }
  report.anchor = *std::move(located);
  report.on_stage = map_from_stage.Inverse() * report.anchor.point_in_map;
  report.distance_m = (model_on_stage - report.on_stage).norm();
  report.distance_px = SeenOff(pair.anchor, map_from_stage * model_on_stage, map);
  return report;
}

}  // namespace

AlignmentReport ReportAlignment(const OccluderDocument& occluder,
                                const vision::SceneDatabase& map,
                                const Similarity3& map_from_stage) {
  AlignmentReport report;
  for (const ModelPairDocument& pair : occluder.model_pairs) {
    report.pairs.push_back(
        ReportPair(pair, occluder.stage_from_mesh * pair.on_mesh, map, map_from_stage));
    const ModelPairReport& added = report.pairs.back();
    if (!added.located) {
      continue;
    }
    ++report.located;
    report.rms_m += added.distance_m * added.distance_m;
    report.rms_px += added.distance_px * added.distance_px;
    if (!report.worst || added.distance_m > report.pairs[*report.worst].distance_m) {
      report.worst = report.pairs.size() - 1;
    }
  }
  if (report.located < 4) {
    report.worst.reset();
  }
  report.rms_m = std::sqrt(report.rms_m / std::max(report.located, 1));
  report.rms_px = std::sqrt(report.rms_px / std::max(report.located, 1));
  return report;
}

Result<Similarity3> AlignByPoints(const OccluderDocument& occluder,
                                  const vision::SceneDatabase& map,
                                  const Similarity3& map_from_stage) {
  std::vector<train::MeshPair> pairs;
  const AlignmentReport report = ReportAlignment(occluder, map, map_from_stage);
  for (size_t i = 0; i < report.pairs.size(); ++i) {
    if (report.pairs[i].located) {
      pairs.push_back({occluder.model_pairs[i].on_mesh, report.pairs[i].on_stage});
    }
  }
  const Result<Similarity3> stage_from_mesh = train::AlignByPairs(
      pairs, occluder.keep_scale ? std::optional(occluder.stage_from_mesh.scale) : std::nullopt);
  return stage_from_mesh.ok() ? stage_from_mesh
                              : Result<Similarity3>(stage_from_mesh.status().At(PlaceOf(occluder)));
}

Result<train::RefineReport> RefineOnMap(const OccluderDocument& occluder,
                                        const geometry::TriangleMesh& mesh,
                                        const vision::SceneDatabase& map,
                                        const Similarity3& map_from_stage,
                                        double search_m,
                                        Progress& progress) {
  const Similarity3 stage_from_map = map_from_stage.Inverse();
  std::vector<Vector3d> points;
  points.reserve(map.points.size());
  for (const Eigen::Vector3f& point : map.points) {
    points.push_back(stage_from_map * point.cast<double>());
  }
  train::RefineOptions options;
  options.search_m = search_m;
  options.keep_scale = occluder.keep_scale;
  Result<train::RefineReport> report =
      train::RefineAlignment(mesh, occluder.stage_from_mesh, points, options, progress);
  return report.ok() ? std::move(report)
                     : Result<train::RefineReport>(report.status().At(PlaceOf(occluder)));
}

std::string RefineText(const train::RefineReport& report, bool translated) {
  const auto say = [translated](const char* text) { return translated ? Tr(text) : text; };
  std::string text =
      Text(say(TrLater("%d points of the map lie on it, to %.1f cm; before, they were %.1f cm off. "
                       "It moved by %.1f cm, and %.0f %% of its surface has points near.")),
           report.points, kCentimetresPerMetre * report.rms_after_m,
           kCentimetresPerMetre * report.rms_before_m, kCentimetresPerMetre * report.moved_m,
           kPercent * report.covered);
  if (report.undetermined > 0) {
    text += std::string(" ") +
            say(TrLater("In some directions the points do not tell how it lies: there it stayed as "
                        "it was."));
  }
  return text;
}

Json AlignmentJson(const OccluderDocument& occluder, const AlignmentReport& report) {
  Json pairs = Json::array();
  for (size_t i = 0; i < report.pairs.size(); ++i) {
    const ModelPairReport& pair = report.pairs[i];
    Json& entry = pairs.emplace_back();
    entry = {{"on_mesh", FormatVector(occluder.model_pairs[i].on_mesh)},
             {"located", pair.located},
             {"problem", pair.problem.message()}};
    if (pair.located) {
      entry["on_stage"] = FormatVector(pair.on_stage);
      entry["distance_cm"] = kCentimetresPerMetre * pair.distance_m;
      entry["distance_px"] = pair.distance_px;
      entry["picks"] = pair.anchor.picks;
      entry["error_px"] = pair.anchor.error_px;
      entry["left_out"] = pair.anchor.left_out;
    }
  }
  Json json = {{"pairs", std::move(pairs)},
               {"worst", nullptr},
               {"rms_cm", kCentimetresPerMetre * report.rms_m},
               {"rms_px", report.rms_px},
               {"keep_scale", occluder.keep_scale}};
  if (report.worst) {
    json["worst"] = *report.worst + 1;
  }
  FormatSimilarity(occluder.stage_from_mesh, json["stage_from_mesh"]);
  return json;
}

Json RefineJson(const train::RefineReport& report) {
  return {{"points", report.points},
          {"rms_before_cm", kCentimetresPerMetre * report.rms_before_m},
          {"rms_after_cm", kCentimetresPerMetre * report.rms_after_m},
          {"moved_cm", kCentimetresPerMetre * report.moved_m},
          {"covered_percent", kPercent * report.covered},
          {"undetermined", report.undetermined}};
}

std::string AlignmentText(const AlignmentReport& report) {
  std::string text;
  for (size_t i = 0; i < report.pairs.size(); ++i) {
    const ModelPairReport& pair = report.pairs[i];
    text += "  " + ModelPairName(i) + ": ";
    text += pair.located ? Text("%.1f cm off, %.2f px", kCentimetresPerMetre * pair.distance_m,
                                pair.distance_px) +
                               (report.worst == i ? " (the worst)" : "")
                         : pair.problem.message();
    text += "\n";
  }
  if (report.located > 0) {
    text +=
        Text("  all: %.1f cm off, %.2f px\n", kCentimetresPerMetre * report.rms_m, report.rms_px);
  }
  return text;
}

void AddModelPair(OccluderDocument& occluder, const Vector3d& on_mesh) {
  occluder.model_pairs.push_back({on_mesh, {ModelPairName(occluder.model_pairs.size()), {}}});
}

void SetModelPick(OccluderDocument& occluder, size_t pair, const stage::Pick& pick) {
  CHECK(pair < occluder.model_pairs.size());
  SetPick(occluder.model_pairs[pair].anchor, pick);
}

void RemoveModelPair(OccluderDocument& occluder, size_t pair) {
  CHECK(pair < occluder.model_pairs.size());
  occluder.model_pairs.erase(occluder.model_pairs.begin() + static_cast<std::ptrdiff_t>(pair));
  for (size_t i = pair; i < occluder.model_pairs.size(); ++i) {
    occluder.model_pairs[i].anchor.name = ModelPairName(i);
  }
}

}  // namespace lararium::editor
