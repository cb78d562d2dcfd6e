#include "shared/render/passes/lamp_wall_texture.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "shared/light/lamp_walls.h"

namespace lararium::render {
namespace {

constexpr GLsizei kSize = light::LampWalls::kSize;

}  // namespace

void LampWallTexture::Create() {
  texture_ = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_3D, texture_.id());
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA32F, kSize, kSize, light::kMaxLamps, 0, GL_RGBA, GL_FLOAT,
               nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_3D, filter, GL_NEAREST);
  }
}

void LampWallTexture::Upload(std::span<const std::shared_ptr<const light::LampWalls>> walls) {
  with_walls_ = 0;
  for (size_t i = 0; i < std::min(walls.size(), uploaded_.size()); ++i) {
    if (walls[i] == nullptr) {
      continue;
    }
    with_walls_ |= 1 << i;
    if (uploaded_[i] != walls[i]) {
      glBindTexture(GL_TEXTURE_3D, texture_.id());
      glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, static_cast<GLint>(i), kSize, kSize, 1, GL_RGBA,
                      GL_FLOAT, walls[i]->planes.data());
      uploaded_[i] = walls[i];
    }
  }
}

void LampWallTexture::Bind(const ShaderProgram& shaders, uint32_t unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_3D, texture_.id());
  shaders.Set("lamp_walls", static_cast<int>(unit));
  shaders.Set("lamps_with_walls", with_walls_);
}

}  // namespace lararium::render
