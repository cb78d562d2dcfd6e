#include "editor/document/occluder_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>
#include <vector>

#include "editor/document/document_fields.h"
#include "editor/text/text.h"

namespace lararium::editor {

namespace {

using Kind = OccluderShape::Kind;

constexpr ShapeSize kWidth = {"width", TrLater("Width"), &OccluderShape::width};
constexpr ShapeSize kHeight = {"height", TrLater("Height"), &OccluderShape::height};
constexpr ShapeSize kDepth = {"depth", TrLater("Depth"), &OccluderShape::depth};
constexpr ShapeSize kDiameter = {"diameter", TrLater("Diameter"), &OccluderShape::width};
constexpr ShapeSize kOpening = {"opening", TrLater("Opening"), &OccluderShape::opening};
constexpr ShapeSize kSpring = {"spring", TrLater("Spring line"), &OccluderShape::spring};

constexpr std::array kBoxSizes = {kWidth, kHeight, kDepth};
constexpr std::array kPlaneSizes = {kWidth, kHeight};
constexpr std::array kCylinderSizes = {kDiameter, kHeight};
constexpr std::array kArchSizes = {kWidth, kHeight, kDepth, kOpening, kSpring};
constexpr std::array kFloorSizes = {kWidth, kDepth};

constexpr std::array<ShapeEntry, 5> kEntries = {{
    {"box", TrLater("Box"), kBoxSizes, {Kind::kBox, 1.0, 1.0, 1.0}},
    {"plane", TrLater("Plane"), kPlaneSizes, {Kind::kPlane, 2.0, 2.5}},
    {"cylinder", TrLater("Cylinder"), kCylinderSizes, {Kind::kCylinder, 0.4, 2.5}},
    {"arch", TrLater("Arch"), kArchSizes, {Kind::kArch, 3.0, 3.0, 0.3, 1.2, 1.8}},
    {"floor", TrLater("Floor"), kFloorSizes, {Kind::kFloor, 6.0, 1.0, 6.0}, false},
}};

// A polygon in the plane of x and y, counter-clockwise, with its triangles.
struct Outline {
  std::vector<glm::dvec2> corners;
  std::vector<uint32_t> indices;
};

// Extrudes the outline by half of the depth to each side of its plane, along z.
geometry::TriangleMesh Extruded(const Outline& outline, double depth) {
  geometry::TriangleMesh mesh;
  const auto count = static_cast<uint32_t>(outline.corners.size());
  for (const double z : {0.5 * depth, -0.5 * depth}) {
    for (const glm::dvec2& corner : outline.corners) {
      mesh.positions.emplace_back(corner.x, corner.y, z);
    }
  }
  mesh.indices = outline.indices;
  for (size_t i = 0; i < outline.indices.size(); i += 3) {
    const uint32_t* face = &outline.indices[i];
    mesh.indices.insert(mesh.indices.end(), {face[0] + count, face[2] + count, face[1] + count});
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    mesh.indices.insert(mesh.indices.end(), {i, i + count, next + count, i, next + count, next});
  }
  return mesh;
}

Outline Rectangle(double width, double height) {
  const double x = 0.5 * width;
  return {{{-x, 0.0}, {x, 0.0}, {x, height}, {-x, height}}, {0, 1, 2, 0, 2, 3}};
}

Outline Circle(double diameter) {
  Outline outline;
  for (int i = 0; i < kRoundSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRoundSides;
    outline.corners.emplace_back(0.5 * diameter * std::cos(angle),
                                 0.5 * diameter * std::sin(angle));
  }
  for (uint32_t i = 1; i + 1 < kRoundSides; ++i) {
    outline.indices.insert(outline.indices.end(), {0, i, i + 1});
  }
  return outline;
}

// The corners run from the left foot over the opening to the right foot, then back along the top.
// Each upper corner of the wall is connected to its half of the arch.
Outline ArchOutline(const OccluderShape& arch) {
  constexpr uint32_t kSteps = kRoundSides / 2;
  const double x = 0.5 * arch.width;
  const double radius = 0.5 * arch.opening;
  const bool jambs = arch.spring >= kMinShape;
  const double spring = jambs ? arch.spring : 0.0;
  Outline outline;
  std::vector<glm::dvec2>& corners = outline.corners;
  corners.emplace_back(-x, 0.0);
  if (jambs) {
    corners.emplace_back(-radius, 0.0);
  }
  // Index of the first corner of the arch.
  const auto first = static_cast<uint32_t>(corners.size());
  for (uint32_t i = 0; i <= kSteps; ++i) {
    const double angle = std::numbers::pi * (1.0 - static_cast<double>(i) / kSteps);
    corners.emplace_back(radius * std::cos(angle), spring + radius * std::sin(angle));
  }
  corners[first].y = corners.back().y = spring;
  const uint32_t last = first + kSteps;
  if (jambs) {
    corners.emplace_back(radius, 0.0);
  }
  corners.emplace_back(x, 0.0);
  const auto right_foot = static_cast<uint32_t>(corners.size() - 1);
  const uint32_t right_top = right_foot + 1;
  const uint32_t left_top = right_foot + 2;
  corners.emplace_back(x, arch.height);
  corners.emplace_back(-x, arch.height);

  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    outline.indices.insert(outline.indices.end(), {a, b, c});
  };
  if (jambs) {
    add(0, 1, first);
    add(last, last + 1, right_foot);
  }
  add(0, first, left_top);
  add(right_top, last, right_foot);
  const uint32_t apex = first + kSteps / 2;
  for (uint32_t i = first; i < last; ++i) {
    add(i < apex ? left_top : right_top, i, i + 1);
  }
  add(left_top, apex, right_top);
  return outline;
}

// A rectangle with two sides that share their corners: each edge has two triangles, as in any
// solid.
geometry::TriangleMesh Sheet(double width, double height) {
  geometry::TriangleMesh mesh;
  for (const glm::dvec2& corner : Rectangle(width, height).corners) {
    mesh.positions.emplace_back(corner.x, corner.y, 0.0);
  }
  mesh.indices = {0, 1, 2, 0, 2, 3, 1, 0, 3, 1, 3, 2};
  return mesh;
}

// Rotates a mesh so that its front faces up.
geometry::TriangleMesh LaidDown(geometry::TriangleMesh mesh, double height) {
  for (glm::vec3& at : mesh.positions) {
    at = {at.x, at.z, static_cast<float>(0.5 * height) - at.y};
  }
  return mesh;
}

// Rotates a mesh that was extruded along z so that its axis is vertical.
geometry::TriangleMesh StoodUp(geometry::TriangleMesh mesh, double height) {
  for (glm::vec3& at : mesh.positions) {
    at = {at.x, at.z + static_cast<float>(0.5 * height), -at.y};
  }
  return mesh;
}

std::string Metres(double value) { return Text("%g m", value); }

}  // namespace

