#pragma once

// The editor's drawing over the camera's image, or without one: points, lines and translucent
// meshes from any view. Colours are sRGB-encoded; alpha is opacity.

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
#include "shared/render/gl/render_target.h"
#include "shared/render/render_scene.h"

namespace lararium::render {

// "Stage" may stand for any frame here (for example the map's), as long as all data use the same.
struct OverlayView {
  geometry::CameraModel display;  // pinhole, scaled to the target's size
  geometry::Rigid3 camera_from_stage;
  float near = 0.01f;  // metres
  float far = 1000.0f;
  // Colour that fills the target first; nullopt: the overlay is drawn over its content.
  std::optional<glm::vec3> clear;

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
  kOnTop,  // always visible, for gizmos
};

class Overlay {
 public:
  // Needs a current context. Call all other members on the thread of that context.
  static Result<std::unique_ptr<Overlay>> Create();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  // mesh must be valid (TriangleMesh::Validate).
  MeshHandle AddMesh(const geometry::TriangleMesh& mesh);
  void RemoveMesh(MeshHandle mesh);

  // Uploads points that stay the same from picture to picture.
  PointsHandle AddPoints(std::span<const OverlayPoint> points);
  void RemovePoints(PointsHandle points);

  // Call Begin, any number of Draw..., then End. The target must have depth
  // (RenderTarget::Depth::kForOverlay) and must live until End.
  void Begin(const OverlayView& view, const RenderTarget& target);
  // Draws the first count points of a set, or all if it has fewer, as discs with a diameter of
  // size_px.
  Status DrawPoints(PointsHandle points,
                    size_t count,
                    float size_px,
                    OverlayDepth depth = OverlayDepth::kTest);
  void DrawLines(std::span<const OverlayLine> lines,
                 float width_px,
                 OverlayDepth depth = OverlayDepth::kTest);
  // Draws both sides of a mesh, shaded by a lamp at the camera.
  Status DrawMesh(MeshHandle mesh, const glm::mat4& stage_from_mesh, glm::u8vec4 colour);
  void End();

 private:
  struct State;
  explicit Overlay(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::render
