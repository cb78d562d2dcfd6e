#include "player/app/stereo_display.h"

#include <utility>

namespace lararium::player {
namespace {

// Maps points (x, y, 1) to pixels.
Eigen::Matrix3d PixelFromPlane(const geometry::CameraModel& pinhole) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 0) = pinhole.fx;
  matrix(1, 1) = pinhole.fy;
  matrix(0, 2) = pinhole.cx;
  matrix(1, 2) = pinhole.cy;
  return matrix;
}

}  // namespace

Result<StereoDisplay> StereoDisplay::Create(const Headset& headset) {
  LARARIUM_ASSIGN_OR_RETURN(render::LensPass lens_pass, render::LensPass::Create());
  LARARIUM_ASSIGN_OR_RETURN(
      render::RenderTarget panel,
      render::RenderTarget::Create(headset.panel->width(), headset.panel->height()));
  return StereoDisplay(headset, std::move(lens_pass), std::move(panel));
}

Status StereoDisplay::Draw(const show::StagedFrame& staged,
                           show::ShowRenderer& renderer,
                           const render::RenderTarget& picture) {
  const int width = picture.width();
  const int height = picture.height();
  const Eigen::Matrix3d picture_from_camera = PixelFromPlane(
      renderer.PictureOf(staged.tracked.camera, width, height).Resized(width, height));
  int left = 0;
  for (const Eye eye : {kLeft, kRight}) {
    if (eye == kLeft || headset_.stereo) {
      LARARIUM_RETURN_IF_ERROR(renderer.Draw(staged, picture, headset_.PictureEyeOf(eye)));
    }
    const geometry::LensModel& lens = headset_.panel->lenses[eye];
    lens_pass_.Draw(picture, {lens, picture_from_camera * headset_.CameraFromEyePlane(eye)}, left,
                    panel_);
    left += lens.width;
  }
  return Status();
}

}  // namespace lararium::player
