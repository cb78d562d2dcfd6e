#include "shared/vision/poses_file.h"

#include <Eigen/LU>

#include "shared/core/json.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr int kMaxSide = 16384;   // pixels
constexpr int64_t kMaxMaps = 64;  // Maximum number of places in a bundle.
constexpr double kMaxFileGain = 1e6;
constexpr double kRotationError = 1e-2;  // Tolerance for the entries of R R^T - I.

// ------------------------------------------------------------ writing

Json ToJson(const Rigid3& pose) {
  const Eigen::Matrix<double, 3, 4> m = pose.Matrix3x4();
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rotation.push_back(m(row, column));
    }
  }
  return {{"R", rotation}, {"t", {m(0, 3), m(1, 3), m(2, 3)}}};
}

void AddDetails(const TrackingDetails& details, Json& json) {
  json["state"] = Name(details.state);
  json["reason"] = Name(details.reason);
  json["map"] = details.map;
  json["followed"] = details.followed;
  json["confidence"] = details.confidence;
  json["gain"] = details.gain;
}

Json ToJson(const PoseRecord& record) {
  const CameraModel& c = record.camera;
  Json json = {
      {"file", record.file},
      {"width", c.width},
      {"height", c.height},
      {"K", {c.fx, c.fy, c.cx, c.cy}},
      {"distortion", {{"model", "opencv"}, {"k1_k2_p1_p2", {c.k1, c.k2, c.p1, c.p2}}}},
      {"world_to_camera", record.camera_from_world ? ToJson(*record.camera_from_world) : Json()},
      {"tracked", record.tracked}};
  if (record.details) {
    AddDetails(*record.details, json);
  }
  return json;
}

// ------------------------------------------------------------ reading

Result<Rigid3> ReadPose(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> r, view.Numbers("R", 9));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> t, view.Numbers("t", 3));
  const Eigen::Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
  const double error =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationError) || rotation.determinant() < 0.0) {
    return view.Problem("R is not a rotation matrix");
  }
  return Rigid3::FromMatrix(rotation, {t[0], t[1], t[2]});
}

Result<CameraModel> ReadCamera(const JsonView& view) {
  CameraModel camera;
  LARARIUM_ASSIGN_OR_RETURN(const int64_t width, view.Integer("width", 1, kMaxSide));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t height, view.Integer("height", 1, kMaxSide));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> k, view.Numbers("K", 4));
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
  camera.fx = k[0];
  camera.fy = k[1];
  camera.cx = k[2];
  camera.cy = k[3];
  if (view.Has("distortion")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView distortion, view.Field("distortion"));
    LARARIUM_ASSIGN_OR_RETURN(const std::string model, distortion.Text("model"));
    if (model != "opencv") {
      return distortion.Problem("the model must be \"opencv\"");
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> d, distortion.Numbers("k1_k2_p1_p2", 4));
    camera.k1 = d[0];
    camera.k2 = d[1];
    camera.p1 = d[2];
    camera.p2 = d[3];
  }
  if (const Status status = camera.Validate(); !status.ok()) {
    return status.At(view.place());
  }
  return camera;
}

Result<bool> ReadFlag(const JsonView& view, std::string_view key) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field(key));
  return field.Boolean();
}

Result<TrackingDetails> ReadDetails(const JsonView& view) {
  TrackingDetails details;
  LARARIUM_ASSIGN_OR_RETURN(const int64_t map, view.Integer("map", 0, kMaxMaps - 1));
  LARARIUM_ASSIGN_OR_RETURN(details.followed, ReadFlag(view, "followed"));
  LARARIUM_ASSIGN_OR_RETURN(const double confidence, view.Number("confidence", 0.0, 1.0));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> gain, view.Numbers("gain", 3));
  details.map = static_cast<uint32_t>(map);
  details.confidence = static_cast<float>(confidence);
  for (size_t c = 0; c < details.gain.size(); ++c) {
    if (!(gain[c] > 0.0 && gain[c] < kMaxFileGain)) {
      return view.Problem("the gain is not positive");
    }
    details.gain[c] = static_cast<float>(gain[c]);
  }
  return details;
}

Result<PoseRecord> ReadRecord(const JsonView& view) {
  PoseRecord record;
  LARARIUM_ASSIGN_OR_RETURN(record.file, view.Text("file"));
  LARARIUM_ASSIGN_OR_RETURN(record.camera, ReadCamera(view));
  if (view.Has("world_to_camera")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView pose, view.Field("world_to_camera"));
    if (!pose.json().is_null()) {
      LARARIUM_ASSIGN_OR_RETURN(record.camera_from_world, ReadPose(pose));
    }
  }
  record.tracked = record.camera_from_world.has_value();
  if (view.Has("tracked")) {
    LARARIUM_ASSIGN_OR_RETURN(const bool tracked, ReadFlag(view, "tracked"));
    record.tracked = record.tracked && tracked;
  }
  if (view.Has("map")) {
    LARARIUM_ASSIGN_OR_RETURN(record.details, ReadDetails(view));
  }
  return record;
}

}  // namespace

PoseRecord MakePoseRecord(std::string file, const TrackedFrame& tracked) {
  return {std::move(file), tracked.camera, tracked.camera_from_map,
          tracked.camera_from_map.has_value(),
          TrackingDetails{tracked.state, tracked.reason, tracked.map, tracked.followed,
                          tracked.confidence, tracked.gain}};
}

Status SavePoses(const std::filesystem::path& path, std::span<const PoseRecord> poses) {
  Json images = Json::array();
  for (const PoseRecord& record : poses) {
    images.push_back(ToJson(record));
  }
  return SaveJson(path, {{"images", images}});
}

Result<std::vector<PoseRecord>> LoadPoses(const std::filesystem::path& path) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(path));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView images, JsonView(json, path.string()).Field("images"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> views, images.Array());
  std::vector<PoseRecord> poses;
  poses.reserve(views.size());
  for (const JsonView& view : views) {
    LARARIUM_ASSIGN_OR_RETURN(PoseRecord record, ReadRecord(view));
    poses.push_back(std::move(record));
  }
  return poses;
}

}  // namespace lararium::vision
