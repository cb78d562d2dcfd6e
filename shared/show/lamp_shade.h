#pragma once

// Keeps the light of lamps behind the walls and furniture of the place that they burn at.

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/light/lamp.h"
#include "shared/light/lamp_walls.h"
#include "shared/stage/place.h"
#include "shared/vision/occluders.h"

namespace lararium::show {

class LampShade {
 public:
  explicit LampShade(std::span<const stage::Occluder> occluders);

  // Gives each lamp its walls. Lamps that have not moved keep those that were found for them;
  // for others about 2000 rays are cast, and memory is allocated while more lamps move than
  // before. Not for more than light::kMaxLamps.
  void SetWalls(std::span<light::Lamp> lamps);

 private:
  struct Known {
    glm::vec3 position = glm::vec3(0.0f);
    std::shared_ptr<light::LampWalls> walls;
    bool used = false;  // in the last call
  };

  Known& Entry(const glm::vec3& position);
  void Look(const light::Lamp& lamp, light::LampWalls& walls) const;

  std::vector<vision::OccluderTree> trees_;
  std::vector<Known> known_;
};

}  // namespace lararium::show
