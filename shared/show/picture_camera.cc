#include "shared/show/picture_camera.h"

#include <algorithm>
#include <cmath>

namespace lararium::show {

geometry::CameraModel PictureCamera(const geometry::CameraModel& camera, int width, int height) {
  geometry::CameraModel display = camera.DisplayPinhole();
  const double wide = static_cast<double>(width) / height;
  const int cut_width =
      std::clamp(static_cast<int>(std::lround(display.height * wide)), 1, display.width);
  const int cut_height =
      std::clamp(static_cast<int>(std::lround(display.width / wide)), 1, display.height);
  display.cx -= 0.5 * (display.width - cut_width);
  display.cy -= 0.5 * (display.height - cut_height);
  display.width = cut_width;
  display.height = cut_height;
  return display;
}

}  // namespace lararium::show
