#pragma once

// A person or a prop on the GPU: parts of one material each, whose vertices follow
// joints. A prop's joints are its movable parts. Private to render.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/render/gl_object.h"
#include "shared/render/screen_bounds.h"
#include "shared/render/texture_store.h"
#include "shared/stage/prop.h"

namespace lararium::render {

struct GpuModel {
  static constexpr int kNoTexture = -1;

  struct Vertices {
    GlBuffer positions;
    GlBuffer normals;
  };
  // Where data came from, and for which picture.
  struct Sent {
    uint64_t picture = 0;  // 0: nothing was sent
    const glm::vec3* data = nullptr;
    size_t count = 0;

    friend bool operator==(const Sent&, const Sent&) = default;
  };

  struct Part {
    human::Surface surface = human::Surface::kPlain;
    int colour_texture = kNoTexture;  // index into textures
    int normal_texture = kNoTexture;
    glm::vec3 colour = glm::vec3(1.0f);
    glm::vec3 emission = glm::vec3(0.0f);
    float roughness = 0.8f;
    float alpha_cutoff = 0.0f;  // 0: opaque
    bool culls_back_faces = false;
    float length = 0.0f;  // metres: longest side of its box in the bind pose

    struct Level {
      size_t first = 0;  // index
      int count = 0;
      float error = 0.0f;   // metres
      size_t vertices = 0;  // MeshLevel::vertices
    };
    std::vector<Level> levels;  // of detail, the finest first
    size_t vertex_count = 0;
    size_t first_vertex = 0;  // among those of all parts
    uint8_t prop_part = 0;    // of a prop: which of its parts this belongs to
    GlVertexArray bind_pose;
    GlVertexArray streamed;  // vertices of this very draw
    GlBuffer attributes;     // what stays: albedo, texture coordinates, skin weights
    Vertices bind_vertices;
    Vertices streamed_vertices;
    GlBuffer irradiance;  // of this very draw
    GlBuffer indices;
    Sent sent_vertices;  // what the streamed buffers hold
    Sent sent_irradiance;

    bool covered() const { return alpha_cutoff > 0.0f; }
    bool short_indices() const { return vertex_count <= 0x10000; }  // of 16 bits, else 32
  };

  std::vector<std::shared_ptr<const StoredTexture>> textures;
  std::vector<Part> parts;  // of a human: parallel to its meshes
  enum class Skin { kLinear, kDualQuaternion, kRigid };
  static constexpr size_t kSkins = 3;
  Skin skin = Skin::kLinear;
  // Of each joint: the box, in the bind pose, of all vertices that follow it, morphed
  // or not. A posed vertex lies in the convex hull of its joints' posed boxes, which
  // are wider for dual quaternions.
  std::vector<Box> joint_boxes;

  size_t joint_count() const { return joint_boxes.size(); }
  size_t vertex_count() const {
    return parts.empty() ? 0 : parts.back().first_vertex + parts.back().vertex_count;
  }

  // Fails where a texture cannot be decoded.
  static Result<GpuModel> Create(const std::shared_ptr<const human::Human>& human,
                                 TextureStore& textures);
  static Result<GpuModel> Create(const std::shared_ptr<const stage::Prop>& prop,
                                 TextureStore& textures);

  // Vertices for the next draws of a part; one for each of its own. A picture, counted from 1,
  // draws a part in several passes: what the part holds of it is not sent again. The buffers' old
  // content is orphaned, so that nothing waits for draws under way.
  void Stream(size_t part,
              uint64_t picture,
              std::span<const glm::vec3> positions,
              std::span<const glm::vec3> normals);
  // Likewise irradiance; one for each vertex that its level takes.
  void StreamIrradiance(size_t part, uint64_t picture, std::span<const glm::vec3> irradiance);
  // The coarsest level whose error is allowed, metres. Attributes as in
  // shaders/pass/model.vert.
  void Draw(size_t part, float allowed_error, bool streamed) const;
};

}  // namespace lararium::render
