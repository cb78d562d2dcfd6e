#include "editor/panels/viewport/overlay_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "shared/geometry/glm_convert.h"

namespace lararium::panels {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBend = 0.94;     // Cosine of 20 degrees: smaller bends count as smooth.
constexpr double kAmbient = 0.35;  // The shade of a face that points away from the lamp.

// Merges vertices at the same position. Files duplicate them for normals and textures, but edges
// need each position once.
std::vector<uint32_t> Weld(const std::vector<glm::vec3>& positions,
                           std::vector<Vector3d>& corners) {
  std::map<std::tuple<float, float, float>, uint32_t> known;
  std::vector<uint32_t> welded;
  welded.reserve(positions.size());
  for (const glm::vec3& at : positions) {
    const auto [entry, is_new] =
        known.try_emplace({at.x, at.y, at.z}, static_cast<uint32_t>(corners.size()));
    if (is_new) {
      corners.push_back(geometry::ToEigen(at));
    }
    welded.push_back(entry->second);
  }
  return welded;
}

Vector3d TwiceArea(const std::vector<Vector3d>& corners, const std::array<uint32_t, 3>& face) {
  return (corners[face[1]] - corners[face[0]]).cross(corners[face[2]] - corners[face[0]]);
}

// The direction within a face, perpendicular to the edge between two of its corners.
Vector3d AcrossEdge(const std::vector<Vector3d>& corners,
                    const std::array<uint32_t, 3>& face,
                    uint32_t from,
                    uint32_t to) {
  const uint32_t apex = face[0] ^ face[1] ^ face[2] ^ from ^ to;  // The third corner.
  const Vector3d along = (corners[to] - corners[from]).normalized();
  const Vector3d to_apex = corners[apex] - corners[from];
  return (to_apex - along.dot(to_apex) * along).normalized();
}

// Finds edges at the border of the surface (with one face, or with two that lie on each other), and
// edges whose faces differ in direction, for either winding.
void FindEdges(OverlayMesh& overlay) {
  std::map<std::pair<uint32_t, uint32_t>, std::vector<size_t>> faces_of;
  for (size_t i = 0; i < overlay.faces.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(overlay.faces[i][k], overlay.faces[i][(k + 1) % 3]);
      faces_of[{low, high}].push_back(i);
    }
  }
  for (const auto& [edge, faces] : faces_of) {
    const auto across = [&overlay, from = edge.first, to = edge.second](size_t face) {
      return AcrossEdge(overlay.corners, overlay.faces[face], from, to);
    };
    const Vector3d first = across(faces.front());
    bool bends = false;
    bool goes_on = false;
    for (size_t i = 1; i < faces.size(); ++i) {
      const double cosine = first.dot(across(faces[i]));
      bends |= std::abs(cosine) < kBend;
      goes_on |= cosine <= -kBend;
    }
    if (bends || !goes_on) {
      overlay.edges.push_back({edge.first, edge.second});
    }
  }
}

// The part of a triangle beyond the near plane; 0, 3 or 4 corners. Camera axes.
int ClipNear(const std::array<Vector3d, 3>& triangle, std::array<Vector3d, 4>& kept) {
  int count = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Vector3d& a = triangle[i];
    const Vector3d& b = triangle[(i + 1) % 3];
    if (a.z() >= kOverlayNear) {
      kept[static_cast<size_t>(count++)] = a;
    }
    if ((a.z() < kOverlayNear) != (b.z() < kOverlayNear)) {
      kept[static_cast<size_t>(count++)] = a + (b - a) * (kOverlayNear - a.z()) / (b.z() - a.z());
    }
  }
  return count;
}

// The shade of the side that the camera sees. Camera axes: x right, y down, z forward.
double Shade(const std::array<Vector3d, 3>& triangle) {
  static const Vector3d kToLamp = Vector3d(-0.45, -0.7, -0.55).normalized();
  Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  if (normal.dot(triangle[0]) > 0.0) {
    normal = -normal;
  }
  return kAmbient + (1.0 - kAmbient) * std::max(0.0, normal.dot(kToLamp));
}

}  // namespace

bool SameMesh(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b) {
  return a.positions == b.positions && a.indices == b.indices;
}

OverlayMesh MakeOverlayMesh(const geometry::TriangleMesh& mesh) {
  OverlayMesh overlay;
  const std::vector<uint32_t> welded = Weld(mesh.positions, overlay.corners);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<uint32_t, 3> face = {welded[mesh.indices[i]], welded[mesh.indices[i + 1]],
                                          welded[mesh.indices[i + 2]]};
    if (!TwiceArea(overlay.corners, face).isZero(0.0)) {
      overlay.faces.push_back(face);
    }
  }
  FindEdges(overlay);
  return overlay;
}

void AddFaces(const OverlayMesh& overlay,
              const geometry::Similarity3& world_from_mesh,
              const ViewCamera& view,
              int number,
              std::vector<OverlayFace>& faces) {
  std::vector<Vector3d> in_camera;
  in_camera.reserve(overlay.corners.size());
  for (const Vector3d& corner : overlay.corners) {
    in_camera.push_back(view.camera_from_world * (world_from_mesh * corner));
  }
  for (const std::array<uint32_t, 3>& face : overlay.faces) {
    const std::array<Vector3d, 3> triangle = {in_camera[face[0]], in_camera[face[1]],
                                              in_camera[face[2]]};
    std::array<Vector3d, 4> kept;
    OverlayFace seen;
    seen.corners = ClipNear(triangle, kept);
    for (size_t i = 0; i < static_cast<size_t>(seen.corners); ++i) {
      seen.outline[i] = view.PixelOf(kept[i]);
      seen.distance += kept[i].z() / seen.corners;
    }
    if (seen.corners > 0) {
      seen.shade = Shade(triangle);
      seen.overlay = number;
      faces.push_back(seen);
    }
  }
}

void SortFarthestFirst(std::vector<OverlayFace>& faces) {
  std::stable_sort(faces.begin(), faces.end(), [](const OverlayFace& a, const OverlayFace& b) {
    return a.distance > b.distance;
  });
}

}  // namespace lararium::panels
