#include "shared/show/lamp_shade.h"

#include <Eigen/Core>
#include <algorithm>
#include <glm/geometric.hpp>

#include "shared/core/check.h"

namespace lararium::show {
namespace {

constexpr float kStill = 0.02f;  // Metres that a lamp may move and keep its walls.
// Metres beyond the lamp's radius; occluders nearer than that hold the lamp.
constexpr float kHolder = 0.06f;
constexpr float kFar = 50.0f;

Eigen::Vector3f ToEigen(const glm::vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

LampShade::LampShade(std::span<const stage::Occluder> occluders) {
  for (const stage::Occluder& occluder : occluders) {
    trees_.emplace_back(vision::Placed(occluder.mesh, occluder.stage_from_mesh));
  }
}

void LampShade::SetWalls(std::span<light::Lamp> lamps) {
  CHECK(lamps.size() <= light::kMaxLamps);
  if (trees_.empty()) {
    return;
  }
  for (Known& known : known_) {
    known.used = std::any_of(lamps.begin(), lamps.end(), [&](const light::Lamp& lamp) {
      return glm::distance(lamp.position, known.position) <= kStill;
    });
  }
  for (light::Lamp& lamp : lamps) {
    const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& known) {
      return known.used && glm::distance(lamp.position, known.position) <= kStill;
    });
    if (found != known_.end()) {
      lamp.walls = found->walls;
      continue;
    }
    Known& known = Entry(lamp.position);
    Look(lamp, *known.walls);
    lamp.walls = known.walls;
  }
}

// An unused entry whose walls no frame refers to, or a new one.
LampShade::Known& LampShade::Entry(const glm::vec3& position) {
  auto entry = std::find_if(known_.begin(), known_.end(), [](const Known& known) {
    return !known.used && known.walls.use_count() == 1;
  });
  if (entry == known_.end()) {
    entry = known_.insert(known_.end(), {position, std::make_shared<light::LampWalls>()});
  }
  entry->position = position;
  entry->used = true;
  return *entry;
}

void LampShade::Look(const light::Lamp& lamp, light::LampWalls& walls) const {
  for (int row = 0; row < light::LampWalls::kSize; ++row) {
    for (int column = 0; column < light::LampWalls::kSize; ++column) {
      const glm::vec3 direction = light::LampWalls::Direction(column, row);
      glm::vec4& plane = walls.planes[static_cast<size_t>(row * light::LampWalls::kSize + column)];
      plane = glm::vec4(0.0f);
      float farthest = kFar;
      for (const vision::OccluderTree& tree : trees_) {
        const auto hit = tree.FirstHit(ToEigen(lamp.position), ToEigen(direction),
                                       lamp.radius + kHolder, farthest);
        if (hit) {
          farthest = hit->distance;
          glm::vec3 normal(hit->normal.x(), hit->normal.y(), hit->normal.z());
          normal = glm::dot(normal, direction) < 0.0f ? -normal : normal;
          plane = glm::vec4(normal, glm::dot(normal, lamp.position + farthest * direction));
        }
      }
    }
  }
}

}  // namespace lararium::show
