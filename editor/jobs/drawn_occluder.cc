#include "editor/jobs/drawn_occluder.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "editor/document/place_edits.h"
#include "shared/geometry/glm_convert.h"
#include "shared/geometry/point_spread.h"

namespace lararium::editor {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kThin = 0.01;  // Share of the face's length; a narrower face counts as a line.

// The plane through the corners, and the corners in its coordinates.
struct Face {
  Vector3d center;
  Vector3d normal;  // Points to the images in which the face was drawn.
  std::vector<Vector2d> corners;
  double unevenness = 0.0;
  bool thin = false;
};

// The mean position of the images on which an occluder was drawn.
Vector3d DrawnFrom(const OccluderDocument& occluder, const vision::SceneDatabase& map) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (const stage::Anchor& corner : occluder.corners) {
    for (const stage::Pick& pick : corner.picks) {
      for (const vision::Keyframe& keyframe : map.keyframes) {
        if (keyframe.session == pick.session && keyframe.frame_index == pick.frame_index) {
          sum += keyframe.camera_from_map.Center();
          ++count;
        }
      }
    }
  }
  return sum / std::max(count, 1);
}

Face FitFace(std::span<const Vector3d> corners, const Vector3d& drawn_from) {
  Face face;
  const geometry::PointSpread spread = geometry::SpreadOf(corners);
  face.center = spread.mean;
  face.thin = spread.deviations[1] < kThin * spread.deviations[2];
  face.normal = spread.axes.col(0);
  if (face.normal.dot(drawn_from - face.center) < 0.0) {
    face.normal = -face.normal;
  }
  const Vector3d x = spread.axes.col(2);
  const Vector3d y = face.normal.cross(x);
  for (const Vector3d& corner : corners) {
    const Vector3d from_center = corner - face.center;
    face.corners.emplace_back(from_center.dot(x), from_center.dot(y));
    face.unevenness = std::max(face.unevenness, std::abs(from_center.dot(face.normal)));
  }
  return face;
}

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double TwiceArea(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return Cross(b - a, c - a);
}

double TwiceArea(std::span<const Vector2d> polygon) {
  double area = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    area += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return area;
}

bool Crosses(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return TwiceArea(a, b, c) * TwiceArea(a, b, d) < 0.0 &&
         TwiceArea(c, d, a) * TwiceArea(c, d, b) < 0.0;
}

// The indices of two edges that cross, each by its first corner. Adjacent edges never do.
std::optional<std::pair<size_t, size_t>> CrossingEdges(std::span<const Vector2d> polygon) {
  const size_t count = polygon.size();
  for (size_t i = 0; i < count; ++i) {
    for (size_t j = i + 2; j < count; ++j) {
      const bool neighbours = i == 0 && j + 1 == count;
      if (!neighbours &&
          Crosses(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % count])) {
        return std::pair(i, j);
      }
    }
  }
  return std::nullopt;
}

// Whether the corner at index at of the remaining polygon is an ear: convex, with no other corner
// inside.
bool IsEar(std::span<const Vector2d> polygon, std::span<const uint32_t> left, size_t at) {
  const size_t count = left.size();
  const Vector2d& a = polygon[left[(at + count - 1) % count]];
  const Vector2d& b = polygon[left[at]];
  const Vector2d& c = polygon[left[(at + 1) % count]];
  if (TwiceArea(a, b, c) <= 0.0) {
    return false;
  }
  return std::none_of(left.begin(), left.end(), [&](uint32_t other) {
    const Vector2d& p = polygon[other];
    return &p != &a && &p != &b && &p != &c && TwiceArea(a, b, p) >= 0.0 &&
           TwiceArea(b, c, p) >= 0.0 && TwiceArea(c, a, p) >= 0.0;
  });
}

