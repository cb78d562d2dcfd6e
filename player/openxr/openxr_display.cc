#include "player/openxr/openxr_display.h"

#include <utility>

namespace lararium::player {

using SteadyClock = std::chrono::steady_clock;

Result<std::unique_ptr<OpenXrDisplay>> OpenXrDisplay::Open(const Headset& headset,
                                                           const std::string& title,
                                                           Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<OpenXrHeadset> openxr,
                            OpenXrHeadset::Open(headset, title, log));
  return std::unique_ptr<OpenXrDisplay>(new OpenXrDisplay(headset, std::move(openxr)));
}

Status OpenXrDisplay::Draw(const show::StagedFrame& staged,
                           show::ShowRenderer& renderer,
                           const render::RenderTarget& picture,
                           double now,
                           float opacity,
                           const std::function<void(const geometry::CameraModel&)>& before) {
  const auto delay = std::chrono::duration<double>(headset_.camera_delay);
  const SteadyClock::time_point taken =
      staged.times.arrival - std::chrono::duration_cast<SteadyClock::duration>(delay);
  if (headset_.runtime_shows_room) {
    return DrawSeeThrough(staged, renderer, picture, taken, now, opacity, before);
  }
  for (const Eye eye : {kLeft, kRight}) {
    if (eye == kLeft || headset_.stereo) {
      LARARIUM_RETURN_IF_ERROR(renderer.Draw(staged, picture, openxr_->PictureEyeOf(eye)));
      LARARIUM_RETURN_IF_ERROR(openxr_->SetPicture(eye, picture));
    }
  }
  openxr_->Place(renderer.PictureOf(staged.tracked.camera, picture.width(), picture.height())
                     .Resized(picture.width(), picture.height()),
                 taken);
  return Status();
}

// Draws only people, from the predicted pose of each eye, because the runtime shows the real world.
Status OpenXrDisplay::DrawSeeThrough(
    const show::StagedFrame& staged,
    show::ShowRenderer& renderer,
    const render::RenderTarget& picture,
    SteadyClock::time_point taken,
    double now,
    float opacity,
    const std::function<void(const geometry::CameraModel&)>& before) {
  const std::optional<geometry::Rigid3> room_from_camera = openxr_->RoomFromCamera(taken);
  if (staged.camera.camera_from_stage && room_from_camera) {
    anchor_.Observe(*room_from_camera * *staged.camera.camera_from_stage, now);
  }
  for (const Eye eye : {kLeft, kRight}) {
    const std::optional<EyeView> view = openxr_->ViewOf(eye, picture.width(), picture.height());
    if (!view || !anchor_.room_from_stage()) {
      return Status();
    }
    before(view->camera);
    LARARIUM_RETURN_IF_ERROR(renderer.DrawSeeThrough(
        staged,
        {view->camera, view->room_from_eye.Inverse() * *anchor_.room_from_stage(),
         anchor_.Opacity(now) * opacity},
        picture));
    LARARIUM_RETURN_IF_ERROR(openxr_->SetPicture(eye, picture));
  }
  return Status();
}

}  // namespace lararium::player
