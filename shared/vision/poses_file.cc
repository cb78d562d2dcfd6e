#include "shared/vision/poses_file.h"

#include <Eigen/LU>
#include <algorithm>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr int64_t kMaxMaps = 64;  // Maximum number of places in a bundle.
constexpr float kMaxFileGain = 1e6f;
constexpr double kRotationError = 1e-2;  // Tolerance for the entries of R R^T - I.

void DescribePose(Fields& fields, Rigid3& pose) {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> r = pose.rotation.toRotationMatrix();
  fields.Numbers("R", std::span(r.data(), 9));
  fields.Numbers("t", std::span(pose.translation.data(), 3));
  if (fields.reading()) {
    const double error = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    fields.Require(error < kRotationError && r.determinant() >= 0.0, "R is not a rotation matrix");
    pose = Rigid3::FromMatrix(r, pose.translation);
  }
}

void DescribeCamera(Fields& fields, CameraModel& camera) {
  geometry::DescribePinhole(fields, camera);
  if (fields.Has("distortion", true)) {
    fields.Object("distortion", camera, [](Fields& distortion, CameraModel& distorted) {
      std::string model = "opencv";
      distortion.Text("model", model);
      distortion.Require(model == "opencv", "the model must be \"opencv\"");
      geometry::DescribeDistortion(distortion, distorted);
    });
  }
  fields.Check(camera.Validate().At(fields.where()));
}

void DescribeDetails(Fields& fields, TrackingDetails& details) {
  if (!fields.reading()) {
    std::string state(Name(details.state));
    std::string reason(Name(details.reason));
    fields.Text("state", state);
    fields.Text("reason", reason);
  }
  fields.Integer("map", details.map, 0, kMaxMaps - 1);
  fields.Flag("followed", details.followed);
  fields.Number("confidence", details.confidence, 0.0, 1.0);
  fields.Numbers("gain", details.gain);
  const auto [least, most] = std::minmax_element(details.gain.begin(), details.gain.end());
  fields.Require(*least > 0.0f && *most < kMaxFileGain, "the gain is not positive");
}

void DescribeRecord(Fields& fields, PoseRecord& record) {
  fields.Text("file", record.file);
  DescribeCamera(fields, record.camera);
  Json pose;  // Null if the pose is not known.
  fields.Raw(Optional("world_to_camera"), pose);
  if (!fields.reading() || !pose.is_null()) {
    fields.Object("world_to_camera", record.camera_from_world, DescribePose);
  }
  bool tracked = record.tracked || fields.reading();
  fields.Flag(Optional("tracked"), tracked);
  if (fields.reading()) {
    record.tracked = tracked && record.camera_from_world.has_value();
  }
  fields.Object("rolling_shutter", record.shutter, [](Fields& rolling, RollingShutter& shutter) {
    rolling.Numbers("readout", std::span(shutter.readout.data(), 2));
    rolling.Numbers("rotation", std::span(shutter.motion.data(), 3));
    rolling.Numbers("translation", std::span(shutter.motion.data() + 3, 3));
  });
  if (fields.Has("map", record.details.has_value())) {
    DescribeDetails(fields, record.details ? *record.details : record.details.emplace());
  }
}

void DescribeRecords(Fields& fields, std::vector<PoseRecord>& records) {
  fields.List("images", records, 1'000'000, DescribeRecord);
}

}  // namespace

PoseRecord MakePoseRecord(std::string file, const TrackedFrame& tracked) {
  return {std::move(file),
          tracked.camera,
          tracked.camera_from_map,
          tracked.camera_from_map.has_value(),
          tracked.rolling_shutter,
          TrackingDetails{tracked.state, tracked.reason, tracked.map, tracked.followed,
                          tracked.confidence, tracked.gain}};
}

Status SavePoses(const std::filesystem::path& path, const std::vector<PoseRecord>& poses) {
  return SaveJson(path, FormatFields(poses, DescribeRecords));
}

Result<std::vector<PoseRecord>> LoadPoses(const std::filesystem::path& path) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(path));
  return ParseFields<std::vector<PoseRecord>>(JsonView(json, path.string()), DescribeRecords,
                                              UnknownFields::kIgnore);
}

}  // namespace lararium::vision
