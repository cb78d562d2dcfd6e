#include "editor/panels/ghost.h"

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

constexpr double kBend = 0.94;     // cosine of 20 degrees: surfaces that bend less look smooth
constexpr double kAmbient = 0.35;  // of a face that turns from the lamp

// Files repeat corners for the sake of normals and textures; edges need each place once.
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

// Where a face goes on from its edge at two of its corners: across the edge, within the face.
Vector3d AcrossEdge(const std::vector<Vector3d>& corners,
                    const std::array<uint32_t, 3>& face,
                    uint32_t from,
                    uint32_t to) {
  const uint32_t apex = face[0] ^ face[1] ^ face[2] ^ from ^ to;  // the third one
  const Vector3d along = (corners[to] - corners[from]).normalized();
  const Vector3d to_apex = corners[apex] - corners[from];
  return (to_apex - along.dot(to_apex) * along).normalized();
}

// Edges beyond which no face goes on, as of a single one or of two that lie on each other, and
// those whose faces differ in direction, however they are wound.
void FindEdges(Ghost& ghost) {
  std::map<std::pair<uint32_t, uint32_t>, std::vector<size_t>> faces_of;
  for (size_t i = 0; i < ghost.faces.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(ghost.faces[i][k], ghost.faces[i][(k + 1) % 3]);
      faces_of[{low, high}].push_back(i);
    }
  }
  for (const auto& [edge, faces] : faces_of) {
    const auto across = [&ghost, from = edge.first, to = edge.second](size_t face) {
      return AcrossEdge(ghost.corners, ghost.faces[face], from, to);
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
      ghost.edges.push_back({edge.first, edge.second});
    }
  }
}

// What of a triangle lies beyond the near plane; 0, 3 or 4 corners. Camera axes.
int ClipNear(const std::array<Vector3d, 3>& triangle, std::array<Vector3d, 4>& kept) {
  int count = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Vector3d& a = triangle[i];
    const Vector3d& b = triangle[(i + 1) % 3];
    if (a.z() >= kGhostNear) {
      kept[static_cast<size_t>(count++)] = a;
    }
    if ((a.z() < kGhostNear) != (b.z() < kGhostNear)) {
      kept[static_cast<size_t>(count++)] = a + (b - a) * (kGhostNear - a.z()) / (b.z() - a.z());
    }
  }
  return count;
}

// Camera axes: x right, y down, z forward. Of the side that the camera sees.
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

Ghost MakeGhost(const geometry::TriangleMesh& mesh) {
  Ghost ghost;
  const std::vector<uint32_t> welded = Weld(mesh.positions, ghost.corners);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<uint32_t, 3> face = {welded[mesh.indices[i]], welded[mesh.indices[i + 1]],
                                          welded[mesh.indices[i + 2]]};
    if (!TwiceArea(ghost.corners, face).isZero(0.0)) {
      ghost.faces.push_back(face);
    }
  }
  FindEdges(ghost);
  return ghost;
}

void AddFaces(const Ghost& ghost,
              const geometry::Similarity3& world_from_mesh,
              const ViewCamera& view,
              int number,
              std::vector<GhostFace>& faces) {
  std::vector<Vector3d> in_camera;
  in_camera.reserve(ghost.corners.size());
  for (const Vector3d& corner : ghost.corners) {
    in_camera.push_back(view.camera_from_world * (world_from_mesh * corner));
  }
  for (const std::array<uint32_t, 3>& face : ghost.faces) {
    const std::array<Vector3d, 3> triangle = {in_camera[face[0]], in_camera[face[1]],
                                              in_camera[face[2]]};
    std::array<Vector3d, 4> kept;
    GhostFace seen;
    seen.corners = ClipNear(triangle, kept);
    for (size_t i = 0; i < static_cast<size_t>(seen.corners); ++i) {
      seen.outline[i] = view.PixelOf(kept[i]);
      seen.distance += kept[i].z() / seen.corners;
    }
    if (seen.corners > 0) {
      seen.shade = Shade(triangle);
      seen.ghost = number;
      faces.push_back(seen);
    }
  }
}

void SortFarthestFirst(std::vector<GhostFace>& faces) {
  std::stable_sort(faces.begin(), faces.end(),
                   [](const GhostFace& a, const GhostFace& b) { return a.distance > b.distance; });
}

}  // namespace lararium::panels
