#pragma once

// Lamps for shaders/include/lamps.glsl. Private to render.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/light/lamp.h"
#include "shared/render/shader_program.h"

namespace lararium::render {

class LampUniforms {
 public:
  // Those of the lamps that give a facing surface at least an irradiance somewhere within
  // radius of a point.
  void Choose(std::span<const light::Lamp> lamps,
              const glm::vec3& middle,
              float radius,
              float least_irradiance);
  // Of the program in use.
  void Set(const ShaderProgram& shaders) const;
  // Of those that were chosen.
  std::span<const std::shared_ptr<const light::LampWalls>> walls() const { return walls_; }

 private:
  std::vector<glm::vec4> places_;
  std::vector<glm::vec3> intensities_;
  std::vector<std::shared_ptr<const light::LampWalls>> walls_;
};

}  // namespace lararium::render
