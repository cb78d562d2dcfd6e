#pragma once

// Finds points and cameras of a map under the pointer.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "editor/panels/viewport/view_camera.h"
#include "shared/geometry/camera_model.h"

namespace lararium::panels {

// Largest distance between press and release of a click; window pixels.
inline constexpr double kClickPx = 4.0;

// The index of the point that a click means: of the points drawn within near_px, the nearest to the
// eye; otherwise the nearest on the screen within reach_px.
std::optional<uint32_t> PointBelow(std::span<const Eigen::Vector3f> points_in_world,
                                   const ViewCamera& view,
                                   const Eigen::Vector2d& pixel,
                                   double near_px,
                                   double reach_px);

// Updates the selected points after a click: at most two. point: the clicked one; nullopt: none.
// add: adds the other end of a distance.
void ChoosePoint(std::optional<uint32_t> point, bool add, std::vector<uint32_t>& chosen);

// The corners of a camera's image at a depth, in the world, clockwise from the top left. depth:
// world units.
struct Frustum {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d corners[4];

  Frustum(const geometry::CameraModel& camera,
          const geometry::Rigid3& camera_from_world,
          double depth);
};

// The distance of a pixel from the lines of a frustum, pixels; infinite where it is not completely
// in front of the view.
double DistancePx(const Frustum& frustum, const ViewCamera& view, const Eigen::Vector2d& pixel);

}  // namespace lararium::panels