std::span<const ShapeEntry> ShapeEntries() { return kEntries; }

const ShapeEntry& EntryOf(Kind kind) { return kEntries[static_cast<size_t>(kind)]; }

const ShapeEntry* FindShapeEntry(std::string_view name) {
  const auto found = std::find_if(kEntries.begin(), kEntries.end(),
                                  [&](const ShapeEntry& entry) { return entry.name == name; });
  return found == kEntries.end() ? nullptr : &*found;
}

std::pair<double, double> RangeOf(const OccluderShape& shape, const ShapeSize& size) {
  if (shape.kind != Kind::kArch || size.value == &OccluderShape::depth) {
    return {kMinShape, kMaxShape};
  }
  if (size.value == &OccluderShape::width) {
    return {shape.opening + 2.0 * kMinShape, kMaxShape};
  }
  if (size.value == &OccluderShape::height) {
    return {shape.spring + 0.5 * shape.opening + kMinShape, kMaxShape};
  }
  if (size.value == &OccluderShape::opening) {
    const double below_top = 2.0 * (shape.height - kMinShape - shape.spring);
    return {kMinShape, std::min(shape.width - 2.0 * kMinShape, below_top)};
  }
  return {0.0, shape.height - kMinShape - 0.5 * shape.opening};
}

Status CheckShape(const OccluderShape& shape, const std::string& where) {
  constexpr double kRounding = 1e-9;
  for (const ShapeSize& size : EntryOf(shape.kind).sizes) {
    const double least = size.value == &OccluderShape::spring ? 0.0 : kMinShape;
    const double value = shape.*size.value;
    if (!(value >= least && value <= kMaxShape)) {
      return Status::Error(where, "\"" + std::string(size.name) + "\" is " + Metres(value),
                           "give from " + Metres(least) + " to " + Metres(kMaxShape));
    }
  }
  if (shape.kind != Kind::kArch) {
    return Status();
  }
  if (shape.opening > shape.width - 2.0 * kMinShape + kRounding) {
    return Status::Error(where,
                         "an opening of " + Metres(shape.opening) + " leaves no wall of " +
                             Metres(shape.width) + " beside it",
                         "make \"width\" more or \"opening\" less");
  }
  const double top = shape.spring + 0.5 * shape.opening;
  if (top > shape.height - kMinShape + kRounding) {
    return Status::Error(where,
                         "the arch ends " + Metres(top) +
                             " above the floor (\"spring\" and half "
                             "of \"opening\"), and leaves no wall of " +
                             Metres(shape.height) + " above it",
                         "make \"height\" more, or one of these less");
  }
  return Status();
}

