#pragma once

// Chooses lamps and sets the uniforms of shaders/include/lamps.glsl. Private to render.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/light/lamp.h"
#include "shared/render/gl/shader_program.h"

namespace lararium::render {

class LampUniforms {
 public:
  // Chooses the lamps whose irradiance on a facing surface reaches least_irradiance somewhere
  // within radius (metres) of middle (stage axes).
  void Choose(std::span<const light::Lamp> lamps,
              const glm::vec3& middle,
              float radius,
              float least_irradiance);
  // Sets the uniforms of shaders, which must be the program in use.
  void Set(const ShaderProgram& shaders) const;
  // The walls of the chosen lamps, in the order of the uniforms.
  std::span<const std::shared_ptr<const light::LampWalls>> walls() const { return walls_; }

 private:
  std::vector<glm::vec4> places_;
  std::vector<glm::vec3> intensities_;
  std::vector<std::shared_ptr<const light::LampWalls>> walls_;
};

}  // namespace lararium::render
