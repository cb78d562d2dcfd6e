#include "player/openxr/headset.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "shared/core/json_fields.h"

namespace lararium::player {
namespace {

using geometry::LensModel;
using geometry::Rigid3;

constexpr double kEyeDistance = 0.063;    // metres, average of adults
constexpr double kFarthestPart = 0.2;     // metres from the middle between the eyes
constexpr double kNearestPicture = 0.3;   // metres
constexpr double kFarthestPicture = 1e4;  // metres; larger distances count as infinite
constexpr double kLeastAhead = 0.5;       // cosine between the directions of eye and camera

// All descriptions here are only for reading.
void DescribePose(Fields& fields, Rigid3& head_from_part) {
  fields.Numbers(Optional("at"), std::span(head_from_part.translation.data(), 3));
  fields.Require(head_from_part.translation.norm() <= kFarthestPart,
                 "\"at\" must be within 0.2 m of the middle between the eyes", "give metres");
  const Eigen::Quaterniond& q = head_from_part.rotation;
  std::array wxyz = {q.w(), q.x(), q.y(), q.z()};
  fields.Numbers(Optional("rotation"), wxyz);
  const Eigen::Quaterniond rotation(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  fields.Require(std::abs(rotation.norm() - 1.0) <= 1e-3,
                 "\"rotation\" must be a unit quaternion (w, x, y, z)");
  head_from_part.rotation = rotation.normalized();
}

// Describes angles in degrees from straight ahead to the left, right, upper and lower edge.
void DescribeAngles(Fields& fields, LensModel& lens) {
  std::array angles = {45.0, 45.0, 45.0, 45.0};
  fields.Numbers("field_of_view", angles);
  for (double& angle : angles) {
    fields.RequireAt("field_of_view", angle >= 1.0 && angle <= 80.0,
                     "each angle must be 1 to 80 degrees", "give left, right, up, down");
    angle *= std::numbers::pi / 180.0;
  }
  lens = LensModel::FromAngles(lens.width, lens.height, angles[0], angles[1], angles[2], angles[3]);
}

void DescribeLens(Fields& fields, LensModel& lens) {
  fields.Require(fields.Has("field_of_view") != fields.Has("K"),
                 "needs either \"K\" or \"field_of_view\"",
                 "docs/file-formats.md says what they hold");
  if (fields.Has("field_of_view")) {
    DescribeAngles(fields, lens);
  } else {
    std::array<double, 4> k = {};
    fields.Numbers("K", k);
    lens = {lens.width, lens.height, k[0], k[1], k[2], k[3]};
  }
  fields.Numbers(Optional("k1_k2_k3"), lens.radial[LensModel::kGreen]);
  lens.radial.fill(lens.radial[LensModel::kGreen]);
  fields.Numbers(Optional("k1_k2_k3_red"), lens.radial[LensModel::kRed]);
  fields.Numbers(Optional("k1_k2_k3_blue"), lens.radial[LensModel::kBlue]);
  fields.Check(lens.Validate().At(fields.where()));
}

void DescribePanel(Fields& fields, Panel& panel) {
  int width = 0;
  LensModel& left = panel.lenses[kLeft];
  fields.Integer("width", width, 32, 32768);
  fields.Integer("height", left.height, 16, 16384);
  fields.Require(width % 2 == 0 && left.height % 2 == 0, "\"width\" and \"height\" must be even");
  left.width = width / 2;
  fields.Object("left", left, DescribeLens);
  panel.lenses[kRight] = left.Mirrored();
  fields.Object(Optional("right"), panel.lenses[kRight], DescribeLens);
}

// Checks that the camera's picture is a plane in front of each eye.
void CheckView(Fields& fields, const Headset& headset) {
  for (const Eye eye : {kLeft, kRight}) {
    const Rigid3 camera_from_eye = headset.head_from_camera.Inverse() * headset.head_from_eye[eye];
    fields.Require((camera_from_eye.rotation * Eigen::Vector3d::UnitZ()).z() >= kLeastAhead,
                   "an eye and the camera look more than 60 degrees apart",
                   "check \"rotation\" of \"camera\", \"left_eye\", \"right_eye\"");
    fields.Require(
        camera_from_eye.translation.z() <= headset.picture_distance - 0.5 * kNearestPicture,
        "an eye is behind the picture", "give a larger \"picture_distance\"");
  }
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

void DescribeFields(Fields& fields, Headset& headset) {
  fields.Object(Optional("camera"), headset, [](Fields& camera, Headset& mounted) {
    DescribePose(camera, mounted.head_from_camera);
    camera.Number(Optional("delay"), mounted.camera_delay, 0.0, 0.5);
  });
  double apart = kEyeDistance;
  fields.Number(Optional("eye_distance"), apart, 0.0, 0.1);
  headset.head_from_eye[kLeft].translation.x() = -0.5 * apart;
  headset.head_from_eye[kRight].translation.x() = 0.5 * apart;
  fields.Object(Optional("left_eye"), headset.head_from_eye[kLeft], DescribePose);
  fields.Object(Optional("right_eye"), headset.head_from_eye[kRight], DescribePose);
  if (fields.IsText("picture_distance")) {
    std::string word;
    fields.Text("picture_distance", word, 16);
    fields.RequireAt("picture_distance", word == "infinity",
                     "must be a number of metres or \"infinity\"");
    headset.picture_distance = std::numeric_limits<double>::infinity();
  } else {
    fields.Number(Optional("picture_distance"), headset.picture_distance, kNearestPicture,
                  kFarthestPicture);
  }
  fields.Flag(Optional("stereo"), headset.stereo);
  std::string shown_by = "camera";
  fields.Text(Optional("see_through"), shown_by, 16);
  headset.runtime_shows_room = shown_by == "runtime";
  fields.RequireAt("see_through", headset.runtime_shows_room || shown_by == "camera",
                   "must be \"camera\" or \"runtime\"");
  fields.Object("panel", headset.panel, DescribePanel);
  CheckView(fields, headset);
}

}  // namespace lararium::player