geometry::TriangleMesh MakeShapeMesh(const OccluderShape& shape) {
  switch (shape.kind) {
    case Kind::kBox:
      return Extruded(Rectangle(shape.width, shape.height), shape.depth);
    case Kind::kPlane:
      return Sheet(shape.width, shape.height);
    case Kind::kCylinder:
      return StoodUp(Extruded(Circle(shape.width), shape.height), shape.height);
    case Kind::kFloor:
      return LaidDown(Sheet(shape.width, shape.depth), shape.depth);
    case Kind::kArch:
      break;
  }
  return Extruded(ArchOutline(shape), shape.depth);
}

std::string DescribeShape(const OccluderShape& shape) {
  const ShapeEntry& entry = EntryOf(shape.kind);
  std::string text = entry.name;
  for (const ShapeSize& size : entry.sizes) {
    text += Text(", %s %g", size.name, shape.*size.value);
  }
  return text;
}

void DescribeFields(Fields& fields, OccluderShape& shape) {
  std::string kind = EntryOf(shape.kind).name;
  fields.Text("kind", kind);
  const ShapeEntry* entry = FindShapeEntry(kind);
  fields.Require(entry != nullptr, "\"kind\" is not known",
                 "use box, plane, cylinder, arch or floor");
  if (entry == nullptr) {
    return;
  }
  if (fields.reading()) {
    shape = entry->usual;
  }
  for (const ShapeSize& size : entry->sizes) {
    fields.Number(size.name, shape.*size.value);
  }
  fields.Check(CheckShape(shape, fields.where()));
}

Eigen::Vector3d FloorBefore(const std::optional<geometry::Rigid3>& camera_from_stage) {
  constexpr double kUsual = 3.0;     // Metres in front of a camera that does not look at the floor.
  constexpr double kNearest = 1.0;   // Metres; closer shapes would not be fully visible.
  constexpr double kFarthest = 6.0;  // Metres; farther shapes would be too small to judge.
  if (!camera_from_stage) {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3d eye = camera_from_stage->Center();
  const Eigen::Vector3d view = camera_from_stage->rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ahead(view.x(), 0.0, view.z());
  if (ahead.norm() < 1e-3) {  // The camera looks straight down or up.
    return {std::round(100.0 * eye.x()) / 100.0, 0.0, std::round(100.0 * eye.z()) / 100.0};
  }
  double distance = kUsual;
  if (eye.y() > 0.0 && view.y() < 0.0) {
    distance = std::clamp(ahead.norm() * eye.y() / -view.y(), kNearest, kFarthest);
  }
  const Eigen::Vector3d at = eye + distance * ahead.normalized();
  return {std::round(100.0 * at.x()) / 100.0, 0.0, std::round(100.0 * at.z()) / 100.0};
}

}  // namespace lararium::editor
