#pragma once

// A head-mounted display as described in the device file (docs/file-formats.md): the positions of
// eyes and camera, what the eyes are shown, and the panel behind the lenses. Head axes: x right,
// y down, z forward, metres; the origin is the middle between the eyes.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "shared/core/json_fwd.h"
#include "shared/core/status.h"
#include "shared/geometry/lens_model.h"
#include "shared/geometry/transform.h"
#include "shared/show/picture_camera.h"

namespace lararium::player {

enum Eye { kLeft, kRight };

// The panel. The parts of both eyes are side by side and have the same size.
struct Panel {
  std::array<geometry::LensModel, 2> lenses;  // index: Eye

  int width() const { return lenses[kLeft].width + lenses[kRight].width; }
  int height() const { return lenses[kLeft].height; }
};

struct Headset {
  Headset();  // eye distance of an adult, camera between the eyes

  geometry::Rigid3 head_from_camera;
  double camera_delay = 0.0;                      // seconds from exposure to arrival of an image
  std::array<geometry::Rigid3, 2> head_from_eye;  // index: Eye
  // Apparent distance of the picture from the camera, metres; may be infinite.
  double picture_distance = 3.0;
  // True: people are drawn from the position of each eye. False: both eyes see the same picture.
  bool stereo = false;
  // True: the headset's OpenXR runtime shows the real world, and the player shows people only.
  // False: the player shows the picture of its own camera.
  bool runtime_shows_room = false;
  std::optional<Panel> panel;  // nullopt: an OpenXR runtime knows the panel

  // The position of an eye relative to the picture, for drawing.
  show::PictureEye PictureEyeOf(Eye eye) const;

  // Homography from a point (x, y, 1) in front of an eye to the same point of the picture on the
  // camera's plane z = 1.
  Eigen::Matrix3d CameraFromEyePlane(Eye eye) const;

  // The part of the camera's view that at least one eye can see. Needs a panel.
  show::ViewPart SeenPart() const;
};

// Describes the field "headset" of a device file, for reading.
void DescribeFields(Fields& fields, Headset& headset);

}  // namespace lararium::player
