#pragma once

// Meshes as translucent solids over a picture: which faces and edges a camera sees, where in the
// window, and how light each face is.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "editor/panels/view_camera.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::panels {

// Whether two meshes have the same corners and triangles.
bool SameMesh(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b);

// A mesh made ready for that; corners in its own coordinates.
struct Ghost {
  std::vector<Eigen::Vector3d> corners;  // each place once
  std::vector<std::array<uint32_t, 3>> faces;
  std::vector<std::array<uint32_t, 2>> edges;  // where the surface ends or bends
};
// Triangles without area are left out.
Ghost MakeGhost(const geometry::TriangleMesh& mesh);

struct GhostFace {
  // What of it lies before the camera, in the window's pixels: convex, three or four corners.
  std::array<Eigen::Vector2d, 4> outline;
  int corners = 0;
  double distance = 0.0;  // of its middle along the view, world units
  double shade = 1.0;     // 0..1, by how it faces a lamp beside and above the camera
  int ghost = 0;          // whose it is, as AddFaces was told
};

// Nearer than this to the camera's plane nothing of a ghost is drawn; world units.
inline constexpr double kGhostNear = 0.02;

// Appends the faces that the camera sees, of either side: what hides, hides from both.
void AddFaces(const Ghost& ghost,
              const geometry::Similarity3& world_from_mesh,
              const ViewCamera& view,
              int number,
              std::vector<GhostFace>& faces);

// So that nearer ones are drawn over those behind.
void SortFarthestFirst(std::vector<GhostFace>& faces);

}  // namespace lararium::panels
