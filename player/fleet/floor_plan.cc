#include "player/fleet/floor_plan.h"

#include <cmath>
#include <map>
#include <utility>

#include "shared/core/json.h"
#include "shared/vision/scene_database.h"

namespace lararium::player {
namespace {

constexpr double kLowest = 0.1;  // metres above the floor of the stage
constexpr double kHighest = 2.2;
constexpr int kLeastPoints = 2;
constexpr double kFarthest = 100.0;  // metres from the origin of the stage
// Number of cells in a metre.
constexpr double kSteps = 10.0;
static_assert(kSteps * kPlanCell == 1.0);

}  // namespace

std::vector<std::array<double, 2>> PlanOf(std::span<const Eigen::Vector3f> points_in_map,
                                          const geometry::Similarity3& map_from_stage) {
  const geometry::Similarity3 stage_from_map = map_from_stage.Inverse();
  std::map<std::pair<int, int>, int> counts;
  for (const Eigen::Vector3f& point_in_map : points_in_map) {
    const Eigen::Vector3d point = stage_from_map * point_in_map.cast<double>().eval();
    if (point.y() >= kLowest && point.y() <= kHighest && std::abs(point.x()) <= kFarthest &&
        std::abs(point.z()) <= kFarthest) {
      ++counts[{static_cast<int>(std::floor(point.x() * kSteps)),
                static_cast<int>(std::floor(point.z() * kSteps))}];
    }
  }
  std::vector<std::array<double, 2>> cells;
  for (const auto& [cell, count] : counts) {
    if (count >= kLeastPoints) {
      cells.push_back({cell.first / kSteps, cell.second / kSteps});
    }
  }
  return cells;
}

Result<Json> PlansOf(const bundle::Bundle& bundle) {
  Json plans = Json::object();
  for (const bundle::PlaceEntry& place : bundle.manifest().places) {
    LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(place.scene));
    LARARIUM_ASSIGN_OR_RETURN(
        const vision::SceneDatabase map,
        vision::ParseSceneDatabase(bytes, bundle.place() + ": " + place.scene));
    plans[place.name] = {{"cell", kPlanCell}, {"points", PlanOf(map.points, place.map_from_stage)}};
  }
  return plans;
}

}  // namespace lararium::player
