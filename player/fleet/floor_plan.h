#pragma once

// The plan of a place, seen from above: where its map has points. The page of a fleet shows devices
// on it.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "shared/bundle/bundle.h"
#include "shared/core/json_fwd.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

// The corners (smallest x and z, metres, stage axes) of the squares of a grid with sides of
// kPlanCell that have at least two points between a hand above the floor and the height of a door.
// Sorted.
inline constexpr double kPlanCell = 0.1;
std::vector<std::array<double, 2>> PlanOf(std::span<const Eigen::Vector3f> points_in_map,
                                          const geometry::Similarity3& map_from_stage);

// The content of plans.json (docs/file-formats.md): a plan for each place of a bundle.
Result<Json> PlansOf(const bundle::Bundle& bundle);

}  // namespace lararium::player
