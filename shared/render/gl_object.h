#pragma once

// Owners of OpenGL objects: move-only, created and destroyed on the thread that
// has the context.

#include <cstdint>
#include <utility>

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

// Empty (id 0) unless made by Generate().
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
