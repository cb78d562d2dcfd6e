#include "shared/show/picture_camera.h"

#include <algorithm>
#include <cmath>

namespace lararium::show {
namespace {

// Crops a picture to width x height from its pixel (left, top) on.
void Cut(geometry::CameraModel& display, double left, double top, int width, int height) {
  display.cx -= left;
  display.cy -= top;
  display.width = width;
  display.height = height;
}

}  // namespace

geometry::CameraModel PartOfView(const geometry::CameraModel& camera, const ViewPart& part) {
  geometry::CameraModel display = camera.DisplayPinhole();
  if (part.isEmpty()) {
    return display;
  }
  const Eigen::Vector2d first = display.PixelFromPlane(part.min()).array() + 0.5;
  const Eigen::Vector2d last = display.PixelFromPlane(part.max()).array() + 0.5;
  const auto within = [](double at, int size) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
  };
  const int left = within(std::floor(first.x()), display.width);
  const int top = within(std::floor(first.y()), display.height);
  const int right = within(std::ceil(last.x()), display.width);
  const int bottom = within(std::ceil(last.y()), display.height);
  if (left < right && top < bottom) {
    Cut(display, left, top, right - left, bottom - top);
  }
  return display;
}

geometry::CameraModel PictureCamera(const geometry::CameraModel& camera,
                                    int width,
                                    int height,
                                    const ViewPart& part) {
  geometry::CameraModel display = PartOfView(camera, part);
  const double wide = static_cast<double>(width) / height;
  const int cut_width =
      std::clamp(static_cast<int>(std::lround(display.height * wide)), 1, display.width);
  const int cut_height =
      std::clamp(static_cast<int>(std::lround(display.width / wide)), 1, display.height);
  Cut(display, 0.5 * (display.width - cut_width), 0.5 * (display.height - cut_height), cut_width,
      cut_height);
  return display;
}

geometry::CameraModel ForEye(const geometry::CameraModel& picture, const PictureEye& eye) {
  const Eigen::Vector3d share = eye.in_camera / eye.picture_distance;
  geometry::CameraModel display = picture;
  display.fx *= 1.0 - share.z();
  display.fy *= 1.0 - share.z();
  display.cx += picture.fx * share.x();
  display.cy += picture.fy * share.y();
  return display;
}

}  // namespace lararium::show