// Triangulates a simple counter-clockwise polygon by cutting off ears (Meisters, "Polygons Have
// Ears", American Mathematical Monthly 1975).
std::vector<uint32_t> Triangulate(std::span<const Vector2d> polygon) {
  std::vector<uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<uint32_t> indices;
  while (left.size() >= 3) {
    size_t ear = 0;
    while (ear < left.size() && !IsEar(polygon, left, ear)) {
      ++ear;
    }
    // No ear exists where corners coincide; the triangle that is cut then has no area.
    ear %= left.size();
    const size_t count = left.size();
    indices.insert(indices.end(),
                   {left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return indices;
}

// corners: counter-clockwise as seen from the front. back: the offset from the face to the back of
// the prism.
geometry::TriangleMesh MakeMesh(std::span<const Vector3d> corners,
                                const std::vector<uint32_t>& face,
                                const Vector3d& back) {
  geometry::TriangleMesh mesh;
  const auto count = static_cast<uint32_t>(corners.size());
  for (const Vector3d& corner : corners) {
    mesh.positions.push_back(geometry::ToGlm(corner));
  }
  mesh.indices = face;
  if (back.isZero()) {
    return mesh;
  }
  for (const Vector3d& corner : corners) {
    mesh.positions.push_back(geometry::ToGlm(Vector3d(corner + back)));
  }
  for (size_t i = 0; i < face.size(); i += 3) {
    mesh.indices.insert(mesh.indices.end(),
                        {count + face[i], count + face[i + 2], count + face[i + 1]});
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    mesh.indices.insert(mesh.indices.end(), {i, count + i, count + next, i, count + next, next});
  }
  return mesh;
}

Result<std::vector<stage::AnchorReport>> LocateCorners(const OccluderDocument& occluder,
                                                       const vision::SceneDatabase& map,
                                                       const std::string& place) {
  if (occluder.corners.size() < 3) {
    return Status::Error(place, "a face needs at least three corners", "pick more corners");
  }
  std::vector<stage::AnchorReport> reports;
  for (const stage::Anchor& corner : occluder.corners) {
    const auto picks = std::count_if(map.keyframes.begin(), map.keyframes.end(),
                                     [&](const auto& k) { return PickIn(corner, k) != nullptr; });
    if (picks < 2) {
      return Status::Error(place, corner.name + " is picked in fewer than two images of this map",
                           "pick it in two, taken from different places");
    }
    Result<stage::AnchorReport> report = stage::SolveAnchor(corner, map);
    if (!report.ok()) {
      return report.status().At(place);
    }
    reports.push_back(*std::move(report));
  }
  return reports;
}

}  // namespace

Result<DrawnOccluder> DrawOccluder(const OccluderDocument& occluder,
                                   const vision::SceneDatabase& map,
                                   double map_units_per_metre) {
  const std::string place = "occluder '" + occluder.name + "'";
  DrawnOccluder drawn;
  LARARIUM_ASSIGN_OR_RETURN(drawn.corners, LocateCorners(occluder, map, place));
  std::vector<Vector3d> corners;
  double squares = 0.0;
  int picks = 0;
  for (const stage::AnchorReport& report : drawn.corners) {
    corners.push_back(report.point_in_map);
    squares += report.picks * report.error_px * report.error_px;
    picks += report.picks;
  }
  drawn.error_px = std::sqrt(squares / picks);
  Face face = FitFace(corners, DrawnFrom(occluder, map));
  drawn.unevenness = face.unevenness;
  if (face.thin) {
    return Status::Error(place, "its corners lie on a line", "pick corners of a face");
  }
  if (const auto crossing = CrossingEdges(face.corners)) {
    return Status::Error(place,
                         "the edges from " + CornerName(crossing->first) + " and from " +
                             CornerName(crossing->second) + " cross",
                         "pick the corners in their order around the face");
  }
  if (occluder.flat) {
    for (Vector3d& corner : corners) {
      corner -= face.normal.dot(corner - face.center) * face.normal;
    }
  }
  if (TwiceArea(face.corners) < 0.0) {
    std::reverse(face.corners.begin(), face.corners.end());
    std::reverse(corners.begin(), corners.end());
  }
  drawn.mesh_in_map = MakeMesh(corners, Triangulate(face.corners),
                               -occluder.depth * map_units_per_metre * face.normal);
  return drawn;
}

PlaceDocument WithoutDrafts(PlaceDocument place, const vision::SceneDatabase& map) {
  std::erase_if(place.occluders, [&](const OccluderDocument& occluder) {
    return occluder.drawn() && !DrawOccluder(occluder, map, 1.0).ok();
  });
  return place;
}

const stage::Pick* PickIn(const stage::Anchor& anchor, const vision::Keyframe& keyframe) {
  const auto found =
      std::find_if(anchor.picks.begin(), anchor.picks.end(),
                   [&](const stage::Pick& pick) { return stage::LiesIn(pick, keyframe); });
  return found == anchor.picks.end() ? nullptr : &*found;
}

std::optional<size_t> NextCorner(const OccluderDocument& occluder,
                                 const vision::Keyframe& keyframe) {
  bool elsewhere = false;
  for (size_t i = 0; i < occluder.corners.size(); ++i) {
    const stage::Anchor& corner = occluder.corners[i];
    const bool here = PickIn(corner, keyframe) != nullptr;
    if (!here && !corner.picks.empty()) {
      return i;
    }
    elsewhere |= corner.picks.size() > 1;
  }
  const bool more = !elsewhere && occluder.corners.size() < kMaxCorners;
  return more ? std::optional(occluder.corners.size()) : std::nullopt;
}

std::optional<size_t> CornerNear(const OccluderDocument& occluder,
                                 const vision::Keyframe& keyframe,
                                 const Vector2d& pixel,
                                 double reach_px) {
  std::optional<size_t> nearest;
  for (size_t i = 0; i < occluder.corners.size(); ++i) {
    const stage::Pick* pick = PickIn(occluder.corners[i], keyframe);
    if (pick != nullptr && (pick->pixel - pixel).norm() <= reach_px) {
      reach_px = (pick->pixel - pixel).norm();
      nearest = i;
    }
  }
  return nearest;
}

void SetCorner(OccluderDocument& occluder,
               size_t corner,
               const vision::Keyframe& keyframe,
               const Vector2d& pixel) {
  if (corner >= occluder.corners.size()) {
    occluder.corners.push_back({CornerName(occluder.corners.size()), {}});
    corner = occluder.corners.size() - 1;
  }
  SetPick(occluder.corners[corner], {keyframe.frame_index, keyframe.name, pixel, keyframe.session});
}

}  // namespace lararium::editor
