#include "shared/render/passes/lamp_uniforms.h"

#include <glm/geometric.hpp>

namespace lararium::render {

void LampUniforms::Choose(std::span<const light::Lamp> lamps,
                          const glm::vec3& middle,
                          float radius,
                          float least_irradiance) {
  places_.clear();
  intensities_.clear();
  walls_.clear();
  for (const light::Lamp& lamp : lamps) {
    if (places_.size() < light::kMaxLamps &&
        glm::distance(lamp.position, middle) < radius + light::ReachOf(lamp, least_irradiance)) {
      places_.emplace_back(lamp.position, lamp.radius);
      intensities_.push_back(lamp.intensity);
      walls_.push_back(lamp.walls);
    }
  }
}

void LampUniforms::Set(const ShaderProgram& shaders) const {
  shaders.Set("lamp_count", static_cast<int>(places_.size()));
  if (!places_.empty()) {
    shaders.Set("lamp_places", places_);
    shaders.Set("lamp_intensities", intensities_);
  }
}

}  // namespace lararium::render
