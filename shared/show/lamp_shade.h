#pragma once

// Confines the light of lamps to the walls and furniture of their place.

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

  // Gives each lamp its walls. Lamps that have not moved keep the walls found earlier. For each
  // other lamp about 2000 rays are cast; memory is allocated if more lamps move than before. At
  // most light::kMaxLamps lamps.
  void SetWalls(std::span<light::Lamp> lamps);

 private:
  struct Known {
    glm::vec3 position = glm::vec3(0.0f);
    std::shared_ptr<light::LampWalls> walls;
    bool used = false;  // True if the last call used this entry.
  };

  Known& Entry(const glm::vec3& position);
  void Look(const light::Lamp& lamp, light::LampWalls& walls) const;

  std::vector<vision::OccluderTree> trees_;
  std::vector<Known> known_;
};

}  // namespace lararium::show
