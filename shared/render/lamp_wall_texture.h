#pragma once

// The walls about lamps for shaders/include/lamp_walls.glsl. Private to render.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "shared/light/lamp.h"
#include "shared/render/gl_object.h"
#include "shared/render/shader_program.h"

namespace lararium::render {

class LampWallTexture {
 public:
  // Empty, with its memory. The constructor makes nothing.
  void Create();
  // Uploads what is not there yet.
  void Upload(std::span<const std::shared_ptr<const light::LampWalls>> walls);
  // Binds it for the program in use.
  void Bind(const ShaderProgram& shaders, uint32_t unit) const;

 private:
  GlTexture texture_;
  // Of each layer; kept, so that the same address is the same walls.
  std::array<std::shared_ptr<const light::LampWalls>, light::kMaxLamps> uploaded_;
  int with_walls_ = 0;  // a bit for each layer
};

}  // namespace lararium::render
