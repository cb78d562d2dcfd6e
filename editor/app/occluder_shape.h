#pragma once

// Real things of a simple form that hide people, given by their sizes: walls, pillars, counters,
// arches. The project keeps the sizes; meshes are made of them wherever they are needed.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::app {

// Frame: Y up; x along the width, z along the depth. The origin is the middle of the foot, so that
// a shape stands on the floor where it is put and turns in place.
struct OccluderShape {
  enum class Kind {
    kBox,
    kPlane,     // an upright rectangle without thickness, facing +z and -z
    kCylinder,  // upright
    kArch,      // a wall with an opening that a half circle closes above
    kFloor      // a lying rectangle without thickness
  };
  Kind kind = Kind::kBox;
  // Metres; those that the kind does not have mean nothing (see ShapeEntry::sizes).
  double width = 1.0;    // of a cylinder: its diameter
  double height = 1.0;   // of the whole
  double depth = 1.0;    // of a box, an arch and a floor
  double opening = 1.0;  // how wide the opening of an arch is
  double spring = 1.0;   // how high its half circle begins; 0: on the floor
};

inline constexpr double kMinShape = 1e-3;  // metres, of every size and of what is left of an arch
inline constexpr double kMaxShape = 1e3;

struct ShapeSize {
  const char* name;   // in files and options
  const char* label;  // in the interface, to be translated
  double OccluderShape::*value;
};

struct ShapeEntry {
  const char* name;   // in files and options
  const char* label;  // in the interface, to be translated
  std::span<const ShapeSize> sizes;
  OccluderShape usual;  // what a new one is like
  // Whether it is in the way: sounds are muffled behind a new one, and people walk around it.
  bool in_the_way = true;
};

// In the order of the kinds.
std::span<const ShapeEntry> ShapeEntries();
const ShapeEntry& EntryOf(OccluderShape::Kind kind);
// nullptr: there is no such kind.
const ShapeEntry* FindShapeEntry(std::string_view name);

// Least and most that a size may be while the others stay as they are.
std::pair<double, double> RangeOf(const OccluderShape& shape, const ShapeSize& size);

// Whether all sizes are within their limits, and an arch has a wall left beside its opening and
// above it. place: what errors call the shape.
Status CheckShape(const OccluderShape& shape, const std::string& place);

// The closed surface of a shape that is valid, wound so that its triangles face outwards; each
// corner once, without normals. Round sides have kRoundSides faces, within the true circle.
inline constexpr int kRoundSides = 48;
geometry::TriangleMesh MakeShapeMesh(const OccluderShape& shape);

// "box, width 2, height 0.9, depth 0.6", in metres.
std::string DescribeShape(const OccluderShape& shape);

// Every size of the kind is needed, and nothing else is taken.
Result<OccluderShape> ParseShape(const JsonView& view);
Json FormatShape(const OccluderShape& shape);

// Where a new shape is put: on the stage's floor, where the camera looks, a few metres before it;
// the stage's origin where there is no pose. To the centimetre.
Eigen::Vector3d FloorBefore(const std::optional<geometry::Rigid3>& camera_from_stage);

}  // namespace lararium::app
