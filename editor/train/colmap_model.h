#pragma once

// A sparse model as COLMAP stores it (Schoenberger & Frahm, "Structure-from-
// Motion Revisited", CVPR 2016): a folder with cameras, images and points3D, as
// text (.txt) or binary (.bin).
//
// Pixels here are COLMAP's: the centre of the top-left pixel is (0.5, 0.5), half
// a pixel more than everywhere else in Lararium. Camera axes are ours.

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

// COLMAP's camera models, by its numbers.
enum class ColmapCameraModel : int32_t {
  kSimplePinhole = 0,  // f, cx, cy
  kPinhole = 1,        // fx, fy, cx, cy
  kSimpleRadial = 2,   // f, cx, cy, k
  kRadial = 3,         // f, cx, cy, k1, k2
  kOpenCv = 4,         // fx, fy, cx, cy, k1, k2, p1, p2
  kOpenCvFisheye = 5,
  kFullOpenCv = 6,
  kFov = 7,
  kSimpleRadialFisheye = 8,
  kRadialFisheye = 9,
  kThinPrismFisheye = 10,
};
inline constexpr int kColmapCameraModels = 11;

// As text files call it, "SIMPLE_PINHOLE".
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
  uint64_t point = kNoPoint;  // id of the point that it shows
};

struct ColmapImage {
  uint32_t id = 0;
  geometry::Rigid3 camera_from_map;
  uint32_t camera = 0;  // id
  std::string name;     // path relative to the image folder
  std::vector<ColmapFeature> features;
};

// A feature that shows a point.
struct ColmapSight {
  uint32_t image = 0;    // id
  uint32_t feature = 0;  // index in ColmapImage::features
};

struct ColmapPoint {
  uint64_t id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<uint8_t, 3> colour = {0, 0, 0};  // sRGB; black where it was not extracted
  double error = 0.0;                         // mean over its sights, pixels; negative: unknown
  std::vector<ColmapSight> sights;
};

// Sorted by id.
struct ColmapModel {
  std::vector<ColmapCamera> cameras;
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint> points;

  // Ids are sorted and unique, references exist, features and points refer to
  // each other, numbers are finite, rotations have unit length; says what is not so.
  Status Validate() const;
};

// Our camera model. An error names a model that it cannot express, and the way out.
Result<geometry::CameraModel> CameraFromColmap(const ColmapCamera& camera);
// The simplest model that holds all of camera.
ColmapCamera ColmapFromCamera(const geometry::CameraModel& camera, uint32_t id);

// The contents of the three files of a model.
struct ColmapFiles {
  std::string cameras;
  std::string images;
  std::string points;
};

// Never a partial model: everything that Validate() says holds. Rotations that
// are off unit length by rounding are normalised. place: what errors call the folder.
Result<ColmapModel> ParseColmapModel(const ColmapFiles& files,
                                     ColmapFormat format,
                                     const std::string& place);
// The same model gives the same bytes; parsing them gives the same model.
ColmapFiles SerializeColmapModel(const ColmapModel& model, ColmapFormat format);

// Binary files are preferred where a folder has both.
Result<ColmapModel> LoadColmapModel(const std::filesystem::path& folder);

}  // namespace lararium::train
