#include "shared/show/camera_look.h"

#include <algorithm>
#include <cmath>

#include "shared/vision/rolling_shutter.h"

namespace lararium::show {

render::CameraLook LookOf(const light::CameraTraits& traits,
                          const StagedFrame& staged,
                          const geometry::CameraModel& display) {
  const geometry::CameraModel& camera = staged.tracked.camera;
  // Picture pixels per pixel of the camera's image.
  const double display_px = display.fx / camera.fx;
  const double measured_px = static_cast<double>(camera.width) / traits.width;
  const double lens = traits.blur_px * measured_px * display_px;
  // A camera pixel is the average over its area. If it covers several pixels of the picture, this
  // adds blur.
  const double pixels = std::max(0.0, (display_px * display_px - 1.0) / 12.0);

  render::CameraLook look;
  look.noise_floor = traits.noise_floor;
  look.noise_slope = traits.noise_slope;
  look.frame = static_cast<uint32_t>(staged.tracked.frame.index);
  look.blur_px = static_cast<float>(std::sqrt(lens * lens + pixels));
  if (staged.camera.motion) {
    look.previous_camera_from_stage = staged.camera.motion->before_from_stage;
    const float shutter = traits.shutter.value_or(staged.tracked.shutter.value_or(0.0f));
    look.shutter = shutter / static_cast<float>(staged.camera.motion->frames);
  }
  return look;
}

std::optional<render::SceneShutter> ShutterOf(const StagedFrame& staged) {
  const std::optional<vision::RollingShutter>& rolling = staged.tracked.rolling_shutter;
  if (!rolling || rolling->readout.isZero(0.0) || !staged.camera.motion ||
      !staged.camera.camera_from_stage) {
    return std::nullopt;
  }
  // The tracker knows the turn at the very time of the image, but only in map units the rest.
  const geometry::Rigid3& now = *staged.camera.camera_from_stage;
  Eigen::Matrix<double, 6, 1> motion = rolling->motion;
  motion.tail<3>() = (now * staged.camera.motion->before_from_stage.Inverse()).translation /
                     static_cast<double>(staged.camera.motion->frames);
  return render::SceneShutter{vision::PoseAfter(now, motion, -1.0), rolling->readout};
}

}  // namespace lararium::show
