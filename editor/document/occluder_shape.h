#pragma once

// Simple solids, given by their sizes, that stand for real objects which hide people: walls,
// pillars, counters, arches. The project stores the sizes; meshes are generated where they are
// needed.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "shared/core/json_fields.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::editor {

// Frame: Y up, x along the width, z along the depth. The origin is the middle of the base, so that
// a shape stands on the floor where it is placed and rotates in place.
struct OccluderShape {
  enum class Kind {
    kBox,
    kPlane,     // An upright rectangle without thickness that faces +z and -z.
    kCylinder,  // The axis is vertical.
    kArch,      // A wall with an opening that ends in a half circle.
    kFloor      // A horizontal rectangle without thickness.
  };
  Kind kind = Kind::kBox;
  // Metres. Sizes that the kind does not have are ignored (see ShapeEntry::sizes).
  double width = 1.0;    // The diameter of a cylinder.
  double height = 1.0;   // The total height.
  double depth = 1.0;    // Used by a box, an arch and a floor.
  double opening = 1.0;  // The width of the opening of an arch.
  double spring = 1.0;   // The height at which the half circle of an arch begins; 0: on the floor.
};

// Metres. Limits of every size. kMinShape is also the least wall that remains around the opening of
// an arch.
inline constexpr double kMinShape = 1e-3;
inline constexpr double kMaxShape = 1e3;

struct ShapeSize {
  const char* name;   // The name in files and options.
  const char* label;  // The label in the interface, to be translated.
  double OccluderShape::*value;
};

struct ShapeEntry {
  const char* name;   // The name in files and options.
  const char* label;  // The label in the interface, to be translated.
  std::span<const ShapeSize> sizes;
  OccluderShape usual;  // The sizes of a new shape.
  // Whether a new shape muffles the sounds behind it and people walk around it.
  bool in_the_way = true;
};

// All kinds, in the order of OccluderShape::Kind.
std::span<const ShapeEntry> ShapeEntries();
const ShapeEntry& EntryOf(OccluderShape::Kind kind);
// Returns nullptr where there is no kind of this name.
const ShapeEntry* FindShapeEntry(std::string_view name);

// The smallest and the largest value of one size while the other sizes stay as they are.
std::pair<double, double> RangeOf(const OccluderShape& shape, const ShapeSize& size);

// Checks that all sizes are within their limits, and that an arch has some wall beside and above
// its opening. where: the name of the shape in errors.
Status CheckShape(const OccluderShape& shape, const std::string& where);

// The closed surface of a valid shape, without normals. Triangles face outwards; each corner exists
// once. Round sides are polygons of kRoundSides corners that lie on the true circle.
inline constexpr int kRoundSides = 48;
geometry::TriangleMesh MakeShapeMesh(const OccluderShape& shape);

// For example "box, width 2, height 0.9, depth 0.6", in metres.
std::string DescribeShape(const OccluderShape& shape);

// Every size of the kind is required; other fields are an error.
void DescribeFields(Fields& fields, OccluderShape& shape);

// Where a new shape is placed, stage axes, metres, rounded to a centimetre: on the stage's floor,
// where the camera looks, a few metres in front of it. Without a pose: the stage's origin.
Eigen::Vector3d FloorBefore(const std::optional<geometry::Rigid3>& camera_from_stage);

}  // namespace lararium::editor
