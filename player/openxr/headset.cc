#include "player/openxr/headset.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/json.h"

namespace lararium::player {
namespace {

using geometry::LensModel;
using geometry::Rigid3;

constexpr double kEyeDistance = 0.063;    // metres, average of adults
constexpr double kFarthestPart = 0.2;     // metres from the middle between the eyes
constexpr double kNearestPicture = 0.3;   // metres
constexpr double kFarthestPicture = 1e4;  // metres; larger distances count as infinite
constexpr double kLeastAhead = 0.5;       // cosine between the directions of eye and camera

// Parses the optional fields "at" and "rotation".
Status ParsePose(const JsonView& view, Rigid3& head_from_part) {
  if (view.Has("at")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> at, view.Numbers("at", 3));
    head_from_part.translation = Eigen::Vector3d(at[0], at[1], at[2]);
    if (head_from_part.translation.norm() > kFarthestPart) {
      return view.Problem("\"at\" must be within 0.2 m of the middle between the eyes",
                          "give metres");
    }
  }
  if (view.Has("rotation")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> q, view.Numbers("rotation", 4));
    head_from_part.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    if (std::abs(head_from_part.rotation.norm() - 1.0) > 1e-3) {
      return view.Problem("\"rotation\" must be a unit quaternion (w, x, y, z)");
    }
    head_from_part.rotation.normalize();
  }
  return Status();
}

Result<double> ParseDistance(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("picture_distance"));
  if (!field.json().is_string()) {
    return field.Number(kNearestPicture, kFarthestPicture);
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string word, field.Text(16));
  if (word != "infinity") {
    return field.Problem("must be a number of metres or \"infinity\"");
  }
  return std::numeric_limits<double>::infinity();
}

Status ParseRadial(const JsonView& view, LensModel& lens) {
  if (view.Has("k1_k2_k3")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> k, view.Numbers("k1_k2_k3", 3));
    lens.radial.fill({k[0], k[1], k[2]});
  }
  for (const auto& [name, colour] :
       {std::pair("k1_k2_k3_red", LensModel::kRed), std::pair("k1_k2_k3_blue", LensModel::kBlue)}) {
    if (view.Has(name)) {
      LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> k, view.Numbers(name, 3));
      lens.radial[colour] = {k[0], k[1], k[2]};
    }
  }
  return Status();
}

// Parses angles in degrees from straight ahead to the left, right, upper and lower edge.
Result<LensModel> ParseAngles(const JsonView& view, int width, int height) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("field_of_view"));
  LARARIUM_ASSIGN_OR_RETURN(std::vector<double> angles, field.Numbers(4));
  for (double& angle : angles) {
    if (!(angle >= 1.0 && angle <= 80.0)) {
      return field.Problem("each angle must be 1 to 80 degrees", "give left, right, up, down");
    }
    angle *= std::numbers::pi / 180.0;
  }
  return LensModel::FromAngles(width, height, angles[0], angles[1], angles[2], angles[3]);
}

Result<LensModel> ParseLens(const JsonView& view, int width, int height) {
  LensModel lens{width, height};
  if (view.Has("field_of_view") == view.Has("K")) {
    return view.Problem("needs either \"K\" or \"field_of_view\"",
                        "docs/file-formats.md says what they hold");
  }
  if (view.Has("K")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> k, view.Numbers("K", 4));
    lens = {width, height, k[0], k[1], k[2], k[3]};
  } else {
    LARARIUM_ASSIGN_OR_RETURN(lens, ParseAngles(view, width, height));
  }
  LARARIUM_RETURN_IF_ERROR(ParseRadial(view, lens));
  if (const Status status = lens.Validate(); !status.ok()) {
    return status.At(view.place());
  }
  return lens;
}

Result<Panel> ParsePanel(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const int64_t width, view.Integer("width", 32, 32768));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t height, view.Integer("height", 16, 16384));
  if (width % 2 != 0 || height % 2 != 0) {
    return view.Problem("\"width\" and \"height\" must be even");
  }
  const int half = static_cast<int>(width / 2);
  Panel panel;
  LARARIUM_ASSIGN_OR_RETURN(const JsonView left, view.Field("left"));
  LARARIUM_ASSIGN_OR_RETURN(panel.lenses[kLeft], ParseLens(left, half, static_cast<int>(height)));
  panel.lenses[kRight] = panel.lenses[kLeft].Mirrored();
  if (view.Has("right")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView right, view.Field("right"));
    LARARIUM_ASSIGN_OR_RETURN(panel.lenses[kRight],
                              ParseLens(right, half, static_cast<int>(height)));
  }
  return panel;
}

