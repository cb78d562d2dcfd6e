#pragma once

// A head-mounted display as the device file describes it (docs/file-formats.md): where the eyes
// and the camera are, what both eyes are shown, and the panel behind the lenses. Head axes: x
// right, y down, z forward, metres, from the middle between the eyes.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/geometry/lens_model.h"
#include "shared/geometry/transform.h"
#include "shared/show/picture_camera.h"

namespace lararium::player {

enum Eye { kLeft, kRight };

// Both eyes' parts side by side; they are of one size.
struct Panel {
  std::array<geometry::LensModel, 2> lenses;  // by Eye

  int width() const { return lenses[kLeft].width + lenses[kRight].width; }
  int height() const { return lenses[kLeft].height; }
};

struct Headset {
  Headset();  // of grown people, with the camera between the eyes

  geometry::Rigid3 head_from_camera;
  double camera_delay = 0.0;                      // seconds from an image's taking to its arrival
  std::array<geometry::Rigid3, 2> head_from_eye;  // by Eye
  // How far from the camera the picture seems to be, metres; infinite: as the stars.
  double picture_distance = 3.0;
  // People are drawn once for each eye, from where it is; otherwise both see one picture.
  bool stereo = false;
  // What is real is shown by the headset's OpenXR runtime, and people alone by us; otherwise all is
  // in our camera's picture.
  bool runtime_shows_room = false;
  std::optional<Panel> panel;  // none: its runtime knows it (OpenXR)

  // Who looks at the picture through an eye.
  show::PictureEye PictureEyeOf(Eye eye) const;

  // Homogeneous: where the camera sees, on its plane z = 1, the point of the picture that is
  // before an eye at (x, y, 1).
  Eigen::Matrix3d CameraFromEyePlane(Eye eye) const;

  // What of the camera's view either eye can see. With a panel only.
  show::ViewPart SeenPart() const;
};

// The field "headset" of a device file.
Result<Headset> ParseHeadset(const JsonView& view);

}  // namespace lararium::player
