#pragma once

// A person or a prop on the GPU. It consists of parts with one material each, whose vertices follow
// joints. The joints of a prop are its movable parts. Private to render.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/texture_store.h"
#include "shared/render/passes/screen_bounds.h"
#include "shared/stage/prop.h"

namespace lararium::render {

struct GpuModel {
  static constexpr int kNoTexture = -1;

  struct Vertices {
    GlBuffer positions;
    GlBuffer normals;
  };
  // Identifies uploaded data by its address, and the picture that it was uploaded for.
  struct Sent {
    uint64_t picture = 0;  // 0: nothing was uploaded
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
    float length = 0.0f;  // longest side of its bounding box in the bind pose, metres

    struct Level {
      size_t first = 0;  // position in `indices`
      int count = 0;
      float error = 0.0f;   // metres
      size_t vertices = 0;  // MeshLevel::vertices
    };
    std::vector<Level> levels;  // levels of detail, finest first
    size_t vertex_count = 0;
    size_t first_vertex = 0;  // number of vertices in the parts before this one
    uint8_t prop_part = 0;    // index of the prop's movable part that this belongs to
    GlVertexArray bind_pose;
    GlVertexArray streamed;  // uses vertices uploaded by Stream
    GlBuffer attributes;     // constant data: albedo, texture coordinates, skin weights
    Vertices bind_vertices;
    Vertices streamed_vertices;
    GlBuffer irradiance;  // uploaded by StreamIrradiance
    GlBuffer indices;
    Sent sent_vertices;  // content of streamed_vertices
    Sent sent_irradiance;

    bool covered() const { return alpha_cutoff > 0.0f; }
    bool short_indices() const { return vertex_count <= 0x10000; }  // 16 bits instead of 32
  };

  std::vector<std::shared_ptr<const StoredTexture>> textures;
  std::vector<Part> parts;  // parallel to Human::meshes or to all meshes of a prop
  enum class Skin { kLinear, kDualQuaternion, kRigid };
  static constexpr size_t kSkins = 3;
  Skin skin = Skin::kLinear;
  // For each joint, the bounding box in the bind pose of all vertices that follow it, including all
  // morphs. A posed vertex lies in the convex hull of the posed boxes of its joints; the boxes are
  // widened for dual quaternions.
  std::vector<Box> joint_boxes;

  size_t joint_count() const { return joint_boxes.size(); }
  size_t vertex_count() const {
    return parts.empty() ? 0 : parts.back().first_vertex + parts.back().vertex_count;
  }

  // Fails if a texture cannot be decoded.
  static Result<GpuModel> Create(const std::shared_ptr<const human::Human>& human,
                                 TextureStore& textures);
  static Result<GpuModel> Create(const std::shared_ptr<const stage::Prop>& prop,
                                 TextureStore& textures);

  // Uploads vertices for the next draws of a part, one for each vertex of the part. Several passes
  // of a picture draw the same part: data that was uploaded for this picture (counted from 1) is
  // not uploaded again. The buffers' old content is orphaned, so nothing waits for pending draws.
  void Stream(size_t part,
              uint64_t picture,
              std::span<const glm::vec3> positions,
              std::span<const glm::vec3> normals);
  // Uploads irradiance in the same way, one value for each vertex that the drawn level uses.
  void StreamIrradiance(size_t part, uint64_t picture, std::span<const glm::vec3> irradiance);
  // Draws the coarsest level whose error is at most allowed_error, metres. Vertex attributes are
  // those of shaders/pass/model.vert.
  void Draw(size_t part, float allowed_error, bool streamed) const;
};

}  // namespace lararium::render