Status ParseEyes(const JsonView& view, Headset& headset) {
  if (view.Has("eye_distance")) {
    LARARIUM_ASSIGN_OR_RETURN(const double apart, view.Number("eye_distance", 0.0, 0.1));
    headset.head_from_eye[kLeft].translation.x() = -0.5 * apart;
    headset.head_from_eye[kRight].translation.x() = 0.5 * apart;
  }
  for (const auto& [name, eye] : {std::pair("left_eye", kLeft), std::pair("right_eye", kRight)}) {
    if (view.Has(name)) {
      LARARIUM_ASSIGN_OR_RETURN(const JsonView pose, view.Field(name));
      LARARIUM_RETURN_IF_ERROR(ParsePose(pose, headset.head_from_eye[eye]));
    }
  }
  return Status();
}

// Checks that the camera's picture is a plane in front of each eye.
Status CheckView(const JsonView& view, const Headset& headset) {
  for (const Eye eye : {kLeft, kRight}) {
    const Rigid3 camera_from_eye = headset.head_from_camera.Inverse() * headset.head_from_eye[eye];
    if ((camera_from_eye.rotation * Eigen::Vector3d::UnitZ()).z() < kLeastAhead) {
      return view.Problem("an eye and the camera look more than 60 degrees apart",
                          "check \"rotation\" of \"camera\", \"left_eye\", \"right_eye\"");
    }
    if (camera_from_eye.translation.z() > headset.picture_distance - 0.5 * kNearestPicture) {
      return view.Problem("an eye is behind the picture", "give a larger \"picture_distance\"");
    }
  }
  return Status();
}

}  // namespace

show::PictureEye Headset::PictureEyeOf(Eye eye) const {
  if (!stereo) {
    return {};
  }
  return {head_from_camera.Inverse() * head_from_eye[eye].translation, picture_distance};
}

Eigen::Matrix3d Headset::CameraFromEyePlane(Eye eye) const {
  const Rigid3 camera_from_eye = head_from_camera.Inverse() * head_from_eye[eye];
  // A ray of the eye meets the plane z = distance of the camera's axes where the ray's own z is
  // distance - t.z: the homography that this plane induces.
  const Eigen::Matrix3d rotation = camera_from_eye.rotation.toRotationMatrix();
  const Eigen::Vector3d& t = camera_from_eye.translation;
  return rotation + t * rotation.row(2) / (picture_distance - t.z());
}

show::ViewPart Headset::SeenPart() const {
  show::ViewPart part;
  for (const Eye eye : {kLeft, kRight}) {
    const Eigen::AlignedBox2d box = panel->lenses[eye].SeenBox();
    const Eigen::Matrix3d camera_from_eye_plane = CameraFromEyePlane(eye);
    for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                              Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
      const Eigen::Vector3d seen = camera_from_eye_plane * box.corner(corner).homogeneous();
      if (seen.z() < 1e-3) {
        return {};  // the eye sees beyond the picture's plane, so nothing can be left out
      }
      part.extend(Eigen::Vector2d(seen.hnormalized()));
    }
  }
  return part;
}

Headset::Headset() {
  head_from_eye[kLeft].translation.x() = -0.5 * kEyeDistance;
  head_from_eye[kRight].translation.x() = 0.5 * kEyeDistance;
}

Result<Headset> ParseHeadset(const JsonView& view) {
  Headset headset;
  if (view.Has("camera")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView camera, view.Field("camera"));
    LARARIUM_RETURN_IF_ERROR(ParsePose(camera, headset.head_from_camera));
    if (camera.Has("delay")) {
      LARARIUM_ASSIGN_OR_RETURN(headset.camera_delay, camera.Number("delay", 0.0, 0.5));
    }
  }
  LARARIUM_RETURN_IF_ERROR(ParseEyes(view, headset));
  if (view.Has("picture_distance")) {
    LARARIUM_ASSIGN_OR_RETURN(headset.picture_distance, ParseDistance(view));
  }
  if (view.Has("stereo")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView stereo, view.Field("stereo"));
    LARARIUM_ASSIGN_OR_RETURN(headset.stereo, stereo.Boolean());
  }
  if (view.Has("see_through")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("see_through"));
    LARARIUM_ASSIGN_OR_RETURN(const std::string by, field.Text(16));
    if (by != "camera" && by != "runtime") {
      return field.Problem("must be \"camera\" or \"runtime\"");
    }
    headset.runtime_shows_room = by == "runtime";
  }
  if (view.Has("panel")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView panel, view.Field("panel"));
    LARARIUM_ASSIGN_OR_RETURN(headset.panel, ParsePanel(panel));
  }
  LARARIUM_RETURN_IF_ERROR(CheckView(view, headset));
  return headset;
}

}  // namespace lararium::player
