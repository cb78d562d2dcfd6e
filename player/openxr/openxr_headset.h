#pragma once

// A headset that an OpenXR runtime drives. The finished picture is handed to the runtime as a layer
// that is fixed in the room: at the pose of the head when the image was taken, at the distance in
// the device file. Alternatively the runtime shows the real world itself, and gets only people,
// drawn from the predicted pose of each eye. In both cases the runtime adapts the layers to the
// pose of the head at every refresh of the display, even if new pictures come less often.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "player/openxr/headset.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/gl/render_target.h"

namespace lararium::player {

// The predicted view of an eye: a pinhole camera and its pose in the runtime's room. Axes are those
// of a camera.
struct EyeView {
  geometry::CameraModel camera;
  geometry::Rigid3 room_from_eye;
};

class OpenXrHeadset {
 public:
  // headset: gives the position of the camera and the distance of the picture; the eyes are those
  // of the runtime. title: name of the program for the runtime. Needs a current OpenGL context of a
  // window; call all members on its thread. Fails if there is no runtime or no headset is
  // connected.
  static Result<std::unique_ptr<OpenXrHeadset>> Open(const Headset& headset,
                                                     const std::string& title,
                                                     Log& log);
  virtual ~OpenXrHeadset() = default;

  // The name of the runtime.
  virtual std::string runtime() const = 0;

  // The position of an eye relative to the picture, as last reported by the runtime.
  virtual show::PictureEye PictureEyeOf(Eye eye) const = 0;

  // Sets the picture of an eye from the next frame on; if the headset is not stereo, kLeft sets it
  // for both eyes. All pictures must have the same size.
  virtual Status SetPicture(Eye eye, const render::RenderTarget& picture) = 0;

  // Places the picture in the room where the camera saw it. pinhole: camera of the picture. taken:
  // time of its image.
  virtual void Place(const geometry::CameraModel& pinhole,
                     std::chrono::steady_clock::time_point taken) = 0;

  // The pose of the camera in the room at a time; nullopt: not known yet.
  virtual std::optional<geometry::Rigid3> RoomFromCamera(
      std::chrono::steady_clock::time_point taken) const = 0;

  // For Headset::runtime_shows_room: the view for which the next picture of an eye must be drawn.
  // Pass the pictures of both eyes to SetPicture before the next frame. nullopt: the poses of the
  // eyes are not known yet. width and height: size of the picture.
  virtual std::optional<EyeView> ViewOf(Eye eye, int width, int height) = 0;

  // Handles events of the runtime, and submits a frame if it asks for one; that waits for the
  // display. Returns false if the runtime has ended the session; an error if it was lost.
  virtual Result<bool> Frame() = 0;

  // Returns the buttons of controllers that were pressed since the last call, such as "hand_select"
  // (visitor_actions.h).
  virtual std::vector<std::string> TakeButtons() = 0;

  // Asks the runtime to end the session and waits for it, at most one second.
  virtual Status End() = 0;
};

}  // namespace lararium::player
