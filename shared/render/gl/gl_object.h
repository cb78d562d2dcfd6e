#pragma once

// Owners of OpenGL objects. They are move-only; create and destroy them on the thread that has the
// context.

#include <cstdint>
#include <string_view>
#include <utility>

#include "shared/core/status.h"

namespace lararium::render {

enum class GlKind {
  kBuffer,
  kTexture,
  kVertexArray,
  kFramebuffer,
  kRenderbuffer,
  kSampler,
  kProgram
};

uint32_t GenerateGlObject(GlKind kind);
void DeleteGlObject(GlKind kind, uint32_t id);

// Checks that the bound framebuffer can be drawn into. what: completes the error "the driver cannot
// draw ...", for example "into 16-bit float images".
Status CheckFramebuffer(std::string_view what);

// Empty (id 0) unless created by Generate().
template <GlKind kind>
class GlObject {
 public:
  GlObject() = default;
  static GlObject Generate() { return GlObject(GenerateGlObject(kind)); }

  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~GlObject() {
    if (id_ != 0) {
      DeleteGlObject(kind, id_);
    }
  }

  uint32_t id() const { return id_; }

 private:
  explicit GlObject(uint32_t id) : id_(id) {}

  uint32_t id_ = 0;
};

using GlBuffer = GlObject<GlKind::kBuffer>;
using GlTexture = GlObject<GlKind::kTexture>;
using GlVertexArray = GlObject<GlKind::kVertexArray>;
using GlFramebuffer = GlObject<GlKind::kFramebuffer>;
using GlRenderbuffer = GlObject<GlKind::kRenderbuffer>;
using GlSampler = GlObject<GlKind::kSampler>;
using GlProgram = GlObject<GlKind::kProgram>;

}  // namespace lararium::render
