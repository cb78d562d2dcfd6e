#pragma once

// A sparse model in COLMAP's format (Schoenberger & Frahm, "Structure-from-Motion Revisited", CVPR
// 2016): a folder with the files cameras, images and points3D, as text (.txt) or binary (.bin).
//
// Pixels here follow COLMAP's convention: the centre of the top-left pixel is (0.5, 0.5), half a
// pixel more than everywhere else in Lararium. The camera axes are the same as ours.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::train {

enum class ColmapFormat { kText, kBinary };

// COLMAP's camera models with their ids in COLMAP. Comments list the parameters.
enum class ColmapCameraModel : int32_t {
  kSimplePinhole = 0,  // f, cx, cy
  kPinhole = 1,        // fx, fy, cx, cy
  kSimpleRadial = 2,   // f, cx, cy, k
  kRadial = 3,         // f, cx, cy, k1, k2
  kOpenCv = 4,         // fx, fy, cx, cy, k1, k2, p1, p2
  kOpenCvFisheye = 5,
  kFullOpenCv = 6,  // fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6
  kFov = 7,
  kSimpleRadialFisheye = 8,
  kRadialFisheye = 9,
  kThinPrismFisheye = 10,
  kRadTanThinPrismFisheye = 11,
  kSimpleDivision = 12,
  kDivision = 13,
  kSimpleFisheye = 14,
  kFisheye = 15,
  kEucm = 16,
  kEquirectangular = 17,
};
inline constexpr int kColmapCameraModels = 18;

// The name in text files, such as "SIMPLE_PINHOLE".
std::string_view Name(ColmapCameraModel model);
size_t ParameterCount(ColmapCameraModel model);

struct ColmapCamera {
  uint32_t id = 0;
  ColmapCameraModel model = ColmapCameraModel::kPinhole;
  uint64_t width = 0;
  uint64_t height = 0;
  std::vector<double> parameters;
};

// A feature of an image.
struct ColmapFeature {
  static constexpr uint64_t kNoPoint = std::numeric_limits<uint64_t>::max();
  double x = 0.0;
  double y = 0.0;
  uint64_t point = kNoPoint;  // Id of the point that the feature shows.
};

struct ColmapImage {
  uint32_t id = 0;
  geometry::Rigid3 camera_from_map;
  uint32_t camera = 0;  // Id of the camera.
  std::string name;     // Path relative to the image folder.
  std::vector<ColmapFeature> features;
};

// A feature that shows a point.
struct ColmapObservation {
  uint32_t image = 0;    // Id of the image.
  uint32_t feature = 0;  // Index into ColmapImage::features.
};

struct ColmapPoint {
  uint64_t id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<uint8_t, 3> colour = {0, 0, 0};  // sRGB; black if it was not extracted.
  double error = 0.0;  // Mean reprojection error, pixels; negative if unknown.
  std::vector<ColmapObservation> observations;
};

// A model. All three lists are sorted by id.
struct ColmapModel {
  std::vector<ColmapCamera> cameras;
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint> points;
  std::vector<std::string> notes;  // Lists what was repaired (colmap_repair.h).

  // Checks that ids are sorted and unique, references exist, features and points refer to each
  // other, numbers are finite, and rotations have unit length. The error says what is wrong.
  Status Validate() const;
};

// Converts to our camera model. If that cannot express the camera, the error names the model and
// says what to do.
Result<geometry::CameraModel> CameraFromColmap(const ColmapCamera& camera);
// Converts to the simplest COLMAP model that can express the camera.
ColmapCamera ColmapFromCamera(const geometry::CameraModel& camera, uint32_t id);

// The contents of the three files of a model.
struct ColmapFiles {
  std::string cameras;
  std::string images;
  std::string points;
};

// Parses a model that passes Validate(), or fails. Rotations whose length differs from 1 by
// rounding are normalised, and references between images and points are repaired. place names the
// folder in errors.
Result<ColmapModel> ParseColmapModel(const ColmapFiles& files,
                                     ColmapFormat format,
                                     const std::string& where);
// Deterministic: the same model gives the same bytes, and parsing them gives the same model.
ColmapFiles SerializeColmapModel(const ColmapModel& model, ColmapFormat format);

// Loads the binary files if the folder has both forms.
Result<ColmapModel> LoadColmapModel(const std::filesystem::path& folder);

}  // namespace lararium::train
