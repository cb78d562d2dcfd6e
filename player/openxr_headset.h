#pragma once

// A headset that an OpenXR runtime drives. The finished picture is handed over as a layer that
// hangs in the room where the camera saw it: as far before it as the device file says, at the
// pose that the head had when the image was taken. Or the runtime shows what is real by itself,
// and is handed people alone, as each eye will see them from where it will be. Either way it shows
// them from where the head is at every refresh of the display, however seldom a new picture comes.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "player/headset.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/render_target.h"

namespace lararium::player {

// What an eye will look through: a pinhole, and where it will be in the runtime's room, axes as a
// camera's.
struct EyeView {
  geometry::CameraModel camera;
  geometry::Rigid3 room_from_eye;
};

class OpenXrHeadset {
 public:
  // headset: where the camera is, and how far away the picture; the eyes are the runtime's. title:
  // what the runtime calls the program. Needs a current OpenGL context of a window; everything
  // happens on its thread. Fails where there is no runtime, or no headset is connected.
  static Result<std::unique_ptr<OpenXrHeadset>> Open(const Headset& headset,
                                                     const std::string& title,
                                                     Log& log);
  virtual ~OpenXrHeadset() = default;

  // What the runtime calls itself.
  virtual std::string runtime() const = 0;

  // How an eye sees the picture; as the runtime last told where it is.
  virtual show::PictureEye PictureEyeOf(Eye eye) const = 0;

  // From the next frame on, the picture of an eye, or of both where the headset is not stereo
  // (kLeft). All have one size.
  virtual Status SetPicture(Eye eye, const render::RenderTarget& picture) = 0;

  // Hangs it where the camera saw it: pinhole is the picture's, taken the moment of its image by a
  // steady clock.
  virtual void Place(const geometry::CameraModel& pinhole,
                     std::chrono::steady_clock::time_point taken) = 0;

  // Where the camera was in the room at a moment of a steady clock; none as long as nobody knows.
  virtual std::optional<geometry::Rigid3> RoomFromCamera(
      std::chrono::steady_clock::time_point taken) const = 0;

  // Where the runtime shows what is real (Headset::runtime_shows_room): for which view of an eye
  // its next picture of that size is to be drawn, which is then handed over by SetPicture, of both
  // eyes before the next frame. None as long as nobody knows where the eyes are.
  virtual std::optional<EyeView> ViewOf(Eye eye, int width, int height) = 0;

  // Handles what the runtime says, and submits a frame where it wants one, which waits for the
  // display. False: the runtime has ended the session. An error where it was lost.
  virtual Result<bool> Frame() = 0;

  // The controllers' buttons that were pressed since the last time, as "hand_select"
  // (visitor_actions.h).
  virtual std::vector<std::string> TakeButtons() = 0;

  // Asks the runtime to end the session and waits until it did, a second at most.
  virtual Status End() = 0;
};

}  // namespace lararium::player
