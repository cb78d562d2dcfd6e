#pragma once

// The texture of the walls around lamps for shaders/include/lamp_walls.glsl. Private to render.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "shared/light/lamp.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/shader_program.h"

namespace lararium::render {

class LampWallTexture {
 public:
  // Allocates the texture, without content. The constructor allocates nothing.
  void Create();
  // Uploads the walls that have changed. walls: one entry for each lamp; nullptr: no walls.
  void Upload(std::span<const std::shared_ptr<const light::LampWalls>> walls);
  // Binds the texture to a texture unit and sets the uniforms of the program in use.
  void Bind(const ShaderProgram& shaders, uint32_t unit) const;

 private:
  GlTexture texture_;
  // The walls in each layer. They are kept alive, so that equal addresses mean equal walls.
  std::array<std::shared_ptr<const light::LampWalls>, light::kMaxLamps> uploaded_;
  int with_walls_ = 0;  // bit i: layer i holds walls
};

}  // namespace lararium::render
