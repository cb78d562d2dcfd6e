#include "editor/check/stage_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "shared/core/units.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

namespace {
constexpr double kPercent = 100.0;
constexpr double kMillimetres = 1000.0;

template <typename... Values>
std::string Format(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

Json TagsJson(const train::TagScale& scale) {
  Json tags = Json::array();
  for (const train::TagReport& tag : scale.tags) {
    tags.push_back({{"id", tag.id},
                    {"keyframes", tag.views},
                    {"error_px", tag.error_px},
                    {"metres_per_unit", tag.metres_per_unit},
                    {"deviation_percent", kPercent * tag.deviation}});
  }
  return tags;
}

Json ScaleJson(const PlaceDocument& place,
               const MapMeasures& measures,
               const ResolvedPicks& resolved) {
  Json json = {{"from", "nothing"}, {"metres_per_unit", 1.0 / resolved.map_from_picked.scale}};
  if (resolved.solution) {
    const stage::StageSolution& solution = *resolved.solution;
    json["from"] = "picks";
    json["length_m"] = place.picks.length_m;
    json["measured_length_m"] = solution.measured_length_m;
    json["percent_per_px"] = kPercent * solution.length_spread;
    json["cm_per_px"] = kCentimetresPerMetre * solution.length_spread * place.picks.length_m;
  }
  if (measures.tags) {
    json["from"] = "tags";
    json["deviation_percent"] = kPercent * measures.tags->deviation;
    json["spread_percent"] = kPercent * measures.tags->spread;
    json["tags"] = TagsJson(*measures.tags);
    json["left_out"] = measures.tags->left_out;
  }
  return json;
}

Json PicksJson(const ResolvedPicks& resolved) {
  Json picks = Json::array();
  if (resolved.solution) {
    for (const stage::AnchorReport& anchor : resolved.solution->anchors) {
      picks.push_back({{"anchor", anchor.name},
                       {"picks", anchor.picks},
                       {"error_px", anchor.error_px},
                       {"angle_deg", kDegreesPerRadian * anchor.angle},
                       {"left_out", anchor.left_out}});
    }
  }
  return picks;
}

// Angle between the up axis of the stage and the normal of the floor, radians.
double StageTilt(const geometry::Similarity3& map_from_stage, const train::FloorPlane& floor) {
  const double cosine = floor.normal.dot(map_from_stage.rotation * Eigen::Vector3d::UnitY());
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double StageHeight(const geometry::Similarity3& map_from_stage, const train::FloorPlane& floor) {
  return floor.Height(map_from_stage.translation) / map_from_stage.scale;
}

}  // namespace

Json StageJson(const PlaceDocument& place,
               const MapMeasures& measures,
               const ResolvedPicks& resolved) {
  Json json = {{"scale", ScaleJson(place, measures, resolved)},
               {"picks", PicksJson(resolved)},
               {"problem", resolved.problem.ok() ? Json() : Json(resolved.problem.message())},
               {"floor", nullptr}};
  if (measures.floor) {
    const train::FloorPlane& floor = *measures.floor;
    const geometry::Similarity3 map_from_stage = resolved.map_from_picked * place.picked_from_stage;
    json["floor"] = {{"points", floor.points},
                     {"spread_mm", kMillimetres * floor.spread / map_from_stage.scale},
                     {"tilt_deviation_deg", kDegreesPerRadian * floor.tilt_deviation},
                     {"stage_tilt_deg", kDegreesPerRadian * StageTilt(map_from_stage, floor)},
                     {"stage_height_mm", kMillimetres * StageHeight(map_from_stage, floor)}};
  }
  return json;
}

std::string StageText(const PlaceDocument& place,
                      const MapMeasures& measures,
                      const ResolvedPicks& resolved) {
  std::string text;
  if (measures.tags) {
    text += Format("scale: from %zu tags, +- %.2f %% (sides and diagonals differ by %.2f %%)\n",
                   measures.tags->tags.size(), kPercent * measures.tags->deviation,
                   kPercent * measures.tags->spread);
    for (const std::string& left_out : measures.tags->left_out) {
      text += "  left out: " + left_out + "\n";
    }
  }
  if (resolved.solution) {
    const stage::StageSolution& solution = *resolved.solution;
    const double off = solution.measured_length_m / place.picks.length_m - 1.0;
    text += Format("known length: %.3f m, +- %.1f cm (%.2f %%) for each px of the picks",
                   place.picks.length_m,
                   kCentimetresPerMetre * solution.length_spread * place.picks.length_m,
                   kPercent * solution.length_spread);
    text += measures.tags ? Format("; %+.2f %% by the tags\n", kPercent * off) : "\n";
    for (const stage::AnchorReport& anchor : solution.anchors) {
      text += Format("  %s: %d picks, %.2f px", anchor.name.c_str(), anchor.picks, anchor.error_px);
      for (const std::string& frame : anchor.left_out) {
        text += ", left out " + frame;
      }
      text += "\n";
    }
  } else if (!measures.tags) {
    text += "scale: a guess; pick a known length, or film a tag\n";
  }
  if (measures.floor) {
    const geometry::Similarity3 map_from_stage = resolved.map_from_picked * place.picked_from_stage;
    const double height = StageHeight(map_from_stage, *measures.floor);
    text += Format(
        "floor: %d points, spread %.1f mm, level to %.2f deg; the stage lies %.1f mm "
        "%s it, tilted by %.2f deg\n",
        measures.floor->points, kMillimetres * measures.floor->spread / map_from_stage.scale,
        kDegreesPerRadian * measures.floor->tilt_deviation, kMillimetres * std::abs(height),
        height < 0.0 ? "below" : "above",
        kDegreesPerRadian * StageTilt(map_from_stage, *measures.floor));
  } else {
    text += "floor: none found\n";
  }
  return text;
}

StageReport ReportStage(const ProjectDocument& document,
                        const PlaceDocument& place,
                        const StagedMap& map) {
  StageReport report{StageText(place, map.measures, map.picks),
                     StageJson(place, map.measures, map.picks),
                     CheckStaging(document, place, *map.database, map.picks.map_from_picked)};
  if (!document.check_points.empty()) {
    report.text += CheckText(report.points);
    report.json["check_points"] = CheckJson(report.points);
  }
  return report;
}

}  // namespace lararium::editor
