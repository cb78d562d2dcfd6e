#pragma once

// What of a map lies below the pointer.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "editor/panels/view_camera.h"
#include "shared/geometry/camera_model.h"

namespace lararium::panels {

// A press and release this close to each other is a click, no drag; window pixels.
inline constexpr double kClickPx = 4.0;

// The index of the point that a click means: of those that are drawn below it (within near_px)
// the nearest to the eye, otherwise the one nearest to it on the screen, within reach_px.
std::optional<uint32_t> PointBelow(std::span<const Eigen::Vector3f> points_in_world,
                                   const ViewCamera& view,
                                   const Eigen::Vector2d& pixel,
                                   double near_px,
                                   double reach_px);

// Which points are chosen after a click: at most two. point: that it means, nullopt: none.
// add: it is the other end of a distance.
void ChoosePoint(std::optional<uint32_t> point, bool add, std::vector<uint32_t>& chosen);

// The corners of a camera's image so far before its eye, in the world: from its top left one
// clockwise. depth: world units.
struct Frustum {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d corners[4];

  Frustum(const geometry::CameraModel& camera,
          const geometry::Rigid3& camera_from_world,
          double depth);
};

// How far a pixel is from the lines of a frustum as they are drawn; infinite where it is not
// wholly before the view.
double DistancePx(const Frustum& frustum, const ViewCamera& view, const Eigen::Vector2d& pixel);

}  // namespace lararium::panels
