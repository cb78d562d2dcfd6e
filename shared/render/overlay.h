#pragma once

// The editor's drawing over, or without, the camera's image: points, lines and
// translucent meshes under any view. Colours are sRGB-encoded, alpha is opacity.

#include <glm/gtc/type_precision.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/render/render_scene.h"
#include "shared/render/render_target.h"

namespace lararium::render {

// Any frame may serve as the stage here (the map, say), as long as all agree.
struct OverlayView {
  geometry::CameraModel display;  // pinhole, scaled to the target's size
  geometry::Rigid3 camera_from_stage;
  float near = 0.01f;  // metres
  float far = 1000.0f;
  std::optional<glm::vec3> clear;  // fills the target first; nullopt: draws over it

  friend bool operator==(const OverlayView& a, const OverlayView& b) {
    return a.display == b.display &&
           a.camera_from_stage.rotation.coeffs() == b.camera_from_stage.rotation.coeffs() &&
           a.camera_from_stage.translation == b.camera_from_stage.translation && a.near == b.near &&
           a.far == b.far && a.clear == b.clear;
  }
};

struct OverlayPoint {
  glm::vec3 position;  // stage
  glm::u8vec4 colour = glm::u8vec4(255);
};

struct OverlayLine {
  glm::vec3 from;  // stage
  glm::vec3 to;
  glm::u8vec4 colour = glm::u8vec4(255);

  friend bool operator==(const OverlayLine&, const OverlayLine&) = default;
};

struct OverlayPoints;
using PointsHandle = Id<OverlayPoints>;

enum class OverlayDepth {
  kTest,   // hidden by nearer overlays
  kOnTop,  // always seen: gizmos
};

class Overlay {
 public:
  // Needs a current context; everything else happens on its thread.
  static Result<std::unique_ptr<Overlay>> Create();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  // Must be valid (TriangleMesh::Validate).
  MeshHandle AddMesh(const geometry::TriangleMesh& mesh);
  void RemoveMesh(MeshHandle mesh);

  // Points that stay as they are from picture to picture.
  PointsHandle AddPoints(std::span<const OverlayPoint> points);
  void RemovePoints(PointsHandle points);

  // Begin, any number of Draw..., End; the target, one that has depth (RenderTarget::Depth), is
  // borrowed in between.
  void Begin(const OverlayView& view, const RenderTarget& target);
  // Round, size_px across.
  void DrawPoints(std::span<const OverlayPoint> points,
                  float size_px,
                  OverlayDepth depth = OverlayDepth::kTest);
  // The first so many of them; at most all.
  Status DrawPoints(PointsHandle points,
                    size_t count,
                    float size_px,
                    OverlayDepth depth = OverlayDepth::kTest);
  void DrawLines(std::span<const OverlayLine> lines,
                 float width_px,
                 OverlayDepth depth = OverlayDepth::kTest);
  // Shaded by a lamp at the camera; both sides are seen.
  Status DrawMesh(MeshHandle mesh, const glm::mat4& stage_from_mesh, glm::u8vec4 colour);
  void End();

 private:
  struct State;
  explicit Overlay(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::render
