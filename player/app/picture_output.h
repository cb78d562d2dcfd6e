#pragma once

// Draws pictures of a show and shows them: in a window, off screen, or on a headset.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "player/app/options.h"
#include "player/app/screen.h"
#include "player/app/stereo_display.h"
#include "player/openxr/headset.h"
#include "player/openxr/openxr_display.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/quality.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show_renderer.h"

namespace lararium::player {

struct PictureLayout {
  geometry::CameraModel camera;    // Calibration for the images of the source, or a guess.
  std::optional<Headset> headset;  // nullopt: the show is not shown on a headset
  show::ViewPart part;             // The part of the camera's view that is drawn.
  PictureSize size;
};

// headset: the one in the device file. An error if the options need its panel and it has none.
Result<PictureLayout> ChooseLayout(const DisplayOptions& options,
                                   const std::optional<Headset>& headset,
                                   const geometry::CameraModel& camera);

// Use it on the thread that opened it, on which its graphics context is current.
class PictureOutput {
 public:
  // bundle: name of the content in errors.
  static Result<std::unique_ptr<PictureOutput>> Open(const DisplayOptions& options,
                                                     const PictureLayout& layout,
                                                     const show::ShowContent& content,
                                                     const render::Quality& quality,
                                                     const std::string& bundle,
                                                     Log& log);

  Screen& screen() { return *screen_; }
  show::ShowRenderer& renderer() { return *renderer_; }
  // nullptr: there is no OpenXR headset.
  OpenXrHeadset* openxr() { return openxr_ != nullptr ? &openxr_->headset() : nullptr; }
  // The picture before it is distorted for lenses.
  const render::RenderTarget& picture() const { return *target_; }
  // The picture as it is shown.
  const render::RenderTarget& shown() const { return stereo_ ? stereo_->panel() : *target_; }

  // The pinhole camera of the pictures for an image camera; without one, for that of the layout.
  geometry::CameraModel PictureCamera() const { return PictureCamera(camera_); }
  geometry::CameraModel PictureCamera(const geometry::CameraModel& camera) const {
    return renderer_->PictureOf(camera, target_->width(), target_->height());
  }

  // Draws a frame and waits until that is done. now, opacity and before: see OpenXrDisplay::Draw.
  Status Draw(const show::StagedFrame& staged,
              double now,
              float opacity,
              const std::function<void(const geometry::CameraModel&)>& before);
  // Shows the picture in the window, if there is one.
  void Present() { screen_->Present(shown()); }

 private:
  explicit PictureOutput(const geometry::CameraModel& camera) : camera_(camera) {}

  geometry::CameraModel camera_;
  std::optional<Screen> screen_;  // Declared before everything that draws, so destroyed after it.
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  std::optional<StereoDisplay> stereo_;
  std::unique_ptr<OpenXrDisplay> openxr_;  // nullptr: no OpenXR headset
};

}  // namespace lararium::player
