#pragma once

// Meshes drawn as translucent solids over a picture: the faces and edges that a camera sees, their
// window positions and their shading.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "editor/panels/viewport/view_camera.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::panels {

// Whether two meshes have the same vertices and triangles.
bool SameMesh(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b);

// A mesh prepared for drawing; corners in its own coordinates.
struct OverlayMesh {
  std::vector<Eigen::Vector3d> corners;  // Each position once.
  std::vector<std::array<uint32_t, 3>> faces;
  std::vector<std::array<uint32_t, 2>> edges;  // Edges where the surface ends or bends.
};
// Triangles without area are left out.
OverlayMesh MakeOverlayMesh(const geometry::TriangleMesh& mesh);

struct OverlayFace {
  // The part of the face in front of the camera, window pixels: convex, three or four corners.
  std::array<Eigen::Vector2d, 4> outline;
  int corners = 0;
  double distance = 0.0;  // Depth of its centre, world units.
  double shade = 1.0;     // 0..1, from a lamp beside and above the camera.
  int overlay = 0;        // The number that was passed to AddFaces.
};

// Parts nearer to the camera's plane are not drawn; world units.
inline constexpr double kOverlayNear = 0.02;

// Appends the faces that the camera sees, from both sides, because occluders hide people on both
// sides.
void AddFaces(const OverlayMesh& overlay,
              const geometry::Similarity3& world_from_mesh,
              const ViewCamera& view,
              int number,
              std::vector<OverlayFace>& faces);

// Sorts for drawing: nearer faces over farther ones.
void SortFarthestFirst(std::vector<OverlayFace>& faces);

}  // namespace lararium::panels
